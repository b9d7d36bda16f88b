//! Who may ask: requests to a name of ours, from a page of ours, with the token.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};

use hyper::header::{
    AUTHORIZATION, COOKIE, HOST, HeaderMap, HeaderName, HeaderValue, ORIGIN, ToStrError,
};
use hyper::http::uri::Authority;
use hyper::{Request, StatusCode};

use crate::refusal::Refusal;
use crate::token::Token;

/// Who may ask.
pub(crate) struct Access {
    token: Token,
    address: SocketAddr,
    /// Further names of the server, as those of a tunnel.
    names: Vec<String>,
    cookie: String,
    /// The value of the cookie, from which nobody finds the token.
    secret: Token,
}

/// The key of the token in the first address.
const QUERY: &str = "token=";

impl Access {
    /// * `token`, `secret`: of the first address, and of the cookie
    pub(crate) fn new([token, secret]: [Token; 2], address: SocketAddr, names: &[String]) -> Self {
        let name = |name: &String| match name.parse::<Ipv6Addr>() {
            Ok(ip) => format!("[{ip}]"),
            Err(_) => name.to_ascii_lowercase(),
        };
        let names = names.iter().map(name).collect();
        // Cookies of a host are sent to all its ports: servers side by side need names of their own.
        Self { token, address, names, cookie: format!("grouser-{}", address.port()), secret }
    }

    /// The first address of the page, with the token.
    pub(crate) fn url(&self) -> String {
        let host = match self.address.ip() {
            IpAddr::V4(ip) if ip.is_unspecified() => Ipv4Addr::LOCALHOST.into(),
            // Some systems take connections of the elder kind at `::`, and some do not.
            IpAddr::V6(ip) if ip.is_unspecified() => Ipv6Addr::LOCALHOST.into(),
            ip => ip,
        };
        let address = SocketAddr::new(host, self.address.port());
        format!("http://{address}/?{QUERY}{}", self.token.text())
    }

    /// The cookie that stands for the token from the first address on.
    pub(crate) fn set_cookie(&self) -> String {
        format!("{}={}; HttpOnly; SameSite=Strict; Path=/", self.cookie, self.secret.text())
    }

    /// Checks that a request is to a name of ours. A name that somebody else's server resolved to
    /// this machine is none.
    pub(crate) fn check_host<B>(&self, request: &Request<B>) -> Result<(), Refusal> {
        let host = only(request.headers(), &HOST);
        let authority = request.uri().authority().map(Authority::as_str);
        let is_own = |host: &str| self.is_own(host);
        if matches!(host, Ok(Some(host)) if is_own(host)) && authority.is_none_or(is_own) {
            return Ok(());
        }
        let message = "this is not an address of this server: it answers on the loopback, and to \
                       names that it was started with";
        Err(Refusal::new(StatusCode::FORBIDDEN, message))
    }

    /// Checks that a request has the token: as a cookie, as a header, or in the first address.
    pub(crate) fn check_token<B>(&self, request: &Request<B>) -> Result<(), Refusal> {
        let headers = request.headers();
        let is_first = || request.uri().path() == "/" && self.is_first(request.uri().query());
        if self.has_cookie(headers) || self.has_header(headers) || is_first() {
            return Ok(());
        }
        let message = "the token is missing: open the whole address that was printed when the \
                       server was started";
        Err(Refusal::new(StatusCode::UNAUTHORIZED, message))
    }

    /// Checks that a question comes from a page of ours. What is no browser names no origin.
    pub(crate) fn check_origin(&self, headers: &HeaderMap) -> Result<(), Refusal> {
        const SITE: HeaderName = HeaderName::from_static("sec-fetch-site");
        let is_own = |origin: &str| {
            let host = origin.strip_prefix("http://").or_else(|| origin.strip_prefix("https://"));
            host.is_some_and(|host| self.is_own(host))
        };
        let is_same = |site: &str| matches!(site, "same-origin" | "none");
        if only(headers, &ORIGIN).is_ok_and(|it| it.is_none_or(is_own))
            && only(headers, &SITE).is_ok_and(|it| it.is_none_or(is_same))
        {
            return Ok(());
        }
        Err(Refusal::new(StatusCode::FORBIDDEN, "this question comes from another page than ours"))
    }

    /// Whether a host, with its port, is a name of the server.
    fn is_own(&self, host: &str) -> bool {
        let host = host.to_ascii_lowercase();
        let (name, port) = match host.rsplit_once(':') {
            Some((name, port)) if !port.ends_with(']') => (name, port.parse().ok()),
            _ => (&*host, Some(80)),
        };
        // A tunnel has a port of its own.
        if self.names.iter().any(|own| own == name) && port.is_some() {
            return true;
        }
        if port != Some(self.address.port()) {
            return false;
        }
        let in_brackets = name.strip_prefix('[').and_then(|name| name.strip_suffix(']'));
        let ip = match in_brackets {
            Some(name) => name.parse().map(IpAddr::V6),
            None => name.parse().map(IpAddr::V4),
        };
        match ip {
            // Nobody's server of names resolves a number.
            Ok(ip) => {
                let own = self.address.ip();
                ip.is_loopback() || ip == own || own.is_unspecified()
            }
            Err(_) => name == "localhost",
        }
    }

    fn is_first(&self, query: Option<&str>) -> bool {
        let mut parts = query.unwrap_or_default().split('&');
        parts.any(|part| part.strip_prefix(QUERY).is_some_and(|token| self.token.is(token)))
    }

    fn has_cookie(&self, headers: &HeaderMap) -> bool {
        let all = headers.get_all(COOKIE).iter().filter_map(|it| it.to_str().ok());
        let mut pairs = all.flat_map(|it| it.split(';')).filter_map(|it| it.trim().split_once('='));
        pairs.any(|(name, token)| name == self.cookie && self.secret.is(token))
    }

    fn has_header(&self, headers: &HeaderMap) -> bool {
        let given = only(headers, &AUTHORIZATION).ok().flatten();
        given.and_then(|it| it.strip_prefix("Bearer ")).is_some_and(|token| self.token.is(token))
    }
}

/// The value of a header, if it is there; an error if there are two, or it is no text: who reads the
/// first and who reads the last would not agree.
fn only<'h>(headers: &'h HeaderMap, name: &HeaderName) -> Result<Option<&'h str>, ()> {
    let mut all = headers.get_all(name).iter();
    let one = all.next().map(HeaderValue::to_str).transpose();
    if all.next().is_some() { Err(()) } else { one.map_err(|_: ToStrError| ()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn access(address: &str, names: &[&str]) -> Access {
        let names: Vec<String> = names.iter().map(|it| (*it).to_owned()).collect();
        let secrets = [(); 2].map(|()| Token::random().unwrap());
        Access::new(secrets, address.parse().unwrap(), &names)
    }

    #[test]
    fn names_are_ours_with_our_port_alone() {
        let on_loopback = access("127.0.0.1:4000", &[]);
        for own in ["127.0.0.1:4000", "localhost:4000", "LOCALHOST:4000", "[::1]:4000"] {
            assert!(on_loopback.is_own(own), "{own}");
        }
        for foreign in [
            "evil.example:4000",
            "localhost.evil.example:4000",
            "127.0.0.1:4001",
            "127.0.0.1",
            "localhost",
            "192.168.0.9:4000",
            "localhost:",
            "::1:4000",
            "[127.0.0.1]:4000",
            "[[::1]]:4000",
            "a@127.0.0.1:4000",
            ":4000",
            "",
        ] {
            assert!(!on_loopback.is_own(foreign), "{foreign}");
        }
    }

    #[test]
    fn other_names_are_those_that_were_given() {
        let tunnelled = access("127.0.0.1:4000", &["Rover.example"]);
        assert!(tunnelled.is_own("rover.example") && tunnelled.is_own("rover.example:8443"));
        assert!(!tunnelled.is_own("rover.example:x") && !tunnelled.is_own("a.rover.example"));
        let open = access("0.0.0.0:4000", &[]);
        assert!(open.is_own("192.168.0.9:4000") && !open.is_own("evil.example:4000"));
        let open = access("[::]:4000", &["::2"]);
        for own in ["[::1]:4000", "[fd00::7]:4000", "127.0.0.1:4000", "[::2]", "[::2]:8443"] {
            assert!(open.is_own(own), "{own}");
        }
        assert!(!open.is_own("evil.example:4000"));
        assert!(open.url().starts_with("http://[::1]:4000/"), "{}", open.url());
        let one = access("10.0.0.2:4000", &[]);
        assert!(one.is_own("10.0.0.2:4000") && !one.is_own("10.0.0.3:4000"));
    }

    #[test]
    fn the_first_address_has_the_token() {
        let access = access("0.0.0.0:4000", &[]);
        let url = access.url();
        let query = url.strip_prefix("http://127.0.0.1:4000/?").unwrap();
        assert!(access.is_first(Some(query)) && access.is_first(Some(&format!("a=b&{query}"))));
        assert!(!access.is_first(Some("token=")) && !access.is_first(None));
    }
}

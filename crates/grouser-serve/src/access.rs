//! Who may ask: requests to a name of ours, from a page of ours, with the token.

use std::net::{IpAddr, SocketAddr};

use hyper::header::{AUTHORIZATION, COOKIE, HOST, HeaderMap, HeaderName, ORIGIN};
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
}

/// The key of the token in the first address.
const QUERY: &str = "token=";

impl Access {
    pub(crate) fn new(token: Token, address: SocketAddr, names: &[String]) -> Self {
        let names = names.iter().map(|name| name.to_ascii_lowercase()).collect();
        // Cookies of a host are sent to all its ports: servers side by side need names of their own.
        Self { token, address, names, cookie: format!("grouser-{}", address.port()) }
    }

    /// The first address of the page, with the token.
    pub(crate) fn url(&self) -> String {
        let ip = self.address.ip();
        let host = if ip.is_unspecified() { IpAddr::from([127, 0, 0, 1]) } else { ip };
        let address = SocketAddr::new(host, self.address.port());
        format!("http://{address}/?{QUERY}{}", self.token.text())
    }

    /// The cookie that stands for the token from the first address on.
    pub(crate) fn set_cookie(&self) -> String {
        format!("{}={}; HttpOnly; SameSite=Strict; Path=/", self.cookie, self.token.text())
    }

    /// Checks that a request is to a name of ours. A name that somebody else's server resolved to
    /// this machine is none.
    pub(crate) fn check_host<B>(&self, request: &Request<B>) -> Result<(), Refusal> {
        let mut hosts = request.headers().get_all(HOST).iter();
        let host = hosts.next().and_then(|host| host.to_str().ok());
        let authority = request.uri().authority().map(Authority::as_str);
        let is_own = |host: &str| self.is_own(host);
        let is_allowed =
            hosts.next().is_none() && host.is_some_and(is_own) && authority.is_none_or(is_own);
        if is_allowed {
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
        let origin = headers.get(ORIGIN).map(|it| it.to_str().unwrap_or("null"));
        let is_own = |origin: &str| {
            let host = origin.strip_prefix("http://").or_else(|| origin.strip_prefix("https://"));
            host.is_some_and(|host| self.is_own(host))
        };
        let site = headers.get(SITE).map(|it| it.to_str().unwrap_or_default());
        let is_same = |site: &str| matches!(site, "same-origin" | "none");
        if origin.is_none_or(is_own) && site.is_none_or(is_same) {
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
        let name = name.trim_start_matches('[').trim_end_matches(']');
        match name.parse::<IpAddr>() {
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
        pairs.any(|(name, token)| name == self.cookie && self.token.is(token))
    }

    fn has_header(&self, headers: &HeaderMap) -> bool {
        let given = headers.get(AUTHORIZATION).and_then(|it| it.to_str().ok());
        given.and_then(|it| it.strip_prefix("Bearer ")).is_some_and(|token| self.token.is(token))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn access(address: &str, names: &[&str]) -> Access {
        let names: Vec<String> = names.iter().map(|it| (*it).to_owned()).collect();
        Access::new(Token::random().unwrap(), address.parse().unwrap(), &names)
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

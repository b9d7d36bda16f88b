//! Who may ask what.

use std::io::Write as _;
use std::net::{IpAddr, Ipv6Addr, TcpStream};
use std::time::{Duration, Instant};

use grouser_serve::{Limits, Server, Settings};

use crate::limits::head;
use crate::served::{Reply, Served};

/// A name of somebody else.
const EVIL: &str = "evil.example";

#[test]
fn a_foreign_host_is_refused_before_a_missing_token_and_that_before_an_unknown_path() {
    let server = Served::usual();
    let (port, token) = (server.port, &server.token);
    let own = format!("127.0.0.1:{port}");
    let status = |host: &str, path: &str, more: &str| {
        let request =
            format!("GET {path} HTTP/1.1\r\nHost: {host}\r\n{more}Connection: close\r\n\r\n");
        server.send(&request).status
    };
    let bearer = format!("Authorization: Bearer {token}\r\n");
    assert_eq!(status("evil.example", "/nothing", ""), 403);
    assert_eq!(status("evil.example", "/", &bearer), 403);
    assert_eq!(status(&own, "/nothing", ""), 401);
    assert_eq!(status(&own, "/nothing", &bearer), 404);
    assert_eq!(status(&own, "/", &bearer), 200);
    assert_eq!(status(&format!("localhost:{port}"), "/", &bearer), 200);
    // A name that was made to lead here, with our port: the token does not help.
    assert_eq!(status(&format!("evil.example:{port}"), "/", &bearer), 403);
    assert_eq!(status("127.0.0.1", "/", &bearer), 403);
}

#[test]
fn two_hosts_or_none_are_refused() {
    let server = Served::usual();
    let own = format!("127.0.0.1:{}", server.port);
    let two = format!("GET / HTTP/1.1\r\nHost: {own}\r\nHost: evil.example\r\n\r\n");
    assert!(matches!(server.send(&two).status, 400 | 403));
    let none = "GET / HTTP/1.1\r\nConnection: close\r\n\r\n";
    assert!(matches!(server.send(none).status, 400 | 403));
    let whole = format!("GET http://{EVIL}/ HTTP/1.1\r\nHost: {own}\r\nConnection: close\r\n\r\n");
    assert_eq!(server.send(&whole).status, 403);
}

#[test]
fn scripts_styles_and_data_ask_for_the_token_too() {
    let server = Served::usual();
    let own = format!("127.0.0.1:{}", server.port);
    let visit =
        format!("GET / HTTP/1.1\r\nHost: {own}\r\nAccept: text/html\r\nConnection: close\r\n\r\n");
    let locked = server.send(&visit);
    assert_eq!(locked.status, 401);
    assert!(locked.body.contains("The token is missing") && !locked.body.contains(&server.token));
    assert!(!locked.head.to_ascii_lowercase().contains("set-cookie"), "{}", locked.head);
    for path in ["/main.js", "/page.css", "/api/presets", "/api/documents", "/"] {
        let bare = format!("GET {path} HTTP/1.1\r\nHost: {own}\r\nConnection: close\r\n\r\n");
        assert_eq!(server.send(&bare).status, 401, "{path}");
        assert_eq!(server.ask("GET", path, "", "").status, 200, "{path}");
    }
    // The token in the address opens the page alone.
    let script = format!(
        "GET /main.js?token={} HTTP/1.1\r\nHost: {own}\r\nConnection: close\r\n\r\n",
        server.token
    );
    assert_eq!(server.send(&script).status, 401);
}

#[test]
fn the_first_address_sets_a_cookie_that_is_not_the_token() {
    let server = Served::usual();
    let (port, token) = (server.port, &server.token);
    let first = format!(
        "GET /?token={token} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n"
    );
    let reply = server.send(&first);
    assert_eq!(reply.status, 200);
    let cookie = reply.head.lines().find_map(|line| line.strip_prefix("set-cookie: ")).unwrap();
    let (named, kept) = cookie.split_once("; ").unwrap();
    assert_eq!(kept, "httponly; samesite=strict; path=/");
    let secret = named.strip_prefix(&format!("grouser-{port}=")).unwrap();
    assert!(secret.len() == 32 && secret != token);
    let with = |cookie: &str| {
        server.send(&format!(
            "GET /main.js HTTP/1.1\r\nHost: localhost:{port}\r\nCookie: {cookie}\r\nConnection: \
             close\r\n\r\n"
        ))
    };
    assert_eq!(with(&format!("a=b; grouser-{port}={secret}")).status, 200);
    assert_eq!(with(&format!("grouser-{}={secret}", port ^ 1)).status, 401);
    // Neither stands for the other.
    assert_eq!(with(&format!("grouser-{port}={token}")).status, 401);
    let bearer = format!(
        "GET / HTTP/1.1\r\nHost: localhost:{port}\r\nAuthorization: Bearer {secret}\r\n\
         Connection: close\r\n\r\n"
    );
    assert_eq!(server.send(&bearer).status, 401);
    assert_eq!(with(&format!("grouser-{port}={}", "0".repeat(32))).status, 401);
    assert_eq!(with(&format!("grouser-{port}=")).status, 401);
}

#[test]
fn questions_of_other_pages_are_refused() {
    let server = Served::usual();
    let port = server.port;
    let asked = |more: &str| server.ask("POST", "/api/stand", more, "{}").status;
    assert_eq!(asked(""), 200);
    assert_eq!(asked(&format!("Origin: http://localhost:{port}\r\n")), 200);
    assert_eq!(asked(&format!("Origin: http://{EVIL}\r\n")), 403);
    assert_eq!(asked("Origin: null\r\n"), 403);
    assert_eq!(asked(&format!("Origin: http://localhost:{}\r\n", port ^ 1)), 403);
    let own = format!("Origin: http://localhost:{port}\r\n");
    for two in [format!("{own}Origin: http://{EVIL}\r\n"), format!("{own}{own}")] {
        assert_eq!(asked(&two), 403, "{two}");
    }
    assert_eq!(asked("Sec-Fetch-Site: same-origin\r\nSec-Fetch-Site: cross-site\r\n"), 403);
    assert_eq!(asked("Sec-Fetch-Site: cross-site\r\n"), 403);
    assert_eq!(asked("Sec-Fetch-Site: same-origin\r\n"), 200);
}

#[test]
fn methods_and_types_are_those_of_the_path() {
    let server = Served::usual();
    assert_eq!(server.ask("GET", "/api/heading", "", "").status, 405);
    assert_eq!(server.ask("POST", "/api/presets", "", "{}").status, 405);
    assert_eq!(server.ask("DELETE", "/", "", "").status, 405);
    let head = server.ask("HEAD", "/main.js", "", "");
    assert_eq!((head.status, head.body.as_str()), (200, ""));
    let form = format!(
        "POST /api/stand HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nAuthorization: Bearer {}\r\n\
         Content-Type: text/plain\r\nContent-Length: 2\r\nConnection: close\r\n\r\n{{}}",
        server.port, server.token
    );
    assert_eq!(server.send(&form).status, 415);
}

/// Also of what is answered before there is a request.
#[test]
fn every_response_keeps_others_out() {
    let limits =
        Limits { connections: 1, head_time: Duration::from_millis(300), ..Limits::default() };
    let server = Served::start(&Settings { limits, ..Settings::default() });
    let foreign = "GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n";
    let refused = server.send(foreign);
    let large = format!("GET / HTTP/1.1\r\nHost: a\r\nX: {}\r\n\r\n", "x".repeat(100_000));
    let [large, many, long, no_http] = [
        large,
        format!("GET / HTTP/1.1\r\nHost: a\r\n{}\r\n", "X: y\r\n".repeat(100)),
        format!("GET /{} HTTP/1.1\r\nHost: a\r\n\r\n", "x".repeat(70_000)),
        "no http at all\r\n\r\n".to_owned(),
    ]
    .map(|request| once_free(|| server.send(&request)));
    let half = once_free(|| server.send("GET / HTTP/1.1\r\nHost: "));
    // One that has begun to ask keeps its place.
    let mut open = server.connect();
    open.write_all(head(&server, "Content-Length: 100").as_bytes()).unwrap();
    std::thread::sleep(Duration::from_millis(100));
    let full = server.send(foreign);
    let is = |reply: &Reply, status: u16| assert_eq!(reply.status, status, "{reply:?}");
    for (reply, status) in
        [(&full, 503), (&half, 408), (&large, 431), (&many, 431), (&no_http, 400)]
    {
        is(reply, status);
        let error: serde_json::Value = serde_json::from_str(&reply.body).unwrap();
        assert_eq!(error["schema"], "grouser.error.v1");
    }
    assert!(matches!(long.status, 414 | 431), "{long:?}");
    let server = Served::usual();
    let [page, answer] =
        [server.ask("GET", "/", "", ""), server.ask("POST", "/api/stand", "", "{}")];
    for reply in [refused, large, many, long, no_http, half, full, page, answer] {
        for header in [
            "content-security-policy: default-src 'none'; script-src 'self'",
            "x-content-type-options: nosniff",
            "x-frame-options: deny",
            "referrer-policy: no-referrer",
            "cache-control: no-store",
            "cross-origin-resource-policy: same-origin",
        ] {
            assert!(reply.head.contains(header), "{header} is not in {}", reply.head);
        }
    }
}

/// What is answered once the only place is free again.
fn once_free(ask: impl Fn() -> Reply) -> Reply {
    let until = Instant::now() + Duration::from_secs(10);
    loop {
        let reply = ask();
        if reply.status != 503 || Instant::now() > until {
            return reply;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// An address of the newer kind is printed and answered to, as is that of any of its machine.
#[test]
fn addresses_of_the_newer_kind_are_answered_to() {
    for ip in [Ipv6Addr::LOCALHOST, Ipv6Addr::UNSPECIFIED] {
        let settings = Settings { address: ip.into(), ..Settings::default() };
        // Some machines have none.
        let Ok(server) = Server::bind(&settings) else { return };
        drop(server);
        let server = Served::start(&settings);
        let (port, token) = (server.port, &server.token);
        assert!(server.url.starts_with(&format!("http://[::1]:{port}/?token=")), "{}", server.url);
        let asked = |host: &str| {
            let stream = TcpStream::connect((IpAddr::from(Ipv6Addr::LOCALHOST), port)).unwrap();
            Served::send_on(
                stream,
                &format!(
                    "GET / HTTP/1.1\r\nHost: {host}\r\nAuthorization: Bearer {token}\r\n\
                     Connection: close\r\n\r\n"
                ),
            )
            .status
        };
        assert_eq!(asked(&format!("[::1]:{port}")), 200);
        assert_eq!(asked(&format!("localhost:{port}")), 200);
        assert_eq!(asked(&format!("evil.example:{port}")), 403);
        assert_eq!(asked(&format!("::1:{port}")), 403);
        let of_machine = if ip.is_unspecified() { 200 } else { 403 };
        assert_eq!(asked(&format!("[fd00::7]:{port}")), of_machine);
    }
}

/// The address stands on no command line: a file that its user alone can read leads to it.
#[test]
fn a_browser_is_opened_with_a_private_file() {
    let server = Server::bind(&Settings::default()).unwrap();
    let page = server.browser_page().unwrap();
    let path = page.path().to_owned();
    assert!(std::fs::read_to_string(&path).unwrap().contains(&server.address()));
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        assert_eq!(std::fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o600);
    }
    drop(page);
    assert!(!path.exists());
}

#[test]
fn a_tunnel_has_the_name_that_was_given() {
    let settings = Settings { hosts: vec!["rover.example".to_owned()], ..Settings::default() };
    let server = Served::start(&settings);
    let asked = |host: &str| {
        let token = &server.token;
        server.send(&format!(
            "GET / HTTP/1.1\r\nHost: {host}\r\nAuthorization: Bearer {token}\r\nConnection: \
             close\r\n\r\n"
        ))
    };
    assert_eq!(asked("rover.example").status, 200);
    assert_eq!(asked("other.example").status, 403);
}

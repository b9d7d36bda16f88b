//! Who may ask what.

use grouser_serve::Settings;

use crate::served::Served;

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
fn the_first_address_sets_a_cookie_that_stands_for_the_token() {
    let server = Served::usual();
    let (port, token) = (server.port, &server.token);
    let first = format!(
        "GET /?token={token} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n"
    );
    let reply = server.send(&first);
    assert_eq!(reply.status, 200);
    let cookie = reply.head.lines().find_map(|line| line.strip_prefix("set-cookie: ")).unwrap();
    assert_eq!(cookie, format!("grouser-{port}={token}; httponly; samesite=strict; path=/"));
    let with = |cookie: &str| {
        server.send(&format!(
            "GET /main.js HTTP/1.1\r\nHost: localhost:{port}\r\nCookie: {cookie}\r\nConnection: \
             close\r\n\r\n"
        ))
    };
    assert_eq!(with(&format!("a=b; grouser-{port}={token}")).status, 200);
    assert_eq!(with(&format!("grouser-{}={token}", port ^ 1)).status, 401);
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

#[test]
fn every_response_keeps_others_out() {
    let server = Served::usual();
    let refused = server.send("GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n");
    for reply in
        [refused, server.ask("GET", "/", "", ""), server.ask("POST", "/api/stand", "", "{}")]
    {
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

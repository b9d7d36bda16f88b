//! A server on a thread of its own, and a client that writes and reads bytes.

use std::io::{Read as _, Write as _};
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use grouser_serve::{Server, Settings};
use serde_json::Value;

/// A server that ends with this.
pub(crate) struct Served {
    pub(crate) port: u16,
    pub(crate) token: String,
    pub(crate) url: String,
    has_ended: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

/// A response.
#[derive(Debug)]
pub(crate) struct Reply {
    pub(crate) status: u16,
    pub(crate) head: String,
    pub(crate) body: String,
}

impl Served {
    pub(crate) fn start(settings: &Settings) -> Self {
        let server = Server::bind(settings).unwrap();
        let (port, url) = (server.port(), server.address());
        let token = url.split_once("token=").unwrap().1.to_owned();
        let has_ended = Arc::new(AtomicBool::new(false));
        let ended = Arc::clone(&has_ended);
        let run = move || server.run(|| ended.load(Ordering::Relaxed)).unwrap();
        Self { port, token, url, has_ended, thread: Some(std::thread::spawn(run)) }
    }

    /// A server of presets, with the usual limits.
    pub(crate) fn usual() -> Self {
        Self::start(&Settings::default())
    }

    pub(crate) fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        stream
    }

    /// Asks a question whose answer is left to be read.
    pub(crate) fn begin(&self, question: &str, body: &Value) -> TcpStream {
        let mut stream = self.connect();
        let request = self.request("POST", &format!("/api/{question}"), "", &body.to_string());
        stream.write_all(request.as_bytes()).unwrap();
        stream
    }

    /// Sends the bytes of a request, and reads until the server has nothing more to say.
    pub(crate) fn send(&self, request: &str) -> Reply {
        Self::send_on(self.connect(), request)
    }

    /// The same on a connection that is there.
    pub(crate) fn send_on(mut stream: TcpStream, request: &str) -> Reply {
        // What is refused before its end may not be read to it.
        let _ = stream.write_all(request.as_bytes());
        Reply::read(stream)
    }

    /// A request with all that it needs.
    ///
    /// * `more`: further headers, each with its line end
    pub(crate) fn request(&self, method: &str, path: &str, more: &str, body: &str) -> String {
        let Self { port, token, .. } = self;
        let kind = if body.is_empty() { "" } else { "Content-Type: application/json\r\n" };
        let length = body.len();
        format!(
            "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nAuthorization: Bearer {token}\r\n\
             Content-Length: {length}\r\n{kind}{more}Connection: close\r\n\r\n{body}"
        )
    }

    /// Sends such a request, and reads its answer.
    pub(crate) fn ask(&self, method: &str, path: &str, more: &str, body: &str) -> Reply {
        self.send(&self.request(method, path, more, body))
    }

    pub(crate) fn post(&self, question: &str, body: &Value) -> Reply {
        self.ask("POST", &format!("/api/{question}"), "", &body.to_string())
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.has_ended.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let ended = thread.join();
            assert!(std::thread::panicking() || ended.is_ok(), "the server failed");
        }
    }
}

impl Reply {
    pub(crate) fn read(mut stream: TcpStream) -> Self {
        let mut bytes = Vec::new();
        let _ = stream.read_to_end(&mut bytes);
        let _ = stream.shutdown(Shutdown::Both);
        let text = String::from_utf8(bytes).unwrap();
        let (head, body) = text.split_once("\r\n\r\n").unwrap_or((&text, ""));
        let status = head.split(' ').nth(1).and_then(|it| it.parse().ok()).unwrap_or(0);
        let is_chunked = head.to_ascii_lowercase().contains("transfer-encoding: chunked");
        let body = if is_chunked { dechunked(body) } else { body.to_owned() };
        Self { status, head: head.to_ascii_lowercase(), body }
    }

    /// The lines of the body.
    pub(crate) fn lines(&self) -> Vec<Value> {
        self.body.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }
}

fn dechunked(mut rest: &str) -> String {
    let mut body = String::new();
    while let Some((size, after)) = rest.split_once("\r\n") {
        let size = usize::from_str_radix(size, 16).unwrap();
        if size == 0 {
            return body;
        }
        body.push_str(&after[..size]);
        rest = &after[size + 2..];
    }
    body
}

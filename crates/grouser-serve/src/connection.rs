//! Connections: a bounded number, each with little time to ask and to read its answer.

use std::convert::Infallible;
use std::io;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};
use std::time::Duration;

use hyper::StatusCode;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;
use tokio::time::{Instant, Sleep, sleep, timeout};

use crate::console::Console;
use crate::refusal::Refusal;
use crate::routes;

/// Bytes of the head of a request.
const HEAD: usize = 16 << 10;
/// Headers of a request.
const HEADERS: usize = 64;

/// Takes connections until it is to end.
pub(crate) async fn accept_all(
    listener: &TcpListener,
    console: &Arc<Console>,
    look: Duration,
    should_end: impl Fn() -> bool,
) {
    let places = Arc::new(Semaphore::new(console.limits.connections));
    while !should_end() {
        let stream = match timeout(look, listener.accept()).await {
            Err(_) => continue,
            Ok(Ok((stream, _))) => stream,
            // Such as too many open files: some may be closed soon.
            Ok(Err(_)) => {
                sleep(look).await;
                continue;
            }
        };
        match Arc::clone(&places).try_acquire_owned() {
            Ok(place) => {
                let console = Arc::clone(console);
                drop(tokio::spawn(async move {
                    serve(stream, &console).await;
                    drop(place);
                }));
            }
            Err(_) => refuse(&stream),
        }
    }
}

/// Answers the requests of a connection, one after another.
async fn serve(stream: TcpStream, console: &Arc<Console>) {
    let limits = &console.limits;
    // Lines of an answer are small, and wanted at once.
    drop(stream.set_nodelay(true));
    let service = service_fn(|request| {
        let console = Arc::clone(console);
        async move { Ok::<_, Infallible>(routes::respond(&console, request).await) }
    });
    let mut connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(limits.head_time)
        .max_buf_size(HEAD)
        .max_headers(HEADERS)
        .serve_connection(TokioIo::new(Patient::new(stream, limits.write_time)), service);
    let ended = (&mut connection).await;
    if ended.is_err_and(|error| error.is_timeout()) {
        let stream = connection.into_parts().io.into_inner().stream;
        let message = "the request did not come in time";
        let _ = stream.try_write(&bare(StatusCode::REQUEST_TIMEOUT, message));
    }
}

/// Says that there are too many connections, to who is one more.
fn refuse(stream: &TcpStream) {
    let message = "too many connections are open: close a page, or wait";
    // What does not take it at once gets nothing.
    let _ = stream.try_write(&bare(StatusCode::SERVICE_UNAVAILABLE, message));
    // Unread bytes would take the answer back.
    let _ = stream.try_read(&mut [0; HEAD]);
}

/// A whole answer outside of a connection that is served.
fn bare(status: StatusCode, message: &str) -> Vec<u8> {
    let body = format!("{}\n", Refusal::new(status, message).to_json());
    let length = body.len();
    format!(
        "HTTP/1.1 {status}\r\ncontent-type: application/json\r\ncontent-length: {length}\r\n\
         connection: close\r\ncache-control: no-store\r\n\r\n{body}"
    )
    .into_bytes()
}

/// A stream whose reader has some time to take more, and has gone if it does not.
struct Patient {
    stream: TcpStream,
    patience: Duration,
    /// Runs while something waits to be taken.
    waits: Option<Pin<Box<Sleep>>>,
}

impl Patient {
    fn new(stream: TcpStream, patience: Duration) -> Self {
        Self { stream, patience, waits: None }
    }

    /// What a write came to, unless nothing was taken for too long.
    fn timed<T>(
        &mut self,
        context: &mut Context<'_>,
        written: Poll<io::Result<T>>,
    ) -> Poll<io::Result<T>> {
        if written.is_ready() {
            self.waits = None;
            return written;
        }
        let until = Instant::now() + self.patience;
        let waits = self.waits.get_or_insert_with(|| Box::pin(tokio::time::sleep_until(until)));
        waits.as_mut().poll(context).map(|()| Err(io::ErrorKind::TimedOut.into()))
    }
}

impl AsyncRead for Patient {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(context, buffer)
    }
}

impl AsyncWrite for Patient {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let written = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.timed(context, written)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        parts: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let written = Pin::new(&mut self.stream).poll_write_vectored(context, parts);
        self.timed(context, written)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        let flushed = Pin::new(&mut self.stream).poll_flush(context);
        self.timed(context, flushed)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}

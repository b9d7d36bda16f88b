//! Connections: a bounded number, each with little time to ask and to read its answer.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::fmt::Write as _;
use std::future::{Future as _, poll_fn};
use std::io;
use std::pin::{Pin, pin};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll};
use std::time::Duration;

use hyper::StatusCode;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::io::{AsyncRead, AsyncWrite, Interest, ReadBuf};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{Notify, Semaphore};
use tokio::time::{Instant, Sleep, sleep, timeout};

use crate::limits::Limits;
use crate::refusal::Refusal;
use crate::routes::{self, PROTECTION};
use crate::shared::Shared;

/// Bytes of the head of a request.
const HEAD: usize = 16 << 10;
/// Headers of a request.
const HEADERS: usize = 64;

/// Takes connections until it is to end.
pub(crate) async fn accept_all(
    listener: &TcpListener,
    shared: &Arc<Shared>,
    look: Duration,
    should_end: impl Fn() -> bool,
) {
    let places = Arc::new(Semaphore::new(shared.limits.connections));
    let silent = Arc::new(Silent::default());
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
        let mut place = Arc::clone(&places).try_acquire_owned().ok();
        if place.is_none() && silent.end_oldest() {
            place =
                timeout(look, Arc::clone(&places).acquire_owned()).await.ok().and_then(Result::ok);
        }
        match place {
            Some(place) => {
                let (shared, silent) = (Arc::clone(shared), Arc::clone(&silent));
                drop(tokio::spawn(async move {
                    serve(stream, &shared, &silent).await;
                    drop(place);
                }));
            }
            None => refuse(&stream),
        }
    }
}

/// Connections that have asked nothing yet: they make place for one more.
#[derive(Default)]
struct Silent(Mutex<Waiting>);

/// By their numbers, the oldest first, what ends each.
#[derive(Default)]
struct Waiting {
    next: u64,
    ends: BTreeMap<u64, Arc<Notify>>,
}

impl Silent {
    /// A connection's number, and what tells it to end.
    fn enter(&self) -> (u64, Arc<Notify>) {
        let end = Arc::new(Notify::new());
        let mut waiting = self.waiting();
        let number = waiting.next;
        waiting.next += 1;
        waiting.ends.insert(number, Arc::clone(&end));
        (number, end)
    }

    /// It asks, or has ended.
    fn leave(&self, number: u64) {
        self.waiting().ends.remove(&number);
    }

    /// Tells the oldest to end; whether there is one.
    fn end_oldest(&self) -> bool {
        let oldest = self.waiting().ends.pop_first();
        oldest.inspect(|(_, end)| end.notify_one()).is_some()
    }

    fn waiting(&self) -> MutexGuard<'_, Waiting> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Answers the requests of a connection, one after another, until the other side has closed it.
async fn serve(stream: TcpStream, shared: &Arc<Shared>, silent: &Arc<Silent>) {
    let limits = &shared.limits;
    // Lines of an answer are small, and wanted at once.
    drop(stream.set_nodelay(true));
    let Ok([stream, watched]) = twice(stream) else { return };
    let (number, end) = silent.enter();
    let has_asked = AtomicBool::new(false);
    let service = service_fn(|request| {
        silent.leave(number);
        has_asked.store(true, Ordering::Relaxed);
        let shared = Arc::clone(shared);
        async move { Ok::<_, Infallible>(routes::respond(&shared, request).await) }
    });
    let mut connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(limits.head_time)
        .max_buf_size(HEAD)
        .max_headers(HEADERS)
        .serve_connection(TokioIo::new(Patient::new(stream, limits)), service);
    let (mut closed, mut to_end) = (pin!(closed(&watched)), pin!(end.notified()));
    let ended = poll_fn(|context| match Pin::new(&mut connection).poll(context) {
        Poll::Pending
            if !has_asked.load(Ordering::Relaxed) && to_end.as_mut().poll(context).is_ready() =>
        {
            Poll::Ready(End::ForAnother)
        }
        Poll::Pending => closed.as_mut().poll(context).map(|()| End::Closed),
        Poll::Ready(Err(error)) if error.is_timeout() => Poll::Ready(End::TooLate),
        Poll::Ready(_) => Poll::Ready(End::Closed),
    });
    let ended = ended.await;
    silent.leave(number);
    let stream = || connection.into_parts().io.into_inner().stream;
    match ended {
        End::Closed => {}
        End::ForAnother => refuse(&stream()),
        End::TooLate => {
            let message = "the request did not come in time";
            let _ = stream().try_write(&bare(StatusCode::REQUEST_TIMEOUT, message));
        }
    }
}

/// Why a connection is not served any more.
enum End {
    Closed,
    /// It asked nothing, and another needs its place.
    ForAnother,
    TooLate,
}

/// Two handles of a connection: one is read and written, one watched.
fn twice(stream: TcpStream) -> io::Result<[TcpStream; 2]> {
    let stream = stream.into_std()?;
    let watched = TcpStream::from_std(stream.try_clone()?)?;
    Ok([TcpStream::from_std(stream)?, watched])
}

/// Waits until the other side has closed a connection. `hyper` does not see it behind a request that
/// waits for the one before it, which would be computed for nobody.
async fn closed(watched: &TcpStream) {
    while watched.ready(Interest::READABLE).await.is_ok_and(|it| !it.is_read_closed()) {
        // Nothing is read here: the next bytes, or the end, are waited for.
        let blocks = || Err::<(), _>(io::ErrorKind::WouldBlock.into());
        let _ = watched.try_io(Interest::READABLE, blocks);
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
    let mut answer = format!(
        "HTTP/1.1 {status}\r\ncontent-type: application/json\r\ncontent-length: {}\r\n\
         connection: close\r\n",
        body.len()
    );
    for (name, value) in &PROTECTION {
        let _ = write!(answer, "{name}: {value}\r\n");
    }
    (answer + "\r\n" + &body).into_bytes()
}

/// Our answer in place of what `hyper` says of a request that it cannot read, which has none of our
/// headers.
fn in_place_of(written: &[u8]) -> Option<Vec<u8>> {
    let status = written.strip_prefix(b"HTTP/1.")?.get(2..5)?;
    let status = StatusCode::from_bytes(status).ok().filter(StatusCode::is_client_error)?;
    let (own, _) = &PROTECTION[0];
    let is_own = written.windows(own.as_str().len()).any(|it| it == own.as_str().as_bytes());
    let message = match status {
        StatusCode::URI_TOO_LONG | StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE => {
            "the head of the request is too large"
        }
        _ => "this is no request of HTTP",
    };
    (!is_own).then(|| bare(status, message))
}

/// A stream whose reader has some time to take more, and has gone if it takes nothing or little.
struct Patient {
    stream: TcpStream,
    patience: Duration,
    /// What a reader takes at the least [bytes/s].
    slowest: u32,
    /// How long it was waited for the reader, less the time that its bytes may take.
    waited: Duration,
    /// Runs while something waits to be taken, since then.
    waits: Option<(Instant, Pin<Box<Sleep>>)>,
}

impl Patient {
    fn new(stream: TcpStream, limits: &Limits) -> Self {
        let &Limits { write_time: patience, slowest, .. } = limits;
        Self { stream, patience, slowest, waited: Duration::ZERO, waits: None }
    }

    /// What a write came to, unless too little was taken for too long.
    fn timed(
        &mut self,
        context: &mut Context<'_>,
        written: Poll<io::Result<usize>>,
    ) -> Poll<io::Result<usize>> {
        if let Poll::Ready(written) = written {
            self.waited += self.waits.take().map_or(Duration::ZERO, |(since, _)| since.elapsed());
            let bytes = written.as_ref().map_or(0, |bytes| *bytes as u64);
            self.waited = self.waited.saturating_sub(Duration::from_secs(bytes) / self.slowest);
            return Poll::Ready(written);
        }
        let (now, left) = (Instant::now(), self.patience.saturating_sub(self.waited));
        let (_, waits) =
            self.waits.get_or_insert_with(|| (now, Box::pin(tokio::time::sleep_until(now + left))));
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
        if let Some(answer) = in_place_of(bytes) {
            // It is the last that is written, and short.
            return Poll::Ready(self.stream.try_write(&answer).map(|_| bytes.len()));
        }
        let written = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.timed(context, written)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        parts: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        if let [only] = parts {
            return self.poll_write(context, only);
        }
        let written = Pin::new(&mut self.stream).poll_write_vectored(context, parts);
        self.timed(context, written)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}

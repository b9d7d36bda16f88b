//! Bodies of responses: whole ones, and lines that come one after another.

use std::convert::Infallible;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use bytes::Bytes;
use hyper::body::{Body as HttpBody, Frame, SizeHint};
use tokio::sync::OwnedSemaphorePermit;
use tokio::sync::mpsc::Receiver;

use crate::runs::{Place, Waiter};

/// The body of a response.
pub(crate) enum ReplyBody {
    /// All of it; nothing once it was sent.
    Whole(Option<Bytes>),
    /// The lines of an answer as they come. When it is dropped, because the last was sent or the
    /// reader has gone, nobody asks any more.
    Lines(AnswerLines),
}

/// A line, with what it takes of the memory for lines.
pub(crate) type SentLine = (Bytes, Option<OwnedSemaphorePermit>);

/// The lines of an answer.
pub(crate) struct AnswerLines {
    pub(crate) first: Option<SentLine>,
    pub(crate) rest: Receiver<SentLine>,
    /// The memory of the line which is being taken.
    pub(crate) taken: Option<OwnedSemaphorePermit>,
    pub(crate) _asking: Waiter,
    pub(crate) _place: Arc<Place>,
}

impl ReplyBody {
    pub(crate) fn whole(content: impl Into<Bytes>) -> Self {
        Self::Whole(Some(content.into()))
    }
}

impl AnswerLines {
    /// The next line. The one before it has been taken, but for some bytes.
    fn next(&mut self, context: &mut Context<'_>) -> Poll<Option<Bytes>> {
        self.taken = None;
        let next = match self.first.take() {
            Some(first) => Poll::Ready(Some(first)),
            None => self.rest.poll_recv(context),
        };
        next.map(|line| {
            let (bytes, room) = line?;
            self.taken = room;
            Some(bytes)
        })
    }
}

impl HttpBody for ReplyBody {
    type Data = Bytes;
    type Error = Infallible;

    fn poll_frame(
        self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Infallible>>> {
        let next = match self.get_mut() {
            Self::Whole(content) => Poll::Ready(content.take()),
            Self::Lines(lines) => lines.next(context),
        };
        next.map(|bytes| bytes.map(|bytes| Ok(Frame::data(bytes))))
    }

    fn is_end_stream(&self) -> bool {
        matches!(self, Self::Whole(None))
    }

    fn size_hint(&self) -> SizeHint {
        match self {
            Self::Whole(content) => {
                SizeHint::with_exact(content.as_ref().map_or(0, Bytes::len) as u64)
            }
            Self::Lines(_) => SizeHint::default(),
        }
    }
}

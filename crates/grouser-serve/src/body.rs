//! Bodies of responses: whole ones, and lines that come one after another.

use std::convert::Infallible;
use std::pin::Pin;
use std::task::{Context, Poll};

use bytes::Bytes;
use hyper::body::{Body as HttpBody, Frame, SizeHint};
use tokio::sync::mpsc::Receiver;

use crate::runs::Waiter;

/// The body of a response.
pub(crate) enum ReplyBody {
    /// All of it; nothing once it was sent.
    Whole(Option<Bytes>),
    /// The lines of an answer as they come. When it is dropped, because the last was sent or the
    /// reader has gone, nobody asks any more.
    Lines { first: Option<Bytes>, rest: Receiver<Bytes>, _asking: Waiter },
}

impl ReplyBody {
    pub(crate) fn whole(content: impl Into<Bytes>) -> Self {
        Self::Whole(Some(content.into()))
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
            Self::Lines { first: first @ Some(_), .. } => Poll::Ready(first.take()),
            Self::Lines { rest, .. } => rest.poll_recv(context),
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
            Self::Lines { .. } => SizeHint::default(),
        }
    }
}

//! What a call returns, and the text of a thread's last error.

use std::cell::RefCell;
use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};

use grouser_core::error::ParameterError;
use grouser_core::mission::MissionError;
use grouser_core::simulation::RunError;
use grouser_io::DocumentError;

/// What a call returns. Where it is not GROUSER_STATUS_OK, nothing was written through the call's
/// pointers, and grouser_last_error has a sentence.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The call did what it says.
    Ok = 0,
    /// A pointer is null that must not be.
    NullPointer = 1,
    /// A handle was freed, is of another kind, or never was one.
    BadHandle = 2,
    /// Another thread is in a call with the same run or mission.
    Busy = 3,
    /// An array is not as long as it must be, or a buffer is too short.
    WrongSize = 4,
    /// A number is NaN or infinite.
    NotFinite = 5,
    /// A number is outside its range, or numbers do not go together.
    OutOfRange = 6,
    /// A text is not UTF-8.
    NotUtf8 = 7,
    /// A document cannot be read; the text has line and column.
    Document = 8,
    /// A motion cannot be computed.
    Computation = 9,
    /// A state or a mission is of another scenario than the run.
    OtherScenario = 10,
    /// A bug in Grouser. The object of the call must be freed; others are as they were.
    Panic = 11,
}

/// Why a call failed.
pub(crate) struct Failure {
    status: Status,
    text: String,
}

impl Failure {
    pub(crate) fn new(status: Status, text: impl Into<String>) -> Self {
        Self { status, text: text.into() }
    }
}

impl From<DocumentError> for Failure {
    fn from(error: DocumentError) -> Self {
        Self::new(Status::Document, error.to_string())
    }
}

impl From<ParameterError> for Failure {
    fn from(error: ParameterError) -> Self {
        Self::new(Status::OutOfRange, error.to_string())
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Parameter(error) => error.into(),
            error => Self::new(Status::Computation, error.to_string()),
        }
    }
}

impl From<MissionError> for Failure {
    fn from(error: MissionError) -> Self {
        match error {
            MissionError::Run(error) => error.into(),
            MissionError::Plan(error) => Self::new(Status::Document, error.to_string()),
        }
    }
}

thread_local! {
    /// The text of the thread's last error, with its zero.
    static LAST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Does what a call does. This is the one place at which panics end and errors become codes.
///
/// A call that succeeds leaves the last error's text as it is, and so allocates nothing.
pub(crate) fn guarded(act: impl FnOnce() -> Result<(), Failure>) -> Status {
    let failure = match catch_unwind(AssertUnwindSafe(act)) {
        Ok(Ok(())) => return Status::Ok,
        Ok(Err(failure)) => failure,
        Err(panic) => {
            let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
            let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
            let text = text.unwrap_or_default();
            Failure::new(Status::Panic, format!("a bug in Grouser, please report it: {text}"))
        }
    };
    // A thread that is about to end has no text any more.
    let _ = LAST.try_with(|last| {
        let mut text = failure.text.into_bytes();
        text.retain(|byte| *byte != 0);
        text.push(0);
        last.replace(text);
    });
    failure.status
}

/// A sentence about the last call of this thread that failed; empty before one did. It is valid
/// until the next call of this thread that fails, and is not to be freed.
#[unsafe(no_mangle)]
pub extern "C" fn grouser_last_error() -> *const c_char {
    let pointer = LAST.try_with(|last| {
        let last = last.borrow();
        if last.is_empty() { c"".as_ptr() } else { last.as_ptr().cast() }
    });
    pointer.unwrap_or(c"".as_ptr())
}

/// The version of the library, such as "0.1.0"; not to be freed.
#[unsafe(no_mangle)]
pub extern "C" fn grouser_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    fn last() -> String {
        // SAFETY: the pointer is that of a text with its zero, of this thread, which makes no call
        // meanwhile.
        unsafe { CStr::from_ptr(grouser_last_error()) }.to_string_lossy().into_owned()
    }

    #[test]
    fn a_panic_becomes_a_code_with_its_text() {
        assert_eq!(last(), "");
        assert_eq!(guarded(|| panic!("nothing is {}", "left")), Status::Panic);
        assert_eq!(last(), "a bug in Grouser, please report it: nothing is left");
        assert_eq!(guarded(|| Ok(())), Status::Ok);
        assert_eq!(guarded(|| Err(Failure::new(Status::Busy, "a\0b"))), Status::Busy);
        assert_eq!(last(), "ab");
    }
}

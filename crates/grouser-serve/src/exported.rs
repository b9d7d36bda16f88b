//! The questions as functions of WebAssembly, for a page without a server.
//!
//! A script asks for `room`, writes the name of a question there and after it the question itself,
//! as JSON, and calls `ask`; that hands each line of the answer to the script's `take`, and on its
//! way asks the script's `go_on` whether to go on. A refusal is a line, too, and so is the message of
//! a panic, after which nothing may be asked any more.

use std::any::Any;
use std::cell::RefCell;
use std::panic;

use grouser::document::json;
use http::StatusCode;

use crate::api::{LISTS, QUESTIONS};
use crate::asked::GoOn;
use crate::console::Console;
use crate::folder::ServedFolder;
use crate::refusal::Refusal;

#[link(wasm_import_module = "page")]
#[expect(unsafe_code, reason = "a script has these functions")]
unsafe extern "C" {
    /// Takes a line; whether somebody reads on.
    safe fn take(line: *const u8, bytes: usize) -> u32;
    /// Whether to go on: asked before each sample.
    safe fn go_on() -> u32;
}

thread_local! {
    /// A question and its name, as the script writes them.
    static ASKED: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Room for a question with its name, until it is asked.
#[unsafe(no_mangle)]
#[expect(unsafe_code, reason = "a script calls it by this name")]
extern "C" fn room(bytes: usize) -> *mut u8 {
    ASKED.with_borrow_mut(|asked| {
        asked.clear();
        asked.resize(bytes, 0);
        asked.as_mut_ptr()
    })
}

/// Answers the question.
///
/// * `name`: how many bytes its name has
#[unsafe(no_mangle)]
#[expect(unsafe_code, reason = "a script calls it by this name")]
extern "C" fn ask(name: usize) {
    panic::set_hook(Box::new(|about| {
        send_refusal(&Refusal::fault(about));
    }));
    let asked = ASKED.take();
    let (name, question) = asked.split_at(name.min(asked.len()));
    if let Err(refusal) = answer(&String::from_utf8_lossy(name), question) {
        send_refusal(&refusal);
    }
}

fn answer(name: &str, question: &[u8]) -> Result<(), Refusal> {
    let console = Console { folder: ServedFolder::none() };
    if let Some((_, list)) = LISTS.iter().find(|(own, _)| *own == name) {
        send(list(&console).trim_end());
        return Ok(());
    }
    let (_, read) = QUESTIONS.iter().find(|(own, _)| *own == name).ok_or_else(|| {
        let message = format!("without the program there is no answer to {name}");
        Refusal::new(StatusCode::NOT_FOUND, message)
    })?;
    read(&console, question)?.answer(&AskedByScript, &|line| send(&line))
}

/// Hands a line to the script; whether somebody reads on.
fn send(line: &str) -> bool {
    take(line.as_ptr(), line.len()) != 0
}

fn send_refusal(refusal: &Refusal) -> bool {
    send(&json::line(&refusal.to_json()))
}

/// The script that asks. It asks one thing at a time, so that it is always its turn.
struct AskedByScript;

impl GoOn for AskedByScript {
    fn is_on(&self) -> bool {
        go_on() != 0
    }

    fn of_study(&self) -> Box<dyn GoOn> {
        Box::new(Self)
    }

    fn turn(&self) -> Option<Box<dyn Any>> {
        Some(Box::new(()))
    }
}

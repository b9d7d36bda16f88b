//! A guard around libraries that panic on damaged input.

use std::any::Any;
use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    static IS_GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Calls a library; where it panics that is an error with the panic's message, and nothing is
/// printed. What the library had begun to change is to be thrown away then.
///
/// # Errors
/// The message of a panic.
pub fn guarded<T>(call: impl FnOnce() -> T) -> Result<T, String> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |about| {
            if !IS_GUARDED.get() {
                usual(about);
            }
        }));
    });
    let was_guarded = IS_GUARDED.replace(true);
    let called = panic::catch_unwind(AssertUnwindSafe(call));
    IS_GUARDED.set(was_guarded);
    called.map_err(|why| message(why.as_ref()))
}

fn message(why: &(dyn Any + Send)) -> String {
    let text = why.downcast_ref::<&str>().copied();
    let text = text.or_else(|| why.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("an error without a message").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error_with_its_message() {
        assert_eq!(guarded(|| 3), Ok(3));
        let of = |index: usize| guarded(move || [1, 2][index]);
        assert_eq!(of(1), Ok(2));
        assert!(of(2).unwrap_err().contains("out of bounds"));
        let inner = guarded(|| (guarded(|| panic!("inner")), panic::catch_unwind(|| 1).is_ok()));
        let inner: Result<(Result<(), String>, bool), String> = inner;
        assert_eq!(inner, Ok((Err("inner".to_owned()), true)));
    }
}

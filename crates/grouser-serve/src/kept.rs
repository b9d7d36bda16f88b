//! Results that are likely to be asked for again: a few of each kind, the last used ones.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// Results by what they were computed from.
pub(crate) struct Kept<T> {
    most: usize,
    /// The last used one first.
    all: Mutex<VecDeque<(String, Arc<T>)>>,
}

impl<T> Kept<T> {
    /// * `most`: how many are kept
    pub(crate) fn new(most: usize) -> Self {
        Self { most, all: Mutex::default() }
    }

    /// The result that was kept, or else a new one.
    ///
    /// * `key`: all that it depends on
    pub(crate) fn get_or<E>(
        &self,
        key: &str,
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<Arc<T>, E> {
        if let Some(found) = self.take(key) {
            self.put(key, &found);
            return Ok(found);
        }
        // Nobody waits for it: two who ask at once compute it twice.
        let made = Arc::new(make()?);
        drop(self.take(key));
        self.put(key, &made);
        Ok(made)
    }

    fn take(&self, key: &str) -> Option<Arc<T>> {
        let mut all = self.all.lock().unwrap_or_else(PoisonError::into_inner);
        let place = all.iter().position(|(own, _)| own == key)?;
        all.remove(place).map(|(_, found)| found)
    }

    fn put(&self, key: &str, made: &Arc<T>) {
        let mut all = self.all.lock().unwrap_or_else(PoisonError::into_inner);
        all.push_front((key.to_owned(), Arc::clone(made)));
        all.truncate(self.most);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_used_ones_are_kept() {
        let kept = Kept::new(2);
        let made = |key: &str| kept.get_or(key, || Ok::<_, ()>(key.to_owned())).unwrap();
        let is_kept = |key: &str| kept.get_or(key, || Err(())).is_ok();
        assert_eq!(made("a").as_str(), "a");
        made("b");
        assert!(is_kept("a"));
        made("c");
        assert!(is_kept("a") && is_kept("c") && !is_kept("b"));
    }
}

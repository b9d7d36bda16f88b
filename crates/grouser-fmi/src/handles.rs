//! What an importer has of an instance or a saved state: a number in the form of a pointer, which
//! is never read. One that was freed, or never was one, is known for what it is.

use std::collections::BTreeMap;
use std::ffi::c_void;
use std::sync::{Arc, Mutex, PoisonError};

/// A table of all objects of one kind.
pub(crate) struct Handles<T> {
    table: Mutex<Objects<T>>,
}

struct Objects<T> {
    /// How many there were so far: no number is used twice.
    count: usize,
    objects: BTreeMap<usize, Arc<T>>,
}

impl<T> Handles<T> {
    pub(crate) const fn new() -> Self {
        Self { table: Mutex::new(Objects { count: 0, objects: BTreeMap::new() }) }
    }

    /// Puts an object into the table.
    pub(crate) fn insert(&self, object: T) -> *mut c_void {
        let mut table = self.table.lock().unwrap_or_else(PoisonError::into_inner);
        table.count += 1;
        let number = table.count;
        table.objects.insert(number, Arc::new(object));
        std::ptr::without_provenance_mut(number)
    }

    /// The object of a handle, which lives on while it is used.
    pub(crate) fn get(&self, handle: *mut c_void) -> Option<Arc<T>> {
        let table = self.table.lock().unwrap_or_else(PoisonError::into_inner);
        table.objects.get(&handle.addr()).cloned()
    }

    /// Takes an object out of the table.
    pub(crate) fn remove(&self, handle: *mut c_void) -> Option<Arc<T>> {
        let mut table = self.table.lock().unwrap_or_else(PoisonError::into_inner);
        table.objects.remove(&handle.addr())
    }
}

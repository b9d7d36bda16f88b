//! The table of all that C has handles of.
//!
//! A handle is a number, not an address: the place of its object in the table, and how often that
//! place was used. A freed handle, or a number that never was one, is therefore known for what it
//! is without reading memory that is no longer ours.

use std::any::Any;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock, TryLockError};

use crate::status::{Failure, Status};

/// What one place of the table has.
struct Slot {
    /// How many objects it has had: the upper half of a handle.
    generation: u32,
    object: Option<Arc<dyn Any + Send + Sync>>,
}

static TABLE: RwLock<Vec<Slot>> = RwLock::new(Vec::new());

/// Puts an object into the table and returns the number of its handle, which is never 0.
pub(crate) fn insert<T: Any + Send + Sync>(object: T) -> u64 {
    let mut table = TABLE.write().unwrap_or_else(PoisonError::into_inner);
    let is_free = |slot: &Slot| slot.object.is_none() && slot.generation < u32::MAX;
    let place = table.iter().position(is_free).unwrap_or_else(|| {
        table.push(Slot { generation: 0, object: None });
        table.len() - 1
    });
    let slot = &mut table[place];
    slot.generation += 1;
    slot.object = Some(Arc::new(object));
    u64::from(slot.generation) << u32::BITS | place as u64
}

/// The object of a handle, which lives on while it is used, even if another thread frees the
/// handle.
///
/// # Errors
/// [`Status::BadHandle`] for a handle that was freed, is of another kind, or never was one.
pub(crate) fn get<T: Any + Send + Sync>(id: u64) -> Result<Arc<T>, Failure> {
    let table = TABLE.read().unwrap_or_else(PoisonError::into_inner);
    let object = table.get(place_of(id)).filter(|slot| slot.generation == generation_of(id));
    let object = object.and_then(|slot| slot.object.clone()).ok_or_else(|| unknown(id))?;
    object.downcast().map_err(|_| bad_handle("the handle is one of another kind"))
}

/// Takes the object of a handle out of the table.
///
/// # Errors
/// The same as [`get`].
pub(crate) fn remove<T: Any + Send + Sync>(id: u64) -> Result<(), Failure> {
    // What is freed is dropped when the table is no longer held.
    let _object = get::<T>(id)?;
    let mut table = TABLE.write().unwrap_or_else(PoisonError::into_inner);
    let slot = table.get_mut(place_of(id)).filter(|slot| slot.generation == generation_of(id));
    let taken = slot.and_then(|slot| slot.object.take());
    taken.map(drop).ok_or_else(|| unknown(id))
}

/// The use of an object that changes, by one thread at a time.
///
/// # Errors
/// [`Status::Busy`] while another thread uses it; [`Status::Panic`] where a call failed half-way
/// before.
pub(crate) fn lock<T>(object: &Mutex<T>) -> Result<MutexGuard<'_, T>, Failure> {
    object.try_lock().map_err(|error| match error {
        TryLockError::WouldBlock => {
            Failure::new(Status::Busy, "another thread is in a call with this handle")
        }
        TryLockError::Poisoned(_) => {
            let text = "an earlier call with this handle failed half-way: free it";
            Failure::new(Status::Panic, text)
        }
    })
}

fn place_of(id: u64) -> usize {
    usize::try_from(id & u64::from(u32::MAX)).unwrap_or(usize::MAX)
}

/// The number of objects that the place had when the handle was made. It fits by construction.
fn generation_of(id: u64) -> u32 {
    u32::try_from(id >> u32::BITS).unwrap_or(0)
}

fn unknown(id: u64) -> Failure {
    match id {
        0 => bad_handle("the handle is zero: it was never set"),
        _ => bad_handle("the handle was freed, or never was one"),
    }
}

fn bad_handle(text: &str) -> Failure {
    Failure::new(Status::BadHandle, text)
}

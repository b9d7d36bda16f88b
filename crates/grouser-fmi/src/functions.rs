//! FMI's functions by their names. Each checks what it gets before it uses it; panics end here, and
//! errors become a status and a sentence for the importer's log.
//!
//! The names, types and numbers are those of the headers of FMI 3.0.

#![allow(non_snake_case, reason = "the names are FMI's")]

use std::ffi::{CStr, CString, c_char, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::{Mutex, TryLockError};

use crate::handles::Handles;
use crate::instance::{Instance, Phase, SavedInstance};
use crate::model::FmuModel;

/// What a function returns.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FmiStatus {
    /// The call did what it says.
    Ok = 0,
    /// It did, and something is odd.
    Warning = 1,
    /// The importer may try again otherwise.
    Discard = 2,
    /// It did nothing, and the log has a sentence.
    Error = 3,
    /// A bug: no instance is to be used any more.
    Fatal = 4,
}

/// The importer's log.
type LogMessage = unsafe extern "C" fn(*mut c_void, FmiStatus, *const c_char, *const c_char);

/// The importer's log, and what it wants back with each message.
struct Logger {
    environment: usize,
    log: Option<LogMessage>,
}

/// An instance of an importer.
struct Held {
    logger: Logger,
    instance: Mutex<Instance>,
}

static INSTANCES: Handles<Held> = Handles::new();
static STATES: Handles<SavedInstance> = Handles::new();

/// The category of messages, as the description declares it.
pub(crate) const CATEGORY: &CStr = c"logStatusError";

impl Logger {
    fn say(&self, status: FmiStatus, text: &str) {
        let Some(log) = self.log else { return };
        let text = CString::new(text.replace('\0', "")).unwrap_or_default();
        let environment = std::ptr::with_exposed_provenance_mut(self.environment);
        // SAFETY: the importer's function, with what it gave for it, and texts that end with a zero.
        unsafe { log(environment, status, CATEGORY.as_ptr(), text.as_ptr()) };
    }
}

/// Does what a call does with an instance.
fn with(instance: *mut c_void, act: impl FnOnce(&mut Instance) -> Result<(), String>) -> FmiStatus {
    // Without its instance nobody's log is known.
    let Some(entry) = INSTANCES.get(instance) else { return FmiStatus::Error };
    let done = caught(|| {
        let mut instance = entry.instance.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => "another thread is in a call with this instance".to_owned(),
            TryLockError::Poisoned(_) => {
                "an earlier call with this instance failed half-way: free it".to_owned()
            }
        })?;
        act(&mut instance)
    });
    done.map_or_else(
        |(status, text)| {
            entry.logger.say(status, &text);
            status
        },
        |()| FmiStatus::Ok,
    )
}

/// What is done, or how it failed.
fn caught<T>(act: impl FnOnce() -> Result<T, String>) -> Result<T, (FmiStatus, String)> {
    match catch_unwind(AssertUnwindSafe(act)) {
        Ok(done) => done.map_err(|text| (FmiStatus::Error, text)),
        Err(panic) => {
            let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
            let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
            let text = text.unwrap_or_default();
            Err((FmiStatus::Fatal, format!("a bug in Grouser, please report it: {text}")))
        }
    }
}

/// An array of the importer's.
///
/// # Safety
/// The pointer is null, or points to that many values, which nobody changes during the call.
unsafe fn array<'a, T>(name: &str, pointer: *const T, count: usize) -> Result<&'a [T], String> {
    if count == 0 {
        return Ok(&[]);
    }
    check::<T>(name, pointer.is_null(), pointer.is_aligned(), count)?;
    // SAFETY: it is not null, aligned, and as long as the importer says.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// Room of the importer's for results.
///
/// # Safety
/// The pointer is null, or points to that many values, which nobody else uses during the call.
unsafe fn room<'a, T>(name: &str, pointer: *mut T, count: usize) -> Result<&'a mut [T], String> {
    if count == 0 {
        return Ok(&mut []);
    }
    check::<T>(name, pointer.is_null(), pointer.is_aligned(), count)?;
    // SAFETY: it is not null, aligned, and as long as the importer says.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

fn check<T>(name: &str, is_null: bool, is_aligned: bool, count: usize) -> Result<(), String> {
    if is_null {
        return Err(format!("{name} is null"));
    }
    if !is_aligned || count > isize::MAX.unsigned_abs() / size_of::<T>().max(1) {
        return Err(format!("{name} is no array of {count} values"));
    }
    Ok(())
}

/// Writes a result whose place may be unwanted.
///
/// # Safety
/// The pointer is null, or points to room for a value that nobody else uses during the call.
unsafe fn put<T>(pointer: *mut T, value: T) {
    if !pointer.is_null() && pointer.is_aligned() {
        // SAFETY: it points to room for the value.
        unsafe { pointer.write(value) };
    }
}

/// A text of the importer's; none if the pointer is null.
///
/// # Safety
/// The pointer is null, or points to a text that ends with a zero.
unsafe fn text<'a>(name: &str, pointer: *const c_char) -> Result<Option<&'a str>, String> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: it ends with a zero, as the importer says.
    let text = unsafe { CStr::from_ptr(pointer) }.to_str();
    text.map(Some).map_err(|error| format!("{name} is not UTF-8: {error}"))
}

fn same_count(references: usize, values: usize) -> Result<(), String> {
    if references == values {
        return Ok(());
    }
    Err(format!("there are {references} references and {values} values: all variables are scalars"))
}

/// The version of FMI.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

/// Errors are always logged, and nothing else is.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetDebugLogging(
    instance: *mut c_void,
    _logging_on: bool,
    count: usize,
    categories: *const *const c_char,
) -> FmiStatus {
    with(instance, |_| {
        // SAFETY: the importer's pointers are as FMI says.
        for category in unsafe { array("categories", categories, count) }? {
            // SAFETY: the same.
            let category = unsafe { text("a category", *category) }?.unwrap_or_default();
            if category.as_bytes() != CATEGORY.to_bytes() {
                return Err(format!("there is no log category {category:?}"));
            }
        }
        Ok(())
    })
}

/// Makes an instance; null where there can be none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    _instance_name: *const c_char,
    instantiation_token: *const c_char,
    resource_path: *const c_char,
    _visible: bool,
    _logging_on: bool,
    event_mode_used: bool,
    _early_return_allowed: bool,
    _required: *const u32,
    required_count: usize,
    environment: *mut c_void,
    log: Option<LogMessage>,
    _intermediate_update: *mut c_void,
) -> *mut c_void {
    let logger = Logger { environment: environment.expose_provenance(), log };
    let made = caught(|| {
        if event_mode_used {
            return Err("this FMU has no event mode".to_owned());
        }
        if required_count > 0 {
            return Err("this FMU has no intermediate variables".to_owned());
        }
        // SAFETY: the importer's pointers are as FMI says.
        let (token, folder) = unsafe {
            (
                text("the instantiation token", instantiation_token)?,
                text("the path of the resources", resource_path)?,
            )
        };
        let token = token.unwrap_or_default();
        let folder = folder.ok_or("the FMU needs the path of its resources, which is null")?;
        Ok(Instance::new(FmuModel::in_resources(Path::new(folder), token)?, token))
    });
    match made {
        Ok(instance) => INSTANCES.insert(Held { logger, instance: Mutex::new(instance) }),
        Err((status, text)) => {
            logger.say(status, &text);
            std::ptr::null_mut()
        }
    }
}

/// Says that there is no other kind of instance, and returns null.
fn no_instance(what: &str, environment: *mut c_void, log: Option<LogMessage>) -> *mut c_void {
    let logger = Logger { environment: environment.expose_provenance(), log };
    logger.say(FmiStatus::Error, &format!("this FMU is for co-simulation, not for {what}"));
    std::ptr::null_mut()
}

/// There is no instance for model exchange: null.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3InstantiateModelExchange(
    _instance_name: *const c_char,
    _instantiation_token: *const c_char,
    _resource_path: *const c_char,
    _visible: bool,
    _logging_on: bool,
    environment: *mut c_void,
    log: Option<LogMessage>,
) -> *mut c_void {
    no_instance("model exchange", environment, log)
}

/// There is no instance for scheduled execution: null.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3InstantiateScheduledExecution(
    _instance_name: *const c_char,
    _instantiation_token: *const c_char,
    _resource_path: *const c_char,
    _visible: bool,
    _logging_on: bool,
    environment: *mut c_void,
    log: Option<LogMessage>,
    _clock_update: *mut c_void,
    _lock_preemption: *mut c_void,
    _unlock_preemption: *mut c_void,
) -> *mut c_void {
    no_instance("scheduled execution", environment, log)
}

/// Frees an instance.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3FreeInstance(instance: *mut c_void) {
    INSTANCES.remove(instance);
}

/// Begins the initialization. A tolerance is the document's, and a stop time is not asked for.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3EnterInitializationMode(
    instance: *mut c_void,
    _tolerance_defined: bool,
    _tolerance: f64,
    start_time: f64,
    _stop_time_defined: bool,
    _stop_time: f64,
) -> FmiStatus {
    with(instance, |it| it.enter_initialization(start_time))
}

/// Ends the initialization: the rover stands at its start.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3ExitInitializationMode(instance: *mut c_void) -> FmiStatus {
    with(instance, Instance::exit_initialization)
}

/// Ends the simulation; results can still be read.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3Terminate(instance: *mut c_void) -> FmiStatus {
    with(instance, Instance::terminate)
}

/// Makes an instance what it was when it was made.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3Reset(instance: *mut c_void) -> FmiStatus {
    with(instance, |it| {
        it.reset();
        Ok(())
    })
}

/// Reads the value of each reference.
///
/// * `counts`: of references and of values
///
/// # Safety
/// The importer's pointers are as FMI says.
unsafe fn read_each<T>(
    instance: *mut c_void,
    references: *const u32,
    values: *mut T,
    counts: [usize; 2],
    value_of: impl Fn(&mut Instance, u32) -> Result<T, String>,
) -> FmiStatus {
    with(instance, |it| {
        same_count(counts[0], counts[1])?;
        // SAFETY: as this function's.
        let (references, values) = unsafe {
            (array("references", references, counts[0])?, room("values", values, counts[1])?)
        };
        for (reference, value) in references.iter().zip(values) {
            *value = value_of(it, *reference)?;
        }
        Ok(())
    })
}

/// Reads numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFloat64(
    instance: *mut c_void,
    references: *const u32,
    reference_count: usize,
    values: *mut f64,
    value_count: usize,
) -> FmiStatus {
    let counts = [reference_count, value_count];
    // SAFETY: the importer's pointers are as FMI says.
    unsafe { read_each(instance, references, values, counts, Instance::number) }
}

/// Reads whole numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetInt64(
    instance: *mut c_void,
    references: *const u32,
    reference_count: usize,
    values: *mut i64,
    value_count: usize,
) -> FmiStatus {
    let counts = [reference_count, value_count];
    // SAFETY: the importer's pointers are as FMI says.
    unsafe { read_each(instance, references, values, counts, Instance::whole) }
}

/// Reads texts, which are valid until the next call that reads one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetString(
    instance: *mut c_void,
    references: *const u32,
    reference_count: usize,
    values: *mut *const c_char,
    value_count: usize,
) -> FmiStatus {
    // There is one text, so that one that is asked for twice is the same.
    let counts = [reference_count, value_count];
    // SAFETY: the importer's pointers are as FMI says.
    unsafe {
        read_each(instance, references, values, counts, |it, reference| {
            Ok(it.text(reference)?.as_ptr())
        })
    }
}

/// Sets inputs and parameters: all of them, or none if one cannot be set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFloat64(
    instance: *mut c_void,
    references: *const u32,
    reference_count: usize,
    values: *const f64,
    value_count: usize,
) -> FmiStatus {
    with(instance, |it| {
        same_count(reference_count, value_count)?;
        // SAFETY: the importer's pointers are as FMI says.
        let (references, values) = unsafe {
            (
                array("references", references, reference_count)?,
                array("values", values, value_count)?,
            )
        };
        it.set(references, values)
    })
}

/// Goes on for a step, with the inputs as they are.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DoStep(
    instance: *mut c_void,
    current_communication_point: f64,
    communication_step_size: f64,
    _no_set_state_before: bool,
    event_handling_needed: *mut bool,
    terminate_simulation: *mut bool,
    early_return: *mut bool,
    last_successful_time: *mut f64,
) -> FmiStatus {
    with(instance, |it| {
        let done = it.step(current_communication_point, communication_step_size);
        // SAFETY: the importer's pointers are as FMI says.
        unsafe {
            put(event_handling_needed, false);
            put(terminate_simulation, false);
            put(early_return, false);
            put(last_successful_time, it.time());
        }
        done
    })
}

/// Copies all that changes in an instance. A state that is there already is replaced.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFMUState(
    instance: *mut c_void,
    state: *mut *mut c_void,
) -> FmiStatus {
    with(instance, |it| {
        // SAFETY: the importer's pointer is as FMI says.
        let place = &mut unsafe { room("the place of the state", state, 1) }?[0];
        STATES.remove(*place);
        *place = STATES.insert(it.saved());
        Ok(())
    })
}

/// Sets an instance to a copied state, which may be used again.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3SetFMUState(instance: *mut c_void, state: *mut c_void) -> FmiStatus {
    with(instance, |it| it.restore(&*saved(state)?))
}

/// Frees a copied state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeFMUState(
    instance: *mut c_void,
    state: *mut *mut c_void,
) -> FmiStatus {
    with(instance, |_| {
        if state.is_null() {
            return Ok(());
        }
        // SAFETY: the importer's pointer is as FMI says.
        let place = &mut unsafe { room("the place of the state", state, 1) }?[0];
        let freed = place.is_null() || STATES.remove(*place).is_some();
        *place = std::ptr::null_mut();
        if freed { Ok(()) } else { Err("the state was freed, or never was one".to_owned()) }
    })
}

/// How many bytes a copied state has.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializedFMUStateSize(
    instance: *mut c_void,
    state: *mut c_void,
    size: *mut usize,
) -> FmiStatus {
    with(instance, |_| {
        let bytes = saved(state)?.to_bytes();
        // SAFETY: the importer's pointer is as FMI says.
        unsafe { room("the place of the size", size, 1) }?[0] = bytes.len();
        Ok(())
    })
}

/// Writes a copied state as bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializeFMUState(
    instance: *mut c_void,
    state: *mut c_void,
    serialized: *mut u8,
    size: usize,
) -> FmiStatus {
    with(instance, |_| {
        let bytes = saved(state)?.to_bytes();
        if bytes.len() != size {
            return Err(format!("the state has {} bytes, there is room for {size}", bytes.len()));
        }
        // SAFETY: the importer's pointer is as FMI says.
        unsafe { room("the bytes", serialized, size) }?.copy_from_slice(&bytes);
        Ok(())
    })
}

/// Reads a state that was written as bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DeserializeFMUState(
    instance: *mut c_void,
    serialized: *const u8,
    size: usize,
    state: *mut *mut c_void,
) -> FmiStatus {
    with(instance, |it| {
        // SAFETY: the importer's pointers are as FMI says.
        let (bytes, place) = unsafe {
            (array("the bytes", serialized, size)?, room("the place of the state", state, 1)?)
        };
        let saved = it.read(bytes)?;
        STATES.remove(place[0]);
        place[0] = STATES.insert(saved);
        Ok(())
    })
}

fn saved(state: *mut c_void) -> Result<std::sync::Arc<SavedInstance>, String> {
    STATES.get(state).ok_or_else(|| "the state was freed, or never was one".to_owned())
}

/// Inputs are kept over a step, so that one without event mode is always in step mode.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3EnterStepMode(instance: *mut c_void) -> FmiStatus {
    with(instance, |it| it.check_phase(&[Phase::Step]))
}

/// Functions of what this FMU does not have. All of their arguments but the instance are ignored.
macro_rules! lacking {
    ($($what:literal: $($name:ident($($type_:ty),*)),+;)+) => {
        $($(
            #[doc = concat!("An error: this FMU has no ", $what, ".")]
            #[unsafe(no_mangle)]
            pub extern "C" fn $name(instance: *mut c_void $(, _: $type_)*) -> FmiStatus {
                with(instance, |_| {
                    let name = stringify!($name);
                    Err(format!(concat!("this FMU has no ", $what, ", which {} is for"), name))
                })
            }
        )+)+
    };
}

/// References and how many they are.
type Refs = *const u32;
/// Arrays that are not looked at.
type In = *const c_void;
type Out = *mut c_void;

lacking! {
    "event mode":
        fmi3EnterEventMode(),
        fmi3EvaluateDiscreteStates(),
        fmi3UpdateDiscreteStates(Out, Out, Out, Out, Out, Out);
    "variables of that type":
        fmi3GetFloat32(Refs, usize, Out, usize),
        fmi3GetInt8(Refs, usize, Out, usize),
        fmi3GetUInt8(Refs, usize, Out, usize),
        fmi3GetInt16(Refs, usize, Out, usize),
        fmi3GetUInt16(Refs, usize, Out, usize),
        fmi3GetInt32(Refs, usize, Out, usize),
        fmi3GetUInt32(Refs, usize, Out, usize),
        fmi3GetUInt64(Refs, usize, Out, usize),
        fmi3GetBoolean(Refs, usize, Out, usize),
        fmi3GetBinary(Refs, usize, Out, Out, usize),
        fmi3GetClock(Refs, usize, Out),
        fmi3SetFloat32(Refs, usize, In, usize),
        fmi3SetInt8(Refs, usize, In, usize),
        fmi3SetUInt8(Refs, usize, In, usize),
        fmi3SetInt16(Refs, usize, In, usize),
        fmi3SetUInt16(Refs, usize, In, usize),
        fmi3SetInt32(Refs, usize, In, usize),
        fmi3SetUInt32(Refs, usize, In, usize),
        fmi3SetUInt64(Refs, usize, In, usize),
        fmi3SetBoolean(Refs, usize, In, usize),
        fmi3SetBinary(Refs, usize, In, In, usize),
        fmi3SetClock(Refs, usize, In);
    "inputs or parameters of that type":
        fmi3SetInt64(Refs, usize, In, usize),
        fmi3SetString(Refs, usize, In, usize);
    "dependencies that change":
        fmi3GetNumberOfVariableDependencies(u32, Out),
        fmi3GetVariableDependencies(u32, Out, Out, Out, Out, usize);
    "derivatives":
        fmi3GetDirectionalDerivative(Refs, usize, Refs, usize, In, usize, Out, usize),
        fmi3GetAdjointDerivative(Refs, usize, Refs, usize, In, usize, Out, usize),
        fmi3GetOutputDerivatives(Refs, usize, In, Out, usize);
    "structural parameters":
        fmi3EnterConfigurationMode(),
        fmi3ExitConfigurationMode();
    "clocks":
        fmi3GetIntervalDecimal(Refs, usize, Out, Out),
        fmi3GetIntervalFraction(Refs, usize, Out, Out, Out),
        fmi3GetShiftDecimal(Refs, usize, Out),
        fmi3GetShiftFraction(Refs, usize, Out, Out),
        fmi3SetIntervalDecimal(Refs, usize, In),
        fmi3SetIntervalFraction(Refs, usize, In, In),
        fmi3SetShiftDecimal(Refs, usize, In),
        fmi3SetShiftFraction(Refs, usize, In, In),
        fmi3ActivateModelPartition(u32, f64);
    "model exchange":
        fmi3EnterContinuousTimeMode(),
        fmi3CompletedIntegratorStep(bool, Out, Out),
        fmi3SetTime(f64),
        fmi3SetContinuousStates(In, usize),
        fmi3GetContinuousStateDerivatives(Out, usize),
        fmi3GetEventIndicators(Out, usize),
        fmi3GetContinuousStates(Out, usize),
        fmi3GetNominalsOfContinuousStates(Out, usize),
        fmi3GetNumberOfEventIndicators(Out),
        fmi3GetNumberOfContinuousStates(Out);
}

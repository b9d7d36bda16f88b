//! What an importer of our FMUs can rely on: the description, the bits, and what wrong uses do.
//!
//! These tests call the functions that importers call. `crates/grouser-python/tests/test_fmu.py`
//! loads FMUs of the program with FMPy.

#![expect(unsafe_code, reason = "FMI's functions take pointers")]

mod description;
mod states;
mod uses;

use std::ffi::{CStr, CString, c_char, c_void};
use std::fs;
use std::sync::Mutex;

use grouser::document::{LoadedScenario, Overrides, Source, read_scenario};
use grouser_fmi::contents::{self, File};
use grouser_fmi::drive::Drive;
use grouser_fmi::functions::{
    FmiStatus, fmi3EnterInitializationMode, fmi3ExitInitializationMode, fmi3FreeInstance,
    fmi3GetFloat64, fmi3InstantiateCoSimulation, fmi3SetFloat64,
};
use tempfile::TempDir;

/// What makes a scenario meet each feature that a run has, and a word of a refusal, if inputs
/// cannot turn its wheels.
const FEATURES: [(&str, &[&str]); 15] = [
    ("plane", &[]),
    ("terrain", &["scenario.terrain.surface=incline", "scenario.terrain.slope_deg=4"]),
    ("suspension", &["scenario.rover=hakuto-rockers"]),
    (
        "suspension on relief",
        &[
            "scenario.rover=hakuto-rockers",
            "scenario.terrain.surface=incline",
            "scenario.terrain.slope_deg=4",
        ],
    ),
    ("motors", &["scenario.rover=hakuto-flight"]),
    ("steering", &["scenario.rover=hakuto-steered"]),
    ("uncertain soil", &["scenario.soil=toyoura-uncertain"]),
    ("bekker", &["scenario.model=bekker"]),
    ("small-wheel", &["scenario.model=small-wheel"]),
    ("rft", &["scenario.model=rft"]),
    ("quasi-steady", &["scenario.simulation=quasi-steady"]),
    (
        "quasi-steady over relief",
        &[
            "scenario.simulation=quasi-steady",
            "scenario.terrain.surface=incline",
            "scenario.terrain.slope_deg=4",
        ],
    ),
    ("gravity", &["scenario.gravity_m_s2=1.62"]),
    ("ruts", &["scenario.ruts=compacted"]),
    ("scatter", &["scenario.scatter.seed=1", "scenario.scatter.speed_std=0.02"]),
];

fn scenario(settings: &[&str]) -> LoadedScenario {
    let overrides = Overrides::parse(settings).expect("settings");
    read_scenario(&Source::default_scenario(), &overrides).expect("a scenario")
}

/// An FMU as an importer has unpacked it.
struct Unpacked {
    folder: TempDir,
    description: String,
}

impl Unpacked {
    fn of(files: Vec<File>) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let mut description = String::new();
        for (name, content) in files {
            let path = folder.path().join(&name);
            fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            fs::write(path, &content).expect("a file");
            if name == "modelDescription.xml" {
                description = String::from_utf8(content).expect("text");
            }
        }
        Self { folder, description }
    }

    fn of_scenario(settings: &[&str]) -> Self {
        Self::of(contents::of_scenario(&scenario(settings), Drive::Inputs).expect("an FMU").files)
    }

    /// What the description says of the variable of a name.
    fn attribute(&self, name: &str, attribute: &str) -> Option<String> {
        let xml = roxmltree::Document::parse(&self.description).expect("XML");
        let mut all = xml.descendants();
        let variable =
            all.find(|it| it.attribute("name") == Some(name) && it.has_attribute("valueReference"));
        variable?.attribute(attribute).map(str::to_owned)
    }

    fn reference(&self, name: &str) -> u32 {
        let reference = self.attribute(name, "valueReference");
        reference.and_then(|it| it.parse().ok()).unwrap_or_else(|| panic!("no variable {name}"))
    }

    fn token(&self) -> String {
        let xml = roxmltree::Document::parse(&self.description).expect("XML");
        xml.root_element().attribute("instantiationToken").expect("a token").to_owned()
    }

    /// An instance that is not yet initialized; its log is the given one.
    fn instantiated(&self, log: &Mutex<Vec<String>>) -> *mut c_void {
        self.instantiated_with(&self.token(), log)
    }

    fn instantiated_with(&self, token: &str, log: &Mutex<Vec<String>>) -> *mut c_void {
        let token = CString::new(token).expect("a text");
        let resources = self.folder.path().join("resources");
        let resources = CString::new(resources.to_str().expect("UTF-8")).expect("a text");
        let log = std::ptr::from_ref(log).cast_mut().cast();
        // SAFETY: texts end with a zero, and the log outlives what is made here.
        unsafe {
            fmi3InstantiateCoSimulation(
                c"rover".as_ptr(),
                token.as_ptr(),
                resources.as_ptr(),
                false,
                false,
                false,
                false,
                std::ptr::null(),
                0,
                log,
                Some(logged),
                std::ptr::null_mut(),
            )
        }
    }
}

/// Keeps what an instance says.
unsafe extern "C" fn logged(
    log: *mut c_void,
    _status: FmiStatus,
    _category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the pointers are that of a log, and a text that ends with a zero.
    let (log, message) = unsafe { (&*log.cast::<Mutex<Vec<String>>>(), CStr::from_ptr(message)) };
    log.lock().expect("a log").push(message.to_string_lossy().into_owned());
}

/// An instance of an FMU, by the names of its variables.
struct Instance<'a> {
    fmu: &'a Unpacked,
    log: Box<Mutex<Vec<String>>>,
    handle: *mut c_void,
}

impl<'a> Instance<'a> {
    fn new(fmu: &'a Unpacked) -> Self {
        let log = Box::new(Mutex::new(Vec::new()));
        let handle = fmu.instantiated(&log);
        assert!(!handle.is_null(), "{log:?}");
        Self { fmu, log, handle }
    }

    fn initialized(self) -> Self {
        assert_eq!(
            fmi3EnterInitializationMode(self.handle, false, 0.0, 0.0, false, 0.0),
            FmiStatus::Ok
        );
        assert_eq!(fmi3ExitInitializationMode(self.handle), FmiStatus::Ok, "{:?}", self.log);
        self
    }

    fn get(&self, name: &str) -> f64 {
        let (status, value) = self.try_get(self.fmu.reference(name));
        assert_eq!(status, FmiStatus::Ok, "{:?}", self.log);
        value
    }

    fn try_get(&self, reference: u32) -> (FmiStatus, f64) {
        let mut value = 0.0;
        // SAFETY: there is room for a value.
        let status =
            unsafe { fmi3GetFloat64(self.handle, &raw const reference, 1, &raw mut value, 1) };
        (status, value)
    }

    fn try_set(&self, name: &str, value: f64) -> FmiStatus {
        let reference = self.fmu.reference(name);
        // SAFETY: there is a value.
        unsafe { fmi3SetFloat64(self.handle, &raw const reference, 1, &raw const value, 1) }
    }

    /// What was said last.
    fn said(&self) -> String {
        self.log.lock().expect("a log").last().cloned().unwrap_or_default()
    }
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        fmi3FreeInstance(self.handle);
    }
}

//! The console, served from this process.

use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};

use grouser_serve::{Limits, ServeError, Server, Settings};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;

use crate::errors;
use crate::threads::released;

/// A server in a thread of its own, until it is stopped or Python ends.
#[pyclass(frozen, module = "grouser._core")]
pub(crate) struct ConsoleServer {
    address: String,
    port: u16,
    is_to_end: Arc<AtomicBool>,
    thread: Mutex<Option<JoinHandle<Result<(), ServeError>>>>,
    /// The process that serves: one that was forked from it has no such thread.
    process: u32,
}

#[pymethods]
impl ConsoleServer {
    #[new]
    fn new(folder: Option<PathBuf>, port: u16, hosts: Vec<String>) -> PyResult<Self> {
        let address = IpAddr::from(Ipv4Addr::LOCALHOST);
        let settings = Settings { folder, address, port, hosts, limits: Limits::default() };
        let server = Server::bind(&settings).map_err(|error| of_serve(&error))?;
        let (address, port) = (server.address(), server.port());
        let is_to_end = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&is_to_end);
        let serve = move || server.run(|| flag.load(Ordering::Relaxed));
        let thread = thread::Builder::new().name("grouser console".to_owned()).spawn(serve)?;
        let (thread, process) = (Mutex::new(Some(thread)), process::id());
        Ok(Self { address, port, is_to_end, thread, process })
    }

    #[getter]
    fn address(&self) -> &str {
        &self.address
    }

    #[getter]
    fn port(&self) -> u16 {
        self.port
    }

    #[getter]
    fn is_serving(&self) -> bool {
        let thread = self.thread.lock().unwrap_or_else(PoisonError::into_inner);
        self.process == process::id() && thread.as_ref().is_some_and(|it| !it.is_finished())
    }

    /// Ends it, and waits until it has.
    fn stop(&self, py: Python<'_>) -> PyResult<()> {
        if self.process != process::id() {
            return Ok(());
        }
        self.is_to_end.store(true, Ordering::Relaxed);
        let thread = self.thread.lock().unwrap_or_else(PoisonError::into_inner).take();
        let Some(thread) = thread else { return Ok(()) };
        match released(py, || thread.join())? {
            Ok(served) => served.map_err(|error| of_serve(&error)),
            Err(why) => Err(errors::of_panic(why.as_ref())),
        }
    }
}

fn of_serve(error: &ServeError) -> PyErr {
    let message = error.to_string();
    match error {
        ServeError::Folder { .. } => {
            errors::parameter(message, "folder", None, "a folder that can be read")
        }
        ServeError::Address { .. } => {
            errors::parameter(message, "port", None, "a port that is free")
        }
        ServeError::System(_) => PyOSError::new_err(message),
    }
}

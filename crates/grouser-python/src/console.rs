//! The console, served from this process.

use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError, TryLockError};
use std::thread::{self, JoinHandle};

use grouser_serve::{BrowserPage, Limits, ServeError, Server, Settings};
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
    page: Mutex<Option<BrowserPage>>,
    thread: Mutex<Option<JoinHandle<Result<(), ServeError>>>>,
    /// The process that serves: one that was forked from it has no such thread.
    process: u32,
}

#[pymethods]
impl ConsoleServer {
    #[new]
    fn new(
        folder: Option<PathBuf>,
        port: u16,
        hosts: Vec<String>,
        has_page: bool,
    ) -> PyResult<Self> {
        let address = IpAddr::from(Ipv4Addr::LOCALHOST);
        let settings =
            Settings { folder, address, port, hosts, card: None, limits: Limits::default() };
        let server = Server::bind(&settings).map_err(|error| of_serve(&error))?;
        let (address, port) = (server.address(), server.port());
        let page = Mutex::new(if has_page { server.browser_page().ok() } else { None });
        let is_to_end = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&is_to_end);
        let serve = move || server.run(|| flag.load(Ordering::Relaxed));
        let thread = thread::Builder::new().name("grouser console".to_owned()).spawn(serve)?;
        let (thread, process) = (Mutex::new(Some(thread)), process::id());
        Ok(Self { address, port, is_to_end, page, thread, process })
    }

    #[getter]
    fn address(&self) -> &str {
        &self.address
    }

    /// The private file to open a browser with, if one was asked for and could be written.
    #[getter]
    fn page(&self) -> Option<PathBuf> {
        let page = self.page.lock().unwrap_or_else(PoisonError::into_inner);
        page.as_ref().map(|page| page.path().to_owned())
    }

    #[getter]
    fn port(&self) -> u16 {
        self.port
    }

    #[getter]
    fn is_serving(&self) -> bool {
        let thread = match self.thread.try_lock() {
            Ok(thread) => thread,
            Err(TryLockError::Poisoned(thread)) => thread.into_inner(),
            // It is being stopped.
            Err(TryLockError::WouldBlock) => return false,
        };
        self.process == process::id() && thread.as_ref().is_some_and(|it| !it.is_finished())
    }

    /// Ends it, and waits until it has.
    fn stop(&self, py: Python<'_>) -> PyResult<()> {
        if self.process != process::id() {
            return Ok(());
        }
        self.is_to_end.store(true, Ordering::Relaxed);
        self.page.lock().unwrap_or_else(PoisonError::into_inner).take();
        // Who stops it meanwhile waits, too.
        let joined = released(py, || {
            let mut thread = self.thread.lock().unwrap_or_else(PoisonError::into_inner);
            thread.take().map(JoinHandle::join)
        });
        match joined? {
            None => Ok(()),
            Some(Ok(served)) => served.map_err(|error| of_serve(&error)),
            Some(Err(why)) => Err(errors::of_panic(why.as_ref())),
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

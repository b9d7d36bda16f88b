//! A server: from its settings to its end.

use std::io;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpListener};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use tokio::runtime::{Builder, Runtime};
use tokio::sync::Semaphore;

use crate::access::Access;
use crate::browser_page::BrowserPage;
use crate::cards::CardMaker;
use crate::connection;
use crate::console::Console;
use crate::folder::ServedFolder;
use crate::limits::Limits;
use crate::maps::KeptOfMaps;
use crate::runs::RunPlaces;
use crate::shared::Shared;
use crate::token::Token;

/// What a server serves, and to whom.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The folder whose documents may be opened, and no file outside of it; without one there are
    /// presets alone.
    pub folder: Option<PathBuf>,
    /// The address that it listens on.
    pub address: IpAddr,
    /// The port; 0 takes a free one.
    pub port: u16,
    /// Names by which it is called beside those of the loopback and its address, as those of a
    /// tunnel.
    pub hosts: Vec<String>,
    /// What draws the operator's card as PDF; without it there is none to save.
    pub card: Option<CardMaker>,
    /// How much it takes on.
    pub limits: Limits,
}

impl Default for Settings {
    /// Presets, on a free port of the loopback.
    fn default() -> Self {
        Self {
            folder: None,
            address: Ipv4Addr::LOCALHOST.into(),
            port: 0,
            hosts: Vec::new(),
            card: None,
            limits: Limits::default(),
        }
    }
}

/// Why there is no server.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// The folder cannot be read.
    #[error("the folder {} cannot be read: {error}", path.display())]
    Folder {
        /// Which one.
        path: PathBuf,
        /// The system's error.
        error: io::Error,
    },
    /// The address cannot be had, as where another program has the port.
    #[error("{address} cannot be listened on: {error}")]
    Address {
        /// Which one.
        address: SocketAddr,
        /// The system's error.
        error: io::Error,
    },
    /// The system has no random numbers, or no events.
    #[error("the system has not what a server needs: {0}")]
    System(io::Error),
}

/// A server that listens.
pub struct Server {
    listener: TcpListener,
    runtime: Runtime,
    shared: Arc<Shared>,
    address: SocketAddr,
}

/// How often it is asked whether to end.
const LOOK: Duration = Duration::from_millis(50);
/// Time for computations to stop at the end.
const END: Duration = Duration::from_secs(2);

impl Server {
    /// Listens from now on; what connects is answered by [`run`](Self::run).
    ///
    /// # Errors
    /// [`ServeError`] for a folder that cannot be read, and an address that cannot be had.
    pub fn bind(settings: &Settings) -> Result<Self, ServeError> {
        let folder = ServedFolder::open(settings.folder.as_deref()).map_err(|error| {
            ServeError::Folder { path: settings.folder.clone().unwrap_or_default(), error }
        })?;
        let asked = SocketAddr::new(settings.address, settings.port);
        let of_address = |error| ServeError::Address { address: asked, error };
        let listener = TcpListener::bind(asked).map_err(of_address)?;
        let address = listener.local_addr().map_err(of_address)?;
        listener.set_nonblocking(true).map_err(of_address)?;
        let random = || Token::random().map_err(ServeError::System);
        let secrets = [random()?, random()?];
        // One thread talks; answers are computed by others.
        let runtime = Builder::new_current_thread()
            .enable_io()
            .enable_time()
            .max_blocking_threads(settings.limits.runs + settings.limits.waiting + 2)
            .build()
            .map_err(ServeError::System)?;
        let shared = Shared {
            access: Access::new(secrets, address, &settings.hosts),
            console: Console { folder, kept: KeptOfMaps::default(), card: settings.card },
            runs: RunPlaces::new(&settings.limits),
            lists: Arc::new(Semaphore::new(1)),
            limits: settings.limits,
        };
        Ok(Self { listener, runtime, shared: Arc::new(shared), address })
    }

    /// The address to open first. It has the token: who knows it may ask.
    #[must_use]
    pub fn address(&self) -> String {
        self.shared.access.url()
    }

    /// A page in a private file that leads a browser to [`address`](Self::address).
    ///
    /// # Errors
    /// Where no such file can be written.
    pub fn browser_page(&self) -> io::Result<BrowserPage> {
        BrowserPage::of(&self.address())
    }

    /// The port.
    #[must_use]
    pub fn port(&self) -> u16 {
        self.address.port()
    }

    /// Answers until it is to end, and stops what computes then.
    ///
    /// * `should_end`: asked some twenty times a second
    ///
    /// # Errors
    /// [`ServeError`] where the system has no events.
    pub fn run(self, should_end: impl Fn() -> bool) -> Result<(), ServeError> {
        let Self { listener, runtime, shared, .. } = self;
        let serve = async {
            let listener = tokio::net::TcpListener::from_std(listener)?;
            connection::accept_all(&listener, &shared, LOOK, should_end).await;
            Ok(())
        };
        let served = runtime.block_on(serve).map_err(ServeError::System);
        shared.runs.end();
        runtime.shutdown_timeout(END);
        served
    }
}

//! The console: a server on the loopback, and the page that it serves. It computes nothing: it asks
//! [`grouser::answers`], and writes what they answer as the program writes it with `--format json`.
//!
//! A request passes these checks, in this order: `access` asks whether its `Host` is one of ours
//! (403) and whether it has the token (401), `routes` whether there is such a path (404) and method
//! (405), and for a question whether its `Origin` is ours (403) and its body small (413) and quick
//! (408) JSON. `connection` bounds connections and what they take, `answering` and
//! `runs` computations and the memory of their answers, `folder` the files that may be opened; `maps`
//! keeps what was computed of maps, `progress` says how far a study is. `browser_page` leads a browser
//! here. `api` makes questions of JSON; `page/` has the page.
//!
//! Without the feature `server` there are the questions about presets alone, and `exported` has them
//! as functions of WebAssembly: the engine of a page without a server, whose scripts are in
//! `without-server/`.
//!
//! It is made on `hyper` itself. What a router and layers of middleware would add are a dozen
//! paths and one order of checks, which is best read as one function; and the limits of
//! connections are `hyper`'s own.
//!
//! ```no_run
//! use grouser_serve::{Server, Settings};
//!
//! let server = Server::bind(&Settings::default())?;
//! println!("{}", server.address());
//! server.run(|| false)?;
//! # Ok::<(), grouser_serve::ServeError>(())
//! ```

#![cfg_attr(
    not(feature = "server"),
    expect(dead_code, reason = "what the server and its questions share with the others")
)]

mod api;
mod asked;
mod console;
#[cfg(not(feature = "server"))]
mod exported;
mod folder;
mod progress;
mod refusal;

#[cfg(feature = "server")]
mod access;
#[cfg(feature = "server")]
mod answering;
#[cfg(feature = "server")]
mod assets;
#[cfg(feature = "server")]
mod body;
#[cfg(feature = "server")]
mod browser_page;
#[cfg(feature = "server")]
mod cards;
#[cfg(feature = "server")]
mod connection;
#[cfg(feature = "server")]
mod kept;
#[cfg(feature = "server")]
mod limits;
#[cfg(feature = "server")]
mod maps;
#[cfg(feature = "server")]
mod routes;
#[cfg(feature = "server")]
mod runs;
#[cfg(feature = "server")]
mod server;
#[cfg(feature = "server")]
mod shared;
#[cfg(feature = "server")]
mod token;

#[cfg(feature = "server")]
pub use browser_page::BrowserPage;
#[cfg(feature = "server")]
pub use cards::{CardMaker, CardOrder};
#[cfg(feature = "server")]
pub use limits::Limits;
#[cfg(feature = "server")]
pub use server::{ServeError, Server, Settings};

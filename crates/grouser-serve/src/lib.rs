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

mod access;
mod answering;
mod api;
mod asked;
mod assets;
mod body;
mod browser_page;
mod connection;
mod console;
mod folder;
mod kept;
mod limits;
mod maps;
mod progress;
mod refusal;
mod routes;
mod runs;
mod server;
mod token;

pub use browser_page::BrowserPage;
pub use limits::Limits;
pub use server::{ServeError, Server, Settings};

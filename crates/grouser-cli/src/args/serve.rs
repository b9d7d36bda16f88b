//! Arguments of `serve`.

use std::net::IpAddr;
use std::path::PathBuf;

use clap::Args;
use clap::builder::NonEmptyStringValueParser;

#[derive(Debug, Args)]
#[command(
    after_help = "The address has a token: who knows it may ask this server anything, and nobody \
                        else may. The page opens documents of FOLDER and no file outside of it; \
                        without FOLDER it has the presets alone. Ctrl-C ends the server. \
                        docs/guide/console.md explains the page, what other programs may ask, and \
                        what is safe."
)]
pub(crate) struct ServeArgs {
    /// A folder of documents to choose from.
    pub(crate) folder: Option<PathBuf>,
    /// The port; 0 takes a free one.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) port: u16,
    /// Do not open the browser.
    #[arg(long)]
    pub(crate) no_open: bool,
    /// Listen on this address in place of the loopback: other machines that know the token may ask
    /// then.
    #[arg(long, value_name = "ADDRESS")]
    pub(crate) listen: Option<IpAddr>,
    /// Also answer to this name, as that of a tunnel; can be repeated.
    #[arg(long = "host", value_name = "NAME", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) hosts: Vec<String>,
}

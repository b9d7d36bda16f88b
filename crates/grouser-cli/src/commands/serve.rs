//! `grouser serve`: the console.

use std::net::{IpAddr, Ipv4Addr};
use std::path::Path;
use std::process::{Command, Stdio};

use grouser_serve::{Limits, ServeError, Server, Settings};

use super::card;
use crate::args::ServeArgs;
use crate::failure::Failure;
use crate::{interrupt, output};

pub(crate) fn run(args: &ServeArgs) -> Result<(), Failure> {
    let address = args.listen.unwrap_or(Ipv4Addr::LOCALHOST.into());
    let server = Server::bind(&Settings {
        folder: args.folder.clone(),
        address,
        port: args.port,
        hosts: args.hosts.clone(),
        card: Some(card::pdf),
        limits: Limits::default(),
    })?;
    let url = server.address();
    output::print(&format!("{url}\n"))?;
    if !address.is_loopback() {
        output::message(&exposed(address, args));
    }
    // It is there until the server ends.
    let page = if args.no_open { None } else { server.browser_page().ok() };
    if let Some(page) = &page {
        open(page.path());
    }
    interrupt::handle_ctrl_c();
    Ok(server.run(interrupt::is_asked_to_stop)?)
}

/// What others may do with a server that listens beyond the loopback.
fn exposed(address: IpAddr, args: &ServeArgs) -> String {
    let documents = match &args.folder {
        Some(folder) => {
            format!("read the documents in {}, and ", grouser::document::escape::path(folder))
        }
        None => String::new(),
    };
    format!(
        "note: it listens on {address}: whoever reaches this machine and knows the token may \
         {documents}let it compute; the connection is not encrypted"
    )
}

/// Opens the page in the user's browser. Without one the address is there to be opened by hand.
fn open(page: &Path) {
    let (program, arguments): (&str, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("rundll32", &["url.dll,FileProtocolHandler"])
    } else {
        ("xdg-open", &[])
    };
    let mut open = Command::new(program);
    open.args(arguments).arg(page).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    drop(open.spawn());
}

impl From<ServeError> for Failure {
    fn from(error: ServeError) -> Self {
        match error {
            ServeError::Folder { .. } => Self::Usage(error.to_string()),
            ServeError::Address { .. } | ServeError::System(_) => Self::Run(error.to_string()),
        }
    }
}

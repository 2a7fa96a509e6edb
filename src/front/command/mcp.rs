//! Serves a session to assistants and other programs (Model Context Protocol).

use std::io::{self, Write};
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpListener};
use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;

use super::failure::{CommandError, Status};
use super::open::{open_for_programs, open_session};
use super::options::{LogLevel, Options};
use super::outputs::Outputs;
use crate::mcp::{self, Server};
use crate::tools::{Opened, World};
use view::watch::live::random_word;

/// Memory (bytes) that plans may use, unless --heap says otherwise: what needs more does not end soon.
const HEAP: usize = 1 << 30;

/// How to serve.
#[derive(Args, Debug)]
pub(crate) struct McpArguments {
    /// Serve over HTTP, on an address of this machine, until Ctrl-C [default: any free port of 127.0.0.1]
    #[arg(
        long,
        value_name = "ADDRESS",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "127.0.0.1:0"
    )]
    http: Option<Address>,
    /// Word in the address that clients have to know [default: a random one]
    #[arg(long, value_name = "WORD", requires = "http", value_parser = word)]
    word: Option<String>,
    /// Folder into which pages with runs may be written; without it, nothing is written
    #[arg(long, value_name = "FOLDER")]
    folder: Option<PathBuf>,
}

/// An address of this machine that no other one can reach.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Address(SocketAddr);

impl FromStr for Address {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let port = text
            .parse()
            .or_else(|_| text.replace("localhost:", "").parse());
        let address = match port {
            Ok(port) => Ok(SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), port)),
            Err(_) => text.parse::<SocketAddr>(),
        };
        let address = address.map_err(|_| "an address was expected, as in 127.0.0.1:8000")?;
        match address.ip().is_loopback() {
            true => Ok(Address(address)),
            false => Err(format!(
                "{} can be reached by other machines: an address of this one was expected, as in 127.0.0.1:{}",
                address.ip(),
                address.port()
            )),
        }
    }
}

/// A word that can stand in an address and is not soon guessed.
fn word(text: &str) -> Result<String, String> {
    let is_plain = text
        .chars()
        .all(|c| c.is_ascii_alphanumeric() || "-_".contains(c));
    match is_plain && (8..=100).contains(&text.len()) {
        true => Ok(text.to_owned()),
        false => Err("8 to 100 letters, digits, - and _ were expected".to_owned()),
    }
}

/// Whether pages may be written into a folder.
pub(super) fn check_folder(
    options: &Options,
    folder: Option<&PathBuf>,
) -> Result<(), CommandError> {
    let outputs = Outputs::reading(options.files());
    outputs.folder("--folder", folder).check()
}

/// What the worlds that are served are made of.
pub(super) fn opened(options: &Options) -> Result<Opened, CommandError> {
    let quiet = Options {
        log_level: LogLevel::Warn,
        realtime: None,
        heap: options.heap.or(Some(HEAP)),
        ..options.clone()
    };
    let session = open_session(&quiet)?;
    Ok(Opened::of(&session, open_for_programs))
}

/// Answers requests until the input ends, or until Ctrl-C.
pub(crate) fn mcp(options: &Options, wanted: &McpArguments) -> Result<Status, CommandError> {
    check_folder(options, wanted.folder.as_ref())?;
    let opened = opened(options)?;
    let folder = wanted.folder.clone();
    let world = move || World::new(&opened, folder.as_deref());
    let Some(Address(address)) = wanted.http else {
        let world = world().map_err(CommandError::Open)?;
        Server::new(world).serve(io::stdin().lock(), io::stdout().lock())?;
        return Ok(Status::Good);
    };
    let listener = TcpListener::bind(address)
        .map_err(|error| CommandError::Open(format!("{address} cannot be used: {error}")))?;
    let address = listener.local_addr()?;
    let word = wanted.word.clone().unwrap_or_else(random_word);
    writeln!(
        io::stdout(),
        "; Assistants can connect to http://{address}/{word}/mcp"
    )?;
    io::stdout().flush()?;
    mcp::serve(listener, &word, world)?;
    Ok(Status::Good)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_addresses_of_this_machine_are_served() {
        for (text, address) in [
            ("8000", "127.0.0.1:8000"),
            ("localhost:8000", "127.0.0.1:8000"),
            ("127.0.0.1:0", "127.0.0.1:0"),
            ("[::1]:80", "[::1]:80"),
        ] {
            let found = text.parse::<Address>().map(|found| found.0.to_string());
            assert_eq!(found.as_deref(), Ok(address));
        }
        for text in [
            "",
            "0.0.0.0:80",
            "192.168.0.1:80",
            "example.org:80",
            "65536",
            "[::]:80",
        ] {
            assert!(text.parse::<Address>().is_err(), "{text}");
        }
        assert!(word("abcd-EFGH_1").is_ok());
        for text in ["", "short", "with/slash", "with space"] {
            assert!(word(text).is_err(), "{text}");
        }
    }
}

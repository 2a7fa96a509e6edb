//! Serves a session to Emacs.

use std::fs;
use std::io::{self, BufRead, Write};
use std::path::{Path, PathBuf};
use std::thread;

use clap::Args;

use super::failure::{CommandError, Status};
use super::open::open_session;
use super::options::Options;
use super::watching::{self, WatchArguments};
use crate::swank::{Ended, Secret, Server, ServerOptions, Stopper, Version, secret};
use lisp::visible::visible;
use session::dialogue::Converse;

/// Options of the server.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct SwankOptions {
    /// Port on which this machine can connect; 0 for any that is free
    #[arg(long, value_name = "N", default_value_t = 4005)]
    port: u16,
    /// Version of SLIME that Emacs has, such as 2.32; Emacs asks if it is another one
    #[arg(long, value_name = "VERSION")]
    slime_version: Option<String>,
    /// File whose first line clients have to send first, which nobody else may read [default:
    /// ~/.slime-secret, from which SLIME takes it; it is made if it does not exist]
    #[arg(long, value_name = "FILE")]
    secret: Option<PathBuf>,
    /// Let all programs of this machine connect
    #[arg(long, conflicts_with = "secret")]
    no_secret: bool,
    /// Take the port file and the version of SLIME from a form on standard input, as M-x slime
    /// sends it, use any free port, and end with standard input
    #[arg(long, conflicts_with_all = ["port", "slime_version"])]
    stdio_init: bool,
}

/// What `M-x slime` writes to the standard input of a Lisp.
struct Init {
    /// The file to which the port is to be written.
    port_file: PathBuf,
    version: Option<String>,
}

/// Serves a session until a client or Ctrl-C ends it.
pub(crate) fn swank(
    options: &Options,
    wanted: &SwankOptions,
    watch: &WatchArguments,
) -> Result<Status, CommandError> {
    let secret = match wanted.no_secret {
        true => None,
        false => Some(
            secret(wanted.secret.as_deref())
                .map_err(|error| CommandError::Open(error.to_string()))?,
        ),
    };
    let init = match wanted.stdio_init {
        true => Some(read_init()?),
        false => None,
    };
    let of_init = init.as_ref().and_then(|init| init.version.as_deref());
    let version = of_init.or(wanted.slime_version.as_deref());
    let server = Server::bind(ServerOptions {
        port: if wanted.stdio_init { 0 } else { wanted.port },
        secret: secret.as_ref().map(|secret| secret.word.clone()),
        version: version.map_or_else(Version::default, Version::named),
    })
    .map_err(|error| CommandError::Open(error.to_string()))?;
    let mut session = open_session(options)?;
    let _watched = watching::begin(&mut session, watch)?;
    let address = server.address();
    writeln!(
        io::stdout(),
        "; Emacs can connect to {address}: M-x slime-connect"
    )?;
    if let Some(Secret { path, .. }) = &secret {
        let path = path.display().to_string();
        writeln!(
            io::stdout(),
            "; Clients have to send the first line of {}, as SLIME does with ~/.slime-secret.",
            visible(&path)
        )?;
    }
    if let Some(init) = &init {
        write_port(&init.port_file, address.port())?;
    }
    let is_child = init.is_some();
    let ended = server
        .serve(&mut session, None, |stopper| {
            stop_at_the_end(stopper, is_child);
        })
        .map_err(|error| CommandError::Open(error.to_string()))?;
    if let Err(reason) = session.finish() {
        // If standard error is closed, the message is lost.
        let _ = writeln!(io::stderr(), "; {reason}.");
    }
    Ok(match ended {
        Ended::Stopped => Status::Good,
        Ended::Quit(status) => Status::Left(status),
    })
}

/// Reads the form `(swank:start-server FILE :slime-version VERSION)` from standard input.
fn read_init() -> Result<Init, CommandError> {
    let mut line = String::new();
    for read in io::stdin().lock().lines() {
        line = read?;
        if !line.trim().is_empty() {
            break;
        }
    }
    init_of(&line).ok_or_else(|| {
        CommandError::Open(
            "standard input does not begin with (swank:start-server FILE …)".to_owned(),
        )
    })
}

fn init_of(line: &str) -> Option<Init> {
    let form = line.trim().strip_prefix("(swank:start-server")?;
    let mut strings = form.split('"').skip(1).step_by(2);
    Some(Init {
        port_file: strings.next()?.into(),
        version: strings.next().map(str::to_owned),
    })
}

/// Writes the port to a file at once: whoever waits for the file must not read half of it.
fn write_port(file: &Path, port: u16) -> Result<(), CommandError> {
    let failed = |error| CommandError::Rewrite {
        path: file.to_owned(),
        error,
    };
    let mut name = file.as_os_str().to_owned();
    name.push(".new");
    fs::write(&name, format!("{port}\n")).map_err(failed)?;
    fs::rename(&name, file).map_err(failed)
}

/// Has the server end at Ctrl-C, and, as a child of Emacs, with standard input.
fn stop_at_the_end(stopper: Stopper, is_child: bool) {
    let at_interrupt = stopper.clone();
    // Without the handler, Ctrl-C ends the program less gently.
    let _ = ctrlc::set_handler(move || at_interrupt.stop());
    if is_child {
        let wait = move || {
            let mut rest = io::stdin().lock();
            let mut line = Vec::new();
            while rest.read_until(b'\n', &mut line).is_ok_and(|read| read > 0) {
                line.clear();
            }
            stopper.stop();
        };
        // Without the thread, Emacs ends the program less gently.
        let _ = thread::Builder::new().spawn(wait);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_emacs_tells_at_first_is_understood() {
        let init = init_of("(swank:start-server \"/tmp/slime.1\" :slime-version \"2.27\")\n");
        let init = init.unwrap();
        assert_eq!(init.port_file, Path::new("/tmp/slime.1"));
        assert_eq!(init.version.as_deref(), Some("2.27"));
        assert!(init_of("(load \"x\")").is_none());
    }
}

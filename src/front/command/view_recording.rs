//! Shows a recording in the browser.

use std::fs;
use std::io::{self, Write};
use std::path::PathBuf;
use std::thread;

use clap::Args;

use super::failure::{CommandError, Status};
use super::open::open_session;
use super::options::Options;
use super::outputs::Outputs;
use lisp::files::permit_regular;
use view::watch::live::{History, Origin, Place, Server, Views, open_in_browser, run_file};
use view::watch::recording::{RecordingError, read_recording};

/// Which recording to show, and how.
#[derive(Args, Debug)]
pub(crate) struct ViewArguments {
    /// MCAP file written by `run --record` or (record "…")
    #[arg(value_name = "MCAP")]
    file: PathBuf,
    /// Write the recording into an HTML file instead, which any browser shows without
    /// planwright
    #[arg(long, value_name = "HTML")]
    html: Option<PathBuf>,
}

/// Serves the page with the recording until interrupted, or writes it into a file.
pub(crate) fn view(options: &Options, wanted: &ViewArguments) -> Result<Status, CommandError> {
    let ViewArguments { file, html } = wanted;
    Outputs::reading(options.files().chain([file]))
        .file("--html", html.as_ref())
        .check()?;
    let failed = |error: RecordingError| CommandError::Recording {
        path: file.to_owned(),
        error,
    };
    let known = fs::metadata(file).and_then(|known| permit_regular(&known));
    let bytes = known
        .and_then(|()| fs::read(file))
        .map_err(|error| failed(error.into()))?;
    let history = History::new(Origin::Recording);
    let found = read_recording(&bytes, &history).map_err(failed)?;
    drop(bytes);
    // The named views depend on the kitchen that the options select.
    let session = open_session(options)?;
    let world = session.simulation().world();
    let views = Views::new(world, |link| history.link_named(link));
    if let Some(path) = html {
        let text = run_file(&history, &views);
        return match fs::write(path, text) {
            Ok(()) => Ok(Status::Good),
            Err(error) => Err(CommandError::Rewrite {
                path: path.to_owned(),
                error,
            }),
        };
    }
    let mut place = Place::new(options.view_port);
    let server = Server::start(&mut place, history.clone(), None, views);
    let server = server.map_err(CommandError::Serve)?;
    let address = server.address();
    let mut out = io::stdout();
    let cut_off = if found.is_cut_off {
        ", cut off at the end"
    } else {
        ""
    };
    writeln!(out, "{}: {} frames{cut_off}", file.display(), found.frames)?;
    writeln!(out, "The recording is at {address}\nPress Ctrl-C to stop.")?;
    out.flush()?;
    open_in_browser(&address);
    loop {
        thread::park();
    }
}

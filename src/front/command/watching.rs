//! Lets a session be watched as the command line asks.

use std::io::{self, Write};
use std::thread;
use std::time::{Duration, Instant};

use super::arguments::WatchArguments;
use super::failure::CommandError;
use crate::session::Session;
use crate::watch::live::open_in_browser;

/// How long to wait for a browser to show the page.
const BROWSER_START: Duration = Duration::from_secs(5);

/// Starts the recording, the page of the run and the live view if they are asked for, and prints the view's address
/// on standard error. Returns whether a browser was started.
pub(crate) fn begin(session: &mut Session, watch: &WatchArguments) -> Result<bool, CommandError> {
    if let Some(path) = &watch.record {
        session.begin_recording(path)?;
    }
    if let Some(path) = &watch.html {
        session.keep_run(path)?;
    }
    if watch.view {
        let address = session.open_view()?;
        // If standard error is closed, the browser may still show the page.
        let _ = writeln!(io::stderr(), "The live view is at {address}");
        return Ok(open_in_browser(&address));
    }
    Ok(false)
}

/// Waits while there are viewers, so that they can look at the end; also waits for a browser
/// that is just starting.
pub(crate) fn linger(session: &Session, has_browser: bool) {
    let Some(server) = session.audience().view_server() else {
        return;
    };
    let begin = Instant::now();
    let is_starting = || has_browser && !server.had_viewer() && begin.elapsed() < BROWSER_START;
    while server.viewers() > 0 || is_starting() {
        thread::sleep(Duration::from_millis(100));
    }
}

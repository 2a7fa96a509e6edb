//! Watching a session as the command line asks for it.

use std::io::{self, Write};
use std::thread;
use std::time::{Duration, Instant};

use super::arguments::WatchArguments;
use super::failure::CommandError;
use crate::session::Session;
use crate::watch::live::open_in_browser;

/// How long a browser may take to show the page before nobody is waited for.
const BROWSER_START: Duration = Duration::from_secs(5);

/// Begins the recording that is asked for. Opens the live view if that is asked for, and
/// tells its address on standard error. Returns whether a browser has been started.
pub(crate) fn begin(session: &mut Session, watch: &WatchArguments) -> Result<bool, CommandError> {
    if let Some(path) = &watch.record {
        session.begin_recording(path)?;
    }
    if watch.view {
        let address = session.open_view()?;
        // Without standard error the browser may still show the page.
        let _ = writeln!(io::stderr(), "The live view is at {address}");
        return Ok(open_in_browser(&address));
    }
    Ok(false)
}

/// Waits as long as somebody looks, so that the end can be looked at, too; at first also for
/// a browser that has been started.
pub(crate) fn linger(session: &Session, has_browser: bool) {
    let Some(server) = session.simulation().view_server() else {
        return;
    };
    let begin = Instant::now();
    let is_starting = || has_browser && !server.had_viewer() && begin.elapsed() < BROWSER_START;
    while server.viewers() > 0 || is_starting() {
        thread::sleep(Duration::from_millis(100));
    }
}

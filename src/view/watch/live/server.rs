//! The server of the page.

use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::connection;
use super::door::{Door, Stranger};
use super::history::History;
use super::pace_control::PaceControl;
use super::place::{Place, PlaceError};
use super::views::Views;

/// Maximum number of connections that have not shown the word.
const MAX_STRANGERS: usize = 128;
/// Maximum number of those that have. A page has one lasting connection, and up to five short ones.
const MAX_GUESTS: usize = 96;

/// Bytes of stack for a connection's thread.
const STACK_BYTES: usize = 512 << 10;

/// How long after the last viewer has left a pause ends.
const GONE: Duration = Duration::from_secs(3);

/// How long viewers may take to hear that the session is over.
const FAREWELL: Duration = Duration::from_millis(300);

/// Serves the page until it is dropped.
pub struct Server {
    shared: Arc<Shared>,
    address: SocketAddr,
    thread: Option<JoinHandle<()>>,
}

/// What the threads of the server share.
pub(super) struct Shared {
    pub history: History,
    /// `None` where time does not pass, as in a recording.
    pub pace: Option<PaceControl>,
    pub views: Views,
    /// The random word in the page's address.
    pub token: String,
    viewers: AtomicUsize,
    had_viewer: AtomicBool,
    is_stopped: AtomicBool,
}

impl Server {
    /// Starts serving at a place on this machine.
    pub fn start(
        place: &mut Place,
        history: History,
        pace: Option<PaceControl>,
        views: Views,
    ) -> Result<Self, PlaceError> {
        let listener = place.listen()?;
        let address = listener.local_addr().map_err(PlaceError::Other)?;
        let shared = Arc::new(Shared {
            history,
            pace,
            views,
            token: place.token().to_owned(),
            viewers: AtomicUsize::new(0),
            had_viewer: AtomicBool::new(false),
            is_stopped: AtomicBool::new(false),
        });
        let accepting = Arc::clone(&shared);
        let thread = thread::Builder::new()
            .name("live view".to_owned())
            .spawn(move || {
                let is_open = || !accepting.is_stopped();
                let own = Arc::clone(&accepting);
                let serve =
                    move |stranger: &Stranger, stream| connection::serve(&own, stranger, stream);
                Door::new(MAX_STRANGERS, MAX_GUESTS).serve(
                    &listener,
                    ("live view", STACK_BYTES),
                    is_open,
                    serve,
                );
            })
            .map_err(PlaceError::Other)?;
        Ok(Self {
            shared,
            address,
            thread: Some(thread),
        })
    }

    /// The page's address.
    pub fn address(&self) -> String {
        format!("http://{}/{}/", self.address, self.shared.token)
    }

    /// The current number of viewers.
    pub fn viewers(&self) -> usize {
        self.shared.viewers.load(Ordering::Relaxed)
    }

    /// Whether there has been a viewer.
    pub fn had_viewer(&self) -> bool {
        self.shared.had_viewer.load(Ordering::Relaxed)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let begin = Instant::now();
        while self.shared.history.is_over() && self.viewers() > 0 && begin.elapsed() < FAREWELL {
            thread::sleep(Duration::from_millis(5));
        }
        self.shared.is_stopped.store(true, Ordering::Relaxed);
        // A connection wakes the thread that waits in `accept`.
        drop(TcpStream::connect(self.address));
        if let Some(thread) = self.thread.take() {
            // The thread does not panic, and even then there would be nothing to do.
            drop(thread.join());
        }
    }
}

impl Shared {
    pub(super) fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }

    /// Counts a viewer for as long as the result lives.
    pub(crate) fn begin_viewing(self: &Arc<Self>) -> Viewing {
        self.viewers.fetch_add(1, Ordering::Relaxed);
        self.had_viewer.store(true, Ordering::Relaxed);
        Viewing(Arc::clone(self))
    }
}

/// A connected viewer.
pub(crate) struct Viewing(Arc<Shared>);

impl Drop for Viewing {
    fn drop(&mut self) {
        self.0.viewers.fetch_sub(1, Ordering::Relaxed);
        let Some(pace) = &self.0.pace else { return };
        // A user who reloads the page comes back at once. A pause that no viewer can see or end
        // ends by itself.
        thread::sleep(GONE);
        if self.0.viewers.load(Ordering::Relaxed) == 0 {
            pace.set_paused(false);
        }
    }
}

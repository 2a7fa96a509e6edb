//! The stream of events to one viewer.

use std::io::{self, Write};
use std::net::TcpStream;
use std::thread;
use std::time::{Duration, Instant};

use super::server::Shared;
use super::updates::{Message, Updates};
use crate::watch::http::begin_events;

/// Minimum time between two frames.
const BETWEEN_FRAMES: Duration = Duration::from_millis(15);

/// How long to stay silent before sending a sign of life, by which each side notices that the
/// other is gone.
const SIGN_OF_LIFE: Duration = Duration::from_millis(500);

/// Sends what is new until the viewer or the session is gone.
pub(super) fn stream(shared: &Shared, to: &mut TcpStream) -> io::Result<()> {
    begin_events(to)?;
    let mut updates = Updates::new(shared.history.clone(), shared.pace.clone(), &shared.views);
    loop {
        let begin = Instant::now();
        let mut messages = updates.wait(SIGN_OF_LIFE);
        if messages.is_empty() {
            messages.push(("alive", "{}".to_owned()));
        }
        let text: String = messages.iter().map(event).collect();
        to.write_all(text.as_bytes())?;
        if updates.is_over() || shared.is_stopped() {
            return Ok(());
        }
        thread::sleep(BETWEEN_FRAMES.saturating_sub(begin.elapsed()));
    }
}

fn event((name, data): &Message) -> String {
    format!("event: {name}\ndata: {data}\n\n")
}

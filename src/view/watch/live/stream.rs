//! The stream of events to one viewer.

use std::io::{self, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use serde_json::json;

use super::event_json;
use super::frame_json::frame_json;
use super::history::{Origin, ReadPosition};
use super::http::begin_events;
use super::pace_control::Speed;
use super::server::Shared;
use crate::watch::{Frame, Halt};

/// Minimum time between two frames.
const BETWEEN_FRAMES: Duration = Duration::from_millis(15);

/// How long to stay silent before sending a sign of life, by which each side notices that the
/// other is gone.
const SIGN_OF_LIFE: Duration = Duration::from_millis(500);

/// Maximum number of news items in one message.
const MAX_NEWS: usize = 500;

/// Sends what is new until the viewer or the session is gone. Sends only the newest frame, so a
/// slow viewer misses some.
pub(super) fn stream(shared: &Shared, to: &mut TcpStream) -> io::Result<()> {
    begin_events(to)?;
    let mut mark = ReadPosition::default();
    let mut shown: Option<Arc<Frame>> = None;
    let mut pace = None;
    let mut halt: Option<Arc<Halt>> = None;
    let hello = json!({
        "recording": shared.history.origin() == Origin::Recording,
        "views": shared.views,
    });
    let mut text = message("hello", &hello.to_string());
    loop {
        let begin = Instant::now();
        let pages = shared.history.read(&mut mark, MAX_NEWS, SIGN_OF_LIFE);
        if !pages.nodes.is_empty() {
            let nodes: Vec<_> = pages.nodes.iter().map(|n| event_json::node(n)).collect();
            text += &message("nodes", &json!(nodes).to_string());
        }
        if !pages.news.is_empty() {
            let news: Vec<_> = pages.news.iter().map(|n| event_json::news(n)).collect();
            text += &message("news", &json!(news).to_string());
        }
        let now = shared.pace.as_ref().map(|p| p.get());
        if now != pace {
            pace = now;
            text += &message("pace", &described(now));
        }
        if let Some(newest) = pages.newest
            && shown
                .as_ref()
                .is_none_or(|shown| !Arc::ptr_eq(shown, &newest))
        {
            let [start, end] = pages.span.unwrap_or([newest.time; 2]);
            text += &message("span", &format!("[{start:.4},{end:.4}]"));
            text += &message("frame", &frame_json(&newest, shown.as_deref()));
            shown = Some(newest);
        }
        let is_same = match (&halt, &pages.halt) {
            (Some(told), Some(new)) => Arc::ptr_eq(told, new),
            (told, new) => told.is_none() && new.is_none(),
        };
        // How a recorded session has ended says nothing about the times before.
        if !is_same && shared.history.origin() == Origin::Session {
            let new = pages.halt.as_deref().map(event_json::halt);
            text += &message("halt", &json!(new).to_string());
            halt = pages.halt;
        }
        let is_over = shared.history.origin() == Origin::Session && pages.is_over;
        if is_over && mark.is_read() {
            text += &message("over", "{}");
        }
        if text.is_empty() {
            text += &message("alive", "{}");
        }
        to.write_all(text.as_bytes())?;
        if (is_over && mark.is_read()) || shared.is_stopped() {
            return Ok(());
        }
        text.clear();
        thread::sleep(BETWEEN_FRAMES.saturating_sub(begin.elapsed()));
    }
}

fn described(pace: Option<(Speed, bool)>) -> String {
    match pace {
        Some((speed, is_paused)) => {
            let factor = Some(speed.factor()).filter(|factor| factor.is_finite());
            json!({"paused": is_paused, "speed": factor}).to_string()
        }
        None => "null".to_owned(),
    }
}

fn message(name: &str, data: &str) -> String {
    format!("event: {name}\ndata: {data}\n\n")
}

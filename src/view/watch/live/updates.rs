//! What is new to a viewer, as the messages that its page receives.

use std::sync::Arc;
use std::time::Duration;

use serde_json::{Value, json};

use super::event_json;
use super::frame_json::{frame_json, frames_json};
use super::history::{History, Origin, ReadPosition, Unread};
use super::mesh_bytes::mesh_bytes;
use super::pace_control::{PaceControl, Speed};
use super::views::Views;
use crate::watch::{Frame, Halt};

/// Maximum number of news items in one message.
const MAX_NEWS: usize = 500;

/// Maximum number of past frames in one answer.
const MAX_FRAMES: usize = 120;

/// A message to a page: its name and a JSON text.
pub type Message = (&'static str, String);

/// What is new to a viewer. Of the frames it gets only the newest, so a slow viewer misses some.
pub struct Updates {
    history: History,
    /// `None` where time does not pass, as in a recording.
    pace: Option<PaceControl>,
    views: Value,
    mark: ReadPosition,
    frame: Option<Arc<Frame>>,
    known_pace: Option<(Speed, bool)>,
    halt: Option<Arc<Halt>>,
    is_greeted: bool,
    is_over: bool,
}

impl Updates {
    /// What a viewer of a history gets, to whom nothing has been sent.
    pub fn new(history: History, pace: Option<PaceControl>, views: &Views) -> Updates {
        Updates {
            history,
            pace,
            views: views.0.clone(),
            mark: ReadPosition::default(),
            frame: None,
            known_pace: None,
            halt: None,
            is_greeted: false,
            is_over: false,
        }
    }

    /// The messages that the viewer lacks, as soon as there are any or the timeout has passed.
    pub(super) fn wait(&mut self, timeout: Duration) -> Vec<Message> {
        // The first message does not depend on what happens.
        let timeout = if self.is_greeted {
            timeout
        } else {
            Duration::ZERO
        };
        let unread = self.history.read(&mut self.mark, MAX_NEWS, timeout);
        self.messages(unread)
    }

    /// The messages that the viewer lacks.
    pub fn unread(&mut self) -> Vec<Message> {
        let unread = self.history.unread(&mut self.mark, MAX_NEWS);
        self.messages(unread)
    }

    /// Whether the viewer has been told everything, and that nothing more will come.
    pub(super) fn is_over(&self) -> bool {
        self.is_over
    }

    /// The meshes of the nodes from this number on, as a page loads them.
    pub fn meshes(&self, first: usize) -> Vec<u8> {
        mesh_bytes(&self.history.nodes_from(first))
    }

    /// The frames of the past between two times (s) as a JSON list, each as its difference from the
    /// one before.
    pub fn past(&self, from: f64, to: f64) -> String {
        past(&self.history, from, to)
    }

    /// Carries out the viewer's wish for the pace of time; returns whether it is known.
    pub fn change_pace(&self, wanted: &str) -> bool {
        self.pace.as_ref().is_some_and(|pace| pace.change(wanted))
    }

    fn messages(&mut self, unread: Unread) -> Vec<Message> {
        let mut messages = Vec::new();
        if !self.is_greeted {
            self.is_greeted = true;
            let is_recording = self.history.origin() == Origin::Recording;
            let hello = json!({"recording": is_recording, "views": self.views});
            messages.push(("hello", hello.to_string()));
        }
        if !unread.nodes.is_empty() {
            let nodes: Vec<_> = unread.nodes.iter().map(|n| event_json::node(n)).collect();
            messages.push(("nodes", json!(nodes).to_string()));
        }
        if !unread.news.is_empty() {
            let news: Vec<_> = unread.news.iter().map(|n| event_json::news(n)).collect();
            messages.push(("news", json!(news).to_string()));
        }
        let pace = self.pace.as_ref().map(PaceControl::get);
        if pace != self.known_pace {
            self.known_pace = pace;
            messages.push(("pace", described(pace)));
        }
        let is_known = |newest: &Arc<Frame>| {
            let known = self.frame.as_ref();
            known.is_some_and(|known| Arc::ptr_eq(known, newest))
        };
        if let Some(newest) = unread.newest.filter(|newest| !is_known(newest)) {
            let [start, end] = unread.span.unwrap_or([newest.time; 2]);
            messages.push(("span", format!("[{start:.4},{end:.4}]")));
            messages.push(("frame", frame_json(&newest, self.frame.as_deref())));
            self.frame = Some(newest);
        }
        let is_same = match (&self.halt, &unread.halt) {
            (Some(known), Some(new)) => Arc::ptr_eq(known, new),
            (known, new) => known.is_none() && new.is_none(),
        };
        // How a recorded session has ended says nothing about the times before.
        if !is_same && self.history.origin() == Origin::Session {
            let new = unread.halt.as_deref().map(event_json::halt);
            messages.push(("halt", json!(new).to_string()));
            self.halt = unread.halt;
        }
        // What happens from here on is not in the messages.
        let is_session = self.history.origin() == Origin::Session;
        self.is_over = is_session && unread.is_over && self.mark.is_read();
        if self.is_over {
            messages.push(("over", "{}".to_owned()));
        }
        messages
    }
}

/// The frames of the past between two times (s) as a JSON list, each as its difference from the one
/// before.
pub(super) fn past(history: &History, from: f64, to: f64) -> String {
    frames_json(&history.past(from, to, MAX_FRAMES))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::WatchEvent;

    #[test]
    fn a_viewer_is_greeted_once_and_gets_each_message_once() {
        let history = History::new(Origin::Session);
        let pace = PaceControl::new(Speed::Times(1.0));
        let mut updates = Updates::new(history.clone(), Some(pace), &Views(json!([])));
        let names = |updates: &mut Updates| {
            let messages = updates.unread().into_iter();
            messages.map(|(name, _)| name).collect::<Vec<_>>()
        };
        assert_eq!(names(&mut updates), ["hello", "pace"]);
        assert!(names(&mut updates).is_empty());
        history.add_news(0.0, &WatchEvent::Output("a".to_owned()));
        assert!(updates.change_pace("pause"));
        assert!(!updates.change_pace("fly"));
        assert_eq!(names(&mut updates), ["news", "pace"]);
        history.close();
        assert_eq!(names(&mut updates), ["over"]);
    }
}

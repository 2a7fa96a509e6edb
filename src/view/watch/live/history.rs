//! What a session offers its viewers: the newest frame, the past, and the news.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::timeline::Timeline;
use crate::watch::{Frame, Halt, Kind, Node, WatchEvent};

/// Number of news items that are kept; the oldest are forgotten first.
const MAX_NEWS: usize = 40_000;

/// Number of characters that are kept of a news item.
const MAX_TEXT: usize = 4_000;

/// Number of ways to continue that are kept.
const MAX_CHOICES: usize = 60;

/// Where a history comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A running session.
    Session,
    /// A recording.
    Recording,
}

/// What a session offers its viewers. Clones share the same history.
#[derive(Clone)]
pub struct History {
    shared: Arc<Shared>,
}

struct Shared {
    origin: Origin,
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    nodes: Vec<Arc<Node>>,
    newest: Option<Arc<Frame>>,
    past: Timeline,
    news: VecDeque<Arc<(f64, WatchEvent)>>,
    /// Number of forgotten news items.
    forgotten: usize,
    /// Why the session does not go on.
    halt: Option<Arc<Halt>>,
    /// Counts changes.
    version: u64,
    is_over: bool,
}

/// How far a reader has come.
#[derive(Clone, Default)]
pub struct ReadPosition {
    version: u64,
    nodes: usize,
    news: usize,
    has_all: bool,
}

impl ReadPosition {
    /// Whether the last read reached the end.
    pub(crate) fn is_read(&self) -> bool {
        self.has_all
    }
}

/// What is new to a reader.
pub struct Unread {
    pub nodes: Vec<Arc<Node>>,
    pub newest: Option<Arc<Frame>>,
    pub news: Vec<Arc<(f64, WatchEvent)>>,
    pub span: Option<[f64; 2]>,
    pub halt: Option<Arc<Halt>>,
    pub is_over: bool,
}

impl History {
    /// An empty history.
    pub fn new(origin: Origin) -> Self {
        let shared = Shared {
            origin,
            state: Mutex::default(),
            changed: Condvar::new(),
        };
        Self {
            shared: Arc::new(shared),
        }
    }

    /// Where the history comes from.
    pub fn origin(&self) -> Origin {
        self.shared.origin
    }

    /// Publishes the newest frame; `nodes` are all known nodes. With `keep`, adds the frame to
    /// the past, too.
    pub fn publish(&self, nodes: &[Arc<Node>], frame: Arc<Frame>, keep: bool) {
        self.change(|state| {
            let known = state.nodes.len().min(nodes.len());
            state.nodes.extend_from_slice(&nodes[known..]);
            if keep {
                state.past.push(Arc::clone(&frame));
            }
            state.newest = Some(frame);
        });
    }

    /// Adds a news item with its simulated time (s). A halt lasts until the session is resumed.
    pub(crate) fn add_news(&self, time: f64, event: &WatchEvent) {
        let (event, halt) = match event {
            WatchEvent::Output(text) => (WatchEvent::Output(shortened(text)), None),
            WatchEvent::Halted(halt) => {
                let halt = shortened_halt(halt);
                (WatchEvent::Halted(halt.clone()), Some(Arc::new(halt)))
            }
            WatchEvent::Resumed => return self.change(|state| state.halt = None),
            WatchEvent::Task(news) => {
                let mut news = news.clone();
                news.name = shortened(&news.name);
                news.failure = shortened(&news.failure);
                news.result = shortened(&news.result);
                (WatchEvent::Task(news), None)
            }
        };
        self.change(|state| {
            state.halt = halt.or(state.halt.take());
            if state.news.len() >= MAX_NEWS {
                state.news.pop_front();
                state.forgotten += 1;
            }
            state.news.push_back(Arc::new((time, event)));
        });
    }

    /// Tells the readers that nothing more will come.
    pub fn close(&self) {
        self.change(|state| state.is_over = true);
    }

    /// Whether nothing more will come.
    pub fn is_over(&self) -> bool {
        self.state().is_over
    }

    /// What is new to a reader, at most `most` news items, as soon as there is anything or the
    /// timeout has passed.
    pub fn read(&self, mark: &mut ReadPosition, most: usize, timeout: Duration) -> Unread {
        let state = self.state();
        let is_old = |state: &mut State| state.version == mark.version && mark.has_all;
        let waiting = self
            .shared
            .changed
            .wait_timeout_while(state, timeout, is_old);
        let (state, _) = waiting.unwrap_or_else(PoisonError::into_inner);
        state.read(mark, most)
    }

    /// What is new to a reader, at most `most` news items.
    pub(crate) fn unread(&self, mark: &mut ReadPosition, most: usize) -> Unread {
        self.state().read(mark, most)
    }

    /// The node of the link of the robot that has this name.
    pub fn link_named(&self, name: &str) -> Option<u32> {
        let state = self.state();
        let mut links = state.nodes.iter().filter(|n| n.kind == Kind::Robot);
        links.find(|node| node.name == name).map(|node| node.id)
    }

    /// The nodes from this number on.
    pub fn nodes_from(&self, first: usize) -> Vec<Arc<Node>> {
        self.state().nodes.get(first..).unwrap_or_default().to_vec()
    }

    /// Why the session does not go on.
    pub(super) fn halt(&self) -> Option<Arc<Halt>> {
        self.state().halt.clone()
    }

    /// The news items that are kept, with their simulated times (s).
    pub fn news(&self) -> Vec<Arc<(f64, WatchEvent)>> {
        self.state().news.iter().cloned().collect()
    }

    /// The past between two times (s), at most `most` frames.
    pub fn past(&self, from: f64, to: f64, most: usize) -> Vec<Arc<Frame>> {
        self.state().past.between(from, to, most)
    }

    fn change(&self, change: impl FnOnce(&mut State)) {
        let mut state = self.state();
        change(&mut state);
        state.version = state.version.wrapping_add(1);
        drop(state);
        self.shared.changed.notify_all();
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // Nothing panics while holding the lock, and even then the state would be consistent.
        let state = self.shared.state.lock();
        state.unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    /// What is new to a reader, at most `most` news items.
    fn read(&self, mark: &mut ReadPosition, most: usize) -> Unread {
        mark.version = self.version;
        let nodes = self.nodes.get(mark.nodes..).unwrap_or_default().to_vec();
        mark.nodes = self.nodes.len();
        let first = mark.news.saturating_sub(self.forgotten);
        let news: Vec<_> = self.news.iter().skip(first).take(most).cloned().collect();
        mark.news = self.forgotten + first.min(self.news.len()) + news.len();
        mark.has_all = mark.news >= self.forgotten + self.news.len();
        Unread {
            nodes,
            newest: self.newest.clone(),
            news,
            span: self.past.span(),
            halt: self.halt.clone(),
            is_over: self.is_over,
        }
    }
}

fn shortened(text: &str) -> String {
    match text.char_indices().nth(MAX_TEXT) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

fn shortened_halt(halt: &Halt) -> Halt {
    let choices = halt.choices.iter().take(MAX_CHOICES);
    Halt {
        class: shortened(&halt.class),
        report: shortened(&halt.report),
        place: shortened(&halt.place),
        choices: choices.map(|choice| shortened(choice)).collect(),
        ..*halt
    }
}

#[cfg(test)]
mod tests {
    use crate::watch::HaltKind;
    use crate::watch::live::history::*;

    fn add_output(history: &History, text: &str) {
        history.add_news(0.0, &WatchEvent::Output(text.to_owned()));
    }

    fn read(history: &History, mark: &mut ReadPosition) -> Vec<String> {
        let pages = history.read(mark, 3, Duration::ZERO);
        let texts = pages.news.iter().map(|news| match &news.1 {
            WatchEvent::Output(text) => text.clone(),
            other => panic!("{other:?}"),
        });
        texts.collect()
    }

    #[test]
    fn a_reader_gets_everything_once() {
        let history = History::new(Origin::Session);
        for text in ["a", "b", "c", "d"] {
            add_output(&history, text);
        }
        let mut mark = ReadPosition::default();
        assert_eq!(read(&history, &mut mark), ["a", "b", "c"]);
        assert_eq!(read(&history, &mut mark), ["d"]);
        assert!(read(&history, &mut mark).is_empty());
        add_output(&history, "e");
        assert_eq!(read(&history, &mut mark), ["e"]);
    }

    #[test]
    fn a_halt_lasts_until_the_session_is_resumed_whatever_is_printed_meanwhile() {
        let history = History::new(Origin::Session);
        let halt = || {
            history
                .read(&mut ReadPosition::default(), 3, Duration::ZERO)
                .halt
        };
        let reported = Halt::new(HaltKind::Stopped, "x".repeat(10 * MAX_TEXT));
        history.add_news(0.0, &WatchEvent::Halted(reported));
        (0..MAX_NEWS + 5).for_each(|i| add_output(&history, &i.to_string()));
        assert!(halt().is_some_and(|halt| halt.report.len() < MAX_TEXT + 9));
        history.add_news(0.0, &WatchEvent::Resumed);
        assert_eq!(halt(), None);
    }

    #[test]
    fn news_are_forgotten_but_those_that_come_are_read() {
        let history = History::new(Origin::Session);
        let mut mark = ReadPosition::default();
        (0..MAX_NEWS + 5).for_each(|i| add_output(&history, &i.to_string()));
        assert_eq!(read(&history, &mut mark)[0], "5");
        assert_eq!(history.state().news.len(), MAX_NEWS);
        add_output(&history, &"x".repeat(10 * MAX_TEXT));
        let last = history.state().news.back().cloned();
        assert!(matches!(&last.unwrap().1, WatchEvent::Output(t) if t.len() < MAX_TEXT + 9));
    }
}

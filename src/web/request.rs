//! What a page asks for.

use std::collections::BTreeMap;

use serde::Deserialize;

/// A request of the page.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub enum Request {
    /// Begin a session.
    Open {
        /// Its seed.
        #[serde(default)]
        seed: u64,
        /// The user's files, by name.
        #[serde(default)]
        files: BTreeMap<String, String>,
    },
    /// Evaluate an input.
    #[serde(rename_all = "camelCase")]
    Evaluate {
        /// Its text.
        text: String,
        /// The name of a file, if it is one's text.
        #[serde(default)]
        file: Option<String>,
        /// The poll at which it was interrupted, if it was, and is to be again.
        #[serde(default)]
        interrupted_at: Option<u64>,
        /// Whether it is repeated, so that time passes without waiting.
        #[serde(default)]
        again: bool,
    },
    /// What could be typed at a place, in UTF-16 units.
    Complete {
        /// The text so far.
        text: String,
        /// The place.
        at: usize,
        /// Comes back with the answer.
        number: u64,
    },
    /// What is known about what is being typed.
    Hint {
        /// The text so far.
        text: String,
        /// The place.
        at: usize,
        /// Comes back with the answer.
        number: u64,
    },
    /// Whether a text is whole, so that Enter evaluates it.
    Enter {
        /// The text.
        text: String,
        /// Comes back with the answer.
        number: u64,
    },
    /// The page of the live view.
    ViewPage {
        /// A script that comes before its own.
        script: String,
        /// Comes back with the answer.
        number: u64,
    },
    /// Find mistakes in a text.
    Check {
        /// The name of the file.
        name: String,
        /// Its text.
        text: String,
    },
    /// Make a text the contents of a file, or delete the file.
    File {
        /// Its name.
        name: String,
        /// Its text; the file is deleted if there is none.
        text: Option<String>,
    },
    /// Which sweep a file defines.
    Sweep {
        /// The name of the file.
        file: String,
        /// Its text.
        text: String,
        /// The sweep's name; the last one of the file if there is none.
        #[serde(default)]
        name: Option<String>,
        /// The seed.
        seed: u64,
        /// Comes back with the answer.
        number: u64,
    },
    /// What comes of a world of the sweep that was asked for.
    World {
        /// The world.
        world: u64,
        /// Comes back with the answer.
        number: u64,
    },
    /// What records of the sweep that was asked for say together.
    Summary {
        /// The records as JSON texts, in order of their worlds.
        lines: Vec<String>,
        /// Comes back with the answer.
        number: u64,
    },
    /// The meshes of the nodes from a number on.
    Meshes(usize),
    /// The frames of the past between two times (s).
    Past {
        /// The first time.
        from: f64,
        /// The last.
        to: f64,
        /// Comes back with the answer.
        number: u64,
    },
    /// Change the pace: `pause`, `go`, or `speed` and a speed.
    Pace(String),
}

//! Transcripts: how they are replayed, and those that there are.

mod conformance;
mod replaying;

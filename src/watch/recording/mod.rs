//! Recordings of sessions as MCAP files, which other tools for robots open, too.
//!
//! Messages are JSON in the schemas that Foxglove publishes, so that its viewer shows them;
//! what has no such schema (tasks, who holds what) has one of its own. Times are simulated:
//! the same session makes the same bytes. [`Recorder`] writes, [`read_recording`] reads.

mod base64;
mod channel;
mod follower;
mod message;
pub(crate) mod read;
mod schema;
mod shapes;
mod write;

pub(crate) use follower::{Recorder, RecordingResult};
pub(crate) use read::read_recording;

use std::io;

use thiserror::Error;

/// Why there is no recording.
#[derive(Debug, Error)]
pub(crate) enum RecordingError {
    /// The file cannot be read or written.
    #[error("{0}")]
    File(#[from] io::Error),
    /// The file is not what MCAP files are.
    #[error("it is no MCAP file: {0}")]
    Format(#[from] mcap::McapError),
    /// A message cannot be read or written.
    #[error("a message is malformed: {0}")]
    Message(#[from] serde_json::Error),
    /// There is nothing in it that could be shown.
    #[error("it holds no recording of planwright")]
    Foreign,
}

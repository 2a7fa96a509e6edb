//! Recordings of sessions as MCAP files, which other robotics tools can open, too.
//!
//! Messages are JSON in the schemas published by Foxglove, so that its viewer can show them;
//! tasks and held objects, for which there are none, have schemas of our own. Times are
//! simulated: the same session gives the same bytes. [`Recorder`] writes, [`read_recording`]
//! reads.

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

/// Why a recording cannot be written or read.
#[derive(Debug, Error)]
pub(crate) enum RecordingError {
    /// The file cannot be read or written.
    #[error("{0}")]
    File(#[from] io::Error),
    /// The file is not an MCAP file.
    #[error("it is not an MCAP file: {0}")]
    Format(#[from] mcap::McapError),
    /// A message cannot be read or written.
    #[error("a message is malformed: {0}")]
    Message(#[from] serde_json::Error),
    /// The file contains nothing that can be shown.
    #[error("it contains no planwright recording")]
    Foreign,
}

//! Recordings of sessions as MCAP files, which other robotics tools can open, too.
//!
//! Messages are Protobuf in the schemas published by Foxglove, so that its viewer can show them;
//! tasks and held objects, for which there are none, have schemas of our own. Robot, kitchen and objects are
//! there as descriptions in URDF, too. Poses and joints are
//! written when they change, and all of them every few seconds. What can be asked of a recording is attached to its
//! end, as rows. Times are simulated: the same
//! session gives the same bytes. [`Recorder`] writes, [`read_recording`] reads, also the JSON of
//! earlier versions.

mod attachment;
mod channel;
mod chunks;
mod contacts;
mod decompress;
mod description;
mod episode;
mod follower;
mod markers;
mod mcap_file;
mod message;
mod messages;
mod places;
mod protobuf;
pub mod read;
mod rows;
mod schema;
mod shapes;
mod told;
mod wire;
mod write;

pub use episode::{Episode, Wanted, read_episode, read_episode_of_file};
pub use follower::{Recorder, RecordingResult};
pub use read::read_recording;
pub use rows::{Datum, Rows};

use std::io::{self, ErrorKind};

use defect::Defect;
use thiserror::Error;

/// Why a recording cannot be written or read.
#[derive(Debug, Error)]
pub enum RecordingError {
    /// There is no space left on the disk.
    #[error("the disk is full")]
    DiskFull,
    /// The file cannot be read or written.
    #[error("{0}")]
    File(io::Error),
    /// The file is not an MCAP file.
    #[error("it is not an MCAP file: {0}")]
    Format(mcap::McapError),
    /// A chunk is larger than any that a recorder writes.
    #[error("a chunk of {size} bytes is too large")]
    LargeChunk {
        /// Its unpacked size (bytes).
        size: u64,
    },
    /// A chunk is compressed in an unknown way.
    #[error("a chunk is compressed with {0}: only lz4 and zstd can be read")]
    Compression(String),
    /// The library that reads MCAP files has failed.
    #[error("the file is damaged in a way that the reader of MCAP files does not expect: {0}")]
    Reader(String),
    /// A message is not what its schema says.
    #[error("a message on {topic} is malformed")]
    Malformed {
        /// The topic of its channel.
        topic: &'static str,
    },
    /// A message cannot be read or written.
    #[error("a message is malformed: {0}")]
    Message(#[from] serde_json::Error),
    /// The file ends in its first chunk.
    #[error("it is cut off before the end of its first second")]
    CutOff,
    /// The file contains nothing that can be shown.
    #[error("it contains no planwright recording")]
    Foreign,
}

impl From<io::Error> for RecordingError {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => Self::DiskFull,
            _ => Self::File(error),
        }
    }
}

impl From<mcap::McapError> for RecordingError {
    fn from(error: mcap::McapError) -> Self {
        match of_system(&error) {
            Some(code) => io::Error::from_raw_os_error(code).into(),
            None => Self::Format(error),
        }
    }
}

impl From<Defect> for RecordingError {
    fn from(defect: Defect) -> Self {
        Self::Reader(defect.message().to_owned())
    }
}

/// The number of the operating system's error that is behind an error, if there is one.
fn of_system(error: &(dyn std::error::Error + 'static)) -> Option<i32> {
    let causes = std::iter::successors(Some(error), |error| error.source());
    let mut of_files = causes.filter_map(|error| error.downcast_ref::<io::Error>());
    of_files.find_map(io::Error::raw_os_error)
}

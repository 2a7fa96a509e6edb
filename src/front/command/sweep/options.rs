//! The arguments of `planwright sweep`.

use std::num::{NonZeroU64, NonZeroUsize};
use std::path::PathBuf;

use clap::Args;

/// How to run a sweep.
#[derive(Args, Debug)]
pub(crate) struct SweepOptions {
    /// File with plans and a sweep
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Which sweep, if the file defines several [default: the last one]
    #[arg(value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// How many worlds [default: as many as the sweep says]
    #[arg(long, value_name = "N")]
    pub(crate) worlds: Option<NonZeroU64>,
    /// How many worlds to run at the same time [default: the number of processors]
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<NonZeroUsize>,
    /// Folder to write the records to, one line of JSON for each world
    #[arg(long, value_name = "FOLDER")]
    pub(crate) into: Option<PathBuf>,
    /// Print the records, one line of JSON for each world, instead of the summary
    #[arg(long)]
    pub(crate) json: bool,
    /// Open the prompt in world I, where (run-sweep-world) runs the plan
    #[arg(long, value_name = "I")]
    pub(crate) replay: Option<u64>,
    /// With --replay: run the plan there instead, and show what it prints
    #[arg(long, requires = "replay")]
    pub(crate) run: bool,
}

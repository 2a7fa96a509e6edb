//! The arguments of `planwright grade`.

use std::num::{NonZeroU64, NonZeroUsize};
use std::path::PathBuf;

use clap::Args;

use crate::command::options::seconds;

/// What to grade, and how.
#[derive(Args, Debug)]
pub(crate) struct GradeArguments {
    /// The lesson: the name of one that is built in, such as bring-the-bottle, or a file
    #[arg(
        value_name = "LESSON",
        required_unless_present = "worker",
        default_value = ""
    )]
    pub(crate) lesson: String,
    /// What was handed in, a plan file of each student; without any, the lesson's own solution is graded
    #[arg(value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// In how many worlds [default: as many as the lesson says]
    #[arg(long, value_name = "N")]
    pub(crate) worlds: Option<NonZeroU64>,
    /// Real time that a submission may take in each world
    #[arg(long, value_name = "SECONDS", value_parser = seconds, default_value = "60")]
    pub(crate) time_limit: f64,
    /// How many submissions to grade at the same time [default: the number of processors]
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<NonZeroUsize>,
    /// Write the marks as a table
    #[arg(long, value_name = "CSV")]
    pub(crate) csv: Option<PathBuf>,
    /// Write a test report
    #[arg(long, value_name = "XML")]
    pub(crate) junit: Option<PathBuf>,
    /// Write a page for each student, with the run of a world that was not passed, and index.html for the
    /// class
    #[arg(long, value_name = "FOLDER")]
    pub(crate) html: Option<PathBuf>,
    /// Grade what standard input says
    #[arg(long, hide = true)]
    pub(crate) worker: bool,
}

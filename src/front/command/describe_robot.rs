//! Writes the description of a robot that follows from its URDF.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;

use super::failure::{CommandError, Status};
use super::open::robot_options;
use super::options::Options;
use lisp::files::text_of;

/// Which robot.
#[derive(Args, Debug)]
pub(crate) struct DescribeRobotArguments {
    /// URDF of the robot
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// SRDF of the robot: which of its links may touch, and postures of its arms
    #[arg(long, value_name = "FILE")]
    srdf: Option<PathBuf>,
}

/// Prints the description.
pub(crate) fn describe(
    options: &Options,
    wanted: &DescribeRobotArguments,
) -> Result<Status, CommandError> {
    let robot = robot_options(options, &wanted.file)?;
    let text = match &wanted.srdf {
        Some(file) => {
            let name = file.display().to_string();
            let srdf = text_of(file);
            let srdf = srdf.map_err(|error| CommandError::Open(format!("{name}: {error}")))?;
            robot.derived_description_with_srdf(&name, &srdf)
        }
        None => robot.derived_description(),
    };
    let text = text.map_err(|error| CommandError::Open(error.to_string()))?;
    io::stdout().write_all(text.as_bytes())?;
    Ok(Status::Good)
}

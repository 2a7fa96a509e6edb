//! Writes the description of a robot that follows from its URDF.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;

use super::failure::{CommandError, Status};
use super::open::robot_options;
use super::options::Options;

/// Which robot.
#[derive(Args, Debug)]
pub(crate) struct DescribeRobotArguments {
    /// URDF of the robot
    #[arg(value_name = "FILE")]
    file: PathBuf,
}

/// Prints the description.
pub(crate) fn describe(
    options: &Options,
    wanted: &DescribeRobotArguments,
) -> Result<Status, CommandError> {
    let text = robot_options(options, &wanted.file)?
        .derived_description()
        .map_err(|error| CommandError::Open(error.to_string()))?;
    io::stdout().write_all(text.as_bytes())?;
    Ok(Status::Good)
}

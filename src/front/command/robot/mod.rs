//! A robot for others: carries out the goals that nodes of ROS 2 send.

#[cfg(feature = "ros2")]
mod goal;
#[cfg(feature = "ros2")]
mod offered;
#[cfg(feature = "ros2")]
mod serving;
#[cfg(feature = "ros2")]
mod sight;
#[cfg(feature = "ros2")]
mod trajectory;

use clap::Args;

#[cfg(feature = "ros2")]
pub(super) use goal::pose;

use super::failure::{CommandError, Status};
use super::open::open_session;
use super::options::Options;
use super::ros2;

/// How others reach the robot.
#[derive(Args, Clone, Debug)]
pub(crate) struct RobotArguments {
    /// By ROS 2, with messages of a distribution such as humble [default: ROS_DISTRO, or jazzy]
    #[arg(
        long,
        required = true,
        value_name = "DISTRIBUTION",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = ""
    )]
    ros2: String,
}

/// Carries out goals until Ctrl-C.
pub(crate) fn robot(options: &Options, wanted: &RobotArguments) -> Result<Status, CommandError> {
    let mut session = open_session(options)?;
    let publishing = ros2::publish(&mut session, &wanted.ros2)?;
    serve(session, publishing)
}

#[cfg(feature = "ros2")]
use serving::serve;

/// Nothing is published without the feature, so there is nothing to serve.
#[cfg(not(feature = "ros2"))]
fn serve(_: session::Session, publishing: ros2::Publishing) -> Result<Status, CommandError> {
    match publishing {}
}

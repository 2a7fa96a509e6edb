//! From a path to a motion in time: rounded corners, the fastest speeds within the limits, and a
//! follower.

pub(crate) mod axis_group;
pub(crate) mod planned_trajectory;
mod rounded_path;
pub(crate) mod speeds;
mod time_scaling;
pub(crate) mod timed_path;
pub(crate) mod trajectory;
pub(crate) mod trajectory_follower;

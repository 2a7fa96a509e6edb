//! Why a motion fails: all data of failures, and their wording. Planning, choosing and jobs return it.

pub(crate) mod base_place;
pub(crate) mod broken_loop;
mod class;
pub(crate) mod grasp_obstacle;
pub(crate) mod joint_limit;
pub(crate) mod motion_failure;
pub(crate) mod no_grasp;
pub(crate) mod no_handle_grasp;
pub(crate) mod overload;
pub(crate) mod pinned_object;
pub(crate) mod process_module;
pub(crate) mod pushed_object;
pub(crate) mod robot_trouble;
pub(crate) mod short_arm;
pub(crate) mod stopped_part;
pub(crate) mod stuck_object;
pub(crate) mod unreachable;
mod wording;
pub(crate) mod wrong_trajectory;

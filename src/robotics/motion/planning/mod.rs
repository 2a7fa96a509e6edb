//! Paths without collisions: for the base over the floor, for the arms to a posture or a pose, and
//! for a hand with what it puts down or opens.

pub(crate) mod aim;
pub(crate) mod base_checker;
mod base_lattice;
pub(crate) mod base_path;
pub(crate) mod cartesian_path;
pub(crate) mod configuration;
pub(crate) mod configuration_checker;
mod drive_legs;
pub(crate) mod drive_plan;
pub(crate) mod goal_configurations;
pub(crate) mod handle_approach;
pub(crate) mod handle_way;
pub mod interruption;
pub(crate) mod joint_path;
pub(crate) mod joint_plan;
pub(crate) mod joint_trajectory;
pub(crate) mod opening_hands;
mod pages;
mod path_test;
pub(crate) mod planning_group;
pub(crate) mod pose_goal;
pub(crate) mod put_plan;
pub(crate) mod rigid_loop;
pub(crate) mod straight_way;
pub(crate) mod way_obstacle;

//! The atomic motions as jobs that are advanced step by step, and the planning of paths.
//!
//! Only this folder moves the robot. Nothing here knows of the plan language.

pub(crate) mod axis_group;
mod base_checker;
mod base_lattice;
pub(crate) mod base_path;
pub(crate) mod cartesian_path;
pub(crate) mod command;
mod configuration_checker;
pub(crate) mod detect;
pub(crate) mod drive;
pub(crate) mod drive_plan;
pub(crate) mod expected_contacts;
pub(crate) mod failure;
mod grasp_chooser;
mod grasp_path;
pub(crate) mod grasp_reach;
mod grip;
pub(crate) mod gripper;
pub(crate) mod guard;
pub(crate) mod hand;
pub(crate) mod handle_chooser;
mod handle_way;
pub(crate) mod hold;
pub(crate) mod interruption;
pub(crate) mod job;
mod joint_follower;
mod joint_limit;
mod joint_motion;
pub(crate) mod joint_path;
mod joint_trajectory;
pub(crate) mod look;
pub(crate) mod move_joints;
pub(crate) mod move_tcp;
pub(crate) mod move_torso;
pub(crate) mod no_grasp;
pub(crate) mod no_handle_grasp;
mod overhead;
pub(crate) mod payload;
mod planning_group;
mod pose_goal;
mod process_module;
pub(crate) mod pull;
pub(crate) mod pushing;
pub(crate) mod put;
mod put_plan;
mod put_reach;
pub(crate) mod reach;
mod replanning;
mod rounded_path;
mod shoulder;
pub(crate) mod speeds;
mod standstill;
mod time_scaling;
mod together;
mod touching;
pub(crate) mod trajectory;
mod trajectory_follower;
pub(crate) mod unreachable;

pub(crate) use base_checker::BaseChecker;
pub(crate) use base_path::LEAST_MARGIN;
pub(crate) use detect::{Detect, DetectQuery};
pub(crate) use drive::Drive;
pub(crate) use expected_contacts::CollisionMode;
pub(crate) use failure::MotionFailure;
pub(crate) use grasp_chooser::{
    Candidates, GraspChoice, GraspChooser, GraspQuestion, about_z, needed,
};
pub(crate) use grasp_path::plan_grasp;
pub(crate) use grasp_reach::{Effort, GraspObstacle, GraspPart, GraspReach, Station};
pub(crate) use gripper::{GripperCommand, MoveGripper};
pub(crate) use handle_chooser::{HandleChooser, HandleQuestion};
pub(crate) use hold::{LetGo, held_objects, take_hold};
pub(crate) use job::{
    DetectedObject, Motion, MotionOutcome, MotionStatus, PlannedTrajectory, ProcessModule,
    TrajectoryAxes,
};
pub(crate) use look::{Look, LookDirection, LookTarget, pan_and_tilt};
pub(crate) use move_joints::MoveJoints;
pub(crate) use move_tcp::{MoveTcp, PoseGoal, TcpPath};
pub(crate) use move_torso::MoveTorso;
pub(crate) use no_handle_grasp::HandleObstacle;
pub(crate) use overhead::Overhead;
pub(crate) use pull::{Pull, StoppedPart};
pub(crate) use put::Put;
pub(crate) use put_reach::{HeldGrip, PutReach, releasing_opening};
pub(crate) use reach::{can_reach, can_stand, touching_at};
pub(crate) use unreachable::{UnreachablePose, UnreachableReason};

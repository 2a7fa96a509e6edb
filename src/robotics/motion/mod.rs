//! The atomic motions as jobs that are advanced step by step, and the planning of paths.
//!
//! Only this folder moves the robot. Nothing here knows of the plan language.

pub mod axis_group;
mod base_checker;
mod base_lattice;
pub mod base_path;
pub mod cartesian_path;
pub mod command;
mod configuration_checker;
pub mod detect;
pub mod drive;
pub mod drive_plan;
pub mod expected_contacts;
pub mod failure;
mod grasp_chooser;
mod grasp_path;
pub mod grasp_reach;
mod grip;
pub mod gripper;
pub mod guard;
pub mod hand;
pub mod handle_chooser;
mod handle_way;
pub mod hold;
pub mod interruption;
pub mod job;
mod joint_follower;
mod joint_limit;
mod joint_motion;
pub mod joint_path;
mod joint_trajectory;
pub mod look;
pub mod move_joints;
pub mod move_tcp;
pub mod move_torso;
pub mod no_grasp;
pub mod no_handle_grasp;
mod overhead;
pub mod payload;
mod planning_group;
mod pose_goal;
mod process_module;
pub mod pull;
pub mod pushing;
pub mod put;
mod put_plan;
mod put_reach;
pub mod reach;
mod replanning;
mod rounded_path;
mod shoulder;
pub mod speeds;
mod standstill;
mod time_scaling;
mod together;
mod touching;
pub mod trajectory;
mod trajectory_follower;
pub mod unreachable;

pub use base_checker::BaseChecker;
pub use base_path::LEAST_MARGIN;
pub use detect::{Detect, DetectQuery};
pub use drive::Drive;
pub use expected_contacts::CollisionMode;
pub use failure::MotionFailure;
pub use grasp_chooser::{Candidates, GraspChoice, GraspChooser, GraspQuestion, about_z, needed};
pub use grasp_path::plan_grasp;
pub use grasp_reach::{Effort, GraspObstacle, GraspPart, GraspReach, Station};
pub use gripper::{GripperCommand, MoveGripper};
pub use handle_chooser::{HandleChooser, HandleQuestion};
pub use hold::{LetGo, held_objects, take_hold};
pub use job::{
    DetectedObject, Motion, MotionOutcome, MotionStatus, PlannedTrajectory, ProcessModule,
    TrajectoryAxes,
};
pub use look::{Look, LookDirection, LookTarget, pan_and_tilt};
pub use move_joints::MoveJoints;
pub use move_tcp::{MoveTcp, PoseGoal, TcpPath};
pub use move_torso::MoveTorso;
pub use no_handle_grasp::HandleObstacle;
pub use overhead::Overhead;
pub use pull::{Pull, StoppedPart};
pub use put::Put;
pub use put_reach::{HeldGrip, PutReach, releasing_opening};
pub use reach::{can_reach, can_stand, touching_at};
pub use unreachable::{UnreachablePose, UnreachableReason};

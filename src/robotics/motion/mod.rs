//! The atomic motions as jobs that are advanced step by step, and the planning of paths.
//!
//! Only this folder moves the robot. Nothing here knows of the plan language. Its rooms, each of
//! which uses only those before it: why a motion fails ([`failure`]), [`trajectories`],
//! [`contact`], [`planning`], [`choosing`], [`jobs`], and typed requests for motions ([`command`]).

pub(crate) mod choosing;
pub mod command;
pub(crate) mod contact;
pub(crate) mod failure;
pub(crate) mod jobs;
pub(crate) mod planning;
pub(crate) mod trajectories;

pub use choosing::carrying_posture::{carries, carrying_posture};
pub use choosing::fitted_grasps::fit_grasps;
pub use choosing::grasp_candidates::{Candidates, GraspChoice, GraspQuestion, about_z};
pub use choosing::grasp_chooser::{GraspChooser, NoGraspHere, needed};
pub(crate) use choosing::grasp_reach::GraspReach;
pub use choosing::grasp_reach::{Effort, Station};
pub use choosing::hand_reach::HandReach;
pub use choosing::handle_chooser::{HandleChooser, HandleQuestion};
pub use choosing::overhead::Overhead;
pub use choosing::put_reach::{HeldGrip, PutReach};
pub use choosing::reach::{can_reach, can_stand, touching_at};
pub use choosing::shape_grasps::ShapeGrasps;
pub use choosing::ungraspable::Ungraspable;
pub use contact::expected_contacts::CollisionMode;
pub use contact::hand::releasing_opening;
pub use contact::holding::{held_objects, take_hold};
pub use failure::base_place::BasePlace;
pub use failure::grasp_obstacle::{GraspObstacle, GraspPart};
pub use failure::motion_failure::MotionFailure;
pub use failure::no_handle_grasp::HandleObstacle;
pub use failure::process_module::ProcessModule;
pub use failure::pushed_object::PushedObject;
pub use failure::robot_trouble::{RobotFailure, RobotTrouble};
pub use failure::stopped_part::StoppedPart;
pub use failure::unreachable::{UnreachablePose, UnreachableReason};
pub use jobs::detect::DetectQuery;
pub use jobs::drive::Drive;
pub use jobs::grasp_path::plan_grasp;
pub use jobs::job::{DetectedObject, Motion, MotionOutcome, MotionStatus, Progress};
pub use jobs::let_go::LetGo;
pub use jobs::look::{Look, LookDirection, LookTarget};
pub use jobs::move_joints::MoveJoints;
pub use jobs::move_tcp::{MoveTcp, PoseGoal, TcpPath};
pub use jobs::put::Put;
pub use planning::aim::{is_in_picture, neck_positions};
pub use planning::base_checker::BaseChecker;
pub(crate) use planning::base_path::MIN_MARGIN;
pub use planning::drive_plan::plan_drive;
pub use planning::interruption;
pub use planning::pose_goal::PathSearch;
pub use planning::rigid_loop::{GREATEST_STRAIN, strain};
pub use planning::straight_way::{WayBegin, WayStart, WaysStart, straight_way, straight_ways};
pub use trajectories::axis_group::AxisGroup;
pub use trajectories::planned_trajectory::{PlannedTrajectory, TrajectoryAxes};
pub use trajectories::trajectory::Trajectory;

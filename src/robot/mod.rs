//! The robot's body: links and joints read from a URDF, where every link is for
//! given joint positions, and which joint positions bring a hand to a given place.
//!
//! The same kinematic tree also describes the furniture. Nothing here knows of
//! time, physics or the plan language; poses are those of [`crate::spatial`].

pub mod arm_chain;
pub mod arm_kinematics;
pub use crate::closest_name;
pub mod description;
mod description_file;
mod elbow_curve;
pub mod joint_positions;
mod polynomial;
pub mod side;
pub mod torso_search;
pub mod tree;
pub mod unreachable;
pub mod urdf;
pub mod urdf_error;
mod urdf_schema;
mod xml_elements;

pub use arm_chain::{ARM_JOINTS, ArmChainError, ArmPositions};
pub use arm_kinematics::ArmKinematics;
pub use description::RobotDescription;
pub use joint_positions::JointPositions;
pub use side::Side;
pub use torso_search::{Reach, TorsoSearch};
pub use tree::{Joint, JointId, JointKind, KinematicTree, Limits, Link, LinkId, Mimic};
pub use unreachable::{LimitViolation, Unreachable};
pub use urdf_error::UrdfError;

/// The text of the built-in PR2 description, `world/pr2.urdf`.
pub const PR2_URDF: &str = include_str!("../../world/pr2.urdf");

/// The text of the built-in kitchen, `world/kitchen.urdf`; its root is the map frame.
pub const KITCHEN_URDF: &str = include_str!("../../world/kitchen.urdf");

/// The text of what the PR2's links and joints are for, `world/pr2.sexp`.
pub const PR2_DESCRIPTION: &str = include_str!("../../world/pr2.sexp");

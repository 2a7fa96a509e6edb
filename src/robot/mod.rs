//! The robot's body: links and joints read from a URDF, the poses of all links for given
//! joint positions, and the joint positions that bring a hand to a given pose.
//!
//! The same kinematic tree also describes the furniture. Nothing here knows of
//! time, physics or the plan language; poses are those of [`crate::spatial`].

pub(crate) mod arm_chain;
pub(crate) mod arm_kinematics;
pub(crate) mod description;
mod description_file;
mod elbow_curve;
pub(crate) mod fit;
pub(crate) mod ids;
mod joint_positions;
mod polynomial;
mod side;
pub(crate) mod torso_search;
pub(crate) mod tree;
pub(crate) mod unreachable;
pub(crate) mod urdf;
mod urdf_elements;
pub(crate) mod urdf_error;
mod urdf_schema;
mod xml_elements;

pub(crate) use arm_chain::{ARM_JOINTS, ArmPositions};
pub(crate) use arm_kinematics::ArmKinematics;
pub(crate) use description::RobotDescription;
pub(crate) use fit::MissingNames;
pub(crate) use ids::{JointId, LinkId};
pub(crate) use joint_positions::JointPositions;
pub use side::Side;
pub(crate) use tree::{Joint, JointKind, KinematicTree, Limits, Link};
pub(crate) use unreachable::{LimitViolation, Unreachable};
pub(crate) use urdf_error::UrdfError;

/// The text of the built-in PR2 description, `world/pr2.urdf`.
pub(crate) const PR2_URDF: &str = include_str!("../../world/pr2.urdf");

/// The text of the built-in kitchen, `world/kitchen.urdf`; its root is the map frame.
pub(crate) const KITCHEN_URDF: &str = include_str!("../../world/kitchen.urdf");

/// The text of the built-in description of the PR2's links and joints, `world/pr2.sexp`.
pub(crate) const PR2_DESCRIPTION: &str = include_str!("../../world/pr2.sexp");

//! The robot's body: links and joints read from a URDF, the poses of all links for given
//! joint positions, and the joint positions that bring a hand to a given pose.
//!
//! The same kinematic tree also describes the furniture. Nothing here knows of
//! time, physics or the plan language; poses are those of [`spatial`].

mod alias_file;
pub(crate) mod arm_chain;
pub mod arm_kinematics;
pub mod arm_plane;
pub mod arm_positions;
mod chain_descent;
mod chain_length;
pub mod closed_form;
pub mod derive;
pub mod description;
mod description_file;
mod description_values;
mod elbow_curve;
pub mod fit;
pub mod ids;
pub mod interface;
mod interface_file;
pub mod jaw_gap;
pub mod joint_chain;
mod joint_positions;
pub mod miss;
mod mounted_frame;
pub mod numeric_kinematics;
mod polynomial;
mod reach_map;
pub(crate) mod shape_extent;
mod shares;
mod side;
pub mod srdf;
pub mod torso_search;
pub mod touching;
pub mod tree;
pub mod unreachable;
pub mod urdf;
pub(crate) mod urdf_error;
mod urdf_node;
pub(crate) mod urdf_remark;
mod urdf_schema;
mod urdf_shapes;
mod urdf_text;
mod xml_elements;

pub(crate) use alias_file::aliases;
pub use arm_kinematics::ArmKinematics;
pub use arm_plane::ArmPlane;
pub use arm_positions::{ArmPositions, MOST_ARM_JOINTS};
pub use derive::{DerivedRobot, TouchTest};
pub use description::RobotDescription;

pub use fit::MissingNames;
pub use ids::{JointId, LinkId};
pub use interface::{PartInterface, RobotInterface, RobotPart};
pub use jaw_gap::{JawGap, JawGapError};
pub use joint_chain::JointChainError;
pub use joint_positions::JointPositions;
pub use miss::Miss;
pub use mounted_frame::MountedFrame;
pub use numeric_kinematics::NumericKinematics;
pub use reach_map::ReachMap;
pub use side::Side;
pub use srdf::{GroupState, Srdf};
pub use touching::{PostureSample, TouchingPairs};
pub use tree::{Alias, AliasedPart, Joint, JointKind, KinematicTree, Limits, Link};
pub use unreachable::{LimitViolation, Unreachable};
pub use urdf::{UrdfReading, UrdfUse};
pub use urdf_error::UrdfError;
pub use urdf_remark::{Leniency, UrdfRemark};
pub use urdf_text::urdf_text;

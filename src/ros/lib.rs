//! A planwright session as a node of ROS 2.
//!
//! Messages are values by the names of their fields ([`Value`]). Which fields there are on the wire, and in
//! which order, says the distribution's table ([`Layouts`]); [`cdr`] encodes by it. With the feature
//! `wire`, a node speaks to others.

pub mod action;
pub mod cdr;
mod distribution;
pub mod frames;
pub mod joints;
mod layout;
pub mod message;
mod names;
mod reach;
pub mod robot_clock;
mod scene_state;
mod value;
#[cfg(feature = "wire")]
pub mod wire;

pub use distribution::{Distribution, UnknownDistribution};
pub use layout::{Field, FieldType, LayoutError, Layouts, Multiplicity, Scalar};
pub use names::{action_type, service, service_type, topic, topic_type};
pub use reach::{Reach, ReachError};
pub use scene_state::{ObjectState, SceneModel, SceneState};
pub use value::Value;

#[cfg(test)]
mod tests;

//! The physical world: kitchen, robot, objects, and how they touch and move each other.
//!
//! A [`World`] is built from [`Models`], which never change. Time passes in [`World::step`]
//! only. Whether a configuration of the robot is possible is asked of a
//! [`CollisionChecker`], which changes nothing. The physics engine is known to
//! [`physics`] alone; every pose here is a [`Pose`](crate::spatial::Pose) in the map frame
//! unless its name says otherwise. Nothing here knows of motions or of the plan language.

pub mod allowed_pairs;
pub mod body_name;
pub mod collision;
mod collision_search;
pub mod contacts;
pub mod error;
pub mod grasp_library;
pub mod hash;
mod holding;
mod kitchen_motion;
mod link_geometry;
pub mod models;
pub mod object;
pub mod object_library;
mod obstacles;
pub mod part_key;
mod penetration;
pub mod physics;
pub mod robot_configuration;
mod robot_motion;
pub mod scene;
pub mod scene_shapes;
mod separation;
pub mod snapshot;
mod solid;
pub mod spawn;

pub use allowed_pairs::AllowedPairs;
pub use body_name::{BodyName, LinkName};
pub use collision::{Clearance, CollisionChecker, CollisionHit};
pub use contacts::{ContactForce, WeldError};
pub use error::WorldError;
pub use models::{Models, ModelsError};
pub use object::{Attachment, Object};
pub use object_library::{ObjectLibrary, ObjectType};
pub use part_key::PartKey;
pub use robot_configuration::RobotConfiguration;
pub use scene::World;
pub use scene_shapes::SceneShape;
pub use snapshot::Snapshot;
pub use spawn::SpawnReport;

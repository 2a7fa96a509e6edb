//! The physical world: kitchen, robot, objects, and how they touch and move each other.
//!
//! A [`World`] is built from [`Models`], which never change. Time passes only in
//! [`World::step`]. A [`CollisionChecker`] tells whether a configuration of the robot is
//! possible, and changes nothing. Only [`physics`] uses the physics engine; every pose here
//! is a [`Pose`](spatial::Pose) in the map frame unless its name says otherwise.
//! Nothing here knows of motions or of the plan language.

pub(crate) mod allowed_pairs;
mod at_rest;
pub mod body_name;
mod carrying;
pub mod cavity;
mod closing;
pub mod collision;
mod collision_search;
pub mod contacts;
pub mod content;
pub mod cutting;
pub mod error;
mod explored_floor;
mod extent;
mod frame;
mod grasp_definition;
pub mod grasp_library;
pub mod handle_hold;
pub mod hash;
mod headroom;
pub mod holding;
mod hollow;
mod inside;
pub mod kitchen_description;
mod kitchen_description_file;
mod kitchen_motion;
pub mod knob;
mod link_geometry;
mod link_pairs;
mod map_area;
pub mod models;
pub(crate) mod moved_part;
mod moving_parts;
pub mod noise;
pub mod object;
pub mod object_definitions;
pub mod object_library;
mod object_shapes;
mod obstacles;
pub(crate) mod oriented_box;
mod part_key;
mod penetration;
pub mod physics;
mod placed_solid;
mod riding;
mod robot_bodies;
pub mod robot_configuration;
mod robot_motion;
pub mod scene;
pub(crate) mod scene_shapes;
pub mod self_touching;
mod separation;
mod settling;
mod shaking;
mod shut_kitchen;
pub mod snapshot;
pub mod solid;
pub mod spawn;
mod splitting;
mod standing;
pub(crate) mod standing_room;
mod surroundings;
pub mod tilt;
mod touches;
mod touching;
mod two_stages;

pub use allowed_pairs::AllowedPairs;
pub use body_name::BodyName;
pub use cavity::Cavity;
pub use closing::Closing;
pub(crate) use collision::SomeLinks;
pub use collision::{CollisionChecker, CollisionHit};
pub use contacts::ContactForce;
pub use content::Content;
pub use cutting::{Blade, NotCut, Piece, PieceNames};
pub use error::WorldError;
pub use explored_floor::Known;
pub(crate) use explored_floor::{ExploredGrid, ExploredGrids};
pub use extent::Extent;
pub use handle_hold::{HandleHold, HandleSlip};
pub use holding::Slip;

pub use kitchen_description::KitchenDescription;
pub use knob::{KNOB_ON, Knob};
pub use map_area::MapArea;
pub use models::Models;
pub use moved_part::{MovedPart, Part};
pub use moving_parts::{MovingParts, Pairs};
pub use object::Object;
pub use part_key::PartKey;
pub use robot_configuration::RobotConfiguration;
pub use scene::World;
pub use shut_kitchen::ShutKitchen;
pub use snapshot::Snapshot;
pub use spawn::SpawnReport;
pub use standing::StandTrial;
pub use standing_room::{Ground, Load, NoRoom, StandingRoom};
pub use tilt::Tilt;
pub use touches::Touches;
pub use two_stages::freeing_joint;

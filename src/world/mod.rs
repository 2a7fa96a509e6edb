//! The physical world: kitchen, robot, objects, and how they touch and move each other.
//!
//! A [`World`] is built from [`Models`], which never change. Time passes only in
//! [`World::step`]. A [`CollisionChecker`] tells whether a configuration of the robot is
//! possible, and changes nothing. Only [`physics`] uses the physics engine; every pose here
//! is a [`Pose`](crate::spatial::Pose) in the map frame unless its name says otherwise.
//! Nothing here knows of motions or of the plan language.

pub(crate) mod allowed_pairs;
pub(crate) mod body_name;
pub(crate) mod collision;
mod collision_search;
pub(crate) mod contacts;
pub(crate) mod error;
mod explored_floor;
mod extent;
mod frame;
pub(crate) mod grasp_library;
pub(crate) mod handle_hold;
pub(crate) mod hash;
mod headroom;
pub(crate) mod holding;
mod kitchen_motion;
mod link_geometry;
mod link_pairs;
mod map_area;
pub(crate) mod models;
pub(crate) mod moved_part;
mod moving_parts;
pub(crate) mod noise;
pub(crate) mod object;
pub(crate) mod object_library;
mod obstacles;
pub(crate) mod oriented_box;
mod part_key;
mod penetration;
pub(crate) mod physics;
mod placed_solid;
mod robot_bodies;
pub(crate) mod robot_configuration;
mod robot_motion;
pub(crate) mod scene;
pub(crate) mod scene_shapes;
mod separation;
mod settling;
pub(crate) mod snapshot;
pub(crate) mod solid;
pub(crate) mod spawn;
mod standing;
mod standing_room;

pub(crate) use allowed_pairs::AllowedPairs;
pub(crate) use body_name::BodyName;
pub(crate) use collision::{CollisionChecker, CollisionHit};
pub(crate) use contacts::ContactForce;
pub(crate) use error::WorldError;
pub(crate) use explored_floor::{ExploredGrid, ExploredGrids, Known};
pub(crate) use extent::Extent;
pub(crate) use handle_hold::{HandleHold, HandleSlip};
pub(crate) use holding::Slip;
pub(crate) use map_area::MapArea;
pub(crate) use models::Models;
pub(crate) use moved_part::{MovedPart, Part};
pub(crate) use moving_parts::{MovingParts, Pairs};
pub(crate) use object::Object;
pub(crate) use part_key::PartKey;
pub(crate) use robot_configuration::RobotConfiguration;
pub(crate) use scene::World;
pub(crate) use snapshot::Snapshot;
pub(crate) use spawn::SpawnReport;
pub(crate) use standing::StandTrial;
pub(crate) use standing_room::{Ground, Load, NoRoom, StandingRoom};

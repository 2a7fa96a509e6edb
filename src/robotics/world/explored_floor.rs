//! What searches for paths over the floor have found out, as long as nothing has moved.
//!
//! A plan often asks for the way to one place after another from where the robot is. That a pose of
//! the base is free, or cannot be reached, holds until something moves: a search need not find it
//! out again.

use std::sync::{Mutex, PoisonError};

use super::part_key::PartKey;
use super::robot_configuration::RobotConfiguration;
use super::scene::World;
use crate::robot::{JointPositions, LinkId};
use spatial::Pose;

/// What is known of a pose of the base.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// Nothing yet.
    Nothing,
    /// The robot can be there.
    Free,
    /// Something is in the way.
    Occupied,
}

/// What is known of the cells of a grid of poses.
#[derive(Clone, Debug, Default)]
pub(crate) struct ExploredGrid {
    /// Whether each is free.
    pub cells: Vec<Known>,
    /// Which can be reached from where the robot is, if all of them have been found.
    pub reached: Option<Vec<bool>>,
    /// Which are known to be cut off from where the robot is; empty if none are.
    pub cut_off: Vec<bool>,
}

/// What is known of each of the grids that a search uses, in its order.
pub(crate) type ExploredGrids = [ExploredGrid; 3];

/// Where everything is that a pose of the base depends on.
#[derive(Clone, Debug, PartialEq)]
struct Arrangement {
    robot: RobotConfiguration,
    kitchen: JointPositions,
    objects: Vec<Arranged>,
}

/// An object in an arrangement.
#[derive(Clone, Debug, PartialEq)]
struct Arranged {
    /// Numbers may be used again after a world has been restored, so its shape is compared, too.
    key: PartKey,
    type_name: String,
    size: [f64; 3],
    /// The link that holds it.
    held_by: Option<LinkId>,
    /// In the map frame, or relative to that link.
    pose: Pose,
}

/// What is known of the floor in the last arrangement that was asked for; a copy knows nothing.
#[derive(Debug, Default)]
pub(super) struct ExploredFloor(Mutex<Option<(Arrangement, ExploredGrids)>>);

impl Clone for ExploredFloor {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl World {
    /// Calls a function with what is known of the floor; it may add to that. The grids are empty if
    /// anything has moved since the last call.
    pub(crate) fn with_explored_floor<T>(
        &self,
        function: impl FnOnce(&mut ExploredGrids) -> T,
    ) -> T {
        let now = self.arrangement();
        let lock = || {
            self.explored
                .0
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
        };
        let known = lock().take().filter(|(then, _)| *then == now);
        let mut grids = known.map(|(_, grids)| grids).unwrap_or_default();
        let value = function(&mut grids);
        *lock() = Some((now, grids));
        value
    }

    fn arrangement(&self) -> Arrangement {
        let objects = self.objects().map(|object| Arranged {
            key: object.key(),
            type_name: object.type_name.clone(),
            size: object.size(),
            held_by: object.attachment.as_ref().map(|held| held.link),
            pose: match &object.attachment {
                Some(held) => held.at,
                None => self.physics.pose(object.body),
            },
        });
        Arrangement {
            robot: self.state.robot.clone(),
            kitchen: self.state.kitchen.clone(),
            objects: objects.collect(),
        }
    }
}

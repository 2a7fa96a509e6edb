//! What searches for paths over the floor have found out, as long as nothing has moved.
//!
//! A plan often asks for the way to one place after another from where the robot is. That a pose of
//! the base is free, or cannot be reached, holds until something moves: a search need not find it
//! out again.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use super::body_name::BodyName;
use super::cell_set::CellSet;
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
    pub reached: Option<CellSet>,
    /// Which are known to be cut off from where the robot is.
    pub cut_off: CellSet,
}

/// What is known of each of the grids that a search uses, in its order.
pub(crate) type ExploredGrids = [ExploredGrid; 3];

/// How many poses of the base are kept at most: half as many as a search looks at that finds none. They take 2 MB.
const MAX_STANDS: usize = 100_000;
/// Poses of the base nearer to each other than this (m, rad) count as one: what is in the way is told with a margin of
/// millimetres.
const SAME_STAND: f64 = 1e-6;

/// The index of a pose at which nothing is in the way.
const FREE: u32 = u32::MAX;

/// What is in the way at poses of the base, in one arrangement: searches for several hands and grasps ask for the same
/// ones.
#[derive(Debug, Default)]
pub(crate) struct KnownStands {
    /// The obstacle, as an index, of each pose, whose numbers are multiples of [`SAME_STAND`]. In small pieces of
    /// memory: one large piece that comes and goes lets the system's allocator keep as much from then on.
    poses: BTreeMap<[i32; 3], u32>,
    obstacles: Vec<BodyName>,
}

impl KnownStands {
    /// What is in the way at a place (m, m, rad): known, or found out by a function.
    pub(crate) fn obstacle(
        &mut self,
        place: &[f64; 3],
        find: impl FnOnce() -> Option<BodyName>,
    ) -> Option<&BodyName> {
        let key = place.map(|number| (number / SAME_STAND).round() as i32);
        let index = match self.poses.get(&key) {
            Some(known) => *known,
            None => {
                let found = find();
                let index = found.map_or(FREE, |obstacle| self.index_of(obstacle));
                if self.poses.len() < MAX_STANDS {
                    self.poses.insert(key, index);
                }
                index
            }
        };
        self.obstacles.get(index as usize)
    }

    /// The place of an obstacle in the list.
    fn index_of(&mut self, obstacle: BodyName) -> u32 {
        let known = self.obstacles.iter().position(|other| *other == obstacle);
        let index = known.unwrap_or_else(|| {
            self.obstacles.push(obstacle);
            self.obstacles.len() - 1
        });
        index as u32
    }
}

/// Where everything is that a pose of the base, or a path of an arm, depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrangement {
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
pub(super) struct ExploredFloor {
    grids: Mutex<Option<(Arrangement, ExploredGrids)>>,
    stands: Mutex<Option<(Arrangement, KnownStands)>>,
}

impl ExploredFloor {
    /// Forgets everything, since something moves.
    pub(super) fn forget(&mut self) {
        *self = Self::default();
    }
}

/// Calls a function with what is kept of an arrangement, which is nothing if another one was kept.
fn with_kept<K: Default, T>(
    kept: &Mutex<Option<(Arrangement, K)>>,
    now: Arrangement,
    function: impl FnOnce(&mut K) -> T,
) -> T {
    let lock = || kept.lock().unwrap_or_else(PoisonError::into_inner);
    let known = lock().take().filter(|(then, _)| *then == now);
    let mut known = known.map(|(_, known)| known).unwrap_or_default();
    let value = function(&mut known);
    *lock() = Some((now, known));
    value
}

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
        with_kept(&self.explored.grids, self.arrangement(), function)
    }

    /// Calls a function with what is known to be in the way at poses of the base; it may add to that. Nothing is known if
    /// anything has moved since the last call.
    pub(crate) fn with_known_stands<T>(&self, function: impl FnOnce(&mut KnownStands) -> T) -> T {
        with_kept(&self.explored.stands, self.arrangement(), function)
    }

    /// Where everything is now.
    pub fn arrangement(&self) -> Arrangement {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_in_the_way_of_a_pose_is_found_out_once() {
        let mut stands = KnownStands::default();
        let mut asked = 0;
        let places = [[0.0, 1.0, 0.5], [0.0, 1.0, 0.6], [0.0, 1.0, 0.5]];
        let found = places.map(|place| {
            let obstacle = stands.obstacle(&place, || {
                asked += 1;
                (place[2] == 0.5).then(|| BodyName::Object("BOX".to_owned()))
            });
            obstacle.map(ToString::to_string)
        });
        assert_eq!(
            found,
            [Some("BOX".to_owned()), None, Some("BOX".to_owned())]
        );
        assert_eq!(asked, 2);
    }
}

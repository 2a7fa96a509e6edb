//! How a hand takes something out from under a shelf board or whatever else is above it, and puts it
//! there: a little up, and straight back out.

use std::cell::RefCell;

use nalgebra::{Translation3, Vector3};

use crate::world::grasp_library::ToolPoses;
use crate::world::{World, WorldError};
use spatial::Pose;

/// How far (m) a hand lifts below something. Source: CRAM's lift for things on shelves.
const UP: f64 = 0.06;
/// How far (m) it stays below that.
const GAP: f64 = 0.02;
/// How far (m) it moves back at most. Source: as above.
const BACK: f64 = 0.4;
/// Step (m) between distances at which it may be out.
const STEP: f64 = 0.05;
/// Directions (unit vectors) that differ so little are the same.
const SAME: f64 = 1e-6;

/// How steep (sine of the angle) a lift is at least.
const STEEP: f64 = 0.5;

/// The poses with a lift that leads up. Lifts are along the axes of an object: where that lies on its side, they
/// would drag it along what it lies on.
pub(crate) fn lifting(poses: ToolPoses) -> ToolPoses {
    let ToolPoses { grasp, lift, .. } = poses;
    if is_steep(&grasp, &lift) {
        return poses;
    }
    ToolPoses {
        lift: as_far_up(&grasp, &lift),
        second_lift: as_far_up(&grasp, &poses.second_lift),
        ..poses
    }
}

/// The pose over a place from which a tool comes down to it, straight above unless it is over it as it is.
pub(super) fn over(at: &Pose, lift: Pose) -> Pose {
    match is_steep(at, &lift) {
        true => lift,
        false => as_far_up(at, &lift),
    }
}

fn is_steep(from: &Pose, to: &Pose) -> bool {
    let way = to.translation.vector - from.translation.vector;
    way.z >= STEEP * way.norm()
}

/// The pose straight above one, as far from it as another one.
fn as_far_up(from: &Pose, to: &Pose) -> Pose {
    let way = (to.translation.vector - from.translation.vector).norm();
    Translation3::new(0.0, 0.0, way) * from
}

/// What is above the place of an object.
pub struct Overhead<'w> {
    world: &'w World,
    object: &'w str,
    /// Names of objects that are taken not to be there.
    absent: &'w [String],
    /// The place, in the map frame.
    at: Pose,
    /// How far (m) the object could rise there.
    headroom: f64,
    /// Directions in the map, and how far (m) out it is in them. There are as many as grasps.
    ways: RefCell<Vec<(Vector3<f64>, f64)>>,
}

impl<'w> Overhead<'w> {
    /// For an object of the world at a pose in the map frame.
    pub fn of(world: &'w World, object: &'w str, at: &Pose) -> Result<Self, WorldError> {
        Self::without(world, object, at, &[])
    }

    /// As [`Self::of`], as if the objects of some names were not there.
    pub fn without(
        world: &'w World,
        object: &'w str,
        at: &Pose,
        absent: &'w [String],
    ) -> Result<Self, WorldError> {
        let headroom = world.headroom(object, at, absent)?;
        let at = *at;
        Ok(Self {
            world,
            object,
            absent,
            at,
            headroom,
            ways: RefCell::default(),
        })
    }

    /// The same, of which no direction has been looked at.
    #[must_use]
    pub fn anew(&self) -> Self {
        Self {
            ways: RefCell::default(),
            ..*self
        }
    }

    /// The poses of the tool (in the frame of the base, which is at a pose in the map) for grasping the
    /// object, such that the hand keeps below what is above until it is out from under it.
    pub fn picking(&self, base: &Pose, poses: ToolPoses) -> ToolPoses {
        let ToolPoses { grasp, lift, .. } = poses;
        let Some([up, back]) = self.way_out(base, &grasp, &poses.second_pregrasp, &lift) else {
            return poses;
        };
        ToolPoses {
            pregrasp: no_higher(&poses.pregrasp, &(up * poses.second_pregrasp)),
            lift: up * grasp,
            second_lift: back * up * grasp,
            ..poses
        }
    }

    /// The same for putting the object down: the poses of the tool over the place, at it, and the two on
    /// the way off the object.
    pub fn putting(&self, base: &Pose, poses: [Pose; 4]) -> [Pose; 4] {
        let [over, at, beside, away] = poses;
        match self.way_out(base, &at, &beside, &over) {
            Some([up, _]) => [up * at, at, beside, no_higher(&away, &(up * beside))],
            None => poses,
        }
    }

    /// How far up and then back (m, in the frame of the base) a tool moves that holds the object; `None`
    /// if it can lift as high as wanted, or comes from above.
    fn way_out(
        &self,
        base: &Pose,
        at: &Pose,
        beside: &Pose,
        lift: &Pose,
    ) -> Option<[Translation3<f64>; 2]> {
        let rise = lift.translation.z - at.translation.z;
        if self.headroom >= rise + GAP {
            return None;
        }
        let off = beside.translation.vector - at.translation.vector;
        let back = Vector3::new(off.x, off.y, 0.0);
        if back.norm() <= off.z.abs() {
            return None;
        }
        let up = (self.headroom - GAP).clamp(0.0, UP);
        let back = back.normalize();
        let way = self.way_along(base.rotation * back);
        Some([Vector3::z() * up, back * way].map(Translation3::from))
    }

    /// How far (m) the object has to move in a direction of the map until nothing is above it any more;
    /// at most so far that it does not matter.
    fn way_along(&self, direction: Vector3<f64>) -> f64 {
        let mut ways = self.ways.borrow_mut();
        let known = ways.iter().find(|(d, _)| (d - direction).norm() < SAME);
        if let Some((_, way)) = known {
            return *way;
        }
        let is_out = |way: f64| {
            let there = Translation3::from(direction * way) * self.at;
            let headroom = self.world.headroom(self.object, &there, self.absent);
            headroom.is_ok_and(|headroom| headroom > self.headroom + UP)
        };
        let steps = (BACK / STEP).round() as u32;
        let mut distances = (1..=steps).map(|i| f64::from(i) * STEP);
        let way = distances.find(|way| is_out(*way)).unwrap_or(BACK);
        ways.push((direction, way));
        way
    }
}

/// A pose, or another one if that is lower.
fn no_higher(pose: &Pose, other: &Pose) -> Pose {
    match pose.translation.z > other.translation.z {
        true => *other,
        false => *pose,
    }
}

//! Signed distance between two solids, and between a solid and the floor.

use parry3d_f64::math::{Pose as ParryPose, Vector};
use parry3d_f64::query;

use super::solid::Solid;

/// The separation of two solids.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Separation {
    /// Gap (m), negative for an overlap.
    pub distance: f64,
    /// A point between the two or in their overlap, in the map frame (m).
    pub point: Vector,
}

/// The separation of two solids (their own poses in the map frame) when it is below `margin`
/// (m); with a negative margin only deeper overlaps count.
///
/// Compare bounds first: this is the expensive part.
pub(crate) fn separation(
    pose1: &ParryPose,
    solid1: &Solid,
    pose2: &ParryPose,
    solid2: &Solid,
    margin: f64,
) -> Option<Separation> {
    let (shape1, shape2) = (&*solid1.shape, &*solid2.shape);
    let reach = margin.max(0.0);
    // All shapes of a solid are convex, so that every query is supported.
    if margin <= 0.0 {
        let hit = query::intersection_test(pose1, shape1, pose2, shape2).ok()?;
        if !hit.intersecting {
            return None;
        }
    }
    let contact = query::contact(pose1, shape1, pose2, shape2, reach).ok()??;
    (contact.dist < margin).then(|| Separation {
        distance: contact.dist,
        point: (contact.point1 + contact.point2) * 0.5,
    })
}

/// Whether two solids overlap, as a separation whose numbers are meaningless.
pub(super) fn overlap(
    pose1: &ParryPose,
    solid1: &Solid,
    pose2: &ParryPose,
    solid2: &Solid,
) -> Option<Separation> {
    // All shapes of a solid are convex, so that every query is supported.
    let hit = query::intersection_test(pose1, &*solid1.shape, pose2, &*solid2.shape).ok()?;
    hit.intersecting.then_some(Separation {
        distance: 0.0,
        point: Vector::ZERO,
    })
}

/// The separation of a solid (its own pose in the map frame) from the floor z = 0, when it is
/// below `margin` (m).
pub(crate) fn below_floor(pose: &ParryPose, solid: &Solid, margin: f64) -> Option<Separation> {
    let lowest = lowest_point(pose, solid);
    (lowest.z < margin).then_some(Separation {
        distance: lowest.z,
        point: lowest,
    })
}

/// The point of the solid (its own pose in the map frame) with the least z (m).
pub(crate) fn lowest_point(pose: &ParryPose, solid: &Solid) -> Vector {
    match solid.shape.as_support_map() {
        Some(shape) => shape.support_point(pose, -Vector::Z),
        // Every convex primitive has a support map; the bounds are the answer for anything else.
        None => solid.shape.compute_aabb(pose).mins,
    }
}

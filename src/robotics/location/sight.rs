//! Whether the robot would see something from a base pose with its head turned to it.

use nalgebra::Point3;

use super::base_query::{BaseQuery, Target};
use super::reach::object_of;
use crate::motion::neck_positions;
use crate::perception::Sight;
use crate::world::{PartKey, World, WorldError};

/// Share of an object that must be in sight.
const SHARE: f64 = 0.9;
/// How much nearer (m) than a bare place may be what is in front of it.
const SLACK: f64 = 0.03;

/// Turns the head of the robot in the imagined world to the target; false if the neck cannot.
fn look(world: &mut World, target: &Target) -> bool {
    let point = Point3::from(target.pose.translation.vector);
    let angles = neck_positions(world, &point);
    let mut robot = world.robot_configuration().clone();
    let models = world.models();
    let neck = &models.description.neck;
    for (&joint, angle) in neck.joints.iter().zip(angles) {
        let limits = models.robot.joint(joint).limits;
        if limits.is_some_and(|l| angle < l.lower || angle > l.upper) {
            return false;
        }
        robot.joints.set(joint, angle);
    }
    world.teleport_robot(&robot);
    true
}

/// Why the robot, which stands there already in the imagined world, does not see the target.
pub(super) fn hidden(world: &mut World, query: &BaseQuery) -> Result<Option<String>, WorldError> {
    let target = &query.target;
    let does_not_see = format!("not seeing {}", target.name);
    if !look(world, target) {
        return Ok(Some(format!(
            "{does_not_see} (the neck does not turn that far)"
        )));
    }
    match object_of(query) {
        Some(name) => {
            let seen = Sight::of_robot_at(world, name)?.visibility(name)?;
            if seen.fraction() >= SHARE {
                return Ok(None);
            }
            let by = seen.occluders.first().map(|(body, _)| body.to_string());
            Ok(Some(match by {
                Some(by) => format!("{does_not_see} (hidden by {by})"),
                None => does_not_see,
            }))
        }
        None => {
            let point = Point3::from(target.pose.translation.vector);
            let glance = Sight::of_robot_towards(world, &point);
            let is_seen = glance.is_some_and(|glance| {
                let is_near = |depth: f64| depth >= glance.wanted - SLACK;
                glance.depth.is_none_or(is_near) || is_at(world, glance.key, &point)
            });
            Ok((!is_seen).then_some(does_not_see))
        }
    }
}

/// Whether what is seen is an object that stands at the point (m, map frame), and so does not hide
/// it.
fn is_at(world: &World, key: Option<PartKey>, point: &Point3<f64>) -> bool {
    let object = world.objects().find(|object| Some(object.key()) == key);
    let extent = object.and_then(|object| world.object_extent(object.name()).ok());
    extent.is_some_and(|extent| {
        let [x, y] = extent.local([point.x, point.y]);
        let z = point.z - extent.frame.translation.z;
        let within = |i: usize, at: f64| at >= extent.min[i] - SLACK && at <= extent.max[i] + SLACK;
        within(0, x) && within(1, y) && within(2, z)
    })
}

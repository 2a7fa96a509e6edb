//! How far an arm gets, as a quick test before inverse kinematics.

use nalgebra::{Point3, Vector3};

use crate::robot::{Joint, JointKind, Side};
use crate::world::World;
use spatial::Pose;

/// Where an arm begins, and how far away its wrist can be.
pub(super) struct Shoulder {
    /// Where it is in the frame of the base (m), with the torso as it is.
    pub(super) at: Point3<f64>,
    /// By how much (m) the torso can raise it.
    range: [f64; 2],
    /// Length of the stretched arm (m).
    length: f64,
}

impl Shoulder {
    /// That of an arm of the robot in the world.
    pub(super) fn of(world: &World, side: Side, torso_moves: bool) -> Self {
        let models = world.models();
        let joints = &world.robot_configuration().joints;
        let (arm, torso) = (models.description.arm(side), &models.description.torso);
        let tree = &models.robot;
        let mut chain: Vec<_> = tree.ancestors(arm.wrist).collect();
        chain.reverse();
        let first = arm.joints().first();
        let begin = chain.iter().position(|joint| Some(joint) == first);
        let mut chain = chain
            .into_iter()
            .skip(begin.unwrap_or(0))
            .map(|id| tree.joint(id));
        let slide = |joint: &Joint| match joint.limits {
            Some(limits) if joint.kind == JointKind::Prismatic => {
                limits.lower.abs().max(limits.upper.abs())
            }
            _ => 0.0,
        };
        // An arm has at least one joint.
        let now = torso.height(joints);
        let first = chain.next();
        let (parent, origin) = first.map_or((arm.base, Pose::identity()), |joint| {
            (joint.parent, joint.origin)
        });
        let start = tree.relative_pose(models.description.base.frame, parent, joints);
        let at = (start.unwrap_or_default() * origin).translation;
        let lengths = chain.map(|joint| joint.origin.translation.vector.norm() + slide(joint));
        let length: f64 = lengths.sum();
        Self {
            at: at.vector.into(),
            range: match torso_moves {
                true => [torso.limits.lower - now, torso.limits.upper - now],
                false => [0.0, 0.0],
            },
            length: length + first.map_or(0.0, slide),
        }
    }

    /// Whether the wrist may get within `span` (m) of a point in the frame of the base (m), with
    /// the torso at some height.
    pub(super) fn reaches(&self, point: &Vector3<f64>, span: f64) -> bool {
        let way = point - self.at.coords;
        let [down, up] = self.range;
        let height = way.z - way.z.clamp(down.min(0.0), up.max(0.0));
        libm::hypot(way.xy().norm(), height) <= self.length + span
    }
}

//! How far an arm gets, as a quick test before inverse kinematics.

use nalgebra::{Point3, Vector3};

use crate::robot::{ARM_JOINTS, JointId, Side};
use crate::world::World;

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
        let start = tree.relative_pose(models.description.base.frame, arm.base, joints);
        let [first, rest @ ..]: &[JointId; ARM_JOINTS] = arm.joints();
        let at = (start.unwrap_or_default() * tree.joint(*first).origin).translation;
        let lengths = rest.iter().map(|joint| tree.joint(*joint).origin);
        let now = joints.get(torso.joint);
        Self {
            at: at.vector.into(),
            range: match torso_moves {
                true => [torso.limits.lower - now, torso.limits.upper - now],
                false => [0.0, 0.0],
            },
            length: lengths.map(|origin| origin.translation.vector.norm()).sum(),
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

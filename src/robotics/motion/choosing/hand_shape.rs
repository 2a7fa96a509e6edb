//! The solids of a hand in the frame of its tool, opened to some gap.

use parry3d_f64::bounding_volume::BoundingVolume;
use parry3d_f64::math::{Pose as ParryPose, Vector};
use parry3d_f64::query::intersection_test;
use parry3d_f64::shape::Shape;

use crate::robot::{LinkId, Side};
use crate::world::Models;
use crate::world::solid::{Solid, from_parry_vector, to_parry};
use spatial::Pose;

/// The solids of a hand.
pub(super) struct HandShape {
    /// Each with its pose in the frame of the tool.
    solids: Vec<(Solid, ParryPose)>,
    /// Where the hand points, in that frame.
    ahead: Vector,
}

impl HandShape {
    /// The hand of a side with its pads so far apart (m).
    pub(super) fn new(models: &Models, side: Side, gap: f64) -> Self {
        let links: Vec<LinkId> = models.description.arm(side).gripper.links().collect();
        Self::of_links(models, side, gap, &links)
    }

    /// The palm of a side, which stays as it is when the fingers move.
    pub(super) fn palm(models: &Models, side: Side) -> Self {
        let palm = models.description.arm(side).gripper.palm;
        Self::of_links(models, side, 0.0, &[palm])
    }

    /// Some links of the hand of a side with its pads so far apart (m).
    fn of_links(models: &Models, side: Side, gap: f64, links: &[LinkId]) -> Self {
        let arm = models.description.arm(side);
        let gripper = &arm.gripper;
        let mut joints = models.description.start_positions(&models.robot);
        joints.set(gripper.joint, gripper.position_for_gap(gap));
        let mut poses = Vec::new();
        let robot = &models.robot;
        robot.forward_kinematics(&Pose::identity(), &joints, &mut poses);
        let wrist = poses.get(arm.wrist.index()).copied().unwrap_or_default();
        let tool = arm.tool_for_wrist(&wrist).inverse();
        let parts = models.robot_geometry.solid_links.iter();
        let parts = parts.filter(|part| links.contains(&part.link));
        let solids = parts.flat_map(|part| {
            let link = poses.get(part.link.index()).copied().unwrap_or_default();
            let at = to_parry(&(tool * link));
            let solids = part.solids.iter();
            solids.map(move |solid| (solid.clone(), at * solid.pose))
        });
        Self {
            solids: solids.collect(),
            ahead: {
                let ahead = arm.ahead();
                Vector::new(ahead.x, ahead.y, ahead.z)
            },
        }
    }

    /// Whether it touches any of the solids, given in the frame in which the tool is at a pose.
    pub(super) fn touches(&self, tool: &Pose, solids: &[Solid]) -> bool {
        let tool = to_parry(tool);
        self.solids.iter().any(|(own, at)| {
            let at = tool * *at;
            let bounds = own.shape.compute_aabb(&at);
            solids
                .iter()
                .any(|other| bounds.intersects(&other.bounds) && overlaps(&*own.shape, &at, other))
        })
    }

    /// How low (m) it reaches with the tool at a pose.
    pub(super) fn lowest(&self, tool: &Pose) -> f64 {
        -self.farthest(tool, Vector::new(0.0, 0.0, -1.0))
    }

    /// How far (m) it reaches beyond the tool's point, where the hand points.
    pub(super) fn ahead(&self) -> f64 {
        self.farthest(&Pose::identity(), self.ahead)
    }

    /// How far (m) it reaches in a direction with the tool at a pose.
    fn farthest(&self, tool: &Pose, direction: Vector) -> f64 {
        let tool = to_parry(tool);
        let ends = self.solids.iter().map(|(own, at)| {
            let at = tool * *at;
            let there = at.rotation.inverse() * direction;
            let point = own
                .shape
                .as_support_map()
                .map(|shape| at.transform_point(shape.local_support_point(there)));
            let point = point.unwrap_or_else(|| {
                let bounds = own.shape.compute_aabb(&at);
                let pick = |d: f64, low: f64, high: f64| if d < 0.0 { low } else { high };
                let (low, high) = (bounds.mins, bounds.maxs);
                Vector::new(
                    pick(direction.x, low.x, high.x),
                    pick(direction.y, low.y, high.y),
                    pick(direction.z, low.z, high.z),
                )
            });
            from_parry_vector(point).dot(&from_parry_vector(direction))
        });
        ends.fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Whether a shape at a pose overlaps a solid; shapes of which that is not known do.
fn overlaps(shape: &dyn Shape, at: &ParryPose, other: &Solid) -> bool {
    intersection_test(at, shape, &other.pose, &*other.shape).map_or(true, |hit| hit.intersecting)
}

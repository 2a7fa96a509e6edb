//! The upright plane in which an arm of fewer than six joints moves its hand.
//!
//! Such an arm cannot bring its hand to every pose. What it can do well are poses in one plane: the axis
//! about which the last joint rolls the hand lies in it, and the hand moves straight ahead, back, up and
//! down without leaving it. Joints whose axes are across the plane, and those that slide within it, take
//! part; others stay at 0. Where the hand is to be elsewhere, the base turns and moves aside.

use nalgebra::{Point3, Vector3};

use super::arm_positions::MOST_ARM_JOINTS;
use super::joint_chain::{ChainPositions, ChainSegment, JointChain};
use spatial::{Pose, pose, trig};

/// Number of joints, the pieces of a telescope counted once, from which on an arm reaches poses in general.
pub(super) const GENERAL: usize = 6;
/// Number of joints that have to take part: two for the place, one for the pitch.
const LEAST: usize = 3;
/// Directions whose cosine is that small are perpendicular; sines, parallel. URDFs are written with few digits.
const EXACT: f64 = 1e-4;
/// An axis of the hand whose horizontal part is that small is upright: it lies in the plane whatever the
/// heading.
const UPRIGHT: f64 = 1e-3;
/// How far a pose of the hand may be from the plane (m, rad): what is measured or held moves a little.
const THICK: (f64, f64) = (0.01, 0.05);

/// The plane of an arm.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmPlane {
    /// The unit vector across it, in the frame of the arm's base; horizontal.
    normal: Vector3<f64>,
    /// Where it is along the normal (m).
    offset: f64,
    /// The axis about which the last joint rolls the hand, in the frame of the tip.
    axis: Vector3<f64>,
    /// A point of the axis in the frame of the tip (m).
    point: Point3<f64>,
    /// Whether each joint of the chain stays at 0 while the hand is in the plane.
    stays: [bool; MOST_ARM_JOINTS],
}

impl ArmPlane {
    /// The plane of a chain whose base stands upright; `None` if it has six joints or more (those of a
    /// telescope counted once), or no such plane.
    pub(super) fn of(chain: &JointChain) -> Option<Self> {
        if chain.freedoms() >= GENERAL {
            return None;
        }
        let (frames, tip) = chain.frames(&[0.0; MOST_ARM_JOINTS]);
        let axes: Vec<Vector3<f64>> = (frames.iter().zip(&chain.segments))
            .map(|(frame, segment)| frame.rotation * segment.axis)
            .collect();
        let (roll, others) = chain.segments.split_last()?;
        let (roll_axis, other_axes) = axes.split_last()?;
        if roll.slides {
            return None;
        }
        let takes_part =
            |segment: &ChainSegment, axis: &Vector3<f64>, normal: &Vector3<f64>| match segment
                .slides
            {
                true => axis.dot(normal).abs() < EXACT,
                false => axis.cross(normal).norm() < EXACT,
            };
        let count = |normal: &Vector3<f64>| {
            let all = others.iter().zip(other_axes);
            all.filter(|(segment, axis)| takes_part(segment, axis, normal))
                .count()
        };
        let across = (others.iter().zip(other_axes))
            .filter(|(segment, axis)| !segment.slides && axis.z.abs() < EXACT)
            .filter(|(_, axis)| axis.dot(roll_axis).abs() < EXACT)
            .map(|(_, axis)| (count(axis), *axis))
            .filter(|(count, _)| *count >= LEAST);
        // The first of those with the most joints.
        let (_, normal) = across.reduce(|best, next| if next.0 > best.0 { next } else { best })?;
        let mut stays = [false; MOST_ARM_JOINTS];
        for (segment, axis) in others.iter().zip(other_axes) {
            if let Some(stays) = stays.get_mut(segment.leader) {
                *stays |= !takes_part(segment, axis, &normal);
            }
        }
        let last = frames.last()?;
        let back = tip.inverse();
        Some(Self {
            offset: last.translation.vector.dot(&normal),
            axis: back.rotation * roll_axis,
            point: back * Point3::from(last.translation.vector),
            normal,
            stays,
        })
    }

    /// The positions with those joints at 0 that would move the hand out of the plane.
    pub(super) fn in_plane(&self, mut positions: ChainPositions) -> ChainPositions {
        for (position, stays) in positions.iter_mut().zip(self.stays) {
            if stays {
                *position = 0.0;
            }
        }
        positions
    }

    /// Whether the tip at a pose in the frame of the arm's base is in the plane, or as good as in it.
    pub(super) fn holds(&self, tip: &Pose) -> bool {
        let (distance, angle) = THICK;
        let out = (tip * self.point).coords.dot(&self.normal) - self.offset;
        let aside = (tip.rotation * self.axis).dot(&self.normal);
        out.abs() < distance && aside.abs() < angle
    }

    /// The pose of the base nearest to the given one (both in the map frame, on the floor) for which the
    /// tip, at a pose in the map frame, is in the plane; and by how much the base turns (rad) and moves
    /// aside (m) for that. `arm_base` is the pose of the arm's base in the frame of the base.
    pub fn base_for(&self, base: &Pose, arm_base: &Pose, tip: &Pose) -> (Pose, [f64; 2]) {
        let normal = arm_base.rotation * self.normal;
        let offset = self.offset + arm_base.translation.vector.dot(&normal);
        let tip = base.inverse() * tip;
        let axis = tip.rotation * self.axis;
        let turn = if libm::hypot(axis.x, axis.y) < UPRIGHT {
            0.0
        } else {
            // The normal is to be a quarter turn from the axis, on whichever side is nearer.
            let from = trig::atan2(normal.y, normal.x);
            let to = trig::atan2(axis.x, -axis.y);
            let turn = trig::wrap(to - from);
            let half = std::f64::consts::FRAC_PI_2;
            match turn {
                _ if turn > half => turn - 2.0 * half,
                _ if turn < -half => turn + 2.0 * half,
                _ => turn,
            }
        };
        let turned = pose::from_xy_yaw(0.0, 0.0, turn);
        let across = turned.rotation * normal;
        let aside = (tip * self.point).coords.dot(&across) - offset;
        let shift = across * aside;
        let moved = base * pose::from_xy_yaw(shift.x, shift.y, turn);
        (moved, [turn, aside])
    }
}

//! How far apart the two jaws of a gripper are, measured from the shapes of its fingers.
//!
//! The jaws are the outermost links of the fingers that have shapes. The gap lies along the direction in
//! which they move apart, between what of the one faces the other. Only the part of the joint's range in
//! which the gap grows counts. Where it stops growing before the joint does, as between the roots of fingers
//! that turn, the gap is that between the pads: what meets first when the jaws close.

use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use thiserror::Error;

use super::shape_extent::{extent, extent_of_all};
use super::{JointId, JointKind, JointPositions, KinematicTree, Limits, LinkId};
use spatial::{PlacedShape, Pose};

/// Intervals of the joint's range at whose ends the gap is measured.
const INTERVALS: usize = 64;
/// Least way (m) that the jaws of a gripper move.
const LEAST_TRAVEL: f64 = 1e-3;
/// Shapes whose faces are this near (m) to the foremost one belong to the pad.
const PAD_DEPTH: f64 = 2e-3;
/// A direction that is this near to an axis of the palm (cosine) is that axis.
const ALONG_AXIS: f64 = 0.985;

/// Why the gap of a gripper cannot be measured.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum JawGapError {
    /// No joint moves the jaws.
    #[error("a gripper needs a joint that moves its fingers")]
    NoJoint,
    /// The joint has no limits.
    #[error("joint \"{0}\" of the gripper has no limits")]
    NoLimits(String),
    /// The limits of the joint are equal.
    #[error("joint \"{joint}\" of the gripper cannot move: both of its limits are {position}")]
    NoTravel {
        /// Name of the joint.
        joint: String,
        /// Where it stands.
        position: f64,
    },
    /// A finger does not hang on the palm.
    #[error("finger \"{finger}\" does not hang on palm \"{palm}\"")]
    NotOnPalm {
        /// Name of the finger's link.
        finger: String,
        /// Name of the palm.
        palm: String,
    },
    /// A finger has no collision shape.
    #[error("the finger \"{0}\" has no collision shape that could face the other one")]
    NoShape(String),
    /// The fingers do not move apart.
    #[error(
        "joint \"{joint}\" moves the fingers \"{left}\" and \"{right}\" apart by less than 1 mm"
    )]
    NotApart {
        /// Name of the joint.
        joint: String,
        /// A link of the left finger.
        left: String,
        /// A link of the right finger.
        right: String,
    },
}

/// The gap of a gripper over the position of its joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JawGap {
    /// The joints that move together, the leading one first; the others at a factor of its position.
    joints: Vec<(JointId, f64)>,
    /// Positions of the leading joint and gaps (m), from closed to open; never fewer than two.
    samples: Vec<(f64, f64)>,
    /// Where the pads meet, in the frame of the palm: x away from the palm, y from the right jaw to the
    /// left one.
    pub grip: Pose,
    /// How far the pads extend along the grip's x and z axes (m).
    pub pad_size: [f64; 2],
}

impl JawGap {
    /// Measures the gap between two fingers that hang on a palm. `joints` are the one that leads, then
    /// those that move with it, besides those that follow it by the URDF. A joint whose range is that of
    /// the first one mirrored moves against it.
    ///
    /// # Errors
    ///
    /// If the joints do not move the jaws apart, or if nothing of them is solid.
    pub fn measure(
        tree: &KinematicTree,
        palm: LinkId,
        joints: &[JointId],
        [left, right]: [&[LinkId]; 2],
    ) -> Result<Self, JawGapError> {
        let leader = *joints.first().ok_or(JawGapError::NoJoint)?;
        let range = limits_of(tree, leader)?;
        if range.upper <= range.lower {
            return Err(JawGapError::NoTravel {
                joint: tree.joint(leader).name.clone(),
                position: range.lower,
            });
        }
        let mut together = Vec::new();
        for joint in joints {
            together.push((*joint, factor(tree, *joint, range)?));
        }
        let mut jaws = Jaws {
            tree,
            palm,
            joints: &together,
            left: jaw(tree, palm, left)?,
            right: jaw(tree, palm, right)?,
        };
        let at = |i: usize| {
            let share = i as f64 / INTERVALS as f64;
            range.lower + share * (range.upper - range.lower)
        };
        let apart =
            |position: f64| jaws.middle(&jaws.left, position) - jaws.middle(&jaws.right, position);
        let [closed, open] = [apart(at(0)), apart(at(INTERVALS))];
        let way = open - closed;
        let unlike = || JawGapError::NotApart {
            joint: tree.joint(leader).name.clone(),
            left: name_of(tree, left),
            right: name_of(tree, right),
        };
        if way.norm() < LEAST_TRAVEL {
            return Err(unlike());
        }
        // From the right jaw to the left one.
        let widest = if closed.norm() > open.norm() {
            closed
        } else {
            open
        };
        let axis = along_axis(way.normalize() * way.dot(&widest).signum());
        let sampled = |jaws: &Jaws| -> Vec<(f64, f64)> {
            let all = (0..=INTERVALS).map(|i| (at(i), jaws.gap(at(i), &axis)));
            opening_part(&all.collect::<Vec<_>>())
        };
        let mut samples = sampled(&jaws);
        let ends = [at(0), at(INTERVALS)];
        if let (Some(first), Some(last)) = (samples.first(), samples.last())
            && !ends.contains(&last.0)
        {
            let pads = jaws.pads(first.0, &axis);
            let between = sampled(&pads);
            if between.last().is_some_and(|widest| widest.1 > last.1) {
                (jaws, samples) = (pads, between);
            }
        }
        let (Some(first), Some(last)) = (samples.first(), samples.last()) else {
            return Err(unlike());
        };
        if last.1 - first.1 < LEAST_TRAVEL {
            return Err(unlike());
        }
        let half = position_at(&samples, (first.1 + last.1) / 2.0);
        let (grip, pad_size) = jaws.grip(half, &axis);
        Ok(Self {
            joints: together,
            samples,
            grip,
            pad_size,
        })
    }

    /// Gap (m) between the pads at a position of the leading joint; slightly negative if they would
    /// overlap. Beyond the part of the range in which it grows, the gap is that at its end.
    pub fn gap(&self, position: f64) -> f64 {
        let mut before: Option<(f64, f64)> = None;
        let opens_up = self.opens_up();
        for &(at, gap) in &self.samples {
            let is_reached = if opens_up {
                position <= at
            } else {
                position >= at
            };
            match before {
                None if is_reached => return gap,
                Some((from, start)) if is_reached => {
                    return start + (gap - start) * (position - from) / (at - from);
                }
                _ => before = Some((at, gap)),
            }
        }
        before.map_or(0.0, |(_, gap)| gap)
    }

    /// Position of the leading joint whose gap (m) is nearest to the given one.
    pub fn position_for_gap(&self, gap: f64) -> f64 {
        position_at(&self.samples, gap)
    }

    /// Position of the leading joint, and gap (m), of the closed gripper.
    pub fn closed(&self) -> (f64, f64) {
        self.samples.first().copied().unwrap_or_default()
    }

    /// Position of the leading joint, and gap (m), of the open gripper.
    pub fn open(&self) -> (f64, f64) {
        self.samples.last().copied().unwrap_or_default()
    }

    /// The joints that move together, the leading one first, each with the factor on its position.
    pub fn joints(&self) -> &[(JointId, f64)] {
        &self.joints
    }

    /// Puts all joints of the gripper where the position of the leading one has them.
    pub fn set_positions(&self, q: &mut JointPositions, position: f64) {
        for (joint, factor) in &self.joints {
            q.set(*joint, factor * position);
        }
    }

    /// Whether the left jaw is on the side of the palm to which none of its axes points: then what is
    /// called left here is to be called right.
    pub fn is_mirrored(&self) -> bool {
        let axis = self.grip.rotation * Vector3::y();
        [axis.x, axis.y, axis.z]
            .into_iter()
            .find(|part| part.abs() > 0.5)
            .is_some_and(|part| part < 0.0)
    }

    /// Whether greater positions of the leading joint open the gripper.
    pub fn opens_up(&self) -> bool {
        self.open().0 > self.closed().0
    }
}

/// The position between samples of growing gaps at which the gap is nearest to the given one.
fn position_at(samples: &[(f64, f64)], gap: f64) -> f64 {
    let mut before: Option<(f64, f64)> = None;
    for &(at, here) in samples {
        match before {
            None if gap <= here => return at,
            Some((from, start)) if gap <= here => {
                return from + (at - from) * (gap - start) / (here - start);
            }
            _ => before = Some((at, here)),
        }
    }
    before.map_or(0.0, |(at, _)| at)
}

/// The samples from the least gap on, in the direction of the greatest one, as long as the gap grows.
fn opening_part(samples: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let gaps = || samples.iter().enumerate();
    let least = gaps().min_by(|a, b| a.1.1.total_cmp(&b.1.1));
    let greatest = gaps().max_by(|a, b| a.1.1.total_cmp(&b.1.1));
    let (Some((least, _)), Some((greatest, _))) = (least, greatest) else {
        return Vec::new();
    };
    let way: Vec<(f64, f64)> = if least <= greatest {
        samples.iter().skip(least).copied().collect()
    } else {
        samples.iter().take(least + 1).rev().copied().collect()
    };
    let mut part: Vec<(f64, f64)> = Vec::new();
    for sample in way {
        if part.last().is_some_and(|last| sample.1 <= last.1) {
            break;
        }
        part.push(sample);
    }
    part
}

/// The limits of a joint of a gripper.
fn limits_of(tree: &KinematicTree, joint: JointId) -> Result<Limits, JawGapError> {
    let joint = tree.joint(joint);
    let limits = joint.limits.filter(|_| joint.kind != JointKind::Fixed);
    limits.ok_or_else(|| JawGapError::NoLimits(joint.name.clone()))
}

/// The position of the joint for each unit of the leader's: -1 if its range is the leader's mirrored.
fn factor(tree: &KinematicTree, joint: JointId, leader: Limits) -> Result<f64, JawGapError> {
    let own = limits_of(tree, joint)?;
    let outside = |sign: f64| {
        own.excess(sign * leader.lower)
            .max(own.excess(sign * leader.upper))
    };
    Ok(if outside(-1.0) < outside(1.0) {
        -1.0
    } else {
        1.0
    })
}

fn name_of(tree: &KinematicTree, links: &[LinkId]) -> String {
    let first = links.first();
    first.map_or_else(String::new, |link| tree.link(*link).name.clone())
}

/// A shape of a link, by its place among those of the link.
type LinkShape = (LinkId, usize);

/// The shapes of a finger's outermost links: those that the most joints move.
fn jaw(
    tree: &KinematicTree,
    palm: LinkId,
    finger: &[LinkId],
) -> Result<Vec<LinkShape>, JawGapError> {
    let mut solid = Vec::new();
    for link in finger {
        if !tree.carries(palm, *link) {
            return Err(JawGapError::NotOnPalm {
                finger: tree.link(*link).name.clone(),
                palm: tree.link(palm).name.clone(),
            });
        }
        let above = tree.ancestors(*link);
        let above = above.take_while(|joint| tree.carries(palm, tree.joint(*joint).parent));
        let moving = above.filter(|joint| tree.joint(*joint).kind != JointKind::Fixed);
        if !tree.link(*link).collisions.is_empty() {
            solid.push((moving.count(), *link));
        }
    }
    let most = solid.iter().map(|(joints, _)| *joints).max();
    let most = most.ok_or_else(|| JawGapError::NoShape(name_of(tree, finger)))?;
    let outermost = solid.into_iter().filter(|(joints, _)| *joints == most);
    let shapes = |link: LinkId| (0..tree.link(link).collisions.len()).map(move |i| (link, i));
    Ok(outermost.flat_map(|(_, link)| shapes(link)).collect())
}

/// The axis of the palm that a direction follows but for little, or the direction itself.
fn along_axis(direction: Vector3<f64>) -> Vector3<f64> {
    for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
        let along = axis.dot(&direction);
        if along.abs() > ALONG_AXIS {
            return axis * along.signum();
        }
    }
    direction
}

/// The two jaws of a gripper and what moves them.
struct Jaws<'a> {
    tree: &'a KinematicTree,
    palm: LinkId,
    joints: &'a [(JointId, f64)],
    left: Vec<LinkShape>,
    right: Vec<LinkShape>,
}

impl Jaws<'_> {
    /// The shapes of a jaw, each with the pose of its link in the frame of the palm.
    fn shapes(&self, jaw: &[LinkShape], position: f64) -> Vec<(&PlacedShape, Pose)> {
        let mut q = self.tree.zero_positions();
        for (joint, factor) in self.joints {
            q.set(*joint, factor * position);
        }
        let placed = jaw.iter().filter_map(|(link, place)| {
            let shape = self.tree.link(*link).collisions.get(*place)?;
            let pose = self.tree.relative_pose(self.palm, *link, &q);
            Some((shape, pose.unwrap_or_else(Pose::identity)))
        });
        placed.collect()
    }

    /// What of the jaws is foremost at a position.
    fn pads(&self, position: f64, axis: &Vector3<f64>) -> Self {
        let foremost = |jaw: &[LinkShape], towards: Vector3<f64>| -> Vec<LinkShape> {
            let shapes = self.shapes(jaw, position);
            let ends: Vec<f64> = shapes
                .iter()
                .map(|(shape, pose)| extent(shape, pose, &towards)[1])
                .collect();
            let face = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let near = jaw
                .iter()
                .zip(&ends)
                .filter(|(_, end)| **end > face - PAD_DEPTH);
            near.map(|(shape, _)| *shape).collect()
        };
        Self {
            tree: self.tree,
            palm: self.palm,
            joints: self.joints,
            left: foremost(&self.left, -axis),
            right: foremost(&self.right, *axis),
        }
    }

    /// The middle of a jaw's shapes.
    fn middle(&self, jaw: &[LinkShape], position: f64) -> Vector3<f64> {
        let shapes = self.shapes(jaw, position);
        let count = shapes.len().max(1) as f64;
        let places = shapes
            .iter()
            .map(|(s, pose)| (pose * s.pose).translation.vector);
        places.sum::<Vector3<f64>>() / count
    }

    /// Where the faces of the two jaws are along the axis: of the right one, and of the left one.
    fn faces(&self, position: f64, axis: &Vector3<f64>) -> [f64; 2] {
        let right = self.shapes(&self.right, position);
        let left = self.shapes(&self.left, position);
        let of = |(shape, pose): &(&PlacedShape, Pose)| extent(shape, pose, axis);
        let right = right
            .iter()
            .map(|s| of(s)[1])
            .fold(f64::NEG_INFINITY, f64::max);
        let left = left.iter().map(|s| of(s)[0]).fold(f64::INFINITY, f64::min);
        [right, left]
    }

    fn gap(&self, position: f64, axis: &Vector3<f64>) -> f64 {
        let [right, left] = self.faces(position, axis);
        left - right
    }

    /// Where the pads meet, and how far they extend along the x and z axes there.
    fn grip(&self, position: f64, axis: &Vector3<f64>) -> (Pose, [f64; 2]) {
        let [right, left] = self.faces(position, axis);
        let pads: Vec<(&PlacedShape, Pose)> = {
            let rights = self.shapes(&self.right, position).into_iter();
            let rights = rights.filter(|(s, p)| extent(s, p, axis)[1] > right - PAD_DEPTH);
            let lefts = self.shapes(&self.left, position).into_iter();
            rights
                .chain(lefts.filter(|(s, p)| extent(s, p, axis)[0] < left + PAD_DEPTH))
                .collect()
        };
        let spread = |direction: &Vector3<f64>| {
            let ends = pads.iter().map(|(s, p)| extent(s, p, direction));
            ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], [low, high]| {
                [a.min(low), b.max(high)]
            })
        };
        let bounds = [Vector3::x(), Vector3::y(), Vector3::z()].map(|d| spread(&d));
        let middle = Vector3::from(bounds.map(|[low, high]| (low + high) / 2.0));
        let away = self.away_from_palm(&middle, axis);
        let across = away.cross(axis);
        let [along, aside] = [away, across].map(|direction| spread(&direction));
        let place = away * ((along[0] + along[1]) / 2.0)
            + across * ((aside[0] + aside[1]) / 2.0)
            + axis * ((right + left) / 2.0);
        let frame = Matrix3::from_columns(&[away, *axis, across]);
        let rotation = Rotation3::from_matrix_unchecked(frame);
        let grip = Pose::from_parts(
            Translation3::from(place),
            UnitQuaternion::from_rotation_matrix(&rotation),
        );
        (grip, [along[1] - along[0], aside[1] - aside[0]])
    }

    /// The direction from the palm to the pads, at a right angle to the axis.
    fn away_from_palm(&self, pads: &Vector3<f64>, axis: &Vector3<f64>) -> Vector3<f64> {
        let body = &self.tree.link(self.palm).collisions;
        let own = [Vector3::x(), Vector3::y(), Vector3::z()].map(|direction| {
            let [low, high] = extent_of_all(body, &Pose::identity(), &direction);
            (low + high) / 2.0
        });
        let own = Some(Vector3::from(own)).filter(|own| own.iter().all(|n| n.is_finite()));
        let across = |way: Vector3<f64>| way - axis * way.dot(axis);
        let long = |way: &Vector3<f64>| way.norm() > 5e-3;
        // Without a shape of the palm: from its frame, or from that of the link that carries it.
        let parent = self.tree.link(self.palm).parent_joint;
        let parent = parent.map(|joint| self.tree.joint(joint).origin.inverse().translation.vector);
        let ways = [own, Some(Vector3::zeros()), parent];
        let way = ways
            .into_iter()
            .flatten()
            .map(|from| across(pads - from))
            .find(long);
        let way = way.unwrap_or_else(|| {
            let least = if axis.x.abs() < 0.5 {
                Vector3::x()
            } else {
                Vector3::z()
            };
            across(least)
        });
        let way = along_axis(way.normalize());
        across(way).normalize()
    }
}

//! How far the tip of a chain of joints can be at most.
//!
//! The bound is simple: no point of a chain is farther away than all of its links in a row. It is made
//! sharper at both ends, where a point is known whatever the joints do: the origin of the last joint is
//! fixed in the hand, and so is that of the joint before if it lies on the last one's axis.

use nalgebra::{Point3, Vector3};

use super::Limits;
use super::joint_chain::{ChainSegment, JointChain};
use spatial::Pose;

/// A bound on the distance between a place near the base and one in the hand.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ChainLength {
    /// The place near the base: a joint that slides takes it from the first point to the second (m).
    from: [Vector3<f64>; 2],
    /// The place in the frame of the tip (m).
    to: Point3<f64>,
    /// Greatest distance (m) between the two.
    length: f64,
}

impl ChainLength {
    pub(super) fn of(chain: &JointChain) -> Self {
        let segments = &chain.segments;
        let count = segments.len();
        // From the joint to the next one, or to the tip, in the frame behind the joint.
        let offset = |i: usize| match segments.get(i + 1) {
            Some(next) => next.origin.translation.vector,
            None => chain.tail.translation.vector,
        };
        let mut from = [Vector3::zeros(); 2];
        let mut first = 0;
        let mut turned = Pose::identity().rotation;
        if let Some(segment) = segments.first() {
            from = [segment.origin.translation.vector; 2];
            turned = segment.origin.rotation;
            if segment.slides {
                let ends = range(chain, segment);
                for (place, end) in from.iter_mut().zip(ends) {
                    *place += turned * (segment.axis * end + offset(0));
                }
                first = 1;
                if let Some(next) = segments.get(1) {
                    turned *= next.origin.rotation;
                }
            }
        }
        if let Some(segment) = segments.get(first)
            && is_turn_about(segment, &offset(first))
            && first + 1 < count
        {
            for place in &mut from {
                *place += turned * offset(first);
            }
            first += 1;
        }
        let mut to = Point3::origin();
        let mut end = count;
        if let Some(last) = segments.last().filter(|last| !last.slides && first < count) {
            let back = chain.tail.inverse();
            to = back * to;
            end = count - 1;
            let before = last.origin.rotation.inverse() * last.origin.translation.vector;
            let turns_before = end > first && segments.get(end - 1).is_some_and(|s| !s.slides);
            if turns_before && is_turn_about(last, &before) {
                to = back * Point3::from(-before);
                end -= 1;
            }
        }
        let lengths = (first..end).filter_map(|i| {
            let segment = segments.get(i)?;
            if !segment.slides {
                return Some(offset(i).norm());
            }
            let ends = range(chain, segment).map(|end| (segment.axis * end + offset(i)).norm());
            Some(ends[0].max(ends[1]))
        });
        Self {
            from,
            to,
            length: lengths.sum(),
        }
    }

    /// How much (m) farther away the goal of the tip is than the chain is long; not positive if it is not.
    pub(super) fn excess(&self, goal: &Pose) -> f64 {
        let goal = (goal * self.to).coords;
        let [start, end] = &self.from;
        let way = end - start;
        let share = (goal - start).dot(&way) / way.norm_squared();
        let nearest = match share.is_finite() {
            true => start + way * share.clamp(0.0, 1.0),
            false => *start,
        };
        (goal - nearest).norm() - self.length
    }
}

/// The least and the greatest position of a joint.
fn range(chain: &JointChain, segment: &ChainSegment) -> [f64; 2] {
    let limits = chain.limits.get(segment.leader).copied().flatten();
    let Limits { lower, upper } = limits.unwrap_or(Limits {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
    });
    let mut at = [0.0; super::arm_positions::MOST_ARM_JOINTS];
    [lower, upper].map(|position| {
        if let Some(leader) = at.get_mut(segment.leader) {
            *leader = position;
        }
        segment.position(&at)
    })
}

/// Whether the joint turns, and a point at `offset` from it stays where it is.
fn is_turn_about(segment: &ChainSegment, offset: &Vector3<f64>) -> bool {
    !segment.slides && segment.axis.cross(offset).norm() < 1e-12
}

//! Pairs that touch before a motion begins, or at its goal.
//!
//! Such pairs must be able to separate, wherever the contact came from, but a motion must not
//! press them together any further.

use super::expected_contacts::ExpectedContacts;
use super::guard::GREATEST_LAG;
use crate::world::{AllowedPairs, CollisionChecker, CollisionHit, InTheWay, RobotConfiguration};

/// A pair may seem to overlap this much (m) more: rounding, not motion.
const SAME_DEPTH: f64 = 5e-5;
/// Gap (m) from which on a pair is clear of each other, and stays so unless both ride on the robot or the motion expects
/// them to touch: what a hand holds is torn out of it where it grazes an edge.
const CLEAR: f64 = 0.001;

/// The pairs that are close at the start or at the goal.
#[derive(Clone, Debug)]
pub(crate) struct TouchingPairs {
    /// With the overlap (m) that each may have.
    close: Vec<(CollisionHit, f64)>,
    /// Pairs that the motion declares.
    allowed: AllowedPairs,
    /// The declared pairs, the pairs that are expected to touch, and the close pairs.
    relaxed: AllowedPairs,
    /// Overlap (m) that a pair that touches may have.
    depth: f64,
    /// Whether every close pair may stay as it is.
    are_all: bool,
}

impl TouchingPairs {
    /// The pairs closer than `margin` (m) in the robot's present configuration; each that touches or is expected to
    /// may overlap by `depth` (m), or as much as it already does.
    pub(crate) fn new(
        checker: &mut CollisionChecker<'_>,
        robot: &RobotConfiguration,
        contacts: &ExpectedContacts,
        margin: f64,
        depth: f64,
    ) -> Self {
        Self::some(checker, robot, contacts, margin, depth, |_| true)
    }

    /// As [`Self::new`], for some pairs only: all others must keep the distance that planned
    /// configurations have.
    pub(crate) fn some(
        checker: &mut CollisionChecker<'_>,
        robot: &RobotConfiguration,
        contacts: &ExpectedContacts,
        margin: f64,
        depth: f64,
        counts: impl Fn(&CollisionHit) -> bool,
    ) -> Self {
        let hits = checker.all_hits(robot, &contacts.allowed, margin);
        Self::of_hits(hits, contacts, depth, counts)
    }

    /// As [`Self::some`], of the close pairs that the motion does not declare.
    pub(crate) fn of_hits(
        mut hits: Vec<CollisionHit>,
        contacts: &ExpectedContacts,
        depth: f64,
        counts: impl Fn(&CollisionHit) -> bool,
    ) -> Self {
        let count = hits.len();
        hits.retain(|hit| hit.depth < GREATEST_LAG && counts(hit));
        let are_all = hits.len() == count;
        let relaxed = hits.iter().fold(contacts.allowed.clone(), |all, hit| {
            all.and(hit.moving.clone(), hit.other.clone())
        });
        let expected = contacts.touching.iter().cloned();
        let relaxed = expected.fold(relaxed, |all, (a, b)| all.and(a, b));
        let close = hits.into_iter().map(|hit| {
            let mut expected = contacts.touching.iter();
            let is_expected = expected.any(|(a, b)| {
                (*a == hit.moving && *b == hit.other) || (*a == hit.other && *b == hit.moving)
            });
            let overlap = overlap(&hit, depth, is_expected || is_own(&hit));
            (hit, overlap)
        });
        Self {
            close: close.collect(),
            allowed: contacts.allowed.clone(),
            relaxed,
            depth,
            are_all,
        }
    }

    /// Whether [`Self::first_hit`] finds nothing where the pairs were found.
    pub(crate) fn are_free_at_start(&self) -> bool {
        self.are_all
    }

    /// Pairs that are closer than the margin (m) at the goal, in whose configuration the robot is, may be close on the
    /// way, too: what rides on the robot may touch the robot, anything else is clear.
    pub(crate) fn expect(
        &mut self,
        checker: &mut CollisionChecker<'_>,
        goal: &RobotConfiguration,
        margin: f64,
    ) {
        for hit in checker.all_hits(goal, &self.relaxed, margin) {
            let is_own = is_own(&hit);
            if hit.depth <= if is_own { self.depth } else { -CLEAR } {
                let relaxed = std::mem::take(&mut self.relaxed);
                self.relaxed = relaxed.and(hit.moving.clone(), hit.other.clone());
                let overlap = overlap(&hit, self.depth, is_own);
                self.close.push((hit, overlap));
            }
        }
    }

    /// Whether nothing is close at the start, nor expected to touch.
    pub(crate) fn is_empty(&self) -> bool {
        self.relaxed.is_same(&self.allowed)
    }

    /// The pairs that were close, and those that are declared.
    pub(crate) fn relaxed(&self) -> &AllowedPairs {
        &self.relaxed
    }

    /// A pair closer than `margin` (m) in the configuration, or overlapping more than allowed, which
    /// is the lesser demand.
    pub(crate) fn first_hit(
        &self,
        checker: &mut CollisionChecker<'_>,
        robot: &RobotConfiguration,
        margin: f64,
    ) -> Option<CollisionHit> {
        let near = checker.first_hit(robot, &self.relaxed, margin);
        // No others are that close.
        near.or_else(|| self.first_deep(checker, robot))
    }

    /// As [`Self::first_hit`], without finding out how far the two overlap, nor where.
    pub(crate) fn first_touch(
        &self,
        checker: &mut CollisionChecker<'_>,
        robot: &RobotConfiguration,
        margin: f64,
    ) -> Option<CollisionHit> {
        let near = checker.first_touch(robot, &self.relaxed, margin);
        near.or_else(|| self.first_deep(checker, robot))
    }

    /// Whether [`Self::first_hit`] finds nothing.
    pub(crate) fn is_free(
        &self,
        checker: &mut CollisionChecker<'_>,
        robot: &RobotConfiguration,
        margin: f64,
    ) -> bool {
        checker.is_free(robot, &self.relaxed, margin) && self.first_deep(checker, robot).is_none()
    }

    /// A pair that is close at the start or at the goal, and overlaps more than allowed in the configuration.
    pub(crate) fn first_deep(
        &self,
        checker: &mut CollisionChecker<'_>,
        robot: &RobotConfiguration,
    ) -> Option<CollisionHit> {
        if self.is_empty() {
            return None;
        }
        let gaps = self.close.iter().map(|(_, overlap)| -overlap);
        let margin = gaps.fold(-self.depth, f64::max);
        let deep = checker.hits_among(robot, &self.relaxed, &self.allowed, margin);
        deep.into_iter().find(|hit| {
            let mut close = self.close.iter();
            let close = close.find(|(c, _)| c.moving == hit.moving && c.other == hit.other);
            hit.depth > close.map_or(self.depth, |(_, overlap)| *overlap) + SAME_DEPTH
        })
    }

    /// What keeps the configuration from being free, one of all, where [`Self::first_hit`] finds something.
    pub(crate) fn in_the_way<'w>(
        &self,
        checker: &mut CollisionChecker<'w>,
        robot: &RobotConfiguration,
        margin: f64,
    ) -> Option<InTheWay<'w>> {
        let near = checker.in_the_way(robot, &self.relaxed, margin);
        near.or_else(|| {
            let deep = self.first_deep(checker, robot)?;
            Some(checker.as_in_the_way(&deep))
        })
    }
}

/// The overlap (m) that a pair may have where it is close: more than `depth` only if it has it already, and none if it
/// is clear, unless it may touch.
fn overlap(pair: &CollisionHit, depth: f64, may_touch: bool) -> f64 {
    match pair.depth <= -CLEAR && !may_touch {
        true => -CLEAR,
        false => pair.depth.max(depth),
    }
}

/// Whether the robot, or what it holds, is close to itself.
fn is_own(pair: &CollisionHit) -> bool {
    pair.other.robot_link().is_some()
}

//! Pairs that touch before a motion begins.
//!
//! Such pairs must be able to part, wherever the contact came from, but a motion must not
//! press them together any further.

use super::expected_contacts::ExpectedContacts;
use super::guard::GREATEST_LAG;
use crate::world::{AllowedPairs, CollisionChecker, CollisionHit, RobotConfiguration};

/// A pair may come this much (m) deeper: rounding, not motion.
const SAME_DEPTH: f64 = 5e-5;

/// The pairs that are near each other in the beginning, with how deep they overlap then.
#[derive(Clone, Debug)]
pub(super) struct TouchingPairs {
    hits: Vec<CollisionHit>,
    /// Pairs that the motion declares.
    allowed: AllowedPairs,
    /// Those, the pairs that are expected to touch, and the near pairs.
    relaxed: AllowedPairs,
    /// Overlap (m) that any near pair may have.
    depth: f64,
}

impl TouchingPairs {
    /// The pairs nearer than `margin` (m) for the robot as it is; each of them may overlap by
    /// `depth` (m), or as much as it does already.
    pub(super) fn new(
        checker: &mut CollisionChecker<'_>,
        robot: &RobotConfiguration,
        contacts: &ExpectedContacts,
        margin: f64,
        depth: f64,
    ) -> Self {
        let mut hits = checker.all_hits(robot, &contacts.allowed, margin);
        hits.retain(|hit| hit.depth < GREATEST_LAG);
        let relaxed = hits.iter().fold(contacts.allowed.clone(), |all, hit| {
            all.and(hit.moving.clone(), hit.other.clone())
        });
        let expected = contacts.touching.iter().cloned();
        let relaxed = expected.fold(relaxed, |all, (a, b)| all.and(a, b));
        Self {
            hits,
            allowed: contacts.allowed.clone(),
            relaxed,
            depth,
        }
    }

    /// Also lets those pairs touch that touch, but do not overlap, in the configuration.
    pub(super) fn expect(
        &mut self,
        checker: &mut CollisionChecker<'_>,
        robot: &RobotConfiguration,
        margin: f64,
    ) {
        for hit in checker.all_hits(robot, &self.relaxed, margin) {
            if hit.depth <= self.depth {
                let relaxed = std::mem::take(&mut self.relaxed);
                self.relaxed = relaxed.and(hit.moving, hit.other);
            }
        }
    }

    /// Whether nothing is near in the beginning, nor expected to touch.
    pub(super) fn is_empty(&self) -> bool {
        self.relaxed == self.allowed
    }

    /// The pairs that were near, and those that are declared.
    pub(super) fn relaxed(&self) -> &AllowedPairs {
        &self.relaxed
    }

    /// What is nearer than `margin` (m) in the configuration, or deeper than it may be.
    pub(super) fn first_hit(
        &self,
        checker: &mut CollisionChecker<'_>,
        robot: &RobotConfiguration,
        margin: f64,
    ) -> Option<CollisionHit> {
        let near = checker.first_hit(robot, &self.relaxed, margin);
        if near.is_some() || self.is_empty() {
            return near;
        }
        let deep = checker.all_hits(robot, &self.allowed, -self.depth);
        deep.into_iter().find(|hit| {
            let mut before = self.hits.iter();
            let before = before.find(|b| b.moving == hit.moving && b.other == hit.other);
            hit.depth > before.map_or(0.0, |b| b.depth).max(self.depth) + SAME_DEPTH
        })
    }
}

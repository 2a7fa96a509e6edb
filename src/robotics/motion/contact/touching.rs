//! Pairs that touch before a motion begins.
//!
//! Such pairs must be able to separate, wherever the contact came from, but a motion must not
//! press them together any further.

use super::expected_contacts::ExpectedContacts;
use super::guard::GREATEST_LAG;
use crate::world::{AllowedPairs, CollisionChecker, CollisionHit, InTheWay, RobotConfiguration};

/// A pair may seem to overlap this much (m) more: rounding, not motion.
const SAME_DEPTH: f64 = 5e-5;

/// The pairs that are close at the start, with their initial overlap.
#[derive(Clone, Debug)]
pub(crate) struct TouchingPairs {
    hits: Vec<CollisionHit>,
    /// Pairs that the motion declares.
    allowed: AllowedPairs,
    /// The declared pairs, the pairs that are expected to touch, and the close pairs.
    relaxed: AllowedPairs,
    /// Overlap (m) that any close pair may have.
    depth: f64,
    /// Whether every close pair may stay as it is.
    are_all: bool,
}

impl TouchingPairs {
    /// The pairs closer than `margin` (m) in the robot's present configuration; each may overlap
    /// by `depth` (m), or as much as it already does.
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
        Self {
            hits,
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

    /// Also allows contact for pairs that touch, but do not overlap, in the configuration.
    pub(crate) fn expect(
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

    /// A pair that was close at the start and overlaps more than allowed in the configuration.
    pub(crate) fn first_deep(
        &self,
        checker: &mut CollisionChecker<'_>,
        robot: &RobotConfiguration,
    ) -> Option<CollisionHit> {
        if self.is_empty() {
            return None;
        }
        let deep = checker.hits_among(robot, &self.relaxed, &self.allowed, -self.depth);
        deep.into_iter().find(|hit| {
            let mut before = self.hits.iter();
            let before = before.find(|b| b.moving == hit.moving && b.other == hit.other);
            hit.depth > before.map_or(0.0, |b| b.depth).max(self.depth) + SAME_DEPTH
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

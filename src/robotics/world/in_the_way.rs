//! What keeps a configuration from being free: an object that could be taken away, or something else.

use super::allowed_pairs::AllowedPairs;
use super::body_name::BodyName;
use super::collision::{CollisionChecker, CollisionHit, SomeLinks};
use super::collision_search::Near;
use super::robot_configuration::RobotConfiguration;
use super::surroundings::ObjectAt;
use spatial::Pose;

/// Something that is too close.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum InTheWay<'w> {
    /// The object of that name, which no hand holds.
    Object(&'w str),
    /// A part of the robot or the kitchen, the floor, or what a hand holds.
    Fixed,
}

impl<'w> CollisionChecker<'w> {
    /// What is closer than `margin` (m) in the configuration and not allowed, one of all.
    pub(crate) fn in_the_way(
        &mut self,
        robot: &RobotConfiguration,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Option<InTheWay<'w>> {
        let near = self.any_near(robot, allowed, margin)?;
        Some(self.what_is(&near))
    }

    /// The same of some links with what is no part of the robot, at poses in the map frame.
    pub(crate) fn in_the_way_at(
        &mut self,
        link_poses: &[Pose],
        links: &SomeLinks,
        allowed: &AllowedPairs,
        margin: f64,
    ) -> Option<InTheWay<'w>> {
        let near = self.any_near_at(link_poses, links, allowed, margin)?;
        Some(self.what_is(&near))
    }

    fn what_is(&self, near: &Near) -> InTheWay<'w> {
        self.lying(|object| object.key == near.moving || object.key == near.other)
    }

    /// What a pair is too close by.
    pub(crate) fn as_in_the_way(&self, hit: &CollisionHit) -> InTheWay<'w> {
        let is_named = |body: &BodyName, object: &ObjectAt<'_>| match body {
            BodyName::Object(name) => name == object.name,
            BodyName::Floor | BodyName::Robot(_) | BodyName::Furniture(_) => false,
        };
        self.lying(|object| is_named(&hit.moving, object) || is_named(&hit.other, object))
    }

    fn lying(&self, is_met: impl Fn(&ObjectAt<'_>) -> bool) -> InTheWay<'w> {
        let mut objects = self.surroundings.objects.iter();
        match objects.find(|object| is_met(object)) {
            Some(object) => InTheWay::Object(object.name),
            None => InTheWay::Fixed,
        }
    }
}

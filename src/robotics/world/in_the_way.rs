//! What keeps a configuration from being free: an object that could be taken away, or something else.

use std::ops::ControlFlow;

use super::allowed_pairs::AllowedPairs;
use super::body_name::BodyName;
use super::collision::{CollisionChecker, SomeLinks};
use super::collision_search::{Near, Wanted};
use super::robot_configuration::RobotConfiguration;
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
        let mut found = None;
        self.about_links(links, |checker| {
            checker.search(link_poses, allowed, Wanted::Whether, margin, |near, _| {
                found = Some(near);
                ControlFlow::Break(())
            });
        });
        Some(self.what_is(&found?))
    }

    fn what_is(&self, near: &Near) -> InTheWay<'w> {
        let mut objects = self.surroundings.objects.iter();
        match objects.find(|object| object.key == near.moving || object.key == near.other) {
            Some(object) => InTheWay::Object(object.name),
            None => InTheWay::Fixed,
        }
    }

    /// The body as something in the way.
    pub(crate) fn as_in_the_way(&self, body: &BodyName) -> InTheWay<'w> {
        let mut objects = self.surroundings.objects.iter();
        match objects.find(|object| *body == BodyName::Object(object.name.to_owned())) {
            Some(object) => InTheWay::Object(object.name),
            None => InTheWay::Fixed,
        }
    }
}

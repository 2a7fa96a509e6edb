//! Objects that the robot is to touch and presses onto something, and those that it pushes along.
//!
//! [`guard`] refuses steps into what does not give way. What gives way never gets deep into the
//! robot, so it is watched here.

use super::guard;
use crate::motion::failure::pinned_object::PinnedObject;
use crate::motion::failure::pushed_object::PushedObject;
use crate::world::physics::STEP_SECONDS;
use crate::world::{AllowedPairs, BodyName, Object, World};
use spatial::Pose;
use spatial::pose::distance_between;

/// How long (s) the robot may press what it is to touch onto something. In 0.05 s a finger can press a
/// thing more than 2 mm into what it stands on.
const PINNED: f64 = 0.03;
/// The same for a motion that begins while the object is pressed, as long as it presses no harder: a hand
/// that goes back needs that long until it moves.
const PINNED_BEFORE: f64 = 0.5;
/// How much harder (as a factor) counts as harder.
const HARDER: f64 = 1.05;
/// How far (m) the robot may push what it is not to touch.
const PUSHED: f64 = 0.005;

/// What a motion does to objects that the robot does not hold.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pushing {
    /// How long (s) an object has been pressed onto something.
    pinned: f64,
    /// The force (N) with which it was pressed when the motion began.
    before: Option<f64>,
    /// Where objects were when the robot began to touch them.
    touched: Vec<(String, Pose)>,
}

impl Pushing {
    /// An object that may be touched and has been pressed onto something for too long; call in
    /// every step.
    pub(crate) fn pinned(&mut self, world: &World, allowed: &AllowedPairs) -> Option<PinnedObject> {
        let may_be_touched = |object: &&Object| {
            let mut pairs = allowed.iter();
            pairs.any(|(_, other)| other.object() == Some(object.name()))
        };
        let mut touchable = guard::loose(world).filter(may_be_touched);
        let pinned = touchable.find_map(|object| guard::pinned(world, object.name()));
        let force = pinned.as_ref().map_or(0.0, |pinned| pinned.force);
        let before = *self.before.get_or_insert(force);
        let Some(pinned) = pinned else {
            self.pinned = 0.0;
            self.before = Some(0.0);
            return None;
        };
        self.pinned += STEP_SECONDS;
        let longest = if force <= before * HARDER {
            PINNED_BEFORE
        } else {
            PINNED
        };
        (self.pinned > longest).then_some(pinned)
    }

    /// An object that has been pushed too far by parts of the robot that may not touch it; call in
    /// every step.
    pub(crate) fn pushed(&mut self, world: &World, allowed: &AllowedPairs) -> Option<PushedObject> {
        guard::loose(world).find_map(|object| {
            let contacts = world.robot_contacts(object.name()).ok()?;
            let is_allowed = |link: &BodyName| {
                let mut pairs = allowed.iter();
                pairs.any(|(one, other)| one == link && other.object() == Some(object.name()))
            };
            let mut contacts = contacts.into_iter();
            let by = contacts.find(|contact| !is_allowed(&contact.body))?.body;
            let now = world.object_pose(object.name()).ok()?;
            let began = self.touched.iter().find(|(name, _)| name == object.name());
            let Some((_, began)) = began else {
                self.touched.push((object.name().to_owned(), now));
                return None;
            };
            let distance = distance_between(began, &now);
            (distance > PUSHED).then(|| PushedObject {
                object: object.name().to_owned(),
                by,
                distance,
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::world::fixture;
    use spatial::pose::{from_xy_yaw, from_xyz_rpy};

    #[test]
    fn what_the_base_pushes_along_is_told_unless_it_may_be_touched() {
        let models = fixture::models();
        let robot = fixture::tucked(&models, [0.0, 0.0, 0.0], 0.1);
        let mut world = World::new(models, robot.clone());
        let box_at = from_xyz_rpy([0.42, 0.0, 0.1], [0.0; 3]);
        fixture::spawn(&mut world, "BOX", "cube", &box_at);
        let base = world.models().robot.link_named("base_link").unwrap();
        let base = world.models().robot_body(base);
        let object = BodyName::Object("BOX".to_owned());
        let allowed = AllowedPairs::none().and(base.clone(), object);
        let (mut strict, mut lenient) = (Pushing::default(), Pushing::default());
        // Half a millimetre in each step.
        let told = (0..400).find_map(|i| {
            let mut robot = robot.clone();
            robot.base = from_xy_yaw(5e-4 * f64::from(i), 0.0, 0.0);
            world.set_robot_configuration(&robot);
            world.step();
            assert_eq!(lenient.pushed(&world, &allowed), None);
            strict.pushed(&world, &AllowedPairs::none())
        });
        let told = told.unwrap();
        assert_eq!((told.object.as_str(), told.by), ("BOX", base));
        assert!((0.005..0.007).contains(&told.distance), "{}", told.distance);
    }
}

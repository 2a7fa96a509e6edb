//! Checking configurations of some joints while everything else stays as it is.

use super::path_test::PathTest;
use crate::motion::contact::expected_contacts::ExpectedContacts;
use crate::motion::contact::guard::GUARD_DEPTH;
use crate::motion::contact::level::LevelHands;
use crate::motion::contact::touching::TouchingPairs;
use crate::robot::JointId;
use crate::world::{
    AllowedPairs, BodyName, CollisionChecker, CollisionHit, InTheWay, MovingParts, Pairs,
    RobotConfiguration, SomeLinks, Tilt, World,
};

/// Clearance (m) of planned configurations from everything.
pub(crate) const PLAN_MARGIN: f64 = 0.004;
/// Overlap (m) accepted for pairs that are close at the start.
pub(crate) const TOUCH_DEPTH: f64 = GUARD_DEPTH - 0.0003;

/// Tells which configurations are free. Pairs that are close at the start, such as a held
/// object and what it stands on, may stay close, but not overlap more.
pub(crate) struct ConfigurationChecker<'w> {
    checker: CollisionChecker<'w>,
    robot: RobotConfiguration,
    joints: Vec<JointId>,
    /// Fingers that are opening meanwhile, and where they are going, if each configuration is to be free with the
    /// fingers as they are, and as they will be.
    opening: Vec<(JointId, f64)>,
    touching: TouchingPairs,
    /// The pairs that decide whether a configuration is free.
    pairs: Pairs,
    /// The hands that stay level on the way.
    level: LevelHands<'w>,
}

/// What rules out a configuration on the way.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum PathObstacle {
    /// Two bodies touch.
    Touch(CollisionHit),
    /// What is open at the top is tilted.
    Tilt(Tilt),
}

impl PathTest<PathObstacle> for ConfigurationChecker<'_> {
    fn obstacle(&mut self, configuration: &[f64]) -> Option<PathObstacle> {
        ConfigurationChecker::obstacle(self, configuration)
    }

    fn is_free(&mut self, configuration: &[f64]) -> bool {
        self.is_free_on_way(configuration)
    }
}

impl<'w> ConfigurationChecker<'w> {
    pub(crate) fn new(world: &'w World, joints: Vec<JointId>, contacts: &ExpectedContacts) -> Self {
        let robot = world.robot_configuration().clone();
        Self::at(world, robot, joints, contacts)
    }

    /// The fingers that are opening in the world have room on the whole way, if they have it at the start.
    #[must_use]
    pub(crate) fn beside_opening_fingers(mut self, world: &World) -> Self {
        let others = world.opening_fingers();
        let others = others.filter(|(joint, _)| !self.joints.contains(joint));
        self.opening = others.collect();
        if self.opening.is_empty() {
            return self;
        }
        let joints = &self.robot.joints;
        let start: Vec<f64> = self.joints.iter().map(|joint| joints.get(*joint)).collect();
        if !self.is_free(&start) {
            self.opening.clear();
        }
        self
    }

    fn at(
        world: &'w World,
        robot: RobotConfiguration,
        joints: Vec<JointId>,
        contacts: &ExpectedContacts,
    ) -> Self {
        let all = |_: &CollisionHit| true;
        Self::about(world, robot, joints, contacts, all)
    }

    /// For the pairs that count where they are close at the start.
    fn about(
        world: &'w World,
        robot: RobotConfiguration,
        joints: Vec<JointId>,
        contacts: &ExpectedContacts,
        counts: impl Fn(&CollisionHit) -> bool,
    ) -> Self {
        let mut checker = world.collision_checker();
        let touching = TouchingPairs::some(
            &mut checker,
            &robot,
            contacts,
            PLAN_MARGIN,
            TOUCH_DEPTH,
            counts,
        );
        Self::with(checker, robot, joints, touching)
    }

    /// With a checker for that world, for the pairs that are close in the configuration.
    pub(crate) fn with(
        mut checker: CollisionChecker<'w>,
        robot: RobotConfiguration,
        joints: Vec<JointId>,
        touching: TouchingPairs,
    ) -> Self {
        // What does not move with the joints is checked once and for all.
        let moving = MovingParts::of_joints(&checker.models().robot, &joints);
        checker.expect(moving, Pairs::Constant);
        let mut made = Self {
            checker,
            robot,
            joints,
            opening: Vec::new(),
            touching,
            pairs: Pairs::All,
            level: LevelHands::default(),
        };
        made.look_at_start();
        made
    }

    /// Finds out which pairs decide, with the robot where the close pairs were found.
    fn look_at_start(&mut self) {
        self.checker.look_at(Pairs::Constant);
        let is_free = self.touching.are_free_at_start() || {
            let touching = &self.touching;
            let hit = touching.first_hit(&mut self.checker, &self.robot, PLAN_MARGIN);
            hit.is_none()
        };
        self.pairs = match is_free {
            true => Pairs::Changing,
            false => Pairs::All,
        };
        self.checker.look_at(self.pairs);
    }

    /// From now on, other pairs are close at the start, or declared.
    pub(crate) fn set_touching(&mut self, start: &RobotConfiguration, touching: &TouchingPairs) {
        if self.touching.relaxed().is_same(touching.relaxed()) {
            return;
        }
        self.touching.clone_from(touching);
        if !touching.are_free_at_start() {
            self.robot.clone_from(start);
        }
        self.look_at_start();
    }

    /// The hands stay level on the way.
    #[must_use]
    pub(crate) fn keeping(mut self, level: LevelHands<'w>) -> Self {
        self.level = level;
        self
    }

    /// The hands that stay level on the way.
    pub(super) fn level(&self) -> &LevelHands<'w> {
        &self.level
    }

    /// What rules out the joint positions on the way, if anything does.
    pub(crate) fn obstacle(&mut self, positions: &[f64]) -> Option<PathObstacle> {
        match self.level.tilted(positions) {
            Some(tilt) => Some(PathObstacle::Tilt(tilt)),
            None => self.blocked(positions).map(PathObstacle::Touch),
        }
    }

    /// Whether nothing rules out the joint positions on the way: as [`Self::obstacle`], without saying what does.
    pub(crate) fn is_free_on_way(&mut self, positions: &[f64]) -> bool {
        self.level.tilted(positions).is_none() && self.is_free(positions)
    }

    /// As [`Self::new`], with the robot elsewhere, and without regard to where the moving bodies
    /// are at the start: they may be close to nothing.
    pub(crate) fn away_from_start(
        world: &'w World,
        robot: RobotConfiguration,
        joints: Vec<JointId>,
        contacts: &ExpectedContacts,
        moving: &[BodyName],
    ) -> Self {
        let stays =
            |hit: &CollisionHit| !moving.contains(&hit.moving) && !moving.contains(&hit.other);
        Self::about(world, robot, joints, contacts, stays)
    }

    /// Pairs that are close at the goal may be as close on the way.
    pub(crate) fn accept_goal(&mut self, positions: &[f64]) {
        self.set(positions);
        self.checker.look_at(Pairs::All);
        self.with_fingers(|touching, checker, robot| {
            touching.expect(checker, robot, PLAN_MARGIN);
            None::<()>
        });
        self.checker.look_at(self.pairs);
    }

    /// What is found with the fingers as they are, or else with those that are opening as they will be.
    fn with_fingers<T>(
        &mut self,
        mut find: impl FnMut(
            &mut TouchingPairs,
            &mut CollisionChecker<'w>,
            &RobotConfiguration,
        ) -> Option<T>,
    ) -> Option<T> {
        let found = find(&mut self.touching, &mut self.checker, &self.robot);
        if found.is_some() || self.opening.is_empty() {
            return found;
        }
        self.exchange_fingers();
        let found = find(&mut self.touching, &mut self.checker, &self.robot);
        self.exchange_fingers();
        found
    }

    /// Exchanges the positions of the opening fingers in the configuration for the others.
    fn exchange_fingers(&mut self) {
        for (joint, other) in &mut self.opening {
            let position = self.robot.joints.get(*joint);
            self.robot.joints.set(*joint, *other);
            *other = position;
        }
    }

    fn set(&mut self, positions: &[f64]) {
        for (joint, position) in self.joints.iter().zip(positions) {
            self.robot.joints.set(*joint, *position);
        }
    }

    /// What rules out the joint positions, if anything does.
    pub(crate) fn blocked(&mut self, positions: &[f64]) -> Option<CollisionHit> {
        self.set(positions);
        self.with_fingers(|touching, checker, robot| {
            touching.first_hit(checker, robot, PLAN_MARGIN)
        })
    }

    /// As [`Self::blocked`], without finding out how far the two overlap, nor where.
    pub(crate) fn touching(&mut self, positions: &[f64]) -> Option<CollisionHit> {
        self.set(positions);
        self.with_fingers(|touching, checker, robot| {
            touching.first_touch(checker, robot, PLAN_MARGIN)
        })
    }

    /// Whether the joint positions are free: as [`Self::blocked`], without saying what is touched.
    pub(crate) fn is_free(&mut self, positions: &[f64]) -> bool {
        self.set(positions);
        let touches = self.with_fingers(|touching, checker, robot| {
            (!touching.is_free(checker, robot, PLAN_MARGIN)).then_some(())
        });
        touches.is_none()
    }

    /// What keeps the joint positions from being free, one of all.
    pub(crate) fn in_the_way(&mut self, positions: &[f64]) -> Option<InTheWay<'w>> {
        self.set(positions);
        self.with_fingers(|touching, checker, robot| {
            touching.in_the_way(checker, robot, PLAN_MARGIN)
        })
    }

    /// Whether one of the links is too close to what is no part of the robot in that
    /// configuration.
    pub(crate) fn touches_surroundings(&mut self, positions: &[f64], links: &SomeLinks) -> bool {
        self.set(positions);
        let relaxed = self.touching.relaxed();
        self.checker
            .links_touch(&self.robot, links, relaxed, PLAN_MARGIN)
    }

    /// The pairs that overlap by more than `depth` (m) in that configuration, whatever the motion
    /// declares, the deepest first.
    pub(crate) fn overlaps(&mut self, positions: &[f64], depth: f64) -> Vec<CollisionHit> {
        self.set(positions);
        let none = AllowedPairs::none();
        self.checker.look_at(Pairs::All);
        let hits = self.checker.all_hits(&self.robot, &none, -depth);
        self.checker.look_at(self.pairs);
        hits
    }

    /// Whether the configuration would also be free with other joints at the given positions.
    pub(super) fn is_free_with(&mut self, positions: &[f64], others: &[(JointId, f64)]) -> bool {
        let joints = &self.robot.joints;
        let before: Vec<_> = others
            .iter()
            .map(|(joint, _)| (*joint, joints.get(*joint)))
            .collect();
        for (joint, position) in others {
            self.robot.joints.set(*joint, *position);
        }
        self.checker.look_at(Pairs::All);
        let free = self.is_free(positions);
        self.checker.look_at(self.pairs);
        for (joint, position) in before {
            self.robot.joints.set(joint, position);
        }
        free
    }

    /// The smallest gap (m) in that configuration, up to `reach` (m).
    pub(super) fn clearance(&mut self, positions: &[f64], reach: f64) -> f64 {
        self.set(positions);
        self.checker.look_at(Pairs::All);
        let nearest = self
            .checker
            .clearance(&self.robot, self.touching.relaxed(), reach);
        self.checker.look_at(self.pairs);
        nearest.map_or(reach, |c| c.distance)
    }
}

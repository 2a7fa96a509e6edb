//! By which grasps hands reach objects from where the robot stands: one question about many.

use crate::simulation::Simulation;
use crate::simulation::grasp_search::picking_way;
use crate::simulation::imagined::Imagined;
use lisp::value::raise::Raise;
use robotics::motion::{CollisionMode, HandReach, Overhead};
use robotics::robot::Side;
use robotics::robot::torso_search::TorsoSearch;
use robotics::world::grasp_library::GraspDefinition;
use robotics::world::{World, WorldError};

/// What is shared by the questions about all grasps of all objects.
pub(crate) struct ReachedGrasps<'s> {
    simulation: &'s Simulation,
    world: &'s World,
    /// Names of objects that are taken not to be there.
    absent: &'s [String],
    searches: Vec<(Side, TorsoSearch<'s>)>,
    /// Hands, by how far (m) they are open.
    hands: Vec<(Side, f64, HandReach<'s>)>,
    /// What is above the object that was asked for last.
    above: Option<(&'s str, Overhead<'s>)>,
}

impl<'s> ReachedGrasps<'s> {
    /// In a world as the simulation's, as if some objects were not there, none of which is held.
    pub(crate) fn new(simulation: &'s Simulation, world: &'s World, absent: &'s [String]) -> Self {
        Self {
            simulation,
            world,
            absent,
            searches: Vec::new(),
            hands: Vec::new(),
            above: None,
        }
    }

    /// Whether a hand can come to a grasp of an object, and leave it, without touching anything else.
    pub(crate) fn has(
        &mut self,
        object: &'s str,
        side: Side,
        grasp: &GraspDefinition,
    ) -> Result<bool, Box<Raise>> {
        let raise = |error: WorldError| Raise::reporting(error);
        let (simulation, world) = (self.simulation, self.world);
        let kind = world.object(object).map_err(raise)?.type_name();
        let opening = simulation.grasps.opening(kind, grasp);
        let imagined = Imagined {
            object,
            object_pose: None,
            base_pose: None,
            side,
            opening,
        };
        if !imagined.is_only_robot(world).map_err(raise)? {
            return simulation.lets_grasp_in(world, &imagined, grasp);
        }
        let base = world.robot_configuration().base;
        let in_base = base.inverse() * world.object_pose(object).map_err(raise)?;
        let axes = &simulation.models.description.arm(side).tool_axes;
        let poses = grasp.tool_poses(&in_base, axes).map_err(Raise::reporting)?;
        let is_far = {
            let search = self.search(side);
            [&poses.second_pregrasp, &poses.grasp]
                .iter()
                .any(|tool| search.is_too_far(tool))
        };
        if is_far {
            return Ok(false);
        }
        let hand = self.hand(side, &imagined);
        let nothing = CollisionMode::AvoidAll;
        let is_blocked = hand.is_surely_blocked(&poses.second_pregrasp, nothing, Some(object))
            || hand.is_surely_blocked(&poses.grasp, CollisionMode::AllowHand, Some(object));
        if is_blocked {
            return Ok(false);
        }
        let search = self.search(side);
        let reaches = [&poses.second_pregrasp, &poses.grasp]
            .iter()
            .all(|tool| search.reaches_tool(tool));
        if !reaches {
            return Ok(false);
        }
        if self.above.as_ref().is_none_or(|(name, _)| *name != object) {
            let at = base * in_base;
            let overhead = Overhead::without(world, object, &at, self.absent).map_err(raise)?;
            self.above = Some((object, overhead));
        }
        let poses = match &self.above {
            Some((_, overhead)) => overhead.anew().picking(&base, poses),
            None => poses,
        };
        let way = picking_way(&poses);
        Ok(self.hand(side, &imagined).reaches(&way, Some(object)))
    }

    fn search(&mut self, side: Side) -> &TorsoSearch<'s> {
        let at = self.searches.iter().position(|(known, _)| *known == side);
        let at = at.unwrap_or_else(|| {
            let (models, joints) = (
                &self.simulation.models,
                &self.world.robot_configuration().joints,
            );
            let search = models.description.torso_search(&models.robot, joints, side);
            self.searches.push((side, search));
            self.searches.len() - 1
        });
        &self.searches[at].1
    }

    fn hand(&mut self, side: Side, imagined: &Imagined<'_>) -> &mut HandReach<'s> {
        let is_known = |(known, opening, _): &(Side, f64, _)| {
            *known == side && opening.to_bits() == imagined.opening.to_bits()
        };
        let at = self.hands.iter().position(is_known).unwrap_or_else(|| {
            let hand = HandReach::new(self.world, imagined.robot(self.world), side, self.absent);
            self.hands.push((side, imagined.opening, hand));
            self.hands.len() - 1
        });
        &mut self.hands[at].2
    }
}

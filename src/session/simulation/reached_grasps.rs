//! By which grasps hands reach objects from where the robot stands: one question about many.

use crate::simulation::Simulation;
use crate::simulation::grasp_search::picking_way;
use crate::simulation::imagined::Imagined;
use lisp::value::raise::Raise;
use robotics::motion::{CollisionMode, HandReach, Overhead};
use robotics::robot::Side;
use robotics::robot::torso_search::TorsoSearch;
use robotics::world::World;
use robotics::world::grasp_library::{GraspDefinition, ToolPoses};
use spatial::Pose;

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

/// Where a tool is on its way, in the frame of the base, and what it may touch there.
type Way = [(Pose, CollisionMode); 4];

/// What keeps a hand from a grasp.
pub(crate) enum Hindrances<'s> {
    Nothing,
    /// One of the objects of these names, or more than one, or something else.
    Objects(Vec<&'s str>),
    /// All objects may count: some are above, or in hands.
    Unclear,
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
        let (simulation, world) = (self.simulation, self.world);
        let imagined = self.imagined(object, side, grasp)?;
        if !imagined.is_only_robot(world).map_err(Raise::reporting)? {
            return simulation.lets_grasp_in(world, &imagined, grasp);
        }
        Ok(self.reached_way(&imagined, grasp)?.is_some())
    }

    /// The way of a hand to a grasp of an object and off it again, if it can go there without touching anything else.
    fn reached_way(
        &mut self,
        imagined: &Imagined<'s>,
        grasp: &GraspDefinition,
    ) -> Result<Option<Way>, Box<Raise>> {
        let (object, side) = (imagined.object, imagined.side);
        let poses = self.poses(object, side, grasp)?;
        let tools = [poses.second_pregrasp, poses.grasp];
        let search = self.search(side);
        if tools.iter().any(|tool| search.is_too_far(tool)) {
            return Ok(None);
        }
        let hand = self.hand(side, imagined);
        let nothing = CollisionMode::AvoidAll;
        let is_blocked = hand.is_surely_blocked(&tools[0], nothing, Some(object))
            || hand.is_surely_blocked(&tools[1], CollisionMode::AllowHand, Some(object));
        if is_blocked {
            return Ok(None);
        }
        let search = self.search(side);
        if !tools.iter().all(|tool| search.reaches_tool(tool)) {
            return Ok(None);
        }
        let way = self.way(object, poses)?;
        let reaches = self.hand(side, imagined).reaches(&way, Some(object));
        Ok(reaches.then_some(way))
    }

    /// What keeps a hand from coming to a grasp of an object, and leaving it: if it could without another object, that
    /// is one of those. `without` is about the same world without any other object.
    pub(crate) fn hindrances(
        &mut self,
        without: &mut ReachedGrasps<'s>,
        object: &'s str,
        side: Side,
        grasp: &GraspDefinition,
    ) -> Result<Hindrances<'s>, Box<Raise>> {
        let mut all = self.world.objects();
        if all.any(|object| object.attachment().is_some()) {
            return Ok(Hindrances::Unclear);
        }
        let imagined = self.imagined(object, side, grasp)?;
        let Some(way_without) = without.reached_way(&imagined, grasp)? else {
            return Ok(Hindrances::Objects(Vec::new()));
        };
        let poses = self.poses(object, side, grasp)?;
        let way = self.way(object, poses)?;
        if way != way_without {
            return Ok(Hindrances::Unclear);
        }
        let found = self.hand(side, &imagined).hindrances(&way, Some(object));
        Ok(found.map_or(Hindrances::Nothing, Hindrances::Objects))
    }

    fn imagined(
        &self,
        object: &'s str,
        side: Side,
        grasp: &GraspDefinition,
    ) -> Result<Imagined<'s>, Box<Raise>> {
        let kind = self.world.object(object).map_err(Raise::reporting)?;
        let opening = self.simulation.grasps.opening(kind.type_name(), grasp);
        Ok(Imagined {
            object,
            object_pose: None,
            base_pose: None,
            side,
            opening,
        })
    }

    /// The poses of the tool in the frame of the base, whatever is above the object.
    fn poses(
        &self,
        object: &str,
        side: Side,
        grasp: &GraspDefinition,
    ) -> Result<ToolPoses, Box<Raise>> {
        let at = self.world.object_pose(object).map_err(Raise::reporting)?;
        let in_base = self.world.robot_configuration().base.inverse() * at;
        let axes = &self.simulation.models.description.arm(side).tool_axes;
        grasp.tool_poses(&in_base, axes).map_err(Raise::reporting)
    }

    /// The way along the poses, such that the hand keeps below what is above the object.
    fn way(&mut self, object: &'s str, poses: ToolPoses) -> Result<Way, Box<Raise>> {
        let world = self.world;
        let base = world.robot_configuration().base;
        if self.above.as_ref().is_none_or(|(name, _)| *name != object) {
            let at = world.object_pose(object).map_err(Raise::reporting)?;
            let overhead = Overhead::without(world, object, &at, self.absent);
            let overhead = overhead.map_err(Raise::reporting)?;
            self.above = Some((object, overhead));
        }
        Ok(picking_way(&match &self.above {
            Some((_, overhead)) => overhead.anew().picking(&base, poses),
            None => poses,
        }))
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

//! Whether the robot could pick something up, or put it down, from a base pose.

use nalgebra::Point3;

use super::base_query::{BaseQuery, Item};
use super::stream::Scene;
use crate::motion::{CollisionMode, can_reach, held_objects};
use crate::robot::torso_search::TorsoSearch;
use crate::robot::{ARM_JOINTS, RobotDescription, Side};
use crate::spatial::{Pose, pose, trig};
use crate::world::grasp_library::GraspDefinition;
use crate::world::{Models, RobotConfiguration, World, WorldError};

/// How high (m) above a bare place the tool must be able to be, and from where (m) it comes.
const OVER: f64 = 0.1;
/// Name of an object that is only imagined.
const IMAGINED: &str = "the object that is to be there";

/// Why a target cannot be reached.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum NoReach {
    /// No wanted grasp of such an object is known.
    NoGrasp,
    /// Too far away, or at an impossible angle.
    TooFar,
    /// Something is in the way.
    InTheWay,
}

/// One way to hold the target.
struct Grip {
    side: Side,
    definition: GraspDefinition,
}

/// An arm, where it can get at all.
struct ArmReach<'a> {
    side: Side,
    search: TorsoSearch<'a>,
    /// The shoulder (m) in the frame of the base, and how far (m) from it the wrist can be.
    shoulder: Point3<f64>,
    length: f64,
}

/// Tests base poses for one target.
pub(super) struct Reach<'a> {
    models: &'a Models,
    arms: Vec<ArmReach<'a>>,
    grips: Vec<Grip>,
    object: Option<String>,
}

/// The world as it would be: with the target where it is to be, and open hands.
pub(super) fn imagined(query: &BaseQuery, scene: Scene<'_>) -> Result<World, WorldError> {
    let mut world = scene.world.clone();
    let target = &query.target;
    match &target.item {
        Item::Object(_) | Item::Point => {}
        Item::Moved(name) => {
            world.detach(name)?;
            world.move_object(name, &target.pose)?;
        }
        Item::Kind(kind) => {
            world.spawn(IMAGINED, kind, &target.pose, None, None)?;
        }
    }
    let mut robot = world.robot_configuration().clone();
    if let Some(kind) = kind_of(query, &world) {
        let opening = scene.grasps.grip(&kind).opening;
        for side in query.arms.iter().flatten() {
            if held_objects(scene.world, *side).is_empty() {
                let gripper = &world.models().description.arm(*side).gripper;
                let fingers = gripper.position_for_opening(opening);
                robot.joints.set(gripper.joint, fingers);
            }
        }
    }
    world.teleport_robot(&robot);
    Ok(world)
}

/// The type of the target.
fn kind_of(query: &BaseQuery, world: &World) -> Option<String> {
    let name = object_of(query)?;
    let object = world.object(name).ok()?;
    Some(object.type_name().to_owned())
}

/// The name of the target in the imagined world.
pub(super) fn object_of(query: &BaseQuery) -> Option<&str> {
    match &query.target.item {
        Item::Object(name) | Item::Moved(name) => Some(name),
        Item::Kind(_) => Some(IMAGINED),
        Item::Point => None,
    }
}

impl<'a> Reach<'a> {
    /// Prepares tests in an imagined world.
    pub(super) fn new(
        query: &BaseQuery,
        scene: Scene<'a>,
        robot: &'a RobotConfiguration,
        imagined: &World,
    ) -> Self {
        let models = &**scene.world.models();
        let sides = query.arms.iter().flatten().copied();
        let kind = kind_of(query, imagined);
        let mut grips = Vec::new();
        for side in sides.clone() {
            let Some(kind) = &kind else { continue };
            let lineage = models.objects.lineage(kind);
            let known = lineage.map(|kind| {
                let names = scene.grasps.grasps(kind).iter();
                names
                    .filter_map(|name| Some((name, scene.grasps.get(kind, side, name)?)))
                    .collect::<Vec<_>>()
            });
            // A type without grasps of its own has those of its supertype.
            let known = known.into_iter().find(|known| !known.is_empty());
            for (name, definition) in known.into_iter().flatten() {
                let is_wanted = query.grasps.as_ref().is_none_or(|g| g.contains(name));
                if is_wanted {
                    grips.push(Grip {
                        side,
                        definition: definition.clone(),
                    });
                }
            }
        }
        Self {
            models,
            arms: sides
                .map(|side| ArmReach::new(models, robot, side))
                .collect(),
            grips,
            object: object_of(query).map(str::to_owned),
        }
    }

    /// Whether the target at the pose may be near enough to the base pose, both in the map frame.
    /// Cheap.
    pub(super) fn is_near(&self, target: &Pose, base: &Pose) -> Result<(), NoReach> {
        let in_base = base.inverse() * target;
        let description = &self.models.description;
        if self.object.is_none() {
            return Ok(());
        }
        if self.grips.is_empty() {
            return Err(NoReach::NoGrasp);
        }
        let is_near = |grip: &Grip| {
            let axes = description.arm(grip.side).tool_axes;
            let poses = grip.definition.tool_poses(&in_base, &axes);
            let arm = self.arm(grip.side);
            poses.is_ok_and(|poses| arm.is_some_and(|arm| arm.is_near(description, &poses.grasp)))
        };
        match self.grips.iter().any(is_near) {
            true => Ok(()),
            false => Err(NoReach::TooFar),
        }
    }

    /// Whether the target at the pose (map frame) can be reached; the robot stands there already in
    /// the imagined world.
    pub(super) fn test(&self, world: &World, target: &Pose) -> Result<(), NoReach> {
        let base = world.robot_configuration().base;
        let in_base = base.inverse() * target;
        match &self.object {
            Some(name) => self.test_object(world, &in_base, name),
            None => self.test_point(world, &in_base),
        }
    }

    fn arm(&self, side: Side) -> Option<&ArmReach<'a>> {
        self.arms.iter().find(|arm| arm.side == side)
    }

    fn test_object(&self, world: &World, in_base: &Pose, name: &str) -> Result<(), NoReach> {
        if self.grips.is_empty() {
            return Err(NoReach::NoGrasp);
        }
        let mut worst = NoReach::TooFar;
        let description = &self.models.description;
        for grip in &self.grips {
            let (Some(arm), axes) = (self.arm(grip.side), description.arm(grip.side).tool_axes)
            else {
                continue;
            };
            let Ok(poses) = grip.definition.tool_poses(in_base, &axes) else {
                continue;
            };
            let way = [
                (poses.grasp, CollisionMode::AllowHand),
                (poses.pregrasp, CollisionMode::AvoidAll),
                (poses.second_pregrasp, CollisionMode::AvoidAll),
                (poses.lift, CollisionMode::AllowHand),
            ];
            if !way.iter().all(|(tool, _)| arm.is_near(description, tool))
                || !way.iter().all(|(tool, _)| arm.gets_to(description, tool))
            {
                continue;
            }
            let is_free = way
                .iter()
                .all(|(tool, mode)| can_reach(world, grip.side, tool, *mode, Some(name)));
            if is_free {
                return Ok(());
            }
            worst = NoReach::InTheWay;
        }
        Err(worst)
    }

    /// Whether the tool can be over a bare place, pointing down or forward.
    fn test_point(&self, world: &World, in_base: &Pose) -> Result<(), NoReach> {
        let mut worst = NoReach::TooFar;
        let p = in_base.translation;
        let ahead = trig::atan2(p.y, p.x);
        let down = std::f64::consts::FRAC_PI_2;
        let tools = [
            [0.0, down, ahead],
            [0.0, 0.0, ahead],
            [0.0, 0.0, ahead + 0.7],
            [0.0, 0.0, ahead - 0.7],
        ];
        let tools = tools.map(|rpy| pose::from_xyz_rpy([p.x, p.y, p.z + OVER], rpy));
        for arm in &self.arms {
            for tool in &tools {
                let description = &self.models.description;
                if !arm.is_near(description, tool) || !arm.gets_to(description, tool) {
                    continue;
                }
                if can_reach(world, arm.side, tool, CollisionMode::AvoidAll, None) {
                    return Ok(());
                }
                worst = NoReach::InTheWay;
            }
        }
        Err(worst)
    }
}

impl<'a> ArmReach<'a> {
    fn new(models: &'a Models, robot: &'a RobotConfiguration, side: Side) -> Self {
        let description = &models.description;
        let arm = description.arm(side);
        let tree = &models.robot;
        let joints: &[_; ARM_JOINTS] = arm.joints();
        let first = tree.joint(joints[0]).child;
        let shoulder = tree
            .relative_pose(description.base.frame, first, &robot.joints)
            .unwrap_or_default();
        let parts = joints[1..].iter();
        let length = parts.map(|joint| tree.joint(*joint).origin.translation.vector.norm());
        Self {
            side,
            search: description.torso_search(tree, &robot.joints, side),
            shoulder: Point3::from(shoulder.translation.vector),
            length: length.sum(),
        }
    }

    /// Whether the wrist is near enough for some height of the torso. Cheap.
    fn is_near(&self, description: &RobotDescription, tool: &Pose) -> bool {
        let wrist = description.arm(self.side).wrist_for_tool(tool);
        let way = wrist.translation.vector - self.shoulder.coords;
        way.xy().norm() <= self.length
    }

    /// Whether the arm gets the tool there at some height of the torso.
    fn gets_to(&self, description: &RobotDescription, tool: &Pose) -> bool {
        let wrist = description.arm(self.side).wrist_for_tool(tool);
        self.search.reach(&wrist).is_ok()
    }
}

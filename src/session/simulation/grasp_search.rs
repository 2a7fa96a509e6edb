//! Search for grasps of an object that the robot could reach, from its base pose or another.

use std::f64::consts::TAU;

use crate::interruption::interruption;
use crate::simulation::Simulation;
use crate::simulation::imagined::Imagined;
use crate::simulation::motions::{side, side_keyword};
use crate::simulation::names::{type_keyword, type_text};
use crate::simulation::properties::property;
use cram::pose::value::pose_stamped;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::motion::interruption::interruptible;
use robotics::motion::plan_drive;
use robotics::motion::{
    Candidates, CollisionMode, Effort, GraspChooser, GraspQuestion, HandReach, Overhead,
};
use robotics::robot::Side;
use robotics::world::grasp_library::{GraspDefinition, ToolPoses};
use robotics::world::{World, WorldError};
use spatial::{Pose, pose, trig};

/// Distances (m) of the base's axis from the object, the most comfortable ones first.
const DISTANCES: [f64; 5] = [0.65, 0.7, 0.6, 0.75, 0.55];
/// Number of directions from the object that are tried.
const DIRECTIONS: u32 = 24;
/// Maximum number of base poses for which a path is searched.
const MAX_WAYS: usize = 2;
/// Maximum number of grasps listed.
const MAX_GRASPS: usize = 4;

/// An object to be grasped, with the requested arm and grasp.
pub(crate) struct Wanted {
    /// Name of the object.
    pub name: String,
    /// Name of its type.
    pub kind: String,
    /// Pose of the object in the map frame.
    pub(crate) in_map: Pose,
    /// The requested arm, if any.
    pub arm: Option<Side>,
    /// The requested grasp, if any.
    pub grasp: Option<String>,
}

/// The poses of the tool in which an object is picked up, as in the plans for picking up and placing: the hand
/// approaches without contact, and may touch the object from then on.
pub(super) fn picking_way(poses: &ToolPoses) -> [(Pose, CollisionMode); 4] {
    [
        (poses.second_pregrasp, CollisionMode::AvoidAll),
        (poses.grasp, CollisionMode::AllowHand),
        (poses.lift, CollisionMode::AllowHand),
        (poses.pregrasp, CollisionMode::AvoidAll),
    ]
}

impl Simulation {
    fn wanted(&self, image: &mut Image, action: &Value) -> Option<Wanted> {
        let object = property(image, action, "OBJECT")?;
        let object = self.perceived(image, &object).ok()?;
        let arm = property(image, action, "ARM");
        let arm = match arm {
            Some(arm) if matches!(arm, Value::Cons(_)) => side(image, &arm.car_or_nil()).ok(),
            Some(arm) => side(image, &arm).ok(),
            None => None,
        };
        let grasp = property(image, action, "GRASP");
        Some(Wanted {
            in_map: self.base() * object.in_base,
            name: object.name,
            kind: object.kind,
            arm,
            grasp: grasp.and_then(|grasp| type_text(image, &grasp)),
        })
    }

    /// Whether the object can be grasped like that with the base at that pose.
    fn can_grasp_from(
        &self,
        image: &mut Image,
        wanted: &Wanted,
        (arm, grasp): (Side, &str),
        base: &Pose,
    ) -> bool {
        let name = type_keyword(image, grasp);
        let Ok(definition) = self.grasp(image, &wanted.kind, arm, &name) else {
            return false;
        };
        let axes = &self.models.description.arm(arm).tool_axes;
        let in_base = base.inverse() * wanted.in_map;
        let Ok(poses) = definition.tool_poses(&in_base, axes) else {
            return false;
        };
        let Ok(overhead) = Overhead::of(&self.world, &wanted.name, &wanted.in_map) else {
            return false;
        };
        let poses = overhead.picking(base, poses);
        // Poses out of the arm's reach are ruled out without checking the surroundings.
        if !self.is_reachable(arm, &[poses.pregrasp, poses.second_pregrasp, poses.grasp]) {
            return false;
        }
        let imagined = Imagined {
            object: &wanted.name,
            object_pose: None,
            base_pose: Some(*base),
            side: arm,
            opening: self.grasps.opening(&wanted.kind, &definition),
        };
        self.lets_grasp(&imagined, &definition).unwrap_or(false)
    }

    /// Whether the hand can approach a grasp of the object in the imagined world, and retreat,
    /// without touching anything else.
    pub(crate) fn lets_grasp(
        &self,
        imagined: &Imagined<'_>,
        grasp: &GraspDefinition,
    ) -> Result<bool, Box<Raise>> {
        self.lets_grasp_in(&self.world, imagined, grasp)
    }

    /// As [`Self::lets_grasp`], in a world in which the robot is as it is here.
    pub(super) fn lets_grasp_in(
        &self,
        now: &World,
        imagined: &Imagined<'_>,
        grasp: &GraspDefinition,
    ) -> Result<bool, Box<Raise>> {
        let raise = |error: WorldError| Raise::reporting(error);
        let side = imagined.side;
        let axes = &self.models.description.arm(side).tool_axes;
        if imagined.object_pose.is_none() && imagined.base_pose.is_none() {
            // Most grasps are out of the arm's reach, which is known without a copy of the world.
            let base = now.robot_configuration().base;
            let object = now.object_pose(imagined.object).map_err(raise)?;
            let poses = grasp.tool_poses(&(base.inverse() * object), axes);
            let poses = poses.map_err(Raise::reporting)?;
            if !self.is_reachable(side, &[poses.second_pregrasp, poses.grasp]) {
                return Ok(false);
            }
        }
        // A copy of the world takes longer than the answer.
        let copy = match imagined.is_only_robot(now).map_err(raise)? {
            true => None,
            false => match imagined.world(now).map_err(raise)? {
                Some(world) => Some(world),
                None => return Ok(false),
            },
        };
        let world = copy.as_ref().unwrap_or(now);
        let robot = imagined.robot(now);
        let base = robot.base;
        let at = world.object_pose(imagined.object).map_err(raise)?;
        let poses = grasp.tool_poses(&(base.inverse() * at), axes);
        let poses = poses.map_err(Raise::reporting)?;
        // As the product of both, which is what the plans have.
        let at = base * (base.inverse() * at);
        let overhead = Overhead::of(world, imagined.object, &at).map_err(raise)?;
        let way = picking_way(&overhead.picking(&base, poses));
        let mut hand = HandReach::new(world, robot, side, &[]);
        Ok(hand.reaches(&way, Some(imagined.object)))
    }

    /// Arms and grasps by which the object of a picking-up action can be reached from the
    /// current base pose, without the action's own.
    pub(crate) fn reachable_grasps(
        &self,
        image: &mut Image,
        action: &Value,
    ) -> Vec<(Value, Value)> {
        let Some(wanted) = self.wanted(image, action) else {
            return Vec::new();
        };
        let arm = self.arm_or_preferred(wanted.arm);
        let first = || self.defined_grasps(&wanted.kind, arm).first().cloned();
        let own = wanted.grasp.clone().or_else(first);
        let grasps = self.grasps_from_here(image, &wanted, own.as_deref());
        grasps
            .into_iter()
            .map(|(arm, grasp)| (side_keyword(image, arm), type_keyword(image, &grasp)))
            .collect()
    }

    /// An arm, or the one that is preferred where none is given.
    fn arm_or_preferred(&self, arm: Option<Side>) -> Side {
        let preferred = self.models.description.preferred_sides();
        arm.or(preferred.first().copied()).unwrap_or(Side::Right)
    }

    /// Arms and grasps by which an object can be reached from the current base pose, those of
    /// the wanted arm first; `tried` is one of that arm's grasps, which is left out.
    pub(crate) fn grasps_from_here(
        &self,
        image: &mut Image,
        wanted: &Wanted,
        tried: Option<&str>,
    ) -> Vec<(Side, String)> {
        let base = self.base();
        let own_arm = self.arm_or_preferred(wanted.arm);
        let others = self.models.description.sides();
        let others = others.filter(|arm| *arm != own_arm);
        let mut found = Vec::new();
        for arm in std::iter::once(own_arm).chain(others) {
            if !self.held_by(arm).is_empty() {
                continue;
            }
            for grasp in self.defined_grasps(&wanted.kind, arm) {
                if (arm == own_arm && tried == Some(&*grasp)) || found.len() == MAX_GRASPS {
                    continue;
                }
                if self.can_grasp_from(image, wanted, (arm, &grasp), &base) {
                    found.push((arm, grasp));
                }
            }
        }
        found
    }

    /// A base pose, arm and grasp for picking up the object of an action: the pose is near,
    /// free and reachable by a path. The action's own arm and grasp are preferred.
    pub(crate) fn place_to_grasp_from(
        &self,
        image: &mut Image,
        action: &Value,
    ) -> Option<(Value, Value, Value)> {
        let wanted = self.wanted(image, action)?;
        let (base, arm, grasp) = self.place_to_grasp(image, &wanted)?;
        let place = pose_stamped("map", &base);
        Some((place, side_keyword(image, arm), type_keyword(image, &grasp)))
    }

    /// A base pose in the map frame, arm and grasp for an object: the pose is near, free and
    /// reachable by a path. The requested arm is used, and the requested grasp preferred.
    pub(crate) fn place_to_grasp(
        &self,
        image: &mut Image,
        wanted: &Wanted,
    ) -> Option<(Pose, Side, String)> {
        let arms: Vec<Side> = match wanted.arm {
            Some(arm) => vec![arm],
            None => self.models.description.preferred_sides(),
        };
        let mut all: Vec<String> = Vec::new();
        for arm in &arms {
            let names = self.defined_grasps(&wanted.kind, *arm).into_iter();
            all.extend(names.filter(|name| !all.contains(name)).collect::<Vec<_>>());
        }
        let own = wanted.grasp.iter().map(|grasp| vec![grasp.clone()]);
        let places = self.places_around(&wanted.in_map);
        let mut ways = 0;
        // Grasps by name, since an action is to be repeated with one.
        for grasps in own.chain([all]).filter(|names| !names.is_empty()) {
            let question = GraspQuestion {
                object: wanted.name.clone(),
                kind: wanted.kind.clone(),
                in_map: wanted.in_map,
                arms: arms.clone(),
                grasps,
                torso_moves: true,
                failed: Vec::new(),
            };
            let candidates = Candidates::new(&self.models, &self.grasps, &question);
            let chooser = GraspChooser::new(&self.world, &question, &candidates);
            for base in &places {
                let Ok(choice) = chooser.with_base_at(base, Effort::QUICK) else {
                    continue;
                };
                let t = base.translation.vector;
                let goal = [t.x, t.y, pose::yaw(base)];
                ways += 1;
                let ends_there = |path: Vec<[f64; 3]>| {
                    path.last().is_some_and(|end| {
                        (end[0] - goal[0]).abs() < 1e-6 && (end[1] - goal[1]).abs() < 1e-6
                    })
                };
                // Ctrl-C ends a long search; nothing is offered then.
                let way = interruptible(interruption(image), || plan_drive(&self.world, goal))?;
                if way.is_ok_and(ends_there) {
                    return Some((*base, choice.side, choice.grasp));
                }
                if ways == MAX_WAYS {
                    return None;
                }
            }
        }
        None
    }

    /// Collision-free base poses around a thing and facing it, those nearest to the current
    /// base pose first.
    pub(crate) fn places_around(&self, thing: &Pose) -> Vec<Pose> {
        let here = self.base();
        let centre = thing.translation.vector;
        let mut checker = self.world.collision_checker();
        let robot = self.world.robot_configuration();
        let mut places: Vec<(f64, Pose)> = Vec::new();
        for distance in DISTANCES {
            for k in 0..DIRECTIONS {
                let angle = TAU * f64::from(k) / f64::from(DIRECTIONS);
                let (s, c) = trig::sin_cos(angle);
                let (x, y) = (centre.x - distance * c, centre.y - distance * s);
                let mut base = pose::from_xy_yaw(x, y, angle);
                base.translation.z = here.translation.z;
                let way = (base.translation.vector - here.translation.vector).norm();
                places.push((way, base));
            }
        }
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        places
            .into_iter()
            .map(|(_, base)| base)
            .filter(|base| {
                let t = base.translation;
                if !self.models.map.contains([t.x, t.y]) {
                    return false;
                }
                let mut there = robot.clone();
                there.base = *base;
                checker.is_free(&there, &robotics::world::AllowedPairs::none(), 0.01)
            })
            .collect()
    }
}

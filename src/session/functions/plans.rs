//! What the plans for picking up and placing query from the world and the grasp library.

use crate::simulation::properties::property;
use cram::designator::value::current;
use nalgebra::Translation3;

use crate::host::SimulationHost;
use crate::simulation::Simulation;
use crate::simulation::held::Held;
use crate::simulation::imagined::Imagined;
use crate::simulation::motions::side;
use crate::simulation::names::{suggestion, type_keyword, type_text, type_text_of};
use cram::Reply;
use cram::pose::value::pose_stamped;
use cram::pose::value::{as_placement, frame_of};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::motion::{
    Effort, HeldGrip, LetGo, Overhead, PutReach, about_z, releasing_opening, take_hold,
};
use robotics::robot::Side;
use robotics::world::grasp_library::{GraspDefinition, Grip};
use spatial::{Pose, pose};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-MOBILE-PICK-PLACE-PLANS`.
pub(super) static TABLE: &[Builtin] = builtins![
    arm_posture,
    objects_in_hand,
    grasps_of_object,
    grasps_from_above,
    grasping_poses,
    gripper_opening,
    hand_releasing_opening,
    gripping_effort,
    attach_object,
    detach_object,
    taken_from,
    held_pose,
    perceived_pose,
    putting_headings,
    free_heading,
    putting_poses_at,
    poses_reachable_p
];

/// An object as described by perception.
pub struct Perceived {
    /// Name in the world.
    pub name: String,
    /// Name of the type.
    pub kind: String,
    /// Pose in the current frame of the robot's base.
    pub in_base: Pose,
}

impl Simulation {
    /// Reads the designator of a perceived object.
    pub fn perceived(&self, image: &mut Image, object: &Value) -> Result<Perceived> {
        let current = current(object);
        let name = property(image, &current, "NAME");
        let kind = property(image, &current, "TYPE");
        let pose = property(image, &current, "POSE");
        let (Some(name), Some(kind), Some(pose)) = (name, kind, pose) else {
            return Err(Raise::simple(format!(
                "{} has not been perceived: perform an action of type detecting first and use its result.",
                print::to_string(image, &current, false)
            )));
        };
        let entry = |key: &str| {
            pose.iter_list()
                .find(|pair| {
                    pair.car_or_nil()
                        .as_symbol()
                        .is_some_and(|sym| image.name(sym) == key)
                })
                .map(|pair| pair.cdr_or_nil().car_or_nil())
                .and_then(|pose| as_placement(&pose))
                .map(|placement| placement.to_pose())
        };
        // The robot may have moved since, so the pose in the map frame counts.
        let in_base = match (entry("POSE-IN-MAP"), entry("POSE")) {
            (Some(in_map), _) => self.believed_base().inverse() * in_map,
            (None, Some(in_base)) => in_base,
            (None, None) => {
                return Err(Raise::simple(format!(
                    "{} has no pose.",
                    print::to_string(image, &current, false)
                )));
            }
        };
        Ok(Perceived {
            name: self.object_named(image, &name)?,
            kind: type_text(image, &kind).unwrap_or_default(),
            in_base,
        })
    }

    /// The definition of a grasp, or an error that lists the existing ones.
    pub fn grasp(
        &self,
        image: &Image,
        kind: &str,
        arm: Side,
        grasp: &Value,
    ) -> Result<GraspDefinition> {
        let wanted = type_text(image, grasp).unwrap_or_default();
        if let Some(definition) = self.definition(kind, arm, &wanted) {
            return Ok(definition);
        }
        let defined: Vec<String> = self.defined_grasps(kind, arm);
        let near = suggestion(&wanted, defined.iter().map(String::as_str), |n| {
            format!(":{}", n.to_uppercase())
        });
        let names: Vec<String> = defined
            .iter()
            .map(|n| format!(":{}", n.to_uppercase()))
            .collect();
        let all = if names.is_empty() {
            "none is".to_owned()
        } else {
            format!("{} are", names.join(", "))
        };
        Err(Raise::simple(format!(
            "No grasp {} of a :{} with the {arm} arm is defined: {all}{near}{}",
            print::to_string(image, grasp, true),
            kind.to_uppercase(),
            if near.is_empty() { "." } else { "" }
        )))
    }

    /// The definition of a grasp of a type, or of the nearest of its supertypes that has it.
    pub fn definition(&self, kind: &str, arm: Side, grasp: &str) -> Option<GraspDefinition> {
        let kinds = self.models.objects.lineage(kind);
        let mut kinds = kinds.take_while(|kind| self.grasps.refusal(kind).is_none());
        kinds.find_map(|k| self.grasps.get(k, arm, grasp)).cloned()
    }

    /// Names of the grasps defined for a type and an arm, in the order in which they are
    /// tried.
    pub(crate) fn defined_grasps(&self, kind: &str, arm: Side) -> Vec<String> {
        let kinds = self.models.objects.lineage(kind);
        for kind in kinds.take_while(|kind| self.grasps.refusal(kind).is_none()) {
            let names: Vec<String> = self
                .grasps
                .grasps(kind)
                .iter()
                .filter(|name| self.grasps.get(kind, arm, name).is_some())
                .cloned()
                .collect();
            if !names.is_empty() {
                return names;
            }
        }
        Vec::new()
    }

    /// By how much (rad) the hand that holds a round object is turned about its axis from the
    /// grasp as it is defined.
    fn turn_of(&self, object: &Perceived, side: Side, grasp: &GraspDefinition) -> f64 {
        let is_round = self.models.objects.get(&object.kind);
        if !is_round.is_some_and(|kind| kind.is_round) {
            return 0.0;
        }
        let (Ok(orientation), Ok(at)) = (grasp.orientation(), self.world.object_pose(&object.name))
        else {
            return 0.0;
        };
        let arm = self.models.description.arm(side);
        let tool = at.inverse() * arm.tool_for_wrist(&self.world.link_pose(arm.wrist));
        let turn = tool.rotation * (orientation * arm.tool_axes).inverse();
        pose::yaw(&Pose::from_parts(Translation3::identity(), turn))
    }

    pub fn grip(&self, kind: &str) -> Grip {
        self.grasps.grip(kind)
    }

    /// Whether the hand can be brought to all poses, given in the frame of the base.
    pub(crate) fn is_reachable(&self, arm: Side, poses: &[Pose]) -> bool {
        let description = &self.models.description;
        let joints = &self.world.robot_configuration().joints;
        let search = description.torso_search(&self.models.robot, joints, arm);
        poses.iter().all(|tool| {
            let wrist = description.arm(arm).wrist_for_tool(tool);
            search.any_reach(&wrist).is_some()
        })
    }
}

impl Simulation {
    /// The heading (rad, relative to the one that is wanted) at which a held object can be put down
    /// at a pose in the frame of the base: the hand opens and retracts without touching anything
    /// else.
    fn free_heading(&self, grip: &HeldGrip, target: &Pose) -> Option<f64> {
        let imagined = Imagined {
            object: &grip.object,
            object_pose: Some(self.base() * target),
            base_pose: None,
            side: grip.side,
            opening: grip.opening,
        };
        let mut world = imagined.world(&self.world).ok()??;
        world.teleport_robot(self.world.robot_configuration());
        let put = PutReach::new(&world, grip).ok()?;
        put.with_base_at(&self.base(), Effort::THOROUGH).ok()
    }
}

/// The joint angles of an arm's posture: :CARRY, :TUCKED, ….
#[builtin]
fn arm_posture(
    simulation: &mut Simulation,
    image: &mut Image,
    arm: &Value,
    posture: &Value,
) -> Result<Value> {
    let side = side(image, arm)?;
    let name = type_text(image, posture).unwrap_or_default();
    let arm = simulation.models.description.arm(side);
    // A robot may be described with one posture that serves for all.
    let names: &[&str] = match name.as_str() {
        "carry" => &["park"],
        "tucked" => &["tucked", "park"],
        other => &[other],
    };
    match names.iter().find_map(|name| arm.posture(name)) {
        Some(angles) => Ok(Value::list(angles.iter().map(|a| Value::Double(*a)))),
        None => Err(Raise::simple(format!(
            "The {side} arm has no posture {}: it has {}.",
            print::to_string(image, posture, true),
            arm.posture_names().collect::<Vec<_>>().join(", ")
        ))),
    }
}

/// Names of the objects that a hand holds.
#[builtin]
fn objects_in_hand(
    simulation: &mut Simulation,
    image: &mut Image,
    arm: &Value,
) -> Result<Vec<Value>> {
    let side = side(image, arm)?;
    let names = simulation.held_by(side);
    Ok(names.iter().map(|n| simulation.symbol_of(n)).collect())
}

/// The grasps that are defined for an object and an arm.
#[builtin]
fn grasps_of_object(
    simulation: &mut Simulation,
    image: &mut Image,
    object: &Value,
    arm: &Value,
) -> Result<Vec<Value>> {
    let object = simulation.perceived(image, object)?;
    let side = side(image, arm)?;
    let names = simulation.defined_grasps(&object.kind, side);
    Ok(names.iter().map(|n| type_keyword(image, n)).collect())
}

/// The grasps of a type by which a hand comes from above, straight or at up to 45 degrees, also those that
/// LIST-DEFINED-GRASPS does not list: they are tried only if they are asked for.
///
/// `(pp-plans::grasps-from-above :cup)` => `(:TOP :TOP-AROUND :TOP-AROUND-LEFT :TOP-AROUND-LOW :TOP-AROUND-LEFT-LOW)`
#[builtin(_, "type")]
fn grasps_from_above(
    simulation: &mut Simulation,
    image: &mut Image,
    kind: &Value,
) -> Result<Vec<Value>> {
    let kind = type_text_of(image, kind)?;
    let names = simulation.grasps.grasps_from_above(&kind).into_iter();
    Ok(names.map(|name| type_keyword(image, name)).collect())
}

/// Poses of the hand for a grasp: pregrasp, second pregrasp, grasp, lift, second lift.
#[builtin]
fn grasping_poses(
    simulation: &mut Simulation,
    image: &mut Image,
    object: &Value,
    arm: &Value,
    grasp: &Value,
) -> Result<Value> {
    let object = simulation.perceived(image, object)?;
    let side = side(image, arm)?;
    let definition = simulation.grasp(image, &object.kind, side, grasp)?;
    let axes = &simulation.models.description.arm(side).tool_axes;
    let poses = definition
        .tool_poses(&object.in_base, axes)
        .map_err(Raise::reporting)?;
    let base = simulation.base();
    let overhead = Overhead::of(&simulation.world, &object.name, &(base * object.in_base))
        .map_err(Raise::reporting)?;
    let poses = overhead.picking(&base, poses);
    Ok(Value::list(
        [
            poses.pregrasp,
            poses.second_pregrasp,
            poses.grasp,
            poses.lift,
            poses.second_lift,
        ]
        .map(|pose| simulation.in_base(&pose)),
    ))
}

/// How wide a hand opens (m) to grasp an object.
#[builtin]
fn gripper_opening(
    simulation: &mut Simulation,
    image: &mut Image,
    object: &Value,
    arm: &Value,
    grasp: &Value,
) -> Result<f64> {
    let object = simulation.perceived(image, object)?;
    let side = side(image, arm)?;
    let grasp = simulation.grasp(image, &object.kind, side, grasp)?;
    let gripper = &simulation.models.description.arm(side).gripper;
    let most = gripper.opening_at(gripper.limits.upper);
    Ok(simulation.grasps.opening(&object.kind, &grasp).min(most))
}

/// How far (m) a hand opens to let go of what it holds: no farther than it needs to withdraw.
///
/// `(progn (pp-tut:init-projection) (< (pp-plans::releasing-opening :left) 0.04))` => `T`
#[builtin("RELEASING-OPENING")]
fn hand_releasing_opening(
    simulation: &mut Simulation,
    image: &mut Image,
    arm: &Value,
) -> Result<f64> {
    let side = side(image, arm)?;
    Ok(releasing_opening(&simulation.world, side))
}

/// How hard an object is gripped (N).
#[builtin]
fn gripping_effort(simulation: &mut Simulation, image: &mut Image, object: &Value) -> Result<f64> {
    let object = simulation.perceived(image, object)?;
    let arms = simulation.models.description.arms.iter();
    let most = arms.map(|arm| arm.gripper.effort).fold(0.0, f64::max);
    Ok(simulation.grip(&object.kind).effort.min(most))
}

/// Notes that a hand holds an object.
#[builtin]
fn attach_object(
    simulation: &mut Simulation,
    image: &mut Image,
    object: &Value,
    arm: &Value,
    grasp: &Value,
) -> Result<()> {
    let perceived = simulation.perceived(image, object)?;
    let side = side(image, arm)?;
    take_hold(&mut simulation.world, side, &perceived.name)
        .map_err(|failure| simulation.failure(image, &failure, object))?;
    let grasp = type_text(image, grasp);
    let definition = grasp
        .as_ref()
        .and_then(|grasp| simulation.definition(&perceived.kind, side, grasp));
    let held = Held {
        side,
        turn: definition.map_or(0.0, |d| simulation.turn_of(&perceived, side, &d)),
        grasp,
        taken_from: simulation.believed_base() * perceived.in_base,
        tool_in_object: simulation.believed_grip(&perceived.in_base, side),
    };
    simulation.held.insert(perceived.name, held);
    Ok(())
}

/// Lets go of an object and waits until it rests.
#[builtin]
fn detach_object(
    host: &mut SimulationHost,
    image: &mut Image,
    name: &Value,
    arm: &Value,
) -> Result<Reply> {
    let held = host.simulation.object_named(image, name)?;
    let side = side(image, arm)?;
    let motion = LetGo::new(side, Some(held));
    let told = host.told(image, None);
    Ok(Reply::Later(host.start(
        Box::new(motion),
        name.clone(),
        "letting-go".to_owned(),
        told,
    )))
}

/// Where an object was when a hand took it, in the frame of the robot's base; NIL if no hand holds it.
#[builtin]
fn taken_from(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
) -> Result<Option<Value>> {
    let name = simulation.object_named(image, name)?;
    let held = simulation.held.get(&name);
    Ok(held
        .map(|held| simulation.in_base(&(simulation.believed_base().inverse() * held.taken_from))))
}

/// Where the robot takes an object to be, in the map, that a hand holds.
#[builtin]
fn held_pose(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    arm: &Value,
) -> Result<Value> {
    let name = simulation.object_named(image, name)?;
    let side = side(image, arm)?;
    let pose = simulation
        .held_pose(&name, side)
        .map_err(Raise::reporting)?;
    Ok(pose_stamped("map", &pose))
}

/// Where an object was detected, in the frame of the robot's base.
#[builtin]
fn perceived_pose(simulation: &mut Simulation, image: &mut Image, object: &Value) -> Result<Value> {
    let object = simulation.perceived(image, object)?;
    Ok(simulation.in_base(&object.in_base))
}

/// How a hand holds an object.
fn grip(simulation: &Simulation, image: &Image, name: &Value, arm: &Value) -> Result<HeldGrip> {
    let name = simulation.object_named(image, name)?;
    let side = side(image, arm)?;
    let grip = simulation.grip_on(&name, side);
    grip.map_err(Raise::reporting)
}

/// A pose in the frame of the base.
fn pose_in_base(simulation: &Simulation, image: &Image, pose: &Value) -> Result<Pose> {
    match frame_of(pose) {
        Some(frame) if simulation.is_base(&frame) => simulation.pose_as_given(image, pose),
        _ => Ok(simulation.believed_base().inverse() * simulation.pose_in_map(image, pose)?),
    }
}

/// The headings (rad, relative to the one of its target) at which a held object may be put down, the nearest
/// first: several if it is round.
#[builtin]
fn putting_headings(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    arm: &Value,
) -> Result<Value> {
    let headings = grip(simulation, image, name, arm)?.headings();
    Ok(Value::list(headings.into_iter().map(Value::Double)))
}

/// A heading (rad) at which a held object can be put down at a pose, and the hand can open and retract
/// without touching anything else; NIL if there is none.
#[builtin]
fn free_heading(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    arm: &Value,
    target: &Value,
) -> Result<Option<f64>> {
    let target = pose_in_base(simulation, image, target)?;
    let grip = grip(simulation, image, name, arm)?;
    Ok(simulation.free_heading(&grip, &target))
}

/// Poses of the hand for placing at a heading (rad): lift, grasp, second pregrasp, pregrasp.
#[builtin]
fn putting_poses_at(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    arm: &Value,
    target: &Value,
    heading: f64,
) -> Result<Value> {
    let target = pose_in_base(simulation, image, target)?;
    let grip = grip(simulation, image, name, arm)?;
    let base = simulation.base();
    let overhead = Overhead::of(&simulation.world, &grip.object, &(base * target))
        .map_err(Raise::reporting)?;
    let poses = overhead.putting(&base, grip.poses(&(target * about_z(heading))));
    Ok(Value::list(poses.map(|pose| simulation.in_base(&pose))))
}

/// Can a hand be brought to all poses, which are in the frame of the robot's base, by some height of the
/// torso?
#[builtin]
fn poses_reachable_p(
    simulation: &mut Simulation,
    image: &mut Image,
    arm: &Value,
    poses: &Value,
) -> Result<bool> {
    let side = side(image, arm)?;
    let poses = poses.iter_list();
    let poses = poses.map(|pose| pose_in_base(simulation, image, &pose));
    let poses: Vec<Pose> = poses.collect::<Result<_>>()?;
    Ok(simulation.is_reachable(side, &poses))
}

//! What the plans for picking up and placing query from the world and the grasp library.

use crate::simulation::properties::property;
use cram::designator::value::current;
use nalgebra::Translation3;

use crate::host::SimulationHost;
use crate::host::call::{done, host};
use crate::simulation::Simulation;
use crate::simulation::held::Held;
use crate::simulation::imagined::Imagined;
use crate::simulation::motions::side;
use crate::simulation::names::{suggestion, type_keyword, type_text, type_text_of};
use cram::Reply;
use cram::pose::value::pose_stamped;
use cram::pose::value::{as_placement, frame_of};
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::motion::{
    Effort, HeldGrip, LetGo, Overhead, PutReach, about_z, releasing_opening, take_hold,
};
use robotics::robot::Side;
use robotics::world::grasp_library::{GraspDefinition, Grip};
use spatial::{Pose, pose};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-MOBILE-PICK-PLACE-PLANS`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "ARM-POSTURE",
        "arm posture",
        "The joint angles of an arm's posture: :CARRY, :TUCKED, ….",
        &[],
        host!(arm_posture),
    ),
    control(
        "OBJECTS-IN-HAND",
        "arm",
        "Names of the objects that a hand holds.",
        &[],
        host!(objects_in_hand),
    ),
    control(
        "GRASPS-OF-OBJECT",
        "object arm",
        "The grasps that are defined for an object and an arm.",
        &[],
        host!(grasps_of_object),
    ),
    control(
        "GRASPS-FROM-ABOVE",
        "type",
        "The grasps of a type by which a hand comes from above, straight or at up to 45 degrees, also those that LIST-DEFINED-GRASPS does not list: they are tried only if they are asked for.",
        &[
            "(pp-plans::grasps-from-above :cup) => (:TOP :TOP-AROUND :TOP-AROUND-LEFT :TOP-AROUND-LOW :TOP-AROUND-LEFT-LOW)",
        ],
        host!(grasps_from_above),
    ),
    control(
        "GRASPING-POSES",
        "object arm grasp",
        "Poses of the hand for a grasp: pregrasp, second pregrasp, grasp, lift, second lift.",
        &[],
        host!(grasping_poses),
    ),
    control(
        "GRIPPER-OPENING",
        "object arm grasp",
        "How wide a hand opens (m) to grasp an object.",
        &[],
        host!(gripper_opening),
    ),
    control(
        "RELEASING-OPENING",
        "arm",
        "How far (m) a hand opens to let go of what it holds: no farther than it needs to withdraw.",
        &["(progn (pp-tut:init-projection) (< (pp-plans::releasing-opening :left) 0.04)) => T"],
        host!(hand_releasing_opening),
    ),
    control(
        "GRIPPING-EFFORT",
        "object",
        "How hard an object is gripped (N).",
        &[],
        host!(gripping_effort),
    ),
    control(
        "ATTACH-OBJECT",
        "object arm grasp",
        "Notes that a hand holds an object.",
        &[],
        host!(attach_object),
    ),
    control(
        "DETACH-OBJECT",
        "name arm",
        "Lets go of an object and waits until it rests.",
        &[],
        host!(detach_object),
    ),
    control(
        "TAKEN-FROM",
        "name",
        "Where an object was when a hand took it, in the frame of the robot's base; NIL if no hand holds it.",
        &[],
        host!(taken_from),
    ),
    control(
        "HELD-POSE",
        "name arm",
        "Where the robot takes an object to be, in the map, that a hand holds.",
        &[],
        host!(held_pose),
    ),
    control(
        "PERCEIVED-POSE",
        "object",
        "Where an object was detected, in the frame of the robot's base.",
        &[],
        host!(perceived_pose),
    ),
    control(
        "PUTTING-HEADINGS",
        "name arm",
        "The headings (rad, relative to the one of its target) at which a held object may be put down, the nearest first: several if it is round.",
        &[],
        host!(putting_headings),
    ),
    control(
        "FREE-HEADING",
        "name arm target",
        "A heading (rad) at which a held object can be put down at a pose, and the hand can open and retract without touching anything else; NIL if there is none.",
        &[],
        host!(free_heading),
    ),
    control(
        "PUTTING-POSES-AT",
        "name arm target heading",
        "Poses of the hand for placing at a heading (rad): lift, grasp, second pregrasp, pregrasp.",
        &[],
        host!(putting_poses_at),
    ),
    control(
        "POSES-REACHABLE-P",
        "arm poses",
        "Can a hand be brought to all poses, which are in the frame of the robot's base, by some height of the torso?",
        &[],
        host!(poses_reachable),
    ),
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

fn arm_posture(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let side = side(image, &args[0])?;
    let name = type_text(image, &args[1]).unwrap_or_default();
    let arm = simulation.models.description.arm(side);
    // A robot may be described with one posture that serves for all.
    let names: &[&str] = match name.as_str() {
        "carry" => &["park"],
        "tucked" => &["tucked", "park"],
        other => &[other],
    };
    match names.iter().find_map(|name| arm.posture(name)) {
        Some(angles) => done(Value::list(angles.iter().map(|a| Value::Double(*a)))),
        None => Err(Raise::simple(format!(
            "The {side} arm has no posture {}: it has {}.",
            print::to_string(image, &args[1], true),
            arm.posture_names().collect::<Vec<_>>().join(", ")
        ))),
    }
}

fn objects_in_hand(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let side = side(image, &args[0])?;
    let names = simulation.held_by(side);
    let symbols: Vec<Value> = names.iter().map(|n| simulation.symbol_of(n)).collect();
    done(Value::list(symbols))
}

fn grasps_of_object(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let object = simulation.perceived(image, &args[0])?;
    let side = side(image, &args[1])?;
    let names = simulation.defined_grasps(&object.kind, side);
    let keywords: Vec<Value> = names.iter().map(|n| type_keyword(image, n)).collect();
    done(Value::list(keywords))
}

fn grasps_from_above(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let kind = type_text_of(image, &args[0])?;
    let names = simulation.grasps.grasps_from_above(&kind).into_iter();
    let keywords: Vec<Value> = names.map(|name| type_keyword(image, name)).collect();
    done(Value::list(keywords))
}

fn grasping_poses(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let object = simulation.perceived(image, &args[0])?;
    let side = side(image, &args[1])?;
    let definition = simulation.grasp(image, &object.kind, side, &args[2])?;
    let axes = &simulation.models.description.arm(side).tool_axes;
    let poses = definition
        .tool_poses(&object.in_base, axes)
        .map_err(Raise::reporting)?;
    let base = simulation.base();
    let overhead = Overhead::of(&simulation.world, &object.name, &(base * object.in_base))
        .map_err(Raise::reporting)?;
    let poses = overhead.picking(&base, poses);
    done(Value::list(
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

fn gripper_opening(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let object = simulation.perceived(image, &args[0])?;
    let side = side(image, &args[1])?;
    let grasp = simulation.grasp(image, &object.kind, side, &args[2])?;
    let gripper = &simulation.models.description.arm(side).gripper;
    let most = gripper.opening_at(gripper.limits.upper);
    done(simulation.grasps.opening(&object.kind, &grasp).min(most))
}

fn hand_releasing_opening(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let side = side(image, &args[0])?;
    done(releasing_opening(&simulation.world, side))
}

fn gripping_effort(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let object = simulation.perceived(image, &args[0])?;
    let arms = simulation.models.description.arms.iter();
    let most = arms.map(|arm| arm.gripper.effort).fold(0.0, f64::max);
    done(simulation.grip(&object.kind).effort.min(most))
}

fn attach_object(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let object = simulation.perceived(image, &args[0])?;
    let side = side(image, &args[1])?;
    take_hold(&mut simulation.world, side, &object.name)
        .map_err(|failure| simulation.failure(image, &failure, &args[0]))?;
    let grasp = type_text(image, &args[2]);
    let definition = grasp
        .as_ref()
        .and_then(|grasp| simulation.definition(&object.kind, side, grasp));
    let held = Held {
        side,
        turn: definition.map_or(0.0, |d| simulation.turn_of(&object, side, &d)),
        grasp,
        taken_from: simulation.believed_base() * object.in_base,
        tool_in_object: simulation.believed_grip(&object.in_base, side),
    };
    simulation.held.insert(object.name, held);
    done(Value::NIL)
}

fn detach_object(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = host.simulation.object_named(image, &args[0])?;
    let side = side(image, &args[1])?;
    let motion = LetGo::new(side, Some(name));
    let name = "letting-go".to_owned();
    let told = host.told(image, None);
    Ok(Reply::Later(host.start(
        Box::new(motion),
        args[0].clone(),
        name,
        told,
    )))
}

fn taken_from(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = simulation.object_named(image, &args[0])?;
    let held = simulation.held.get(&name);
    done(held.map_or(Value::NIL, |held| {
        simulation.in_base(&(simulation.believed_base().inverse() * held.taken_from))
    }))
}

fn held_pose(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = simulation.object_named(image, &args[0])?;
    let side = side(image, &args[1])?;
    let pose = simulation
        .held_pose(&name, side)
        .map_err(Raise::reporting)?;
    done(pose_stamped("map", &pose))
}

fn perceived_pose(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let object = simulation.perceived(image, &args[0])?;
    done(simulation.in_base(&object.in_base))
}

/// How the hand of the second argument holds the object of the first.
fn grip(simulation: &Simulation, image: &Image, args: &[Value]) -> Result<HeldGrip> {
    let name = simulation.object_named(image, &args[0])?;
    let side = side(image, &args[1])?;
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

fn putting_headings(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let headings = grip(simulation, image, args)?.headings();
    done(Value::list(headings.into_iter().map(Value::Double)))
}

fn free_heading(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let target = pose_in_base(simulation, image, &args[2])?;
    let grip = grip(simulation, image, args)?;
    let heading = simulation.free_heading(&grip, &target);
    done(heading.map_or(Value::NIL, Value::Double))
}

fn putting_poses_at(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let target = pose_in_base(simulation, image, &args[2])?;
    let heading =
        number::to_f64(&args[3]).ok_or_else(|| Raise::type_error(&args[3], known::REAL))?;
    let grip = grip(simulation, image, args)?;
    let base = simulation.base();
    let overhead = Overhead::of(&simulation.world, &grip.object, &(base * target))
        .map_err(Raise::reporting)?;
    let poses = overhead.putting(&base, grip.poses(&(target * about_z(heading))));
    done(Value::list(poses.map(|pose| simulation.in_base(&pose))))
}

fn poses_reachable(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let side = side(image, &args[0])?;
    let poses = args[1].iter_list();
    let poses = poses.map(|pose| pose_in_base(simulation, image, &pose));
    let poses: Vec<Pose> = poses.collect::<Result<_>>()?;
    done(simulation.is_reachable(side, &poses))
}

//! Builtins for drawers, doors and knobs: what there is, how it is open or turned, and how a hand can move it.

use crate::interruption::interruption;
use crate::simulation::Simulation;
use crate::simulation::motions::{self, side, side_keyword, sides};
use crate::simulation::names::{type_keyword, type_text};
use cram::pose::value::pose_stamped;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use nalgebra::Translation3;
use robotics::location::{Container, container_before, containers};
use robotics::motion::interruption::interruptible;
use robotics::motion::{Effort, HandleChooser, HandleQuestion, MotionFailure, StoppedPart};
use robotics::robot::JointKind;
use robotics::world::{KNOB_ON, Knob};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// A container whose joint is nearer than this (m or rad) to its lower limit is closed.
const CLOSED: f64 = 0.1;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![list_containers, open_p, list_knobs, knob_state];

/// Builtins of package `CRAM-MOBILE-PICK-PLACE-PLANS`.
pub(crate) static PLANS_TABLE: &[Builtin] = builtins![
    container_state,
    container_p,
    container_before_that,
    assert_way_is_free,
    choose_handle_grasp,
    handle_in_hand,
    withdrawn_pose
];

/// The keyword of a link of the kitchen.
fn furniture_keyword(image: &mut Image, name: &str) -> Value {
    type_keyword(image, &name.replace('_', "-"))
}

fn kind_keyword(image: &mut Image, kind: JointKind) -> Value {
    let name = match kind {
        JointKind::Prismatic => "PRISMATIC",
        _ => "REVOLUTE",
    };
    image.keyword(name).into()
}

/// What can be opened by a handle: lists of the name that (urdf-name …) takes, the joint, its position and
/// its limits (m or rad), :PRISMATIC for a drawer or :REVOLUTE for a door, and the pose of the handle in the
/// map.
///
/// `(first (assoc :iai-fridge-door (list-containers)))` => `:IAI-FRIDGE-DOOR`
#[builtin]
fn list_containers(simulation: &mut Simulation, image: &mut Image) -> Vec<Value> {
    let containers = containers(&simulation.models);
    let moving = containers.into_iter().filter(|c| simulation.moves(c));
    let rows = moving.map(|container| {
        let mut row = state(simulation, image, &container).to_vec();
        row.push(pose_stamped(
            "map",
            &simulation.world.furniture_pose(container.handle),
        ));
        Value::list(row)
    });
    rows.collect()
}

/// The name of a container, that of its joint, where this is and its limits (m or rad), and its
/// kind.
fn state(simulation: &Simulation, image: &mut Image, container: &Container) -> [Value; 6] {
    let kitchen = &simulation.models.kitchen;
    let joint = kitchen.joint(container.joint);
    let limits = simulation.travel(container);
    [
        furniture_keyword(image, &kitchen.link(container.link).name),
        Value::from(joint.name.as_str()),
        Value::Double(simulation.opening_of(container)),
        Value::Double(limits.lower),
        Value::Double(limits.upper),
        kind_keyword(image, joint.kind),
    ]
}

/// Is a drawer or door open, by more than 0.1 m or rad? It is given by its name or by an object that
/// describes it.
///
/// `(progn (pp-tut:init-projection) (open-p :iai-fridge-door))` => `NIL`
#[builtin]
fn open_p(simulation: &mut Simulation, image: &mut Image, container: &Value) -> Result<bool> {
    let container = simulation.container(image, container)?;
    let limits = simulation.travel(&container);
    Ok(simulation.opening_of(&container) - limits.lower > CLOSED)
}

/// Whether a knob is on, its angle and the limits of that (rad).
fn turned(simulation: &Simulation, image: &mut Image, knob: &Knob) -> [Value; 4] {
    let (angle, is_on) = simulation.world.knob_state(knob);
    let joint = simulation.models.kitchen.joint(knob.joint);
    let limit = |limit: Option<f64>| limit.map_or(Value::NIL, Value::Double);
    [
        image.keyword(if is_on { "ON" } else { "OFF" }).into(),
        Value::Double(angle),
        limit(joint.limits.as_ref().map(|l| l.lower)),
        limit(joint.limits.as_ref().map(|l| l.upper)),
    ]
}

/// The knobs of the kitchen: lists of the name that (urdf-name …) takes, :ON or :OFF, the angle and its
/// limits (rad), and the pose of the knob in the map.
///
/// `(length (list-knobs))` => `5`
#[builtin]
fn list_knobs(simulation: &mut Simulation, image: &mut Image) -> Vec<Value> {
    let rows = simulation.models.knobs().into_iter().map(|knob| {
        let name = simulation.models.kitchen.link(knob.link).name.clone();
        let mut row = vec![furniture_keyword(image, &name)];
        row.extend(turned(simulation, image, &knob));
        let pose = simulation.world.furniture_pose(knob.link);
        row.push(pose_stamped("map", &pose));
        Value::list(row)
    });
    rows.collect()
}

/// Of a knob, given by its name or described: :ON, if it is turned by 0.35 rad or more, or :OFF; its angle
/// and the limits of that (rad), the name of its joint, its own, and by how much (rad) it has to be turned to
/// be on.
///
/// `(progn (pp-tut:init-projection) (values (knob-state :oven-area-oven-knob-oven)))` => `:OFF`
#[builtin]
fn knob_state(simulation: &mut Simulation, image: &mut Image, knob: &Value) -> Result<Value> {
    let knob = simulation.knob(image, knob)?;
    let mut values = turned(simulation, image, &knob).to_vec();
    let kitchen = &simulation.models.kitchen;
    values.push(Value::from(kitchen.joint(knob.joint).name.as_str()));
    let name = kitchen.link(knob.link).name.clone();
    values.push(furniture_keyword(image, &name));
    values.push(Value::Double(KNOB_ON));
    Ok(Value::values(values))
}

/// Of a drawer or door, given by its name or described: its name, the name of its joint, the joint's position
/// and limits (m or rad), and :PRISMATIC or :REVOLUTE.
///
/// `(second (multiple-value-list (pp-plans::container-state :iai-fridge-main)))` => `"iai_fridge_door_joint"`
#[builtin]
fn container_state(
    simulation: &mut Simulation,
    image: &mut Image,
    container: &Value,
) -> Result<Value> {
    let container = simulation.container(image, container)?;
    Ok(Value::values(state(simulation, image, &container).to_vec()))
}

/// The name of the drawer or door that has to be open before one, given by its name or described, can move,
/// as the flap of a dishwasher before its rack; NIL if there is none. What is in its way while everything is
/// shut, and is not once it is open, has to be open.
///
/// `(pp-plans::container-before :iai-fridge-door)` => `NIL`
#[builtin("CONTAINER-BEFORE")]
fn container_before_that(
    simulation: &mut Simulation,
    image: &mut Image,
    container: &Value,
) -> Result<Option<Value>> {
    let container = simulation.container(image, container)?;
    let models = &simulation.models;
    let before = container_before(models, &container);
    Ok(before.map(|before| furniture_keyword(image, &models.kitchen.link(before.link).name)))
}

/// What is asked of a hand that is to bring a container to a position.
fn question(
    simulation: &Simulation,
    image: &mut Image,
    container: &Value,
    position: &Value,
    arms: Option<&Value>,
    grasps: Option<&Value>,
) -> Result<(Container, HandleQuestion)> {
    let container = simulation.handled(image, container)?;
    let arms = match arms.filter(|arms| arms.is_true()) {
        Some(arms) => sides(image, arms)?,
        None => motions::arms(image).into_iter().rev().collect(),
    };
    let grasps = grasps.map_or_else(Vec::new, |grasps| grasps.iter_list().collect());
    let position = simulation.wanted_opening(&container, Some(position))?;
    let question = HandleQuestion {
        part: simulation.world.part(container.joint),
        handle: container.handle,
        position,
        arms,
        grasps: grasps.iter().filter_map(|g| type_text(image, g)).collect(),
    };
    Ok((container, question))
}

/// The failure that something is in the way of a drawer or door, if there is something.
fn way_blocked(
    simulation: &Simulation,
    container: &Container,
    chooser: &HandleChooser<'_>,
) -> std::result::Result<(), MotionFailure> {
    let Some((ahead, hit)) = chooser.blocked() else {
        return Ok(());
    };
    let joint = simulation.models.kitchen.joint(container.joint);
    Err(MotionFailure::PartStopped(Box::new(StoppedPart {
        joint: joint.name.clone(),
        position: simulation.opening_of(container),
        ahead: Some(*ahead),
        hit: hit.clone(),
    })))
}

/// Fails with ENVIRONMENT-MANIPULATION-GOAL-NOT-REACHED if other things are in the way of a drawer or door,
/// or of what is in it, to a position (m or rad).
///
/// `(progn (pp-tut:init-projection) (pp-plans::assert-way-is-free :iai-fridge-door 1.5))` => `NIL`
#[builtin]
fn assert_way_is_free(
    simulation: &mut Simulation,
    image: &mut Image,
    container: &Value,
    distance: &Value,
) -> Result<()> {
    let (handled, question) = question(simulation, image, container, distance, None, None)?;
    let chooser = HandleChooser::new(&simulation.world, &question, Effort::QUICK);
    let free = way_blocked(simulation, &handled, &chooser);
    free.map_err(|failure| simulation.failure(image, &failure, container))
}

/// The first arm and grasp by which a drawer or door can be brought to a position (m or rad) from where the
/// robot stands: the arm, the grasp, the height (m) of the torso, the joint angles (rad) of the arm before
/// the approach, and the poses of the hand there and at the handle. Fails with MANIPULATION-POSE-UNREACHABLE
/// if there is none, and with ENVIRONMENT-MANIPULATION-GOAL-NOT-REACHED if something is in the way of the
/// drawer or door itself.
#[builtin]
fn choose_handle_grasp(
    simulation: &mut Simulation,
    image: &mut Image,
    container: &Value,
    distance: &Value,
    #[key] arms: Option<&Value>,
    #[key] grasps: Option<&Value>,
) -> Result<Value> {
    let (handled, question) = question(simulation, image, container, distance, arms, grasps)?;
    let found = interruptible(interruption(image), || {
        let chooser = HandleChooser::new(&simulation.world, &question, Effort::THOROUGH);
        way_blocked(simulation, &handled, &chooser)?;
        let nothing = |nothing| MotionFailure::NoHandleGrasp(Box::new(nothing));
        chooser.with_base_at(&simulation.base()).map_err(nothing)
    });
    let Some(found) = found else {
        // Ctrl-C stops the plan at its next step.
        return Ok(Value::values(Vec::new()));
    };
    let choice = found.map_err(|failure| simulation.failure(image, &failure, container))?;
    let posture = choice
        .posture
        .into_iter()
        .map(Value::Double)
        .collect::<Vec<_>>();
    Ok(Value::values(vec![
        side_keyword(image, choice.side),
        type_keyword(image, choice.grasp),
        Value::Double(choice.torso),
        Value::list(posture),
        pose_stamped("map", &choice.pregrasp),
        pose_stamped("map", &choice.tool),
    ]))
}

/// Is furniture, given by its name or described, a drawer or door, or in one?
///
/// `(pp-plans::container-p :iai-fridge-main)` => `T`
/// `(pp-plans::container-p :kitchen-island-surface)` => `NIL`
#[builtin]
fn container_p(simulation: &mut Simulation, image: &mut Image, thing: &Value) -> Result<bool> {
    simulation.is_container(image, thing)
}

/// The name of the joint that is moved by the handle that a hand holds, or NIL.
///
/// `(progn (pp-tut:init-projection) (pp-plans::handle-in-hand :left))` => `NIL`
#[builtin]
fn handle_in_hand(
    simulation: &mut Simulation,
    image: &mut Image,
    arm: &Value,
) -> Result<Option<String>> {
    let side = side(image, arm)?;
    let hold = simulation.world.handle_hold(side);
    Ok(hold.map(|hold| simulation.models.kitchen.joint(hold.joint).name.clone()))
}

/// The pose of a hand that has withdrawn straight by a distance (m) from where it is.
#[builtin]
fn withdrawn_pose(
    simulation: &mut Simulation,
    image: &mut Image,
    arm: &Value,
    distance: &Value,
) -> Result<Value> {
    let arm = simulation.models.description.arm(side(image, arm)?);
    let distance = number::to_f64(distance).unwrap_or(0.0);
    let tool = arm.tool_for_wrist(&simulation.world.link_pose(arm.wrist));
    let back = tool * Translation3::new(-distance, 0.0, 0.0);
    Ok(pose_stamped("map", &back))
}

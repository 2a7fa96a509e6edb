//! What questions about the world are made of.

use std::rc::Rc;

use crate::simulation::Simulation;
use crate::simulation::held::Held;
use crate::simulation::motions::side;
use crate::simulation::names::{name_text, suggestion, type_keyword, type_text};
use cram::pose::value::pose_stamped;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use lisp::value::string::LispString;
use nalgebra::Point3;
use robotics::motion::{CollisionMode, can_reach, neck_positions};
use robotics::perception::{Camera, Sight};
use robotics::robot::{JointId, KinematicTree};
use robotics::world::{BodyName, WorldError};
use spatial::Shape;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The longest time (s) that a world may be let pass at once: an hour.
const LONGEST: f64 = 3600.0;

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static TABLE: &[Builtin] = builtins![
    touching,
    carried_by,
    links,
    link_pose,
    joints,
    set_joint,
    settled,
    sights,
    shares_in_sight,
    hand_reaches,
    super::reached::reached,
    super::reached::hindrances,
    point_head,
    put_in_hand,
    take_from_hand,
    object_types,
    grasps_of,
    type_grip,
    spawn_shape,
    is_moving
];

fn raise(error: WorldError) -> Box<Raise> {
    Raise::reporting(error)
}

/// A body with its link.
fn shown(simulation: &Simulation, image: &mut Image, body: &BodyName) -> Value {
    let (body, link) = match body {
        BodyName::Object(name) => (simulation.symbol_of(name), Value::NIL),
        BodyName::Floor => (image.keyword("FLOOR").into(), Value::NIL),
        BodyName::Robot(link) => (image.keyword("ROBOT").into(), Value::from(&*link.name)),
        BodyName::Furniture(link) => (image.keyword("KITCHEN").into(), Value::from(&*link.name)),
    };
    Value::cons(body, link)
}

/// What an object touches, by shapes that are at most 1 mm apart: a list of (body . link). A body is the name
/// of an object, or :KITCHEN, :ROBOT or :FLOOR.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%touching 'bottle-1))` => `((:KITCHEN . "table_area_main"))`
#[builtin("%TOUCHING")]
fn touching(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<Vec<Value>> {
    let name = simulation.object_named(image, name)?;
    let bodies = simulation.world.touching(&name).map_err(raise)?;
    Ok(all_shown(simulation, image, &bodies))
}

/// What pushes a spawned object up, as %TOUCHING gives it; of the robot, only what does not hold it.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%carried-by 'bottle-1))` => `((:KITCHEN . "table_area_main"))`
#[builtin("%CARRIED-BY")]
fn carried_by(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<Vec<Value>> {
    let name = simulation.object_named(image, name)?;
    let bodies = simulation.world.carried_by(&name).map_err(raise)?;
    Ok(all_shown(simulation, image, &bodies))
}

/// Bodies with their links.
fn all_shown(simulation: &Simulation, image: &mut Image, bodies: &[BodyName]) -> Vec<Value> {
    let bodies = bodies.iter();
    bodies.map(|body| shown(simulation, image, body)).collect()
}

/// Which of the two trees is meant, if it is one of them.
pub(super) fn is_kitchen(image: &Image, body: &Value) -> Option<bool> {
    match name_text(image, body)?.as_str() {
        "KITCHEN" => Some(true),
        "ROBOT" => Some(false),
        _ => None,
    }
}

/// The tree that is meant; an error for anything but the two.
fn tree<'s>(simulation: &'s Simulation, image: &Image, body: &Value) -> Result<&'s KinematicTree> {
    match is_kitchen(image, body) {
        Some(true) => Ok(&simulation.models.kitchen),
        Some(false) => Ok(&simulation.models.robot),
        None => Err(Raise::simple("Only :ROBOT and :KITCHEN have links.")),
    }
}

/// The names of the links of :ROBOT or :KITCHEN; if SOLID, of those that have a shape.
///
/// `(first (btr::%links :robot))` => `"base_footprint"`
#[builtin("%LINKS")]
fn links(
    simulation: &mut Simulation,
    image: &mut Image,
    body: &Value,
    #[default(false)] solid: bool,
) -> Result<Vec<Value>> {
    let world = &simulation.world;
    let is_kitchen = is_kitchen(image, body);
    Ok(match (solid, is_kitchen) {
        (true, Some(true)) => world.solid_kitchen_links().map(name_of).collect(),
        (true, Some(false)) => world.solid_robot_links().map(name_of).collect(),
        _ => {
            let tree = tree(simulation, image, body)?;
            tree.links()
                .map(|(_, link)| Value::from(link.name.as_str()))
                .collect()
        }
    })
}

pub(super) fn name_of(body: BodyName) -> Value {
    Value::from(body.to_string().as_str())
}

/// The pose in the map of a link of :ROBOT or :KITCHEN; NIL if there is no such link.
///
/// `(btr::%link-pose :robot "no_such_link")` => `NIL`
#[builtin("%LINK-POSE")]
fn link_pose(
    simulation: &mut Simulation,
    image: &mut Image,
    body: &Value,
    link: &Rc<LispString>,
) -> Result<Value> {
    let link = tree(simulation, image, body)?.link_named(&link.text());
    Ok(match (link, is_kitchen(image, body)) {
        (None, _) => Value::NIL,
        (Some(link), Some(true)) => pose_stamped("map", &simulation.world.furniture_pose(link)),
        (Some(link), _) => pose_stamped("map", &simulation.world.link_pose(link)),
    })
}

/// The joints of :ROBOT or :KITCHEN that can be moved: a list of (name . position), in rad or m.
///
/// `(progn (pp-tut:init-projection) (cdr (assoc "iai_fridge_door_joint" (btr::%joints :kitchen) :test #'string=)))` => `0.0d0`
#[builtin("%JOINTS")]
fn joints(simulation: &mut Simulation, image: &mut Image, body: &Value) -> Result<Vec<Value>> {
    let tree = tree(simulation, image, body)?;
    let positions = match is_kitchen(image, body) {
        Some(true) => simulation.world.kitchen_positions(),
        _ => &simulation.world.robot_configuration().joints,
    };
    let moving = tree.joints().filter(|(_, joint)| joint.is_actuated());
    let pairs = moving.map(|(id, joint)| {
        let position = Value::Double(tree.position(positions, id));
        Value::cons(Value::from(joint.name.as_str()), position)
    });
    Ok(pairs.collect())
}

/// A joint of the robot that can be moved.
fn robot_joint(simulation: &Simulation, name: &str) -> Result<JointId> {
    let tree = &simulation.models.robot;
    let found = tree.joint_named(name);
    found
        .filter(|joint| tree.joint(*joint).is_actuated())
        .ok_or_else(|| {
            let names = tree.joints().map(|(_, joint)| joint.name.as_str());
            let near = suggestion(name, names, |n| format!("{n:?}"));
            let end = if near.is_empty() { "." } else { "" };
            Raise::simple(format!("The robot has no joint {name:?}{near}{end}"))
        })
}

/// Puts a joint of :ROBOT or :KITCHEN somewhere at once, within its limits. Returns where it is then.
#[builtin("%SET-JOINT", edit)]
fn set_joint(
    simulation: &mut Simulation,
    image: &mut Image,
    body: &Value,
    joint: &Rc<LispString>,
    position: f64,
) -> Result<f64> {
    let name = joint.text();
    if !position.is_finite() {
        return Err(Raise::type_error(&Value::Double(position), known::REAL));
    }
    if is_kitchen(image, body) == Some(true) {
        let now = simulation.world.teleport_kitchen_joint(&name, position);
        return now.map_err(raise);
    }
    let joint = robot_joint(simulation, &name)?;
    let limits = simulation.models.robot.joint(joint).limits;
    let position = limits.map_or(position, |limits| limits.clamp(position));
    let mut robot = simulation.world.robot_configuration().clone();
    robot.joints.set(joint, position);
    simulation.world.teleport_robot(&robot);
    Ok(position)
}

/// Where the objects would be after so much time, or once all are at rest: a list of (name pose). The world
/// stays as it is.
///
/// `(progn (pp-tut:init-projection) (btr::%settled 5))` => `NIL`
#[builtin("%SETTLED")]
fn settled(simulation: &mut Simulation, seconds: &Value) -> Result<Vec<Value>> {
    let seconds = time_to_pass(seconds)?;
    // A copy takes longer than the answer.
    let copy = (!simulation.world.sleeps()).then(|| {
        let mut world = simulation.world.clone();
        world.settle(seconds);
        world
    });
    let world = copy.as_ref().unwrap_or(&simulation.world);
    let mut poses = Vec::new();
    for object in simulation.world.objects() {
        let pose = world.object_pose(object.name()).map_err(raise)?;
        let name = simulation.symbol_of(object.name());
        poses.push(Value::list([name, pose_stamped("map", &pose)]));
    }
    Ok(poses)
}

/// A time that may be let pass (s).
pub(super) fn time_to_pass(value: &Value) -> Result<f64> {
    let seconds = number::to_f64(value).filter(|s| (0.0..=LONGEST).contains(s));
    seconds.ok_or_else(|| {
        Raise::simple("A time from 0 to 3600 s was expected: how long the world is let alone.")
    })
}

/// A look at objects, by the robot's camera or one at the pose of an optical frame.
fn look<'s>(
    simulation: &'s Simulation,
    image: &mut Image,
    names: &[String],
    camera_pose: &Value,
) -> Result<Sight<'s>> {
    let world = &simulation.world;
    let description = world.models().description.camera();
    let pose = match camera_pose.is_true() {
        false => world.link_pose(description.frame),
        true => simulation.pose_in_map(image, camera_pose)?,
    };
    let camera = Camera::new(description, pose);
    match names {
        [name] => Sight::at(world, camera, name, 0.0).map_err(raise),
        _ => Ok(Sight::take(world, camera, 0.0)),
    }
}

/// The names of the objects that are in a list.
pub(super) fn names_in(
    simulation: &Simulation,
    image: &mut Image,
    list: &Value,
) -> Result<Vec<String>> {
    let names = list.iter_list();
    names
        .map(|name| simulation.object_named(image, &name))
        .collect()
}

/// The names in a list, and what the camera sees of these objects; `None` if there are none.
fn sight_of<'s>(
    simulation: &'s Simulation,
    image: &mut Image,
    names: &Value,
    camera_pose: &Value,
) -> Result<Option<(Vec<String>, Sight<'s>)>> {
    let names = names_in(simulation, image, names)?;
    if names.is_empty() {
        return Ok(None);
    }
    let sight = look(simulation, image, &names, camera_pose)?;
    Ok(Some((names, sight)))
}

/// What the robot's camera sees of objects, or one at the pose of an optical frame: a list of (name share
/// outside occluders): the share of the object that is in sight (0 to 1), whether it is out of the picture at
/// least in part, and the bodies in front of it.
///
/// `(progn (pp-tut:init-projection) (btr::%sights nil nil))` => `NIL`
#[builtin("%SIGHTS")]
fn sights(
    simulation: &mut Simulation,
    image: &mut Image,
    names: &Value,
    camera_pose: &Value,
) -> Result<Vec<Value>> {
    let Some((names, sight)) = sight_of(simulation, image, names, camera_pose)? else {
        return Ok(Vec::new());
    };
    let mut found = Vec::new();
    for name in &names {
        let visibility = sight.visibility(name).map_err(raise)?;
        let bodies: Vec<Value> = visibility
            .occluders()
            .map(|body| shown(simulation, image, body).car_or_nil())
            .collect();
        found.push(Value::list([
            simulation.symbol_of(name),
            Value::Double(visibility.fraction()),
            Value::bool(visibility.outside.is_some()),
            Value::list(bodies),
        ]));
    }
    Ok(found)
}

/// As %SIGHTS, but only the shares: a list of (name share).
///
/// `(progn (pp-tut:init-projection) (btr::%shares-in-sight nil nil))` => `NIL`
#[builtin("%SHARES-IN-SIGHT")]
fn shares_in_sight(
    simulation: &mut Simulation,
    image: &mut Image,
    names: &Value,
    camera_pose: &Value,
) -> Result<Vec<Value>> {
    let Some((names, sight)) = sight_of(simulation, image, names, camera_pose)? else {
        return Ok(Vec::new());
    };
    let row = |name: &String| {
        let share = sight.share(name).map_err(raise)?;
        Ok(Value::list([
            simulation.symbol_of(name),
            Value::Double(share),
        ]))
    };
    names.iter().map(row).collect()
}

/// Can the hand be at a pose from where the robot stands, at any height of the torso, while the robot touches
/// nothing, or nothing but the object?
///
/// `(progn (pp-tut:init-projection) (btr::%hand-reaches '((5 0 1) (0 0 0 1)) :left))` => `NIL`
#[builtin("%HAND-REACHES")]
fn hand_reaches(
    simulation: &mut Simulation,
    image: &mut Image,
    pose: &Value,
    arm: &Value,
    object: Option<&Value>,
) -> Result<bool> {
    let tool = simulation.believed_base().inverse() * simulation.pose_in_map(image, pose)?;
    let side = side(image, arm)?;
    let object = object.filter(|object| object.is_true());
    let object = object.map(|name| simulation.object_named(image, name));
    let object = object.transpose()?;
    let mode = match object {
        Some(_) => CollisionMode::AllowHand,
        None => CollisionMode::AvoidAll,
    };
    Ok(can_reach(
        &simulation.world,
        side,
        &tool,
        mode,
        object.as_deref(),
    ))
}

/// Turns the head towards a pose at once, as far as it can be turned.
#[builtin("%POINT-HEAD", edit)]
fn point_head(simulation: &mut Simulation, image: &mut Image, pose: &Value) -> Result<bool> {
    let pose = simulation.pose_in_map(image, pose)?;
    let positions = neck_positions(&simulation.world, &Point3::from(pose.translation.vector));
    let neck = &simulation.models.description.neck;
    let tree = &simulation.models.robot;
    let mut robot = simulation.world.robot_configuration().clone();
    for (&joint, position) in neck.joints.iter().zip(positions) {
        let limits = tree.joint(joint).limits;
        let position = limits.map_or(position, |limits| limits.clamp(position));
        robot.joints.set(joint, position);
    }
    simulation.world.teleport_robot(&robot);
    Ok(true)
}

/// Lets a hand hold an object where it is.
#[builtin("%PUT-IN-HAND", edit)]
fn put_in_hand(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    arm: &Value,
    grasp: &Value,
) -> Result<()> {
    let name = simulation.object_named(image, name)?;
    let side = side(image, arm)?;
    let link = simulation.models.description.arm(side).gripper.palm;
    let taken_from = simulation.world.object_pose(&name).map_err(raise)?;
    simulation.world.attach(&name, link).map_err(raise)?;
    let held = Held {
        side,
        grasp: type_text(image, grasp),
        turn: 0.0,
        taken_from,
        tool_in_object: None,
    };
    simulation.held.insert(name, held);
    Ok(())
}

/// Lets go of an object, which stays where it is until time passes.
#[builtin("%TAKE-FROM-HAND", edit)]
fn take_from_hand(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<bool> {
    let name = simulation.object_named(image, name)?;
    let was_held = simulation.world.detach(&name).map_err(raise)?.is_some();
    simulation.held.shift_remove(&name);
    Ok(was_held)
}

/// The types of objects, as keywords.
///
/// `(listp (btr::%object-types))` => `T`
#[builtin("%OBJECT-TYPES")]
fn object_types(simulation: &mut Simulation, image: &mut Image) -> Vec<Value> {
    let types = simulation.models.objects.names();
    types.map(|name| type_keyword(image, name)).collect()
}

/// The grasps of a type of objects with an arm, as keywords, those that are tried first at the front.
///
/// `(listp (btr::%grasps-of :bottle :left))` => `T`
#[builtin("%GRASPS-OF", "type arm")]
fn grasps_of(
    simulation: &mut Simulation,
    image: &mut Image,
    kind: &Value,
    arm: &Value,
) -> Result<Vec<Value>> {
    let kind = type_text(image, kind).unwrap_or_default();
    let side = side(image, arm)?;
    let grasps = simulation.defined_grasps(&kind, side);
    Ok(grasps
        .iter()
        .map(|name| type_keyword(image, name))
        .collect())
}

/// How hard (N) objects of a type are gripped, and how wide (m) a hand opens for them, as a list.
///
/// `(length (btr::%type-grip :bottle))` => `2`
#[builtin("%TYPE-GRIP", "type")]
fn type_grip(simulation: &mut Simulation, image: &mut Image, kind: &Value) -> Value {
    let kind = type_text(image, kind).unwrap_or_default();
    let grip = simulation.grip(&kind);
    Value::list([grip.effort, grip.opening].map(Value::Double))
}

/// Puts a :BOX with edges (x y z), a :SPHERE with a radius (r), or a :CYLINDER with radius and length (r l),
/// in m, into the world; its frame is in its middle.
#[builtin("%SPAWN-SHAPE", edit)]
fn spawn_shape(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    shape: &Value,
    size: &Value,
    pose: &Value,
    mass: &Value,
    color: &Value,
) -> Result<Value> {
    let size: Vec<f64> = size
        .iter_list()
        .filter_map(|x| number::to_f64(&x))
        .collect();
    let kind = name_text(image, shape).unwrap_or_default();
    let shape = match (kind.as_str(), size.as_slice()) {
        ("BOX", [x, y, z]) => Shape::Box { size: [*x, *y, *z] },
        ("SPHERE", [radius]) => Shape::Sphere { radius: *radius },
        ("CYLINDER", [radius, length]) => Shape::Cylinder {
            radius: *radius,
            length: *length,
        },
        _ => {
            return Err(Raise::simple(
                "A :BOX has a size (x y z), a :SPHERE (radius), a :CYLINDER (radius length).",
            ));
        }
    };
    let pose = simulation.pose_in_map(image, pose)?;
    simulation.spawn_shape(image, name, &kind.to_lowercase(), shape, &pose, mass, color)?;
    Ok(name.clone())
}

/// Does the robot move?
///
/// `(btr::%moving-p)` => `NIL`
#[builtin("%MOVING-P")]
fn is_moving(simulation: &mut Simulation) -> bool {
    !simulation.jobs.is_idle()
}

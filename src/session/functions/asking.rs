//! What questions about the world are made of.

use super::reached::{hindrances, reached};
use crate::host::call::{done, edit, host};
use crate::simulation::Simulation;
use crate::simulation::held::Held;
use crate::simulation::motions::side;
use crate::simulation::names::{name_text, suggestion, type_keyword, type_text};
use cram::Reply;
use cram::pose::value::pose_stamped;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
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
pub(super) static TABLE: &[Builtin] = &[
    control(
        "%TOUCHING",
        "name",
        "What an object touches, by shapes that are at most 1 mm apart: a list of (body . link). A body is the name of an object, or :KITCHEN, :ROBOT or :FLOOR.",
        &[
            "(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%touching 'bottle-1)) => ((:KITCHEN . \"table_area_main\"))",
        ],
        host!(touching),
    ),
    control(
        "%CARRIED-BY",
        "name",
        "What pushes a spawned object up, as %TOUCHING gives it; of the robot, only what does not hold it.",
        &[
            "(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%carried-by 'bottle-1)) => ((:KITCHEN . \"table_area_main\"))",
        ],
        host!(carried_by),
    ),
    control(
        "%LINKS",
        "body &optional solid",
        "The names of the links of :ROBOT or :KITCHEN; if SOLID, of those that have a shape.",
        &["(first (btr::%links :robot)) => \"base_footprint\""],
        host!(links),
    ),
    control(
        "%LINK-POSE",
        "body link",
        "The pose in the map of a link of :ROBOT or :KITCHEN; NIL if there is no such link.",
        &["(btr::%link-pose :robot \"no_such_link\") => NIL"],
        host!(link_pose),
    ),
    control(
        "%JOINTS",
        "body",
        "The joints of :ROBOT or :KITCHEN that can be moved: a list of (name . position), in rad or m.",
        &[
            "(progn (pp-tut:init-projection) (cdr (assoc \"iai_fridge_door_joint\" (btr::%joints :kitchen) :test #'string=))) => 0.0d0",
        ],
        host!(joints),
    ),
    control(
        "%SET-JOINT",
        "body joint position",
        "Puts a joint of :ROBOT or :KITCHEN somewhere at once, within its limits. Returns where it is then.",
        &[],
        edit!(set_joint),
    ),
    control(
        "%SETTLED",
        "seconds",
        "Where the objects would be after so much time, or once all are at rest: a list of (name pose). The world stays as it is.",
        &["(progn (pp-tut:init-projection) (btr::%settled 5)) => NIL"],
        host!(settled),
    ),
    control(
        "%SIGHTS",
        "names camera-pose",
        "What the robot's camera sees of objects, or one at the pose of an optical frame: a list of (name share outside occluders): the share of the object that is in sight (0 to 1), whether it is out of the picture at least in part, and the bodies in front of it.",
        &["(progn (pp-tut:init-projection) (btr::%sights nil nil)) => NIL"],
        host!(sights),
    ),
    control(
        "%SHARES-IN-SIGHT",
        "names camera-pose",
        "As %SIGHTS, but only the shares: a list of (name share).",
        &["(progn (pp-tut:init-projection) (btr::%shares-in-sight nil nil)) => NIL"],
        host!(shares_in_sight),
    ),
    control(
        "%HAND-REACHES",
        "pose arm &optional object",
        "Can the hand be at a pose from where the robot stands, at any height of the torso, while the robot touches nothing, or nothing but the object?",
        &[
            "(progn (pp-tut:init-projection) (btr::%hand-reaches '((5 0 1) (0 0 0 1)) :left)) => NIL",
        ],
        host!(hand_reaches),
    ),
    control(
        "%REACHED-GRASPS",
        "names sides each &optional absent among",
        "By which grasps hands reach objects from where the robot stands, as lists (object side grasp): all grasps if EACH is :GRASP, the first of each hand if :SIDE, the first of all if :OBJECT; as if the objects ABSENT were not there. With AMONG, lists such as these, of no others.",
        &[
            "(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%reached-grasps '(bottle-1) '(:left :right) :grasp)) => NIL",
        ],
        host!(reached),
    ),
    control(
        "%HINDRANCES",
        "name sides",
        "The objects without any of which a hand could grasp an object from where the robot stands that no hand can grasp now; or :UNCLEAR where objects are above that one or in hands, so that each has to be tried.",
        &[
            "(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%hindrances 'bottle-1 '(:left :right))) => NIL",
        ],
        host!(hindrances),
    ),
    control(
        "%POINT-HEAD",
        "pose",
        "Turns the head towards a pose at once, as far as it can be turned.",
        &[],
        edit!(point_head),
    ),
    control(
        "%PUT-IN-HAND",
        "name arm grasp",
        "Lets a hand hold an object where it is.",
        &[],
        edit!(put_in_hand),
    ),
    control(
        "%TAKE-FROM-HAND",
        "name",
        "Lets go of an object, which stays where it is until time passes.",
        &[],
        edit!(take_from_hand),
    ),
    control(
        "%OBJECT-TYPES",
        "",
        "The types of objects, as keywords.",
        &["(listp (btr::%object-types)) => T"],
        host!(object_types),
    ),
    control(
        "%GRASPS-OF",
        "type arm",
        "The grasps of a type of objects with an arm, as keywords, those that are tried first at the front.",
        &["(listp (btr::%grasps-of :bottle :left)) => T"],
        host!(grasps_of),
    ),
    control(
        "%TYPE-GRIP",
        "type",
        "How hard (N) objects of a type are gripped, and how wide (m) a hand opens for them, as a list.",
        &["(length (btr::%type-grip :bottle)) => 2"],
        host!(type_grip),
    ),
    control(
        "%SPAWN-SHAPE",
        "name shape size pose mass color",
        "Puts a :BOX with edges (x y z), a :SPHERE with a radius (r), or a :CYLINDER with radius and length (r l), in m, into the world; its frame is in its middle.",
        &[],
        edit!(spawn_shape),
    ),
    control(
        "%MOVING-P",
        "",
        "Does the robot move?",
        &["(btr::%moving-p) => NIL"],
        host!(is_moving),
    ),
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

fn touching(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = simulation.object_named(image, &args[0])?;
    let bodies = simulation.world.touching(&name).map_err(raise)?;
    done(all_shown(simulation, image, &bodies))
}

fn carried_by(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = simulation.object_named(image, &args[0])?;
    let bodies = simulation.world.carried_by(&name).map_err(raise)?;
    done(all_shown(simulation, image, &bodies))
}

/// Bodies with their links.
fn all_shown(simulation: &Simulation, image: &mut Image, bodies: &[BodyName]) -> Value {
    let bodies: Vec<Value> = bodies
        .iter()
        .map(|body| shown(simulation, image, body))
        .collect();
    Value::list(bodies)
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

pub(super) fn text(value: &Value) -> Result<String> {
    let text = value.as_text();
    text.ok_or_else(|| Raise::type_error(value, known::STRING))
}

fn links(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let world = &simulation.world;
    let is_kitchen = is_kitchen(image, &args[0]);
    let names: Vec<Value> = match (args.get(1).is_some_and(Value::is_true), is_kitchen) {
        (true, Some(true)) => world.solid_kitchen_links().map(name_of).collect(),
        (true, Some(false)) => world.solid_robot_links().map(name_of).collect(),
        _ => {
            let tree = tree(simulation, image, &args[0])?;
            tree.links()
                .map(|(_, link)| Value::from(link.name.as_str()))
                .collect()
        }
    };
    done(Value::list(names))
}

pub(super) fn name_of(body: BodyName) -> Value {
    Value::from(body.to_string().as_str())
}

fn link_pose(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let link = tree(simulation, image, &args[0])?.link_named(&text(&args[1])?);
    done(match (link, is_kitchen(image, &args[0])) {
        (None, _) => Value::NIL,
        (Some(link), Some(true)) => pose_stamped("map", &simulation.world.furniture_pose(link)),
        (Some(link), _) => pose_stamped("map", &simulation.world.link_pose(link)),
    })
}

fn joints(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let tree = tree(simulation, image, &args[0])?;
    let positions = match is_kitchen(image, &args[0]) {
        Some(true) => simulation.world.kitchen_positions(),
        _ => &simulation.world.robot_configuration().joints,
    };
    let moving = tree.joints().filter(|(_, joint)| joint.is_actuated());
    let pairs: Vec<Value> = moving
        .map(|(id, joint)| {
            let position = Value::Double(tree.position(positions, id));
            Value::cons(Value::from(joint.name.as_str()), position)
        })
        .collect();
    done(Value::list(pairs))
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

fn set_joint(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = text(&args[1])?;
    let Some(position) = number::to_f64(&args[2]).filter(|q| q.is_finite()) else {
        return Err(Raise::type_error(&args[2], known::REAL));
    };
    if is_kitchen(image, &args[0]) == Some(true) {
        let now = simulation.world.teleport_kitchen_joint(&name, position);
        return done(Value::Double(now.map_err(raise)?));
    }
    let joint = robot_joint(simulation, &name)?;
    let limits = simulation.models.robot.joint(joint).limits;
    let position = limits.map_or(position, |limits| limits.clamp(position));
    let mut robot = simulation.world.robot_configuration().clone();
    robot.joints.set(joint, position);
    simulation.world.teleport_robot(&robot);
    done(Value::Double(position))
}

fn settled(simulation: &mut Simulation, _: &mut Image, args: &[Value]) -> Result<Reply> {
    let seconds = seconds(&args[0])?;
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
    done(Value::list(poses))
}

/// A time that may be let pass (s).
pub(super) fn seconds(value: &Value) -> Result<f64> {
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

fn sights(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let names = names_in(simulation, image, &args[0])?;
    if names.is_empty() {
        return done(Value::NIL);
    }
    let sight = look(simulation, image, &names, &args[1])?;
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
    done(Value::list(found))
}

fn shares_in_sight(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let names = names_in(simulation, image, &args[0])?;
    if names.is_empty() {
        return done(Value::NIL);
    }
    let sight = look(simulation, image, &names, &args[1])?;
    let row = |name: &String| {
        let share = sight.share(name).map_err(raise)?;
        Ok(Value::list([
            simulation.symbol_of(name),
            Value::Double(share),
        ]))
    };
    let rows: Result<Vec<Value>> = names.iter().map(row).collect();
    done(Value::list(rows?))
}

fn hand_reaches(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let tool = simulation.believed_base().inverse() * simulation.pose_in_map(image, &args[0])?;
    let side = side(image, &args[1])?;
    let object = args.get(2).filter(|object| object.is_true());
    let object = object.map(|name| simulation.object_named(image, name));
    let object = object.transpose()?;
    let mode = match object {
        Some(_) => CollisionMode::AllowHand,
        None => CollisionMode::AvoidAll,
    };
    let reaches = can_reach(&simulation.world, side, &tool, mode, object.as_deref());
    done(Value::bool(reaches))
}

fn point_head(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let pose = simulation.pose_in_map(image, &args[0])?;
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
    done(Value::T)
}

fn put_in_hand(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = simulation.object_named(image, &args[0])?;
    let side = side(image, &args[1])?;
    let link = simulation.models.description.arm(side).gripper.palm;
    let taken_from = simulation.world.object_pose(&name).map_err(raise)?;
    simulation.world.attach(&name, link).map_err(raise)?;
    let held = Held {
        side,
        grasp: type_text(image, &args[2]),
        turn: 0.0,
        taken_from,
        tool_in_object: None,
    };
    simulation.held.insert(name, held);
    done(Value::NIL)
}

fn take_from_hand(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = simulation.object_named(image, &args[0])?;
    let was_held = simulation.world.detach(&name).map_err(raise)?.is_some();
    simulation.held.shift_remove(&name);
    done(Value::bool(was_held))
}

fn object_types(simulation: &mut Simulation, image: &mut Image, _: &[Value]) -> Result<Reply> {
    let types: Vec<String> = simulation
        .models
        .objects
        .names()
        .map(str::to_owned)
        .collect();
    let types: Vec<Value> = types.iter().map(|name| type_keyword(image, name)).collect();
    done(Value::list(types))
}

fn grasps_of(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let kind = type_text(image, &args[0]).unwrap_or_default();
    let side = side(image, &args[1])?;
    let grasps = simulation.defined_grasps(&kind, side);
    let grasps: Vec<Value> = grasps
        .iter()
        .map(|name| type_keyword(image, name))
        .collect();
    done(Value::list(grasps))
}

fn type_grip(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let kind = type_text(image, &args[0]).unwrap_or_default();
    let grip = simulation.grip(&kind);
    done(Value::list([grip.effort, grip.opening].map(Value::Double)))
}

fn spawn_shape(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let size: Vec<f64> = args[2]
        .iter_list()
        .filter_map(|x| number::to_f64(&x))
        .collect();
    let kind = name_text(image, &args[1]).unwrap_or_default();
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
    let pose = simulation.pose_in_map(image, &args[3])?;
    simulation.spawn_shape(
        image,
        &args[0],
        &kind.to_lowercase(),
        shape,
        &pose,
        &args[4],
        &args[5],
    )?;
    done(args[0].clone())
}

fn is_moving(simulation: &mut Simulation, _: &mut Image, _: &[Value]) -> Result<Reply> {
    done(Value::bool(!simulation.jobs.is_idle()))
}

//! Builtins for what two hands do together: ways on which both move at once, found before anything moves, and how
//! well they keep together.

use super::straight_ways::{beginning, imagined, way_of};
use crate::host::call::{done, host};
use crate::interruption::interruption;
use crate::simulation::Simulation;
use crate::simulation::motions::side;
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::typed::keywords;
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::motion::interruption::interruptible;
use robotics::motion::{can_stand, straight_ways, strain};
use robotics::robot::Side;
use robotics::world::World;
use spatial::{Pose, pose};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "%BOTH-WAYS",
        "ways &key base-pose begin object opening",
        "The first of some ways, each a list of the poses of the left hand and those of the right one, as many, through which both can be moved straight at the same time while the robot and what it holds touch nothing: its number, the height (m) of the torso, and the positions (rad) of the left and the right arm's joints in which it begins. NIL if there is none. BASE-POSE, BEGIN and OBJECT are as for %STRAIGHT-WAY. With OPENING, as if the fingers were so far apart (m).",
        &[
            "(progn (pp-tut:init-projection) (btr::%both-ways '(((((5 0 1) (0 0 0 1))) (((5 1 1) (0 0 0 1))))))) => NIL",
        ],
        host!(both_ways),
    ),
    control(
        "%STRAIN",
        "",
        "How far (m) the hands that hold one object together are from where they were when they took it, relative to each other; NIL if no two hands hold one.",
        &["(progn (pp-tut:init-projection) (btr::%strain)) => NIL"],
        host!(strain_of_hands),
    ),
    control(
        "%FORCE-BETWEEN-HANDS",
        "",
        "The force (N) with which the hands that hold one object together press it between them, or pull at it, along the line from one to the other: now, and the greatest since both have held it, as a list; NIL if no two hands hold one.",
        &["(progn (pp-tut:init-projection) (btr::%force-between-hands)) => NIL"],
        host!(force_between),
    ),
    control(
        "%MASS",
        "name",
        "The mass (kg) of an object.",
        &[
            "(progn (pp-tut:init-projection) (btr-utils:spawn-object 'tray-1 :tray :pose '((1.4 0.6 0.9) (0 0 0 1))) (btr::%mass 'tray-1)) => 0.2d0",
        ],
        host!(mass),
    ),
    control(
        "%PAYLOAD",
        "arm",
        "The mass (kg) that an arm may carry by the robot's description, or NIL.",
        &["(btr::%payload :left) => 1.8d0"],
        host!(payload),
    ),
];

fn both_ways(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let keys = ["BASE-POSE", "BEGIN", "OBJECT", "OPENING"].map(|name| image.keyword(name));
    let [base, begin, object, opening] = keywords::parse(image, &args[1..], keys)?;
    let opening = opening.and_then(|opening| number::to_f64(&opening));
    let begin = beginning(image, begin);
    let object = object.filter(Value::is_true);
    let object = object.map(|name| simulation.object_named(image, &name));
    let object = object.transpose()?;
    let base = base.filter(Value::is_true);
    let base = base.map(|base| simulation.pose_as_given(image, &base));
    let base = base.transpose()?;
    if simulation.models.description.sides().count() < 2 {
        return done(Value::NIL);
    }
    if let Some(base) = &base {
        let place = [base.translation.x, base.translation.y, pose::yaw(base)];
        if !can_stand(&simulation.world, &place) {
            return done(Value::NIL);
        }
    }
    let mut ways = Vec::new();
    for way in args[0].iter_list() {
        let mut hands = way.iter_list();
        let (left, right) = (hands.next(), hands.next());
        let poses = |simulation: &Simulation, hand: Option<Value>| {
            way_of(simulation, image, &hand.unwrap_or(Value::NIL))
        };
        ways.push([poses(simulation, left)?, poses(simulation, right)?]);
    }
    let there = (base.is_some() || opening.is_some()).then(|| {
        let there = imagined(&simulation.world, base.as_ref(), None);
        opened(there, opening)
    });
    let world = there.as_ref().unwrap_or(&simulation.world);
    // There, the robot would take itself to be where it went to.
    let in_base = base.unwrap_or_else(|| simulation.believed_base()).inverse();
    let local = |poses: &[Pose]| poses.iter().map(|pose| in_base * pose).collect();
    let found = interruptible(interruption(image), || {
        ways.iter().enumerate().find_map(|(number, [left, right])| {
            let both = [(Side::Left, local(left)), (Side::Right, local(right))];
            let start = straight_ways(world, &both, begin, object.as_deref(), &[])?;
            Some((number, start))
        })
    });
    done(match found.flatten() {
        None => Value::NIL,
        Some((number, start)) => {
            let mut values = vec![Value::from(number), Value::Double(start.torso)];
            values.extend(start.arms.into_iter().map(|arm| {
                let joints = arm.into_iter().map(Value::Double);
                Value::list(joints.collect::<Vec<_>>())
            }));
            Value::list(values)
        }
    })
}

/// The world with the fingers of both hands so far apart (m), if that is given.
fn opened(mut world: World, opening: Option<f64>) -> World {
    let Some(opening) = opening else { return world };
    let mut robot = world.robot_configuration().clone();
    for arm in &world.models().description.arms {
        let position = arm.gripper.position_for_opening(opening);
        let position = arm.gripper.limits.clamp(position);
        robot.joints.set(arm.gripper.joint, position);
    }
    world.teleport_robot(&robot);
    world
}

fn strain_of_hands(simulation: &mut Simulation, _: &mut Image, _: &[Value]) -> Result<Reply> {
    done(strain(&simulation.world).map_or(Value::NIL, Value::Double))
}

fn force_between(simulation: &mut Simulation, _: &mut Image, _: &[Value]) -> Result<Reply> {
    let forces = simulation.world.force_between_hands();
    done(forces.map_or(Value::NIL, |forces| Value::list(forces.map(Value::Double))))
}

fn mass(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = simulation.object_named(image, &args[0])?;
    let object = simulation.world.object(&name);
    let object = object.map_err(|error| Raise::simple(format!("{error}.")))?;
    done(Value::Double(object.mass()))
}

fn payload(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let arm = simulation.models.description.arm(side(image, &args[0])?);
    done(arm.payload.map_or(Value::NIL, Value::Double))
}

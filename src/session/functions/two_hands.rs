//! Builtins for what two hands do together: ways on which both move at once, found before anything moves, and how
//! well they keep together.

use super::straight_ways::{beginning, imagined, way_of};
use crate::interruption::interruption;
use crate::simulation::Simulation;
use crate::simulation::motions::side;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
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
pub(super) static TABLE: &[Builtin] =
    builtins![both_ways, strain_of_hands, force_between, mass, payload];

/// The first of some ways, each a list of the poses of the left hand and those of the right one, as many,
/// through which both can be moved straight at the same time while the robot and what it holds touch nothing:
/// its number, the height (m) of the torso, and the positions (rad) of the left and the right arm's joints in
/// which it begins. NIL if there is none. BASE-POSE, BEGIN and OBJECT are as for %STRAIGHT-WAY. With OPENING,
/// as if the fingers were so far apart (m).
///
/// `(progn (pp-tut:init-projection) (btr::%both-ways '(((((5 0 1) (0 0 0 1))) (((5 1 1) (0 0 0 1)))))))` => `NIL`
#[builtin("%BOTH-WAYS")]
fn both_ways(
    simulation: &mut Simulation,
    image: &mut Image,
    ways: &Value,
    #[key] base_pose: Option<&Value>,
    #[key] begin: Option<&Value>,
    #[key] object: Option<&Value>,
    #[key] opening: Option<&Value>,
) -> Result<Option<Value>> {
    let opening = opening.and_then(number::to_f64);
    let begin = beginning(image, begin);
    let object = object.filter(|object| object.is_true());
    let object = object.map(|name| simulation.object_named(image, name));
    let object = object.transpose()?;
    let base = base_pose.filter(|base| base.is_true());
    let base = base.map(|base| simulation.pose_as_given(image, base));
    let base = base.transpose()?;
    if simulation.models.description.sides().count() < 2 {
        return Ok(None);
    }
    if let Some(base) = &base {
        let place = [base.translation.x, base.translation.y, pose::yaw(base)];
        if !can_stand(&simulation.world, &place) {
            return Ok(None);
        }
    }
    let mut both_hands = Vec::new();
    for way in ways.iter_list() {
        let mut hands = way.iter_list();
        let (left, right) = (hands.next(), hands.next());
        let poses = |simulation: &Simulation, hand: Option<Value>| {
            way_of(simulation, image, &hand.unwrap_or(Value::NIL))
        };
        both_hands.push([poses(simulation, left)?, poses(simulation, right)?]);
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
        let mut ways = both_hands.iter().enumerate();
        ways.find_map(|(number, [left, right])| {
            let both = [(Side::Left, local(left)), (Side::Right, local(right))];
            let start = straight_ways(world, &both, begin, object.as_deref(), &[])?;
            Some((number, start))
        })
    });
    Ok(found.flatten().map(|(number, start)| {
        let mut values = vec![Value::from(number), Value::Double(start.torso)];
        values.extend(start.arms.into_iter().map(|arm| {
            let joints = arm.into_iter().map(Value::Double);
            Value::list(joints.collect::<Vec<_>>())
        }));
        Value::list(values)
    }))
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

/// How far (m) the hands that hold one object together are from where they were when they took it, relative
/// to each other; NIL if no two hands hold one.
///
/// `(progn (pp-tut:init-projection) (btr::%strain))` => `NIL`
#[builtin("%STRAIN")]
fn strain_of_hands(simulation: &mut Simulation) -> Option<f64> {
    strain(&simulation.world)
}

/// The force (N) with which the hands that hold one object together press it between them, or pull at it,
/// along the line from one to the other: now, and the greatest since both have held it, as a list; NIL if no
/// two hands hold one.
///
/// `(progn (pp-tut:init-projection) (btr::%force-between-hands))` => `NIL`
#[builtin("%FORCE-BETWEEN-HANDS")]
fn force_between(simulation: &mut Simulation) -> Option<Value> {
    let forces = simulation.world.force_between_hands();
    forces.map(|forces| Value::list(forces.map(Value::Double)))
}

/// The mass (kg) of an object.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'tray-1 :tray :pose '((1.4 0.6 0.9) (0 0 0 1))) (btr::%mass 'tray-1))` => `0.2d0`
#[builtin("%MASS")]
fn mass(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<f64> {
    let name = simulation.object_named(image, name)?;
    let object = simulation.world.object(&name);
    let object = object.map_err(|error| Raise::simple(format!("{error}.")))?;
    Ok(object.mass())
}

/// The mass (kg) that an arm may carry by the robot's description, or NIL.
///
/// `(btr::%payload :left)` => `1.8d0`
#[builtin("%PAYLOAD")]
fn payload(simulation: &mut Simulation, image: &mut Image, arm: &Value) -> Result<Option<f64>> {
    let arm = simulation.models.description.arm(side(image, arm)?);
    Ok(arm.payload)
}

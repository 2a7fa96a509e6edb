//! Straight ways of a hand, found before anything moves: here, from another place to stand, or as if the other arm
//! were in another posture.

use crate::interruption::interruption;
use crate::simulation::Simulation;
use crate::simulation::motions::{numbers, side};
use crate::simulation::names::name_text;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::motion::interruption::interruptible;
use robotics::motion::{WayBegin, can_stand, straight_way};
use robotics::robot::{ArmPositions, Side};
use robotics::world::{BodyName, World};
use spatial::{Pose, pose};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static TABLE: &[Builtin] = builtins![straight_hand_way];

/// The first of some ways, each a list of poses, through which a hand can be moved straight, one pose after
/// the other, while the robot and what it holds touch nothing: its number, and the height (m) of the torso
/// and the positions (rad) of the arm's joints in which it begins. NIL if there is none. With BASE-POSE, from
/// there, if the robot can stand there as it is. With POSTURE, a list of an arm, a height of the torso and
/// positions of its joints, as if they were so. BEGIN is where it begins: :HERE, where the hand is on the
/// robot, or :HERE-AT-ANY-HEIGHT, if the torso may move on the way; :THIS-HEIGHT, at the first pose with the
/// torso as it is; else at the first pose. The hand may touch OBJECT, if it is given; what the hand holds may
/// touch the objects THROUGH.
///
/// `(progn (pp-tut:init-projection) (btr::%straight-way :left '((((5 0 1) (0 0 0 1))))))` => `NIL`
#[builtin("%STRAIGHT-WAY")]
fn straight_hand_way(
    simulation: &mut Simulation,
    image: &mut Image,
    arm: &Value,
    ways: &Value,
    #[key] base_pose: Option<&Value>,
    #[key] posture: Option<&Value>,
    #[key] begin: Option<&Value>,
    #[key] object: Option<&Value>,
    #[key] through: Option<&Value>,
) -> Result<Option<Value>> {
    let side = side(image, arm)?;
    let mut passed = Vec::new();
    for name in through.into_iter().flat_map(Value::iter_list) {
        passed.push(BodyName::Object(simulation.object_named(image, &name)?));
    }
    let begin = beginning(image, begin);
    let object = object.filter(|object| object.is_true());
    let object = object.map(|name| simulation.object_named(image, name));
    let object = object.transpose()?;
    let base = base_pose.filter(|base| base.is_true());
    let base = base.map(|base| simulation.pose_as_given(image, base));
    let base = base.transpose()?;
    let posture = posture.filter(|posture| posture.is_true());
    let posture = posture.map(|posture| posture_of(image, posture));
    let posture = posture.transpose()?;
    if let Some(base) = &base {
        let place = [base.translation.x, base.translation.y, pose::yaw(base)];
        if !can_stand(&simulation.world, &place) {
            return Ok(None);
        }
    }
    let imagined = (base.is_some() || posture.is_some())
        .then(|| imagined(&simulation.world, base.as_ref(), posture.as_ref()));
    let ways = ways.iter_list();
    let ways = ways.map(|way| way_of(simulation, image, &way));
    let ways: Vec<Vec<Pose>> = ways.collect::<Result<_>>()?;
    let world = imagined.as_ref().unwrap_or(&simulation.world);
    // There, the robot would take itself to be where it went to.
    let in_base = base.unwrap_or_else(|| simulation.believed_base()).inverse();
    let found = interruptible(interruption(image), || {
        ways.iter().enumerate().find_map(|(number, way)| {
            let way: Vec<_> = way.iter().map(|pose| in_base * pose).collect();
            Some((
                number,
                straight_way(world, side, &way, begin, object.as_deref(), &passed)?,
            ))
        })
    });
    Ok(found.flatten().map(|(number, start)| {
        let arm = start.arm.into_iter().map(Value::Double);
        Value::list([
            Value::from(number),
            Value::Double(start.torso),
            Value::list(arm.collect::<Vec<_>>()),
        ])
    }))
}

/// Where a way begins, by a name.
pub(super) fn beginning(image: &Image, begin: Option<&Value>) -> WayBegin {
    let begin = begin.and_then(|begin| name_text(image, begin));
    match begin.as_deref() {
        Some("HERE") => WayBegin::Here,
        Some("HERE-AT-ANY-HEIGHT") => WayBegin::HereAtAnyHeight,
        Some("THIS-HEIGHT") => WayBegin::AtThisHeight,
        _ => WayBegin::AtAnyHeight,
    }
}

/// The poses of a way in the map.
pub(super) fn way_of(simulation: &Simulation, image: &Image, way: &Value) -> Result<Vec<Pose>> {
    let poses = way.iter_list();
    let poses = poses.map(|pose| simulation.pose_in_map(image, &pose));
    poses.collect()
}

/// An arm, the height (m) of the torso, and the positions (rad) of the arm's joints.
pub(super) type Posture = (Side, f64, ArmPositions);

fn posture_of(image: &mut Image, value: &Value) -> Result<Posture> {
    let parts: Vec<Value> = value.iter_list().collect();
    let [arm, torso, joints] = parts.as_slice() else {
        return Err(Raise::simple(format!(
            "{} is no posture: a list of an arm, a height and positions was expected.",
            print::to_string(image, value, true)
        )));
    };
    let torso = number::to_f64(torso).filter(|torso| torso.is_finite());
    let torso = torso.ok_or_else(|| Raise::simple("The height of the torso is a number."))?;
    let positions = numbers(joints)?;
    let positions = ArmPositions::try_from(positions.as_slice());
    let positions = positions.map_err(|error| Raise::simple(format!("{error}.")))?;
    Ok((side(image, arm)?, torso, positions))
}

/// The world with the robot at another place, or with the torso and an arm in another posture.
pub(super) fn imagined(world: &World, base: Option<&Pose>, posture: Option<&Posture>) -> World {
    let mut imagined = world.clone();
    let mut robot = world.robot_configuration().clone();
    if let Some(base) = base {
        let t = base.translation;
        let height = robot.base.translation.z;
        robot.base = pose::from_xy_yaw(t.x, t.y, pose::yaw(base));
        robot.base.translation.z = height;
    }
    if let Some((side, torso, positions)) = posture {
        let description = &world.models().description;
        (description.torso).set_height(&mut robot.joints, *torso);
        let arm = description.arm(*side);
        arm.set_positions(&mut robot.joints, positions);
    }
    imagined.teleport_robot(&robot);
    imagined
}

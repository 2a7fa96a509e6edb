//! Defining grasps.

use crate::host::call::{done, host};
use crate::log_level::LogLevel;
use crate::simulation::Simulation;
use crate::simulation::motions::sides;
use crate::simulation::names::type_text;
use cram::Reply;
use cram::designator::vocabulary::{Domain, Vocabulary};
use cram::pose::argument;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::print;
use lisp::typed::keywords;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::world::grasp_library::{GraspDefinition, Lift};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-OBJECT-INTERFACES`.
pub(super) static TABLE: &[Builtin] = &[control(
    "DEF-OBJECT-TYPE-TO-GRIPPER-TRANSFORMS",
    "types arms grasp &key grasp-translation grasp-rot-matrix pregrasp-offsets 2nd-pregrasp-offsets lift-offsets 2nd-lift-offsets lift-translation lift-rotation 2nd-lift-translation 2nd-lift-rotation location-type",
    "Defines how objects of the types (one or a list) are grasped by the arms (one or a list). Offsets are relative to the translation, along the object's axes (m); LIFT-TRANSLATION and LIFT-ROTATION (a quaternion) move hand and object along the axes of the robot's base. A grasp that exists is replaced.",
    &[
        "(progn (obj-int:def-object-type-to-gripper-transforms :bread '(:left :right) :from-above :grasp-translation '(0 0 0.02) :grasp-rot-matrix '((0 1 0) (1 0 0) (0 0 -1)) :pregrasp-offsets '(0 0 0.15) :lift-offsets '(0 0 0.15)) (pp-tut:list-defined-grasps :bread)) => (:FROM-ABOVE)",
    ],
    host!(define_grasp),
)];

fn triple(image: &Image, value: &Value, what: &str) -> Result<[f64; 3]> {
    let numbers: Vec<f64> = value
        .iter_list()
        .filter_map(|v| number::to_f64(&v))
        .collect();
    <[f64; 3]>::try_from(numbers.as_slice()).map_err(|_| {
        Raise::simple(format!(
            "{} is no {what}: a list of three numbers (m) was expected.",
            print::to_string(image, value, true)
        ))
    })
}

fn matrix(image: &Image, value: &Value) -> Result<[[f64; 3]; 3]> {
    let rows: Vec<[f64; 3]> = value
        .iter_list()
        .map(|row| triple(image, &row, "row of a rotation matrix"))
        .collect::<Result<_>>()?;
    <[[f64; 3]; 3]>::try_from(rows.as_slice())
        .map_err(|_| Raise::simple("A rotation matrix is a list of three rows of three numbers."))
}

/// The offset (m) along the object's axes; zero unless given.
fn offsets(image: &Image, value: Option<Value>, what: &str) -> Result<[f64; 3]> {
    value.map_or(Ok([0.0; 3]), |value| triple(image, &value, what))
}

/// A lift from its offset along the object's axes, and from its translation and rotation (a
/// quaternion) in the frame of the robot's base.
fn lift_of(
    image: &Image,
    offset: Option<Value>,
    in_base: Option<Value>,
    turn: Option<Value>,
) -> Result<Lift> {
    let mut lift = Lift::along_object(offsets(image, offset, "lift offset")?);
    lift.in_base.translation = offsets(image, in_base, "lift translation")?.into();
    if let Some(turn) = turn {
        lift.in_base.rotation = argument::quaternion(image, &turn)?.rotation();
    }
    Ok(lift)
}

fn define_grasp(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let types: Vec<Value> = match &args[0] {
        Value::Cons(_) => args[0].iter_list().collect(),
        single => vec![single.clone()],
    };
    let arms = sides(image, &args[1])?;
    let Some(grasp) = type_text(image, &args[2]) else {
        return Err(Raise::type_error(&args[2], known::SYMBOL));
    };
    let names = [
        "GRASP-TRANSLATION",
        "GRASP-ROT-MATRIX",
        "PREGRASP-OFFSETS",
        "2ND-PREGRASP-OFFSETS",
        "LIFT-OFFSETS",
        "LIFT-TRANSLATION",
        "LIFT-ROTATION",
        "2ND-LIFT-OFFSETS",
        "2ND-LIFT-TRANSLATION",
        "2ND-LIFT-ROTATION",
        "LOCATION-TYPE",
    ]
    .map(|name| image.keyword(name));
    let [
        translation,
        rotation,
        pregrasp,
        second_pregrasp,
        lift @ ..,
        location,
    ] = keywords::parse(image, &args[3..], names)?;
    let [
        offset,
        in_base,
        turn,
        second_offset,
        second_in_base,
        second_turn,
    ] = lift;
    Vocabulary::of(image).add(Domain::Grasp, [grasp.as_str()]);
    let definition = GraspDefinition {
        translation: offsets(image, translation, "grasp translation")?,
        rotation: match rotation {
            Some(rows) => matrix(image, &rows)?,
            None => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        },
        pregrasp: offsets(image, pregrasp, "pregrasp offset")?,
        second_pregrasp: offsets(image, second_pregrasp, "pregrasp offset")?,
        lift: lift_of(image, offset, in_base, turn)?,
        second_lift: lift_of(image, second_offset, second_in_base, second_turn)?,
        opening: None,
    };
    if let Some(location) = location.filter(Value::is_true) {
        let [grasp, location] =
            [&args[2], &location].map(|name| print::to_string(image, name, true));
        simulation.log(
            image,
            LogLevel::Warn,
            "(OBJ-INT DEF-OBJECT-TYPE-TO-GRIPPER-TRANSFORMS)",
            &format!(
                "The grasp {grasp} for objects in a {location} is left out: grasps hold for \
                 objects in any place."
            ),
        );
        return done(args[2].clone());
    }
    for kind in &types {
        let Some(kind) = type_text(image, kind) else {
            return Err(Raise::type_error(kind, known::SYMBOL));
        };
        for arm in &arms {
            simulation
                .grasps
                .change(|known| known.define(&kind, *arm, &grasp, definition.clone()))
                .map_err(Raise::reporting)?;
        }
    }
    simulation.forget_what_is_out_of_reach();
    done(args[2].clone())
}

//! Defining grasps.

use crate::log_level::LogLevel;
use crate::simulation::Simulation;
use crate::simulation::motions::sides;
use crate::simulation::names::type_text;
use cram::designator::vocabulary::{Domain, Vocabulary};
use cram::pose::argument;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::world::grasp_library::{GraspDefinition, Lift};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-OBJECT-INTERFACES`.
pub(super) static TABLE: &[Builtin] = builtins![def_object_type_to_gripper_transforms];

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
fn offsets(image: &Image, value: Option<&Value>, what: &str) -> Result<[f64; 3]> {
    value.map_or(Ok([0.0; 3]), |value| triple(image, value, what))
}

/// A lift from its offset along the object's axes, and from its translation and rotation (a
/// quaternion) in the frame of the robot's base.
fn lift_of(
    image: &Image,
    offset: Option<&Value>,
    in_base: Option<&Value>,
    turn: Option<&Value>,
) -> Result<Lift> {
    let mut lift = Lift::along_object(offsets(image, offset, "lift offset")?);
    lift.in_base.translation = offsets(image, in_base, "lift translation")?.into();
    if let Some(turn) = turn {
        lift.in_base.rotation = argument::quaternion(image, turn)?.rotation();
    }
    Ok(lift)
}

/// Defines how objects of the types (one or a list) are grasped by the arms (one or a list). Offsets are
/// relative to the translation, along the object's axes (m); LIFT-TRANSLATION and LIFT-ROTATION (a
/// quaternion) move hand and object along the axes of the robot's base. A grasp that exists is replaced.
///
/// `(progn (obj-int:def-object-type-to-gripper-transforms :bread '(:left :right) :from-above :grasp-translation '(0 0 0.02) :grasp-rot-matrix '((0 1 0) (1 0 0) (0 0 -1)) :pregrasp-offsets '(0 0 0.15) :lift-offsets '(0 0 0.15)) (pp-tut:list-defined-grasps :bread))` => `(:FROM-ABOVE)`
#[builtin]
fn def_object_type_to_gripper_transforms(
    simulation: &mut Simulation,
    image: &mut Image,
    types: &Value,
    arms: &Value,
    grasp: &Value,
    #[key] grasp_translation: Option<&Value>,
    #[key] grasp_rot_matrix: Option<&Value>,
    #[key] pregrasp_offsets: Option<&Value>,
    #[key("2nd-pregrasp-offsets")] second_pregrasp_offsets: Option<&Value>,
    #[key] lift_offsets: Option<&Value>,
    #[key("2nd-lift-offsets")] second_lift_offsets: Option<&Value>,
    #[key] lift_translation: Option<&Value>,
    #[key] lift_rotation: Option<&Value>,
    #[key("2nd-lift-translation")] second_lift_translation: Option<&Value>,
    #[key("2nd-lift-rotation")] second_lift_rotation: Option<&Value>,
    #[key] location_type: Option<&Value>,
) -> Result<Value> {
    let types: Vec<Value> = match types {
        Value::Cons(_) => types.iter_list().collect(),
        single => vec![single.clone()],
    };
    let arms = sides(image, arms)?;
    let Some(name) = type_text(image, grasp) else {
        return Err(Raise::type_error(grasp, known::SYMBOL));
    };
    Vocabulary::of(image).add(Domain::Grasp, [name.as_str()]);
    let definition = GraspDefinition {
        translation: offsets(image, grasp_translation, "grasp translation")?,
        rotation: match grasp_rot_matrix {
            Some(rows) => matrix(image, rows)?,
            None => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        },
        pregrasp: offsets(image, pregrasp_offsets, "pregrasp offset")?,
        second_pregrasp: offsets(image, second_pregrasp_offsets, "pregrasp offset")?,
        lift: lift_of(image, lift_offsets, lift_translation, lift_rotation)?,
        second_lift: lift_of(
            image,
            second_lift_offsets,
            second_lift_translation,
            second_lift_rotation,
        )?,
        opening: None,
    };
    if let Some(location) = location_type.filter(|location| location.is_true()) {
        let [shown, location] = [grasp, location].map(|name| print::to_string(image, name, true));
        simulation.log(
            image,
            LogLevel::Warn,
            "(OBJ-INT DEF-OBJECT-TYPE-TO-GRIPPER-TRANSFORMS)",
            &format!(
                "The grasp {shown} for objects in a {location} is left out: grasps hold for \
                 objects in any place."
            ),
        );
        return Ok(grasp.clone());
    }
    for kind in &types {
        let Some(kind) = type_text(image, kind) else {
            return Err(Raise::type_error(kind, known::SYMBOL));
        };
        for arm in &arms {
            simulation
                .grasps
                .change(|known| known.define(&kind, *arm, &name, definition.clone()))
                .map_err(Raise::reporting)?;
        }
    }
    simulation.forget_what_is_out_of_reach();
    Ok(grasp.clone())
}

//! Defining grasps.

use crate::lisp::builtin::{Builtin, control};
use crate::lisp::builtins::keywords;
use crate::lisp::image::Image;
use crate::lisp::known;
use crate::lisp::number;
use crate::lisp::print;
use crate::lisp::raise::Raise;
use crate::lisp::value::Value;
use crate::plan::Reply;
use crate::session::simulation::Simulation;
use crate::session::simulation::call::{done, host};
use crate::session::simulation::motions::sides;
use crate::session::simulation::names::type_text;
use crate::world::grasp_library::GraspDefinition;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-OBJECT-INTERFACES`.
pub static TABLE: &[Builtin] = &[control(
    "DEF-OBJECT-TYPE-TO-GRIPPER-TRANSFORMS",
    "types arms grasp &key grasp-translation grasp-rot-matrix pregrasp-offsets 2nd-pregrasp-offsets lift-offsets 2nd-lift-offsets lift-translation 2nd-lift-translation location-type",
    "Defines how objects of the types are grasped by the arms.",
    &[],
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
        "2ND-LIFT-OFFSETS",
        "LIFT-TRANSLATION",
        "2ND-LIFT-TRANSLATION",
        "LIFT-ROTATION",
        "2ND-LIFT-ROTATION",
        "LOCATION-TYPE",
    ]
    .map(|name| image.keyword(name));
    let [
        translation,
        rotation,
        pregrasp,
        second_pregrasp,
        lift,
        second_lift,
        lift_in_base,
        second_lift_in_base,
        ..,
    ] = keywords::parse(image, &args[3..], names)?;
    let offset = |image: &Image, value: Option<Value>, what: &str| match value {
        Some(value) => triple(image, &value, what),
        None => Ok([0.0; 3]),
    };
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let definition = GraspDefinition {
        translation: offset(image, translation, "grasp translation")?,
        rotation: match rotation {
            Some(rows) => matrix(image, &rows)?,
            None => identity,
        },
        pregrasp: offset(image, pregrasp, "pregrasp offset")?,
        second_pregrasp: offset(image, second_pregrasp, "pregrasp offset")?,
        lift: offset(image, lift.or(lift_in_base), "lift offset")?,
        second_lift: offset(image, second_lift.or(second_lift_in_base), "lift offset")?,
    };
    for kind in &types {
        let Some(kind) = type_text(image, kind) else {
            return Err(Raise::type_error(kind, known::SYMBOL));
        };
        for arm in &arms {
            simulation
                .grasps
                .define(&kind, *arm, &grasp, definition.clone())
                .map_err(|error| Raise::simple(format!("{error}.")))?;
        }
    }
    done(args[2].clone())
}

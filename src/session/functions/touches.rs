//! Builtins for what a thing has touched, and how hard: for chores that move a tool on a surface.

use crate::simulation::Simulation;
use crate::simulation::names::type_text_of;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static TABLE: &[Builtin] = builtins![watch, end, touches, untouched, own_box, is_kind];

fn force(image: &Image, value: &Value) -> Result<f64> {
    let force = number::to_f64(value).filter(|force| force.is_finite() && *force >= 0.0);
    force.ok_or_else(|| {
        Raise::simple(format!(
            "{} is no force: a number of N from 0 was expected.",
            print::to_string(image, value, true)
        ))
    })
}

/// From now on, notes in every step of the simulation what an object touches below it, and how hard; LEAST
/// and MOST are the forces (N) between which it is right. Forgets what it has touched before.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%watch-touches 'bottle-1 1 3))` => `T`
#[builtin("%WATCH-TOUCHES")]
fn watch(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    least: &Value,
    most: &Value,
) -> Result<bool> {
    let name = simulation.object_named(image, name)?;
    let range = (force(image, least)?, force(image, most)?);
    let watched = simulation.world.watch_touches(&name, range);
    watched.map_err(Raise::reporting)?;
    Ok(true)
}

/// Notes no more what an object touches.
#[builtin("%END-TOUCHES")]
fn end(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<()> {
    let name = simulation.object_named(image, name)?;
    simulation.world.end_touches(&name);
    Ok(())
}

/// What has been noted of the forces (N) from below on an object: (:steps n :within n :mean n :peak n :now n
/// :aside n), the number of steps in which it was touched, of those with the right force, the mean, the
/// greatest and the present force, and the greatest one from a side. NIL if nothing is noted.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%touches 'bottle-1))` => `NIL`
#[builtin("%TOUCHES")]
fn touches(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<Vec<Value>> {
    let name = simulation.object_named(image, name)?;
    let Some(touches) = simulation.world.touches_of(&name) else {
        return Ok(Vec::new());
    };
    // Far fewer steps than a number holds.
    let count = |steps: u64| Value::from(usize::try_from(steps).unwrap_or(usize::MAX));
    let rows = [
        ("STEPS", count(touches.steps())),
        ("WITHIN", count(touches.within())),
        ("MEAN", Value::Double(touches.mean())),
        ("PEAK", Value::Double(touches.peak())),
        ("NOW", Value::Double(touches.now())),
        ("ASIDE", Value::Double(touches.aside())),
    ];
    let mut list = Vec::new();
    for (name, value) in rows {
        list.push(image.keyword(name).into());
        list.push(value);
    }
    Ok(list)
}

/// Those of some points (x y z), in the map (m), at which an object has not touched anything below it since
/// that is noted.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%watch-touches 'bottle-1 1 3) (btr::%untouched 'bottle-1 '((0 0 1))))` => `((0 0 1))`
#[builtin("%UNTOUCHED")]
fn untouched(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    points: &Value,
) -> Result<Vec<Value>> {
    let name = simulation.object_named(image, name)?;
    let touches = simulation.world.touches_of(&name);
    let mut left = Vec::new();
    for point in points.iter_list() {
        let numbers: Vec<f64> = point
            .iter_list()
            .filter_map(|n| number::to_f64(&n))
            .collect();
        let Ok(at) = <[f64; 3]>::try_from(numbers) else {
            return Err(Raise::simple(format!(
                "{} is no point: a list of x, y and z was expected.",
                print::to_string(image, &point, true)
            )));
        };
        if !touches.is_some_and(|touches| touches.has_touched(at)) {
            left.push(point);
        }
    }
    Ok(left)
}

/// The box around an object in its own frame: the least and the greatest x, y and z (m), as two lists.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cube-1 :cube :pose '((1.4 0.6 0.9) (0 0 0 1))) (first (btr::%own-box 'cube-1)))` => `(-0.035d0 -0.035d0 -0.035d0)`
#[builtin("%OWN-BOX")]
fn own_box(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<Value> {
    let name = simulation.object_named(image, name)?;
    let corners = simulation.world.own_box(&name).map_err(Raise::reporting)?;
    Ok(Value::list(
        corners.map(|c| Value::list(c.map(Value::Double))),
    ))
}

/// Is an object of a type, or of one of its kinds?
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%kind-p 'bottle-1 :kitchen-item))` => `T`
#[builtin("%KIND-P")]
fn is_kind(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    kind: &Value,
) -> Result<bool> {
    let name = simulation.object_named(image, name)?;
    let kind = type_text_of(image, kind)?;
    let object = simulation.world.object(&name).map_err(Raise::reporting)?;
    let library = &simulation.world.models().objects;
    Ok(library.is_kind_of(object.type_name(), &kind))
}

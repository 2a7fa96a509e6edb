//! Builtins for what is in vessels.

use super::grains;
use crate::simulation::Simulation;
use crate::simulation::names::{type_keyword, type_text_of};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::world::{Cavity, MIXTURE, Object};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![set_content, content_of, capacity_of, spilled_from];

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static SHAPE_TABLE: &[Builtin] = builtins![hollow_of, level];

/// The object with a name.
fn object<'w>(simulation: &'w Simulation, image: &Image, name: &Value) -> Result<&'w Object> {
    let name = simulation.object_named(image, name)?;
    simulation.world.object(&name).map_err(Raise::reporting)
}

/// Fills a vessel with so much (ml) of something, in place of what was in it; to fill a bottle or a carton is
/// to open it. What is above its rim when it is tilted leaves it, into a vessel below or beside it.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.9) (0 0 0 1))) (set-content 'cup-1 :water 200) (content-of 'cup-1))` => `(:WATER 200.0d0)`
#[builtin(edit)]
fn set_content(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    what: &Value,
    amount: &Value,
) -> Result<Option<Value>> {
    let what = type_text_of(image, what)?;
    let shown = || print::to_string(image, amount, true);
    let volume = number::to_f64(amount).filter(|ml| ml.is_finite() && *ml >= 0.0);
    let Some(volume) = volume else {
        return Err(Raise::simple(format!(
            "{} is no amount: a number of ml from 0 was expected.",
            shown()
        )));
    };
    let vessel = object(simulation, image, name)?;
    let vessel_name = vessel.name().to_owned();
    let Some(cavity) = vessel.cavity() else {
        return Err(Raise::simple(format!(
            "{} is closed: nothing can be filled into it.",
            vessel_name.to_uppercase()
        )));
    };
    let most = cavity.capacity();
    if volume > most {
        return Err(Raise::simple(format!(
            "{} does not hold {} ml: it is full with {most:.0} ml.",
            vessel_name.to_uppercase(),
            shown()
        )));
    }
    let set = simulation.world.set_content(&vessel_name, &what, volume);
    set.map_err(Raise::reporting)?;
    content_of(simulation, image, name)
}

/// What is in a vessel, and how much (ml), as a list; NIL if it is empty. A grain has 0.9 ml.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.9) (0 0 0 1))) (content-of 'cup-1))` => `NIL`
#[builtin]
fn content_of(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
) -> Result<Option<Value>> {
    let vessel = object(simulation, image, name)?;
    let content = vessel.content().clone();
    let level = (content.volume > 0.0).then_some((content.what, content.volume));
    let all = match (level, grains::content(&simulation.world, vessel.name())?) {
        (Some((what, level)), Some((other, grains))) => {
            let is_mixed = what != other;
            let what = if is_mixed { MIXTURE.to_owned() } else { what };
            Some((what, level + grains))
        }
        (level, grains) => level.or(grains),
    };
    Ok(all.map(|(what, volume)| {
        let what = type_keyword(image, &what);
        Value::list([what, Value::Double(volume)])
    }))
}

/// How much (ml) a vessel holds when it is upright; NIL if it is not open at its top.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.9) (0 0 0 1))) (< 220 (capacity-of 'cup-1) 290))` => `T`
#[builtin]
fn capacity_of(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
) -> Result<Option<f64>> {
    let cavity = object(simulation, image, name)?.cavity();
    Ok(cavity.map(Cavity::capacity))
}

/// How much (ml) has left a vessel since it was filled and has fallen beside every other one.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.9) (0 0 0 1))) (spilled-from 'cup-1))` => `0.0d0`
#[builtin]
fn spilled_from(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<f64> {
    let vessel = object(simulation, image, name)?;
    Ok(vessel.content().spilled + grains::spilled(&simulation.world, vessel.name())?)
}

/// Where the mouth of a vessel is in its own frame, and how wide: x, y, z of its middle, its radius, the z of
/// its foot, how far it is wider than its mouth (m), and how much (ml) falls out of its holes each time it is
/// shaken, or NIL, as a list; NIL if it is not open at its top.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'fork-1 :fork :pose '((1.4 0.6 0.9) (0 0 0 1))) (btr::%cavity 'fork-1))` => `NIL`
#[builtin("%CAVITY")]
fn hollow_of(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
) -> Result<Option<Value>> {
    let cavity = object(simulation, image, name)?.cavity();
    Ok(cavity.map(|cavity| {
        let [x, y] = cavity.axis;
        let numbers = [x, y, cavity.rim, cavity.mouth, cavity.foot, cavity.shoulder];
        let portion = cavity.portion.map_or(Value::NIL, Value::Double);
        Value::list(numbers.map(Value::Double).into_iter().chain([portion]))
    }))
}

/// How much (ml) a vessel holds when it is tilted by an angle (rad); 0 if it is not open.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'fork-1 :fork :pose '((1.4 0.6 0.9) (0 0 0 1))) (btr::%level 'fork-1 0))` => `0.0d0`
#[builtin("%LEVEL")]
fn level(simulation: &mut Simulation, image: &mut Image, name: &Value, tilt: f64) -> Result<f64> {
    if !tilt.is_finite() {
        return Err(Raise::type_error(&Value::Double(tilt), known::REAL));
    }
    let cavity = object(simulation, image, name)?.cavity();
    Ok(cavity.map_or(0.0, |cavity| cavity.volume_at(tilt.abs())))
}

//! Builtins for grains: small balls in vessels.

use crate::simulation::Simulation;
use crate::simulation::names::{type_keyword, type_text_of};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::world::{GRAIN_VOLUME, MIXTURE, World};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![fill_with_grains, grains_in, remove_spilled_grains];

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static SHAPE_TABLE: &[Builtin] = builtins![volume_of_grains, grains_that_fit];

/// The colour of grains for which none is given: that of rice.
const COLOR: [f32; 4] = [0.93, 0.9, 0.78, 1.0];

/// How much (ml) is in a vessel in grains, and what they are; nothing if there are none.
pub(super) fn content(world: &World, name: &str) -> Result<Option<(String, f64)>> {
    let all = world.grains_in(name).map_err(Raise::reporting)?;
    let count: usize = all.iter().map(|(_, count)| count).sum();
    let what = match all.as_slice() {
        [] => return Ok(None),
        [(what, _)] => (*what).to_owned(),
        _ => MIXTURE.to_owned(),
    };
    Ok(Some((what, count as f64 * GRAIN_VOLUME)))
}

/// How much (ml) has been lost from a vessel in grains.
pub(super) fn spilled(world: &World, name: &str) -> Result<f64> {
    let lost = world.grains_spilled_from(name).map_err(Raise::reporting)?;
    Ok(lost as f64 * GRAIN_VOLUME)
}

/// Fills a vessel with so many grains, balls with a radius of 6 mm, in place of what was in it. COLOR is a list of
/// red, green and blue. They settle as time passes. Returns the same as GRAINS-IN.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.9) (0 0 0 1))) (fill-with-grains 'cup-1 :rice 50))` => `(:RICE 50)`
#[builtin("FILL-WITH-GRAINS", "name what count &key color", edit)]
fn fill_with_grains(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    what: &Value,
    count: usize,
    #[key] color: Option<&Value>,
) -> Result<Value> {
    let what = type_text_of(image, what)?;
    let shown = color
        .map(super::objects::color)
        .transpose()?
        .unwrap_or(COLOR);
    let vessel = simulation.object_named(image, name)?;
    let fit = simulation
        .world
        .grains_that_fit(&vessel)
        .map_err(Raise::reporting)?;
    match fit {
        None => {
            let told = format!(
                "{} is no open vessel: grains do not get into it.",
                vessel.to_uppercase()
            );
            return Err(Raise::simple(told));
        }
        Some(most) if count > most => {
            let told = format!(
                "{} does not hold {count} grains: it is full with {most}.",
                vessel.to_uppercase()
            );
            return Err(Raise::simple(told));
        }
        Some(_) => {}
    }
    simulation
        .world
        .fill_with_grains(&vessel, &what, count, shown)
        .map_err(Raise::reporting)?;
    grains_in(simulation, image, name)
}

/// What grains are in a vessel, and how many of each: as (:RICE 50), NIL if there are none.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.9) (0 0 0 1))) (grains-in 'cup-1))` => `NIL`
#[builtin]
fn grains_in(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<Value> {
    let vessel = simulation.object_named(image, name)?;
    let all = simulation
        .world
        .grains_in(&vessel)
        .map_err(Raise::reporting)?;
    let parts = all
        .into_iter()
        .flat_map(|(what, count)| [type_keyword(image, what), Value::from(count)]);
    Ok(Value::list(parts.collect::<Vec<_>>()))
}

/// Removes the grains that are in no vessel. Returns how many.
///
/// `(progn (pp-tut:init-projection) (remove-spilled-grains))` => `0`
#[builtin(edit)]
fn remove_spilled_grains(simulation: &mut Simulation) -> usize {
    simulation.world.remove_spilled_grains()
}

/// How much (ml) of what is in a vessel are grains.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.9) (0 0 0 1))) (btr::%volume-of-grains 'cup-1))` => `0.0d0`
#[builtin("%VOLUME-OF-GRAINS")]
fn volume_of_grains(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<f64> {
    let vessel = simulation.object_named(image, name)?;
    let known = content(&simulation.world, &vessel)?;
    Ok(known.map_or(0.0, |(_, volume)| volume))
}

/// How many grains fit into a vessel, when it is filled up to its rim; 0 if none get in.
///
/// `(progn (pp-tut:init-projection) (btr-utils:spawn-object 'fork-1 :fork :pose '((1.4 0.6 0.9) (0 0 0 1))) (btr::%grains-that-fit 'fork-1))` => `0`
#[builtin("%GRAINS-THAT-FIT")]
fn grains_that_fit(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<usize> {
    let vessel = simulation.object_named(image, name)?;
    let fit = simulation.world.grains_that_fit(&vessel);
    Ok(fit.map_err(Raise::reporting)?.unwrap_or(0))
}

//! What plans ask of how the arms carry what is open at the top.

use crate::simulation::Simulation;
use crate::simulation::motions::side;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::motion::{carries, carrying_posture};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-MOBILE-PICK-PLACE-PLANS`.
pub(super) static TABLE: &[Builtin] =
    builtins![upright_in_hand, posture_for_carrying, carries_upright_p];

/// The name of what a hand holds upright and what is open at the top, as a cup or a plate is; NIL if it holds
/// no such thing.
///
/// `(progn (pp-tut:init-projection) (pp-plans::upright-in-hand :left))` => `NIL`
#[builtin]
fn upright_in_hand(
    simulation: &mut Simulation,
    image: &mut Image,
    arm: &Value,
) -> Result<Option<Value>> {
    let side = side(image, arm)?;
    let held = simulation.world.upright_in_hand(side);
    let name = held.map(|(object, _)| object.name().to_owned());
    Ok(name.map(|name| simulation.symbol_of(&name)))
}

/// The joint angles of a posture near the body in which what an arm holds upright stays so, and to which it
/// finds a path on which that stays so; NIL if it holds nothing that is open at the top, or if there is none.
///
/// `(progn (pp-tut:init-projection) (pp-plans::carrying-posture :left))` => `NIL`
#[builtin("CARRYING-POSTURE")]
fn posture_for_carrying(
    simulation: &mut Simulation,
    image: &mut Image,
    arm: &Value,
) -> Result<Option<Value>> {
    let side = side(image, arm)?;
    let found = carrying_posture(&simulation.world, side);
    if found.is_some() {
        simulation.carrying[side.index()] = found;
    }
    Ok(found.map(|angles| Value::list(angles.iter().map(|a| Value::Double(*a)))))
}

/// Is an arm that holds something upright in a posture for carrying that, up to an angle (rad) for each
/// joint?
///
/// `(progn (pp-tut:init-projection) (pp-plans::carries-upright-p :left 0.02))` => `NIL`
#[builtin]
fn carries_upright_p(
    simulation: &mut Simulation,
    image: &mut Image,
    arm: &Value,
    tolerance: &Value,
) -> Result<bool> {
    let side = side(image, arm)?;
    let tolerance = number::to_f64(tolerance).unwrap_or(0.0);
    let found = simulation.carrying[side.index()].as_ref();
    Ok(carries(&simulation.world, side, found, tolerance))
}

//! What plans ask of how the arms carry what is open at the top.

use crate::host::call::{done, host};
use crate::simulation::Simulation;
use crate::simulation::motions::side;
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::motion::{carries, carrying_posture};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-MOBILE-PICK-PLACE-PLANS`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "UPRIGHT-IN-HAND",
        "arm",
        "The name of what a hand holds upright and what is open at the top, as a cup or a plate is; NIL if it holds no such thing.",
        &["(progn (pp-tut:init-projection) (pp-plans::upright-in-hand :left)) => NIL"],
        host!(upright_in_hand),
    ),
    control(
        "CARRYING-POSTURE",
        "arm",
        "The joint angles of a posture near the body in which what an arm holds upright stays so, and to which it finds a path on which that stays so; NIL if it holds nothing that is open at the top, or if there is none.",
        &["(progn (pp-tut:init-projection) (pp-plans::carrying-posture :left)) => NIL"],
        host!(posture_for_carrying),
    ),
    control(
        "CARRIES-UPRIGHT-P",
        "arm tolerance",
        "Is an arm that holds something upright in a posture for carrying that, up to an angle (rad) for each joint?",
        &["(progn (pp-tut:init-projection) (pp-plans::carries-upright-p :left 0.02)) => NIL"],
        host!(carries_upright),
    ),
];

fn upright_in_hand(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let side = side(image, &args[0])?;
    let held = simulation.world.upright_in_hand(side);
    let name = held.map(|(object, _)| object.name().to_owned());
    done(name.map_or(Value::NIL, |name| simulation.symbol_of(&name)))
}

fn posture_for_carrying(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let side = side(image, &args[0])?;
    let found = carrying_posture(&simulation.world, side);
    done(found.map_or(Value::NIL, |angles| {
        Value::list(angles.iter().map(|a| Value::Double(*a)))
    }))
}

fn carries_upright(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let side = side(image, &args[0])?;
    let tolerance = number::to_f64(&args[1]).unwrap_or(0.0);
    done(carries(&simulation.world, side, tolerance))
}

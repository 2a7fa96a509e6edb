//! Builtins for what is in vessels.

use crate::host::call::{done, edit, host};
use crate::simulation::Simulation;
use crate::simulation::names::{type_keyword, type_text_of};
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::world::{Cavity, Object};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "SET-CONTENT",
        "name what amount",
        "Fills a vessel with so much (ml) of something, in place of what was in it; to fill a bottle or a carton is to open it. What is above its rim when it is tilted leaves it, into a vessel below or beside it.",
        &[
            "(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.9) (0 0 0 1))) (set-content 'cup-1 :water 200) (content-of 'cup-1)) => (:WATER 200.0d0)",
        ],
        edit!(set_content),
    ),
    control(
        "CONTENT-OF",
        "name",
        "What is in a vessel, and how much (ml), as a list; NIL if it is empty.",
        &[
            "(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.9) (0 0 0 1))) (content-of 'cup-1)) => NIL",
        ],
        host!(content_of),
    ),
    control(
        "CAPACITY-OF",
        "name",
        "How much (ml) a vessel holds when it is upright; NIL if it is not open at its top.",
        &[
            "(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.9) (0 0 0 1))) (< 220 (capacity-of 'cup-1) 290)) => T",
        ],
        host!(capacity_of),
    ),
    control(
        "SPILLED-FROM",
        "name",
        "How much (ml) has left a vessel since it was filled and has fallen beside every other one.",
        &[
            "(progn (pp-tut:init-projection) (btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.9) (0 0 0 1))) (spilled-from 'cup-1)) => 0.0d0",
        ],
        host!(spilled_from),
    ),
];

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static SHAPE_TABLE: &[Builtin] = &[
    control(
        "%CAVITY",
        "name",
        "Where the mouth of a vessel is in its own frame, and how wide: x, y, z of its middle, its radius, the z of its foot, how far it is wider than its mouth (m), and how much (ml) falls out of its holes each time it is shaken, or NIL, as a list; NIL if it is not open at its top.",
        &[
            "(progn (pp-tut:init-projection) (btr-utils:spawn-object 'fork-1 :fork :pose '((1.4 0.6 0.9) (0 0 0 1))) (btr::%cavity 'fork-1)) => NIL",
        ],
        host!(hollow_of),
    ),
    control(
        "%LEVEL",
        "name tilt",
        "How much (ml) a vessel holds when it is tilted by an angle (rad); 0 if it is not open.",
        &[
            "(progn (pp-tut:init-projection) (btr-utils:spawn-object 'fork-1 :fork :pose '((1.4 0.6 0.9) (0 0 0 1))) (btr::%level 'fork-1 0)) => 0.0d0",
        ],
        host!(level),
    ),
];

/// The object with a name.
fn object<'w>(simulation: &'w Simulation, image: &Image, name: &Value) -> Result<&'w Object> {
    let name = simulation.object_named(image, name)?;
    simulation.world.object(&name).map_err(Raise::reporting)
}

fn set_content(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let what = type_text_of(image, &args[1])?;
    let shown = || print::to_string(image, &args[2], true);
    let amount = number::to_f64(&args[2]).filter(|ml| ml.is_finite() && *ml >= 0.0);
    let Some(amount) = amount else {
        return Err(Raise::simple(format!(
            "{} is no amount: a number of ml from 0 was expected.",
            shown()
        )));
    };
    let vessel = object(simulation, image, &args[0])?;
    let name = vessel.name().to_owned();
    let Some(cavity) = vessel.cavity() else {
        return Err(Raise::simple(format!(
            "{} is closed: nothing can be filled into it.",
            name.to_uppercase()
        )));
    };
    let most = cavity.capacity();
    if amount > most {
        return Err(Raise::simple(format!(
            "{} does not hold {} ml: it is full with {most:.0} ml.",
            name.to_uppercase(),
            shown()
        )));
    }
    let set = simulation.world.set_content(&name, &what, amount);
    set.map_err(Raise::reporting)?;
    content_of(simulation, image, args)
}

fn content_of(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let content = object(simulation, image, &args[0])?.content().clone();
    done(match content.volume > 0.0 {
        true => Value::list([
            type_keyword(image, &content.what),
            Value::Double(content.volume),
        ]),
        false => Value::NIL,
    })
}

fn capacity_of(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let cavity = object(simulation, image, &args[0])?.cavity();
    done(cavity.map_or(Value::NIL, |cavity| Value::Double(cavity.capacity())))
}

fn spilled_from(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let content = object(simulation, image, &args[0])?.content();
    done(Value::Double(content.spilled))
}

fn hollow_of(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let cavity = object(simulation, image, &args[0])?.cavity();
    done(cavity.map_or(Value::NIL, |cavity| {
        let [x, y] = cavity.axis;
        let numbers = [x, y, cavity.rim, cavity.mouth, cavity.foot, cavity.shoulder];
        let portion = cavity.portion.map_or(Value::NIL, Value::Double);
        Value::list(numbers.map(Value::Double).into_iter().chain([portion]))
    }))
}

fn level(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let tilt = number::to_f64(&args[1]).filter(|tilt| tilt.is_finite());
    let Some(tilt) = tilt else {
        return Err(Raise::type_error(&args[1], lisp::value::known::REAL));
    };
    let cavity = object(simulation, image, &args[0])?.cavity();
    let level = cavity.map_or(0.0, |cavity: &Cavity| cavity.volume_at(tilt.abs()));
    done(Value::Double(level))
}

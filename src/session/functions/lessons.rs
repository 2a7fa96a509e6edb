//! What lessons ask of the session: what has happened, and which lessons are built in.

use crate::deeds::{Deed, Deeds};
use crate::host::SimulationHost;
use crate::host::call::{done, edit};
use cram::Reply;
use lisp::builtin::{Builtin, control, pure};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::robot::Side;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLAN-SYSTEM`, which `PLANWRIGHT` imports.
pub(super) static TABLE: &[Builtin] = &[
    pure(
        "%DEEDS",
        "",
        "What has happened since a lesson began, in order: lists of a keyword and what it is about.",
        &["(pw::%deeds) => NIL"],
        deeds,
    ),
    control(
        "%BEGIN-DEEDS",
        "",
        "What happens is noted from now on.",
        &[],
        edit!(begin),
    ),
    pure(
        "%LESSON-NAMES",
        "",
        "The names of the lessons that are built in.",
        &["(first (pw::%lesson-names)) => \"bring-the-bottle\""],
        names,
    ),
];

fn deeds(image: &mut Image, _: &[Value]) -> Result<Value> {
    let all = Deeds::of(image).all();
    let values = all.iter().map(|deed| {
        let (kind, parts): (&str, Vec<Value>) = match deed {
            Deed::Held { object, side } => ("HELD", vec![text(object), text(name_of(*side))]),
            Deed::Released { object, side } => {
                ("RELEASED", vec![text(object), text(name_of(*side))])
            }
            Deed::Performed(name) => ("PERFORMED", vec![text(name)]),
            Deed::Failed { motion, class } => ("FAILED", vec![text(motion), text(class)]),
            Deed::Collided(bodies) => ("COLLIDED", bodies.iter().map(|b| text(b)).collect()),
            Deed::Ended(class) => {
                let class = class.as_deref().map_or(Value::NIL, text);
                ("ENDED", vec![class])
            }
        };
        let mut values = vec![Value::from(image.keyword(kind))];
        values.extend(parts);
        Value::list(values)
    });
    let values: Vec<Value> = values.collect();
    Ok(Value::list(values))
}

fn text(text: &str) -> Value {
    Value::string(text)
}

fn name_of(side: Side) -> &'static str {
    match side {
        Side::Left => "LEFT",
        Side::Right => "RIGHT",
    }
}

fn begin(host: &mut SimulationHost, image: &mut Image, _: &[Value]) -> Result<Reply> {
    let deeds = Deeds::of(image);
    deeds.set(Vec::new());
    if let Some(witness) = deeds.witness() {
        host.audience.remove_follower(witness);
    }
    let witness = Box::new(std::rc::Rc::clone(&deeds).observer());
    let (audience, simulation) = (&mut host.audience, &host.simulation);
    let witness = audience.add_follower(simulation, image, witness);
    deeds.set_witness(Some(witness));
    done(Value::NIL)
}

fn names(_: &mut Image, _: &[Value]) -> Result<Value> {
    let names: Vec<Value> = plan_files::lesson_names().map(text).collect();
    Ok(Value::list(names))
}

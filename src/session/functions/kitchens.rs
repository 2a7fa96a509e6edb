//! Other kitchens than the one in which a session began: generated ones.

use crate::host::SimulationHost;
use crate::host::call::{done, edit};
use crate::options::generated_kitchen;
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::robot::KinematicTree;
use robotics::world::KitchenDescription;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = &[control(
    "NEW-KITCHEN",
    "&optional seed",
    "Puts the robot into the generated kitchen of a seed, without objects; without a seed, into the kitchen in which the session began. Returns what is remarkable about it: how its furniture is arranged, the size of the room, the narrowest way between rows that face each other and the height of the counter (m), the number of drawers.",
    &[
        "(getf (new-kitchen 7) :arrangement) => :L",
        "(new-kitchen) => NIL",
    ],
    edit!(new_kitchen),
)];

fn new_kitchen(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let seed = match args.first().filter(|seed| seed.is_true()) {
        None => None,
        Some(given) => Some(seed_of(given)?),
    };
    if host.audience.shows_kitchen() {
        return Err(Raise::simple(
            "The live view and recordings show one kitchen: end them, or start planwright with --world generated:SEED.",
        ));
    }
    let simulation = &mut host.simulation;
    if !simulation.jobs.is_idle() {
        return Err(Raise::simple(
            "The robot moves: stop it before it gets another kitchen.",
        ));
    }
    let Some(seed) = seed else {
        simulation.go_home();
        simulation.restart();
        return done(Value::NIL);
    };
    let kitchen = generated_kitchen(seed).map_err(Raise::reporting)?;
    let name = format!("generated:{seed}");
    let tree = KinematicTree::built_in(&kitchen.urdf, &name).map_err(Raise::reporting)?;
    let description = KitchenDescription::from_sexp(&kitchen.description, &name, &tree)
        .map_err(Raise::reporting)?;
    let models = simulation.models.with_kitchen(tree, description);
    simulation.begin_with(&models);
    let facts = kitchen.facts;
    // As the reader makes it of a decimal fraction.
    let length = |length: f64| Value::Single(((length * 1e3).round() / 1e3) as f32);
    let arrangement = facts.arrangement.name().to_uppercase();
    let aisle = match facts.aisle.is_finite() {
        true => length(facts.aisle),
        false => Value::NIL,
    };
    let entries = [
        ("ARRANGEMENT", image.keyword(&arrangement).into()),
        ("ROOM", Value::list(facts.room.map(length))),
        ("AISLE", aisle),
        ("COUNTER-HEIGHT", length(facts.counter_height)),
        ("DRAWERS", Value::from(facts.drawers as i64)),
        ("TABLE", facts.has_table.into()),
    ];
    let entries: Vec<Value> = entries
        .into_iter()
        .flat_map(|(key, value)| [image.keyword(key).into(), value])
        .collect();
    done(Value::list(entries))
}

/// The seed that a value is.
fn seed_of(given: &Value) -> Result<u64> {
    let seed = match given {
        Value::Int(seed) => u64::try_from(*seed).ok(),
        Value::Big(seed) => u64::try_from(&**seed).ok(),
        _ => None,
    };
    seed.ok_or_else(|| Raise::simple("A seed is an integer from 0 to 18446744073709551615."))
}

//! Restoring earlier states of the world: `rewind`, `snapshot`, `restore`.

use crate::host::SimulationHost;
use crate::printing::on_one_line;
use crate::simulation::Simulation;
use crate::simulation::names::name_text;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![rewind, snapshot, restore, world_hash];

fn say(image: &mut Image, text: &str) {
    image.output.fresh_line();
    image.output.write(text);
    image.output.write("\n");
}

/// Restores the world to before the last COUNT forms at the prompt that changed it (default: 1). Objects, the
/// robot and what it holds are restored; Lisp variables and simulated time are not.
#[builtin(edit)]
fn rewind(host: &mut SimulationHost, image: &mut Image, count: Option<&Value>) -> Result<bool> {
    let count = match count {
        None => 1,
        Some(Value::Int(n)) if *n > 0 => usize::try_from(*n).unwrap_or(usize::MAX),
        Some(other) => return Err(Raise::type_error(other, known::INTEGER)),
    };
    let form = host.person.snapshots.rewind(&mut host.simulation, count)?;
    let shown = print::to_string(image, &form, true);
    let shown = on_one_line(&shown);
    say(
        image,
        &format!("; The world is as before {shown}; Lisp variables keep their values."),
    );
    Ok(true)
}

fn text_of(image: &Image, value: &Value) -> Result<String> {
    name_text(image, value).ok_or_else(|| Raise::type_error(value, known::SYMBOL))
}

/// Saves the world as it is now under a name, for RESTORE. Returns the name.
///
/// `(pw:snapshot 'before-lunch)` => `BEFORE-LUNCH`
#[builtin]
fn snapshot(host: &mut SimulationHost, image: &mut Image, name: &Value) -> Result<Value> {
    let text = text_of(image, name)?;
    host.person.keep_snapshot(&host.simulation, &text);
    Ok(name.clone())
}

/// Restores the world that SNAPSHOT saved under the name. Lisp variables and simulated time stay.
///
/// `(progn (pw:snapshot 'now) (pw:restore 'now))` => `NOW`
#[builtin(edit)]
fn restore(host: &mut SimulationHost, image: &mut Image, name: &Value) -> Result<Value> {
    let text = text_of(image, name)?;
    host.person
        .snapshots
        .restore_kept(&mut host.simulation, &text)?;
    say(
        image,
        &format!("; The world is as in {text}; Lisp variables keep their values."),
    );
    Ok(name.clone())
}

/// A hash of the whole state of the world, sixteen hexadecimal digits: equal worlds have equal hashes.
///
/// `(equal (pw:world-hash) (pw:world-hash))` => `T`
#[builtin]
fn world_hash(simulation: &mut Simulation) -> String {
    format!("{:016x}", simulation.world.hash())
}

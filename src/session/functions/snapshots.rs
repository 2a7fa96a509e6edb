//! Restoring earlier states of the world: `rewind`, `snapshot`, `restore`.

use crate::host::SimulationHost;
use crate::host::call::{done, edit, host};
use crate::printing::on_one_line;
use crate::simulation::Simulation;
use crate::simulation::names::name_text;
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "REWIND",
        "&optional count",
        "Restores the world to before the last COUNT forms at the prompt that changed it (default: 1). Objects, the robot and what it holds are restored; Lisp variables and simulated time are not.",
        &[],
        edit!(rewind),
    ),
    control(
        "SNAPSHOT",
        "name",
        "Saves the world as it is now under a name, for RESTORE. Returns the name.",
        &["(pw:snapshot 'before-lunch) => BEFORE-LUNCH"],
        host!(snapshot),
    ),
    control(
        "RESTORE",
        "name",
        "Restores the world that SNAPSHOT saved under the name. Lisp variables and simulated time stay.",
        &["(progn (pw:snapshot 'now) (pw:restore 'now)) => NOW"],
        edit!(restore),
    ),
    control(
        "WORLD-HASH",
        "",
        "A hash of the whole state of the world, sixteen hexadecimal digits: equal worlds have equal hashes.",
        &["(equal (pw:world-hash) (pw:world-hash)) => T"],
        host!(world_hash),
    ),
];

fn say(image: &mut Image, text: &str) {
    image.output.fresh_line();
    image.output.write(text);
    image.output.write("\n");
}

fn rewind(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let count = match args.first() {
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
    done(Value::T)
}

fn name(image: &Image, value: &Value) -> Result<String> {
    name_text(image, value).ok_or_else(|| Raise::type_error(value, known::SYMBOL))
}

fn snapshot(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = name(image, &args[0])?;
    host.person.keep_snapshot(&host.simulation, &name);
    done(args[0].clone())
}

fn restore(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = name(image, &args[0])?;
    host.person
        .snapshots
        .restore_kept(&mut host.simulation, &name)?;
    say(
        image,
        &format!("; The world is as in {name}; Lisp variables keep their values."),
    );
    done(args[0].clone())
}

fn world_hash(simulation: &mut Simulation, _: &mut Image, _: &[Value]) -> Result<Reply> {
    done(Value::string(format!("{:016x}", simulation.world.hash())))
}

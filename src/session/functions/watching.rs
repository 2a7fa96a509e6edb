//! Watching the session: the live view, and recordings.

use std::path::Path;

use crate::host::SimulationHost;
use crate::host::call::{done, edit, host};
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use view::watch::live::open_in_browser;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "VIEW",
        "&optional (on t)",
        "Opens the live view in the browser and returns its address; with NIL, closes it. While it is open, simulated time passes as fast as real time.",
        &["(pw:view nil) => NIL"],
        edit!(view),
    ),
    control(
        "RECORD",
        "file",
        "Starts to record the session into an MCAP file, which Foxglove and `planwright view` show; with NIL, ends the recording.",
        &["(pw:record nil) => NIL"],
        host!(record),
    ),
    control(
        "SAVE-VIEW",
        "file",
        "Writes one HTML file that any browser shows without planwright and without a network: the page of the live view with all that has been seen since the view was opened, with its slider; if it is not open, the world as it is now. Returns the file's name.",
        &[],
        host!(save_view),
    ),
];

fn view(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply, Box<Raise>> {
    if args.first().is_some_and(Value::is_nil) {
        host.audience.close_view();
        return done(Value::NIL);
    }
    let was_open = host.audience.view_server().is_some();
    let address = host
        .audience
        .open_view(&host.simulation, image)
        .map_err(Raise::reporting)?;
    if !was_open {
        open_in_browser(&address);
    }
    done(Value::string(address))
}

fn save_view(
    host: &mut SimulationHost,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply, Box<Raise>> {
    let Value::Str(name) = &args[0] else {
        return Err(Raise::type_error(&args[0], known::STRING));
    };
    let SimulationHost {
        simulation,
        audience,
        ..
    } = host;
    audience
        .save_view(simulation, image, Path::new(&name.text()))
        .map_err(Raise::reporting)?;
    done(args[0].clone())
}

fn record(
    host: &mut SimulationHost,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply, Box<Raise>> {
    let SimulationHost {
        simulation,
        audience,
        ..
    } = host;
    let told = match &args[0] {
        Value::Str(name) => audience.begin_recording(simulation, image, Path::new(&name.text())),
        nothing if nothing.is_nil() => audience.end_recording(simulation),
        other => return Err(Raise::type_error(other, known::STRING)),
    };
    told.map_err(Raise::reporting)?;
    done(args[0].clone())
}

//! Watching the session: the live view, and recordings.

use std::path::Path;
use std::rc::Rc;

use crate::host::SimulationHost;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::value::string::LispString;
use view::watch::live::open_in_browser;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![view, record, save_view];

/// Opens the live view in the browser and returns its address; with NIL, closes it. While it is open,
/// simulated time passes as fast as real time.
///
/// `(pw:view nil)` => `NIL`
#[builtin(_, "&optional (on t)", edit)]
fn view(
    host: &mut SimulationHost,
    image: &mut Image,
    on: Option<&Value>,
) -> Result<Option<String>> {
    if on.is_some_and(Value::is_nil) {
        host.audience.close_view();
        return Ok(None);
    }
    let was_open = host.audience.view_server().is_some();
    let address = host
        .audience
        .open_view(&host.simulation, image)
        .map_err(Raise::reporting)?;
    if !was_open {
        open_in_browser(&address);
    }
    Ok(Some(address))
}

/// Writes one HTML file that any browser shows without planwright and without a network: the page of the live
/// view with all that has been seen since the view was opened, with its slider; if it is not open, the world
/// as it is now. Returns the file's name.
#[builtin]
fn save_view(host: &mut SimulationHost, image: &mut Image, file: &Rc<LispString>) -> Result<Value> {
    let SimulationHost {
        simulation,
        audience,
        ..
    } = host;
    audience
        .save_view(simulation, image, Path::new(&file.text()))
        .map_err(Raise::reporting)?;
    Ok(Value::Str(Rc::clone(file)))
}

/// Starts to record the session into an MCAP file, which Foxglove and `planwright view` show; with NIL, ends
/// the recording.
///
/// `(pw:record nil)` => `NIL`
#[builtin]
fn record(host: &mut SimulationHost, image: &mut Image, file: &Value) -> Result<Value> {
    let SimulationHost {
        simulation,
        audience,
        ..
    } = host;
    let told = match file {
        Value::Str(name) => audience.begin_recording(simulation, image, Path::new(&name.text())),
        nothing if nothing.is_nil() => audience.end_recording(simulation),
        other => return Err(Raise::type_error(other, known::STRING)),
    };
    told.map_err(Raise::reporting)?;
    Ok(file.clone())
}

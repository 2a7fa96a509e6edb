//! Builtins for cutting a thing with a blade.

use crate::simulation::Simulation;
use crate::simulation::names::{name_text, type_text_of};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use robotics::world::{NotCut, PieceNames};

/// The kind of what can be cut.
const FOOD: &str = "food";

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static TABLE: &[Builtin] = builtins![blade, begin_cut, end_cut, cut];

/// The blade of an object, in its own frame (m): its middle (x y z), the direction of its tip, that of its
/// edge, half its length, and half its height; NIL if it has none.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%blade 'bottle-1))` => `NIL`
#[builtin("%BLADE")]
fn blade(simulation: &mut Simulation, image: &mut Image, name: &Value) -> Result<Option<Value>> {
    let name = simulation.object_named(image, name)?;
    let object = simulation.world.object(&name).map_err(Raise::reporting)?;
    let point = |p: [f64; 3]| Value::list(p.map(Value::Double));
    Ok(object.blade().map(|blade| {
        let [length, height] = blade.half.map(Value::Double);
        let directions = [blade.middle, blade.tip, blade.edge].map(point);
        Value::list(directions.into_iter().chain([length, height]))
    }))
}

/// From now on, a tool passes through what it is to cut, and through its pieces. T, or a text that says why
/// it cannot.
#[builtin("%BEGIN-CUT")]
fn begin_cut(
    simulation: &mut Simulation,
    image: &mut Image,
    tool: &Value,
    food: &Value,
) -> Result<Value> {
    let tool = simulation.object_named(image, tool)?;
    let food = simulation.object_named(image, food)?;
    let object = simulation.world.object(&food).map_err(Raise::reporting)?;
    let library = &simulation.world.models().objects;
    if !library.is_kind_of(object.type_name(), FOOD) {
        return Ok(Value::from(format!("{food} is no food")));
    }
    match simulation.world.begin_cut(&tool, &food) {
        Ok(()) => Ok(Value::T),
        Err(why) => Ok(Value::from(why.to_string())),
    }
}

/// A tool passes through nothing any more.
#[builtin("%END-CUT")]
fn end_cut(simulation: &mut Simulation, image: &mut Image, tool: &Value) -> Result<()> {
    let tool = simulation.object_named(image, tool)?;
    simulation.world.end_cut(&tool);
    Ok(())
}

/// Parts what a tool in a hand cuts where its blade is. The smaller piece gets the name and the type SLICE,
/// the other one, or the one that a hand holds, those of REST. The value is (slice rest), each as (name
/// volume thickness) (m³, m); a text if the blade is not all the way through.
#[builtin("%CUT")]
fn cut(
    simulation: &mut Simulation,
    image: &mut Image,
    tool: &Value,
    food: &Value,
    slice: &Value,
    slice_type: &Value,
    rest: &Value,
    rest_type: &Value,
) -> Result<Value> {
    let tool = simulation.object_named(image, tool)?;
    let food = simulation.object_named(image, food)?;
    let named = |value: &Value| {
        let name = name_text(image, value);
        name.ok_or_else(|| Raise::type_error(value, known::SYMBOL))
    };
    let (slice_name, rest_name) = (named(slice)?, named(rest)?);
    let (slice_type, rest_type) = (
        type_text_of(image, slice_type)?,
        type_text_of(image, rest_type)?,
    );
    for name in [&slice_name, &rest_name] {
        if *name != food && simulation.world.object(name).is_ok() {
            return Ok(Value::from(format!("there is a {name} already")));
        }
    }
    let names = PieceNames {
        slice: &slice_name,
        slice_type: &slice_type,
        rest: &rest_name,
        rest_type: &rest_type,
    };
    let pieces = match simulation.world.cut(&tool, &food, names) {
        Ok(pieces) => pieces,
        Err(NotCut::World(error)) => return Err(Raise::reporting(error)),
        Err(why) => return Ok(Value::from(why.to_string())),
    };
    simulation.names.shift_remove(&food);
    let held = simulation.held.shift_remove(&food);
    if let Some(held) = held {
        simulation.held.insert(rest_name.clone(), held);
    }
    for (name, symbol) in [(slice_name, slice), (rest_name, rest)] {
        simulation.names.insert(name, symbol.clone());
    }
    let rows = [slice.clone(), rest.clone()].into_iter().zip(pieces);
    let rows = rows.map(|(symbol, piece)| {
        Value::list([
            symbol,
            Value::Double(piece.volume),
            Value::Double(piece.thickness),
        ])
    });
    Ok(Value::list(rows))
}

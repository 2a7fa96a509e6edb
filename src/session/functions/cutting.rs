//! Builtins for cutting a thing with a blade.

use crate::host::call::{done, host};
use crate::simulation::Simulation;
use crate::simulation::names::{name_text, type_text_of};
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use robotics::world::{NotCut, PieceNames};

/// The kind of what can be cut.
const FOOD: &str = "food";

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "%BLADE",
        "name",
        "The blade of an object, in its own frame (m): its middle (x y z), the direction of its tip, that of its edge, half its length, and half its height; NIL if it has none.",
        &[
            "(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%blade 'bottle-1)) => NIL",
        ],
        host!(blade),
    ),
    control(
        "%BEGIN-CUT",
        "tool food",
        "From now on, a tool passes through what it is to cut, and through its pieces. T, or a text that says why it cannot.",
        &[],
        host!(begin_cut),
    ),
    control(
        "%END-CUT",
        "tool",
        "A tool passes through nothing any more.",
        &[],
        host!(end_cut),
    ),
    control(
        "%CUT",
        "tool food slice slice-type rest rest-type",
        "Parts what a tool in a hand cuts where its blade is. The smaller piece gets the name and the type SLICE, the other one, or the one that a hand holds, those of REST. The value is (slice rest), each as (name volume thickness) (m³, m); a text if the blade is not all the way through.",
        &[],
        host!(cut),
    ),
];

fn blade(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = simulation.object_named(image, &args[0])?;
    let object = simulation.world.object(&name).map_err(Raise::reporting)?;
    let point = |p: [f64; 3]| Value::list(p.map(Value::Double));
    done(object.blade().map_or(Value::NIL, |blade| {
        let [length, height] = blade.half.map(Value::Double);
        let directions = [blade.middle, blade.tip, blade.edge].map(point);
        Value::list(
            directions
                .into_iter()
                .chain([length, height])
                .collect::<Vec<_>>(),
        )
    }))
}

fn begin_cut(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let tool = simulation.object_named(image, &args[0])?;
    let food = simulation.object_named(image, &args[1])?;
    let object = simulation.world.object(&food).map_err(Raise::reporting)?;
    let library = &simulation.world.models().objects;
    if !library.is_kind_of(object.type_name(), FOOD) {
        return done(Value::from(format!("{food} is no food")));
    }
    match simulation.world.begin_cut(&tool, &food) {
        Ok(()) => done(Value::T),
        Err(why) => done(Value::from(why.to_string())),
    }
}

fn end_cut(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let tool = simulation.object_named(image, &args[0])?;
    simulation.world.end_cut(&tool);
    done(Value::NIL)
}

fn cut(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let tool = simulation.object_named(image, &args[0])?;
    let food = simulation.object_named(image, &args[1])?;
    let named = |value: &Value| {
        let name = name_text(image, value);
        name.ok_or_else(|| Raise::type_error(value, known::SYMBOL))
    };
    let (slice, rest) = (named(&args[2])?, named(&args[4])?);
    let (slice_type, rest_type) = (
        type_text_of(image, &args[3])?,
        type_text_of(image, &args[5])?,
    );
    for name in [&slice, &rest] {
        if *name != food && simulation.world.object(name).is_ok() {
            return done(Value::from(format!("there is a {name} already")));
        }
    }
    let names = PieceNames {
        slice: &slice,
        slice_type: &slice_type,
        rest: &rest,
        rest_type: &rest_type,
    };
    let pieces = match simulation.world.cut(&tool, &food, names) {
        Ok(pieces) => pieces,
        Err(NotCut::World(error)) => return Err(Raise::reporting(error)),
        Err(why) => return done(Value::from(why.to_string())),
    };
    simulation.names.shift_remove(&food);
    let held = simulation.held.shift_remove(&food);
    if let Some(held) = held {
        simulation.held.insert(rest.clone(), held);
    }
    for (name, symbol) in [(slice, &args[2]), (rest, &args[4])] {
        simulation.names.insert(name, symbol.clone());
    }
    let rows = [args[2].clone(), args[4].clone()].into_iter().zip(pieces);
    let rows = rows.map(|(symbol, piece)| {
        Value::list([
            symbol,
            Value::Double(piece.volume),
            Value::Double(piece.thickness),
        ])
    });
    done(Value::list(rows.collect::<Vec<_>>()))
}

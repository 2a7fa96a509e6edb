//! Facts of other runs: records of sweeps and exported episodes.

use std::rc::Rc;

use crate::host::call::{done, host};
use crate::simulation::Simulation;
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use sweep::relations::{Cell, Relation};
use view::watch::recording::read_episode;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLAN-SYSTEM`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "%ADD-FACTS",
        "relation text",
        "Adds the lines of a text to a relation, each an object of JSON, or a record of a sweep. Returns how many lines there were.",
        &[],
        host!(add_facts),
    ),
    control(
        "%ADD-FACTS-OF-FILE",
        "relation file",
        "Adds the lines of a file to a relation, as %ADD-FACTS adds those of a text.",
        &[],
        host!(add_facts_of_file),
    ),
    control(
        "%ADD-RECORDING",
        "file",
        "Adds what was performed in a recording, an MCAP file, to relations. Returns whether the file is whole.",
        &[],
        host!(add_recording),
    ),
    control(
        "%FORGET-FACTS",
        "",
        "Forgets all facts that have been read.",
        &[],
        host!(forget_facts),
    ),
    control(
        "%FACT-RELATIONS",
        "",
        "The relations of which facts have been read: names, columns and the number of rows.",
        &[],
        host!(fact_relations),
    ),
    control(
        "%FACTS",
        "relation given wanted",
        "Rows of a relation: the values of the columns WANTED where the columns of the plist GIVEN have its values.",
        &[],
        host!(facts),
    ),
];

/// Columns whose texts are names, which are keywords in the plan language.
const NAMES: &[&str] = &[
    "kind", "type", "status", "outcome", "class", "name", "key", "level",
];

fn add_facts(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let relation = name_of(image, &args[0]);
    let Value::Str(text) = &args[1] else {
        return Err(Raise::type_error(&args[1], known::STRING));
    };
    add_text(simulation, &relation, &text.text())
}

fn add_facts_of_file(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let relation = name_of(image, &args[0]);
    let bytes = image.files.read(&name_of(image, &args[1]));
    let bytes = bytes.map_err(|error| Raise::simple(error.to_string()))?;
    let text = String::from_utf8(bytes);
    let text = text.map_err(|_| Raise::simple("it is no text in UTF-8"))?;
    add_text(simulation, &relation, &text)
}

fn add_text(simulation: &mut Simulation, relation: &str, text: &str) -> Result<Reply> {
    let facts = Rc::make_mut(&mut simulation.facts);
    match facts.add(relation, text) {
        Ok(count) => done(Value::from(count as i64)),
        Err(wrong) => Err(Raise::simple(format!(
            "line {}: {}",
            wrong.line, wrong.problem
        ))),
    }
}

fn add_recording(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let file = name_of(image, &args[0]);
    let bytes = image.files.read(&file);
    let bytes = bytes.map_err(|error| Raise::simple(error.to_string()))?;
    let episode = read_episode(&bytes).map_err(|error| Raise::simple(error.to_string()))?;
    let facts = Rc::make_mut(&mut simulation.facts);
    for (relation, text) in &episode.relations {
        facts.add(relation, text).map_err(|wrong| {
            Raise::simple(format!(
                "{relation}, line {}: {}",
                wrong.line, wrong.problem
            ))
        })?;
    }
    done(Value::bool(!episode.is_cut_off))
}

fn forget_facts(simulation: &mut Simulation, _: &mut Image, _: &[Value]) -> Result<Reply> {
    simulation.facts = Rc::default();
    done(Value::NIL)
}

fn fact_relations(simulation: &mut Simulation, image: &mut Image, _: &[Value]) -> Result<Reply> {
    let facts = Rc::clone(&simulation.facts);
    let relations = facts.iter().map(|(name, relation)| {
        let columns = relation.columns().iter();
        let columns: Vec<Value> = columns.map(|column| keyword(image, column)).collect();
        Value::list([
            keyword(image, name),
            Value::list(columns),
            Value::from(relation.len() as i64),
        ])
    });
    done(Value::list(relations.collect::<Vec<_>>()))
}

fn facts(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let facts = Rc::clone(&simulation.facts);
    let name = name_of(image, &args[0]);
    let Some(relation) = facts.get(&name) else {
        return done(Value::NIL);
    };
    let given: Vec<Value> = args[1].iter_list().collect();
    let given: Vec<(usize, Cell)> = given
        .chunks(2)
        .filter_map(|pair| Some((pair.first()?, pair.get(1)?)))
        .map(|(column, value)| {
            Ok((
                column_of(image, relation, &name, column)?,
                cell(image, value),
            ))
        })
        .collect::<Result<_>>()?;
    let wanted = args[2].iter_list();
    let wanted = wanted.map(|column| column_of(image, relation, &name, &column));
    let wanted: Vec<usize> = wanted.collect::<Result<_>>()?;
    let is_name: Vec<bool> = relation
        .columns()
        .iter()
        .map(|column| NAMES.contains(&column.as_str()))
        .collect();
    let mut rows = Vec::new();
    for row in relation.rows(&given) {
        let values = wanted.iter().map(|column| {
            let cell = row.get(*column).unwrap_or(&Cell::Null);
            value(image, cell, is_name.get(*column) == Some(&true))
        });
        rows.push(Value::list(values.collect::<Vec<_>>()));
    }
    done(Value::list(rows))
}

/// The number of a column, or an error that tells which there are.
fn column_of(image: &Image, relation: &Relation, name: &str, column: &Value) -> Result<usize> {
    let wanted = name_of(image, column);
    relation.column(&wanted).ok_or_else(|| {
        let columns: Vec<String> = relation
            .columns()
            .iter()
            .map(|column| format!(":{column}"))
            .collect();
        Raise::simple(format!(
            "The facts ({} …) have no :{}: they have {}.",
            name.to_lowercase(),
            wanted.to_lowercase(),
            columns.join(", ")
        ))
    })
}

/// A symbol's name, or a text.
fn name_of(image: &Image, value: &Value) -> String {
    match value {
        Value::Symbol(sym, ..) => image.name(*sym).to_owned(),
        Value::Str(text) => text.text(),
        _ => String::new(),
    }
}

fn keyword(image: &mut Image, name: &str) -> Value {
    image.keyword(&name.to_uppercase()).into()
}

/// A value of the plan language as a value of a fact.
fn cell(image: &Image, value: &Value) -> Cell {
    match value {
        Value::Int(int) => Cell::Int(*int),
        Value::Single(number) => Cell::Number(f64::from(*number)),
        Value::Double(number) => Cell::Number(*number),
        _ if !value.is_true() => Cell::Null,
        Value::Str(text) => Cell::Text(text.text().into()),
        _ if value.is_eq(&Value::T) => Cell::Bool(true),
        _ => Cell::Text(name_of(image, value).into()),
    }
}

/// A value of a fact in the plan language; names are keywords.
fn value(image: &mut Image, cell: &Cell, is_name: bool) -> Value {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-._/".contains(c);
    match cell {
        Cell::Null | Cell::Bool(false) => Value::NIL,
        Cell::Bool(true) => Value::T,
        Cell::Int(int) => Value::Int(*int),
        Cell::Number(number) => Value::Double(*number),
        Cell::Text(text) if is_name && !text.is_empty() && text.chars().all(plain) => {
            keyword(image, text)
        }
        Cell::Text(text) => Value::from(&**text),
    }
}

//! Facts of other runs: records of sweeps and exported episodes.

use std::fmt::Display;
use std::io::BufWriter;
use std::rc::Rc;
use std::sync::Arc;

use crate::simulation::Simulation;
use lisp::builtin::Builtin;
use lisp::files::{Contents, Opening};
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::equality::equal;
use lisp::value::raise::Raise;
use lisp::value::string::LispString;
use sweep::relations::{Cell, Relation, Relations};
use sweep::sqlite::{Sqlite, SqliteError};
use view::watch::recording::{Datum, Episode, Wanted, read_episode_of_file};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLAN-SYSTEM`.
pub(super) static TABLE: &[Builtin] = builtins![
    add_facts,
    add_facts_of_file,
    add_recording,
    forget_facts,
    fact_relations,
    facts,
    fact_bindings,
    write_sqlite
];

/// Columns whose texts are names, which are keywords in the plan language.
const NAMES: &[&str] = &[
    "kind", "type", "status", "outcome", "class", "name", "key", "level",
];

/// Adds the lines of a text to a relation, each an object of JSON, or a record of a sweep. Returns how many
/// lines there were.
#[builtin("%ADD-FACTS")]
fn add_facts(
    simulation: &mut Simulation,
    image: &mut Image,
    relation: &Value,
    text: &Rc<LispString>,
) -> Result<usize> {
    let relation = name_of(image, relation);
    add_text(simulation, &relation, &text.text())
}

/// Adds the lines of a file to a relation, as %ADD-FACTS adds those of a text.
#[builtin("%ADD-FACTS-OF-FILE")]
fn add_facts_of_file(
    simulation: &mut Simulation,
    image: &mut Image,
    relation: &Value,
    file: &Value,
) -> Result<usize> {
    let relation = name_of(image, relation);
    let bytes = image.files.read(&name_of(image, file));
    let bytes = bytes.map_err(|error| Raise::simple(error.to_string()))?;
    let text = String::from_utf8(bytes);
    let text = text.map_err(|_| Raise::simple("it is no text in UTF-8"))?;
    add_text(simulation, &relation, &text)
}

fn add_text(simulation: &mut Simulation, relation: &str, text: &str) -> Result<usize> {
    let facts = Rc::make_mut(&mut simulation.facts);
    let added = facts.add(relation, text);
    added.map_err(|wrong| Raise::simple(format!("line {}: {}", wrong.line, wrong.problem)))
}

/// Adds what a recording, an MCAP file, says of relations, a list of their names, or else of all. Returns
/// whether the file is whole.
#[builtin("%ADD-RECORDING")]
fn add_recording(
    simulation: &mut Simulation,
    image: &mut Image,
    file: &Value,
    relations: Option<&Value>,
) -> Result<bool> {
    let file = name_of(image, file);
    let reader = image.files.reader(&file);
    let reader = reader.map_err(|error| Raise::simple(error.to_string()))?;
    let names = relations.into_iter().flat_map(Value::iter_list);
    let names: Vec<String> = names
        .map(|name| name_of(image, &name).to_lowercase())
        .collect();
    let wanted = match names.is_empty() {
        true => Wanted::ALL,
        false => Wanted::of(|name| names.iter().any(|other| other == name)),
    };
    let episode =
        read_episode_of_file(reader, wanted).map_err(|error| Raise::simple(error.to_string()))?;
    let facts = Rc::make_mut(&mut simulation.facts);
    let is_cut_off = episode.is_cut_off;
    add_episode(facts, episode);
    Ok(!is_cut_off)
}

/// Adds the relations of a recording.
pub fn add_episode(facts: &mut Relations, episode: Episode) {
    let cell = |datum| match datum {
        Datum::Null => Cell::Null,
        Datum::Int(int) => Cell::Int(int),
        Datum::Number(number) => Cell::Number(number),
        Datum::Text(text) => Cell::Text(text),
    };
    for (relation, rows) in episode.relations {
        let all = rows.rows.into_iter();
        let all = all.map(|row| row.into_iter().map(cell).collect());
        facts.add_rows(relation, rows.columns, all);
    }
}

/// Forgets all facts that have been read.
#[builtin("%FORGET-FACTS")]
fn forget_facts(simulation: &mut Simulation) {
    simulation.facts = Rc::default();
}

/// The relations of which facts have been read: names, columns and the number of rows.
#[builtin("%FACT-RELATIONS")]
fn fact_relations(simulation: &mut Simulation, image: &mut Image) -> Vec<Value> {
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
    relations.collect()
}

/// Rows of a relation: the values of the columns WANTED where the columns of the plist GIVEN have its values.
#[builtin("%FACTS")]
fn facts(
    simulation: &mut Simulation,
    image: &mut Image,
    relation: &Value,
    given: &Value,
    wanted: &Value,
) -> Result<Vec<Value>> {
    let given: Vec<Value> = given.iter_list().collect();
    let wanted: Vec<Value> = wanted.iter_list().collect();
    let rows = rows(simulation, image, relation, &given, &wanted)?.unwrap_or_default();
    Ok(rows.into_iter().map(Value::list).collect())
}

/// The bindings of the variables in a plist of columns, a list for each row in which the others have their
/// values; T if there is no such relation, or that is no plist. A variable that is there twice must be equal
/// to itself.
#[builtin("%FACT-BINDINGS")]
fn fact_bindings(
    simulation: &mut Simulation,
    image: &mut Image,
    relation: &Value,
    columns: &Value,
) -> Result<Value> {
    let columns: Vec<Value> = columns.iter_list().collect();
    let is_keyword = |column: &Value| {
        let symbol = column.as_symbol();
        symbol.is_some_and(|symbol| image.is_keyword(symbol))
    };
    let (mut given, mut wanted, mut variables) = (Vec::new(), Vec::new(), Vec::new());
    for pair in columns.chunks(2) {
        let [column, value] = pair else {
            return Ok(Value::T);
        };
        if !is_keyword(column) {
            return Ok(Value::T);
        }
        match is_variable(image, value) {
            true => {
                wanted.push(column.clone());
                variables.push(value.clone());
            }
            false => given.extend([column.clone(), value.clone()]),
        }
    }
    if is_variable(image, relation) {
        return Ok(Value::T);
    }
    let Some(rows) = rows(simulation, image, relation, &given, &wanted)? else {
        return Ok(Value::T);
    };
    let former = |at: usize| {
        let mut before = variables.iter().take(at);
        before.position(|other: &Value| other.is_eq(&variables[at]))
    };
    let former: Vec<Option<usize>> = (0..variables.len()).map(former).collect();
    let mut all = Vec::with_capacity(rows.len());
    for values in rows {
        let is_one = |(at, former): (usize, &Option<usize>)| match former {
            None => true,
            Some(former) => match (values.get(at), values.get(*former)) {
                (Some(one), Some(other)) => equal(one, other),
                _ => false,
            },
        };
        if !former.iter().enumerate().all(is_one) {
            continue;
        }
        let pairs = variables.iter().zip(values).zip(&former);
        let pairs = pairs.filter(|(_, former)| former.is_none());
        let pairs = pairs.map(|((variable, value), _)| Value::cons(variable.clone(), value));
        all.push(Value::list(pairs.collect::<Vec<_>>()));
    }
    Ok(Value::list(all))
}

/// Is it a variable of a goal?
fn is_variable(image: &Image, value: &Value) -> bool {
    let symbol = value.as_symbol();
    symbol.is_some_and(|symbol| image.name(symbol).starts_with('?'))
}

/// What [`facts`] returns; `None` if there is no such relation.
fn rows(
    simulation: &mut Simulation,
    image: &mut Image,
    relation: &Value,
    given: &[Value],
    wanted: &[Value],
) -> Result<Option<Vec<Vec<Value>>>> {
    let facts = Rc::clone(&simulation.facts);
    let name = name_of(image, relation);
    let Some(relation) = facts.get(&name) else {
        return Ok(None);
    };
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
    let wanted = wanted.iter();
    let wanted = wanted.map(|column| column_of(image, relation, &name, column));
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
        rows.push(values.collect());
    }
    Ok(Some(rows))
}

/// Writes facts into an SQLite file that does not exist: those that have been read, or those of RELATIONS, a
/// list of names, each followed by a text with lines of JSON. Returns how many rows there are.
#[builtin("%WRITE-SQLITE")]
fn write_sqlite(
    simulation: &mut Simulation,
    image: &mut Image,
    file: &Value,
    relations: &Value,
) -> Result<Value> {
    let file = name_of(image, file);
    let files = Arc::clone(&image.files);
    let refused = |why: &dyn Display| Raise::simple(format!("cannot write {file}: {why}"));
    // SQLite would apply what it has left of an earlier file to the new one.
    for end in ["", ".part", "-journal", "-wal"] {
        let there = format!("{file}{end}");
        let found = files.facts(&there);
        if found.is_ok_and(|found| found.is_folder || found.length > 0) {
            return Err(Raise::simple(format!(
                "{there} is there already: delete it, or name another file"
            )));
        }
    }
    let unfinished = format!("{file}.part");
    let opening = Opening {
        creates: true,
        contents: Contents::Drop,
    };
    let output = files
        .open(&unfinished, opening)
        .map_err(|error| refused(&error))?;
    let texts: Vec<Value> = relations.iter_list().collect();
    let write = || -> std::result::Result<u64, SqliteError> {
        let mut sqlite = Sqlite::begin(BufWriter::new(output))?;
        if texts.is_empty() {
            sqlite.add_relations(&simulation.facts)?;
        }
        for pair in texts.chunks_exact(2) {
            let (relation, text) = (name_of(image, &pair[0]), name_of(image, &pair[1]));
            for line in text.lines() {
                sqlite.add_line(&relation, line)?;
            }
        }
        let (_, counts) = sqlite.finish()?;
        Ok(counts.iter().map(|(_, rows)| rows).sum())
    };
    let written = write().and_then(|rows| {
        files.rename(&unfinished, &file)?;
        Ok(rows)
    });
    match written {
        Ok(rows) => Ok(Value::from(rows as i64)),
        Err(error) => {
            // An error is reported; what is left of the file is of no use.
            let _ = files.remove(&unfinished);
            Err(refused(&error))
        }
    }
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

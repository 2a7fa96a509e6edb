//! Writes relations into an SQLite file, row by row, in memory that does not grow with the rows but for 16 bytes for
//! each page. Other programs read the file; nothing here reads it back.
//!
//! The format: <https://www.sqlite.org/fileformat2.html>. A file has one table for each relation, without indices.

mod pages;
mod record;
mod schema;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::io::{self, Seek, Write};

use self::pages::{HEADER, PAGE, Pages, Tree, put};
use self::record::Affinity;
use crate::line::{Field, Line};
use crate::relations::{Cell, Relations};
use thiserror::Error;

/// Maximum number of columns of a table, and of bytes of a row, that SQLite reads.
const MAX_COLUMNS: usize = 2000;
const MAX_ROW: usize = 1_000_000_000;

/// Why a row cannot be stored.
#[derive(Debug, Error)]
pub enum SqliteError {
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] io::Error),
    /// A line is no object of JSON.
    #[error("{0}")]
    Malformed(String),
    /// Rows have too many different columns.
    #[error("the rows of {0} have more than {MAX_COLUMNS} different columns, which SQLite has not")]
    TooManyColumns(String),
    /// A row is too long.
    #[error("a row of {0} has more than {MAX_ROW} bytes, which SQLite does not read")]
    LongRow(String),
}

/// A column of a table.
struct Column {
    name: String,
    affinity: Affinity,
    /// Are its texts names, which are stored in lower case?
    is_name: bool,
}

impl Column {
    fn new(name: &str, affinity: Affinity) -> Column {
        Column {
            name: name.to_owned(),
            affinity,
            is_name: schema::NAMES.contains(&name),
        }
    }
}

/// A table.
#[derive(Default)]
struct Table {
    columns: Vec<Column>,
    tree: Tree,
}

impl Table {
    /// The column for the field of a row with this number and name.
    fn column(&self, number: usize, name: &str) -> Option<usize> {
        // Rows name their columns in the same order as a rule.
        if self
            .columns
            .get(number)
            .is_some_and(|column| column.name == name)
        {
            return Some(number);
        }
        let at = |name: &str| self.columns.iter().position(|column| column.name == name);
        at(name).or_else(|| at(&column_name(name)))
    }
}

/// An SQLite file that is written.
pub struct Sqlite<W> {
    pages: Pages<W>,
    /// By their names.
    tables: BTreeMap<String, Table>,
    row: Vec<u8>,
}

impl<W: Write + Seek> Sqlite<W> {
    /// Begins a file, which has to be empty. It has the tables of all relations that there can be.
    pub fn begin(to: W) -> Result<Sqlite<W>, SqliteError> {
        let tables = schema::TABLES.iter().map(|(name, columns)| {
            let columns = columns.iter();
            let columns = columns.map(|(name, affinity)| Column::new(name, *affinity));
            (
                (*name).to_owned(),
                Table {
                    columns: columns.collect(),
                    tree: Tree::default(),
                },
            )
        });
        Ok(Sqlite {
            tables: tables.collect(),
            pages: Pages::begin(to)?,
            row: Vec::new(),
        })
    }

    /// Adds what a line of JSON Lines says: a row of the relation, or, of a record of a sweep, rows of several.
    pub fn add_line(&mut self, relation: &str, line: &str) -> Result<(), SqliteError> {
        let line = Line::read(line).map_err(SqliteError::Malformed)?;
        let mut result = Ok(());
        line.rows(relation, &mut |relation, fields| {
            if result.is_ok() {
                result = self.add(relation, &fields);
            }
        });
        result
    }

    /// Adds all rows of relations.
    pub fn add_relations(&mut self, relations: &Relations) -> Result<(), SqliteError> {
        for (name, relation) in relations.iter() {
            for row in relation.rows(&[]) {
                let columns = relation.columns().iter().map(String::as_str);
                let fields: Vec<_> = columns.zip(row.iter().map(field)).collect();
                self.add(name, &fields)?;
            }
        }
        Ok(())
    }

    fn add(&mut self, relation: &str, fields: &[(&str, Field<'_>)]) -> Result<(), SqliteError> {
        let table = match self.tables.contains_key(relation) {
            true => self.tables.get_mut(relation),
            false => Some(self.tables.entry(table_name(relation)).or_default()),
        };
        let Some(table) = table else {
            return Ok(());
        };
        // Runs that are not of a sweep have the number 0.
        let zero = Field::Int(0);
        let mut values: Vec<&Field<'_>> = vec![&Field::Null; table.columns.len()];
        if let (Some(first), Some(column)) = (values.first_mut(), table.columns.first())
            && column.name == "run"
        {
            *first = &zero;
        }
        for (number, (name, field)) in fields.iter().enumerate() {
            let at = match table.column(number, name) {
                Some(at) => at,
                None if table.columns.len() >= MAX_COLUMNS => {
                    return Err(SqliteError::TooManyColumns(relation.to_owned()));
                }
                None => {
                    table
                        .columns
                        .push(Column::new(&column_name(name), Affinity::Any));
                    values.push(&Field::Null);
                    table.columns.len() - 1
                }
            };
            if let Some(place) = values.get_mut(at) {
                *place = field;
            }
        }
        if values.is_empty() {
            return Ok(());
        }
        self.row.clear();
        let values = table.columns.iter().zip(&values);
        record::encode(
            &mut self.row,
            values.map(|(column, value)| (column.affinity, column.is_name, *value)),
        );
        if self.row.len() > MAX_ROW {
            return Err(SqliteError::LongRow(relation.to_owned()));
        }
        Ok(table.tree.append(&mut self.pages, &self.row)?)
    }

    /// Writes what is left. Returns the names of the tables, with how many rows they have.
    pub fn finish(mut self) -> Result<(W, Vec<(String, u64)>), SqliteError> {
        let mut schema = Tree::first();
        let mut counts = Vec::new();
        for (name, table) in &mut self.tables {
            if table.columns.is_empty() {
                counts.push((name.clone(), 0));
                continue;
            }
            let root = table.tree.finish(&mut self.pages)?;
            counts.push((name.clone(), table.tree.rows));
            let text = |text: &str| Field::Text(text.to_owned().into());
            let row = [
                text("table"),
                text(name),
                text(name),
                Field::Int(root.into()),
                text(&definition(name, &table.columns)),
            ];
            self.row.clear();
            let values = row.iter().map(|value| (Affinity::Any, false, value));
            record::encode(&mut self.row, values);
            schema.append(&mut self.pages, &self.row)?;
        }
        let mut first = schema.finish_first(&mut self.pages)?;
        write_header(&mut first, self.pages.count);
        Ok((self.pages.finish(&first)?, counts))
    }
}

fn field(cell: &Cell) -> Field<'_> {
    match cell {
        Cell::Null => Field::Null,
        Cell::Bool(is) => Field::Bool(*is),
        Cell::Int(int) => Field::Int(*int),
        Cell::Number(number) => Field::Number(*number),
        Cell::Text(text) => Field::Text((&**text).into()),
    }
}

/// The name of the table of a relation. Some names belong to SQLite.
fn table_name(relation: &str) -> String {
    let name = column_name(relation);
    match name.starts_with("sqlite_") {
        true => format!("_{name}"),
        false => name,
    }
}

/// A name as that of a column: names are compared in any case, and cannot contain the character that ends a statement.
fn column_name(name: &str) -> String {
    name.to_lowercase()
        .replace('-', "_")
        .replace('\0', "\u{fffd}")
}

fn definition(name: &str, columns: &[Column]) -> String {
    let quoted = |name: &str| format!("\"{}\"", name.replace('"', "\"\""));
    let columns: Vec<String> = columns
        .iter()
        .map(|column| format!("{}{}", quoted(&column.name), column.affinity.declared()))
        .collect();
    format!("CREATE TABLE {}({})", quoted(name), columns.join(","))
}

/// The header of a file with so many pages.
fn write_header(page: &mut [u8; PAGE], pages: u32) {
    let mut header = [0; HEADER];
    put(&mut header, 0, b"SQLite format 3\0");
    put(&mut header, 16, &(PAGE as u16).to_be_bytes());
    // How it is written and read, and how much of a page a row may take.
    put(&mut header, 18, &[1, 1, 0, 64, 32, 32]);
    let number = |header: &mut [u8; HEADER], at: usize, value: u32| {
        put(header, at, &value.to_be_bytes());
    };
    // How often the file has been changed, and its schema.
    number(&mut header, 24, 1);
    number(&mut header, 28, pages);
    number(&mut header, 40, 1);
    // The format of the schema, and UTF-8.
    number(&mut header, 44, 4);
    number(&mut header, 56, 1);
    number(&mut header, 60, schema::VERSION);
    // The number of pages is that of the last change. The version of SQLite whose format it is: 3.40.
    number(&mut header, 92, 1);
    number(&mut header, 96, 3_040_000);
    put(page, 0, &header);
}

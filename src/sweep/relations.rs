//! Facts of many runs as relations: what records of sweeps and exported episodes say, as rows of named
//! columns that can be asked for by their values.

use std::collections::BTreeMap;

use super::column_index::ColumnIndex;
use super::line::Line;

/// A value in a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Nothing.
    Null,
    /// Yes or no.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// Another number.
    Number(f64),
    /// A text.
    Text(Box<str>),
}

impl Cell {
    /// Whether two values are the same: numbers by their value, texts in any case of letters, and no
    /// value like no.
    pub fn is(&self, other: &Cell) -> bool {
        match (self, other) {
            (Cell::Text(one), Cell::Text(other)) => one.eq_ignore_ascii_case(other),
            (Cell::Int(int), Cell::Number(number)) | (Cell::Number(number), Cell::Int(int)) => {
                *int as f64 == *number
            }
            (Cell::Null, Cell::Bool(false)) | (Cell::Bool(false), Cell::Null) => true,
            _ => self == other,
        }
    }
}

/// Rows of the same columns.
#[derive(Clone, Debug, Default)]
pub struct Relation {
    columns: Vec<String>,
    rows: Vec<Vec<Cell>>,
    /// For each value of the first column that is a whole number, the rows that have it.
    by_first: BTreeMap<i64, Vec<usize>>,
    /// For each column, what finds rows by its values.
    indices: Vec<ColumnIndex>,
}

impl Relation {
    /// The names of the columns.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The number of the column of that name, in any case of letters.
    pub fn column(&self, name: &str) -> Option<usize> {
        let mut columns = self.columns.iter();
        columns.position(|column| column.eq_ignore_ascii_case(name))
    }

    /// The rows in which the columns have the values, in the order in which they were added.
    pub fn rows<'a>(
        &'a self,
        given: &'a [(usize, Cell)],
    ) -> Box<dyn Iterator<Item = &'a [Cell]> + 'a> {
        let fits = |row: &&Vec<Cell>| {
            given
                .iter()
                .all(|(column, value)| row.get(*column).is_some_and(|cell| cell.is(value)))
        };
        match self.candidates(given) {
            Some(numbers) => {
                let rows = numbers.iter().filter_map(|number| self.rows.get(*number));
                Box::new(rows.filter(fits).map(Vec::as_slice))
            }
            None => Box::new(self.rows.iter().filter(fits).map(Vec::as_slice)),
        }
    }

    /// The numbers of rows, in their order, among which are all that have the values; `None` for all rows.
    fn candidates(&self, given: &[(usize, Cell)]) -> Option<&[usize]> {
        let first = given.iter().find_map(|(column, value)| match value {
            Cell::Int(number) if *column == 0 => Some(*number),
            _ => None,
        });
        let mut best = first.map(|number| {
            let numbers = self.by_first.get(&number);
            numbers.map_or(&[][..], Vec::as_slice)
        });
        let by_column = given.iter().filter_map(|(column, value)| {
            let index = self.indices.get(*column)?;
            Some((*column, index, value))
        });
        for (_, index, value) in by_column.clone() {
            let found = index.get(value);
            if found.is_some_and(|found| best.is_none_or(|best| found.len() < best.len())) {
                best = found;
            }
        }
        let count = best.map_or(self.rows.len(), <[usize]>::len);
        for (column, index, _) in by_column {
            if column > 0 || first.is_none() {
                index.note(count, &self.rows, column);
            }
        }
        best
    }

    /// Adds a row with a value for each of the columns, which are all that the relation has, if it has any.
    fn push(&mut self, columns: &[&str], row: Vec<Cell>) {
        if self.columns.is_empty() {
            self.set_columns(columns.iter().map(|name| (*name).to_owned()).collect());
        }
        match self.columns.iter().eq(columns.iter()) {
            true => self.push_row(row),
            false => self.add(columns.iter().copied().zip(row)),
        }
    }

    fn set_columns(&mut self, columns: Vec<String>) {
        self.indices.clear();
        self.indices
            .resize_with(columns.len(), ColumnIndex::default);
        self.columns = columns;
    }

    fn push_row(&mut self, row: Vec<Cell>) {
        self.indices.iter_mut().for_each(ColumnIndex::forget);
        if let Some(Cell::Int(number)) = row.first() {
            let of_number = self.by_first.entry(*number).or_default();
            of_number.push(self.rows.len());
        }
        self.rows.push(row);
    }

    /// Adds a row; columns that it does not name are empty in it, and new ones in those before.
    fn add<'c>(&mut self, cells: impl Iterator<Item = (&'c str, Cell)>) {
        let mut row = vec![Cell::Null; self.columns.len()];
        for (number, (name, cell)) in cells.enumerate() {
            // Rows name their columns in the same order as a rule.
            let expected = self.columns.get(number).filter(|column| *column == name);
            let at = match expected {
                Some(_) => Some(number),
                None => self.columns.iter().position(|column| column == name),
            };
            match at {
                Some(at) => {
                    if let Some(place) = row.get_mut(at) {
                        *place = cell;
                    }
                }
                None => {
                    self.columns.push(name.to_owned());
                    self.indices.push(ColumnIndex::default());
                    for row in &mut self.rows {
                        row.push(Cell::Null);
                    }
                    row.push(cell);
                }
            }
        }
        self.push_row(row);
    }
}

/// Relations by name.
#[derive(Clone, Debug, Default)]
pub struct Relations {
    all: BTreeMap<String, Relation>,
}

/// A line that cannot be read: its number, from 1, and what is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MalformedLine {
    /// Its number.
    pub line: usize,
    /// What is wrong.
    pub problem: String,
}

impl Relations {
    /// The relation of that name, in any case of letters.
    pub fn get(&self, name: &str) -> Option<&Relation> {
        self.all.get(&name.to_ascii_lowercase())
    }

    /// All relations, by name.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Relation)> {
        let all = self.all.iter();
        all.map(|(name, relation)| (name.as_str(), relation))
    }

    /// Adds the lines of a text, each with an object of JSON: rows of the relation, or records of a
    /// sweep, which become rows of several. Returns how many lines there were. After an error nothing
    /// has been added.
    pub fn add(&mut self, relation: &str, text: &str) -> Result<usize, MalformedLine> {
        let lines = text.lines().enumerate();
        let lines = lines.filter(|(_, line)| !line.trim().is_empty());
        let objects: Vec<Line<'_>> = lines
            .map(|(number, line)| {
                Line::read(line).map_err(|problem| MalformedLine {
                    line: number + 1,
                    problem,
                })
            })
            .collect::<Result<_, _>>()?;
        let count = objects.len();
        for object in objects {
            object.rows(relation, &mut |relation, fields| {
                let cells = fields.into_iter();
                self.relation(relation)
                    .add(cells.map(|(name, field)| (name, field.cell())));
            });
        }
        Ok(count)
    }

    /// Adds rows of a relation, each with a value for each of the columns.
    pub fn add_rows(
        &mut self,
        relation: &str,
        columns: &[&str],
        rows: impl Iterator<Item = Vec<Cell>>,
    ) {
        for row in rows {
            self.relation(relation).push(columns, row);
        }
    }

    fn relation(&mut self, name: &str) -> &mut Relation {
        self.all.entry(name.to_ascii_lowercase()).or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECORDS: &str = r#"{"world":0,"outcome":"failure","class":"GRIPPER-CLOSED-COMPLETELY","bodies":["BOWL-1"],"draws":{"bottle.y":-0.9,"clutter":2},"time":5.5}

{"world":3,"outcome":"success","class":null,"draws":{"bottle.y":-0.8},"expectations":{"parked":true},"time":30}
"#;

    fn texts(relations: &Relations, name: &str, given: &[(&str, Cell)]) -> Vec<Vec<Cell>> {
        let relation = relations.get(name).unwrap();
        let given: Vec<(usize, Cell)> = given
            .iter()
            .map(|(column, cell)| (relation.column(column).unwrap(), cell.clone()))
            .collect();
        relation.rows(&given).map(<[Cell]>::to_vec).collect()
    }

    #[test]
    fn records_of_a_sweep_become_relations() {
        let mut relations = Relations::default();
        assert_eq!(relations.add("records", RECORDS), Ok(2));
        let success = Cell::Text("SUCCESS".into());
        let runs = texts(&relations, "RUN", &[("outcome", success)]);
        assert_eq!(runs.len(), 1);
        assert_eq!(runs[0][0], Cell::Int(3));
        let draws = texts(&relations, "draw", &[("run", Cell::Number(0.0))]);
        assert_eq!(draws.len(), 2);
        assert_eq!(draws[0][2], Cell::Number(-0.9));
        let bodies = texts(&relations, "body", &[("run", Cell::Int(0))]);
        assert_eq!(bodies[0][1], Cell::Text("BOWL-1".into()));
        let held = texts(&relations, "expectation", &[("held", Cell::Bool(true))]);
        assert_eq!(held.len(), 1);
    }

    #[test]
    fn rows_may_have_other_columns_than_those_before() {
        let mut relations = Relations::default();
        let text = "{\"task\":1,\"type\":\"going\"}\n{\"task\":2,\"ended\":2.5}\n";
        assert_eq!(relations.add("task", text), Ok(2));
        let task = relations.get("task").unwrap();
        assert_eq!(task.columns(), ["task", "type", "ended"]);
        let all: Vec<_> = task.rows(&[]).collect();
        assert_eq!(all[0][2], Cell::Null);
        assert_eq!(all[1][1], Cell::Null);
    }

    #[test]
    fn a_malformed_line_adds_nothing() {
        let mut relations = Relations::default();
        let error = relations.add("task", "{\"task\":1}\n[1]\n").unwrap_err();
        assert_eq!(error.line, 2);
        assert!(relations.iter().next().is_none());
    }

    #[test]
    fn rows_that_an_index_finds_are_those_of_a_search_in_their_order() {
        let columns = ["run", "task", "type", "ended"];
        let mut relations = Relations::default();
        let row = |n: usize| {
            vec![
                Cell::Int((n / 9) as i64),
                Cell::Int((n % 9) as i64),
                Cell::Text(["Going", "PLACING", "going", "looking"][n % 4].into()),
                match n % 5 {
                    0 => Cell::Null,
                    k => Cell::Number(k as f64),
                },
            ]
        };
        let all: Vec<Vec<Cell>> = (0..900).map(row).collect();
        relations.add_rows("task", &columns, all.iter().cloned());
        let questions: [&[(usize, Cell)]; 7] = [
            &[(2, Cell::Text("GOING".into()))],
            &[(1, Cell::Int(4))],
            &[(1, Cell::Number(4.0)), (2, Cell::Text("looking".into()))],
            &[(3, Cell::Bool(false))],
            &[(3, Cell::Int(2)), (0, Cell::Int(7))],
            &[(0, Cell::Number(7.0))],
            &[(2, Cell::Text("falling".into()))],
        ];
        let searched = |all: &[Vec<Cell>], given: &[(usize, Cell)]| -> Vec<Vec<Cell>> {
            let fits = |row: &&Vec<Cell>| given.iter().all(|(at, value)| row[*at].is(value));
            all.iter().filter(fits).cloned().collect()
        };
        let found = |relations: &Relations, given: &[(usize, Cell)]| -> Vec<Vec<Cell>> {
            let relation = relations.get("task").unwrap();
            relation.rows(given).map(<[Cell]>::to_vec).collect()
        };
        for _ in 0..20 {
            for given in questions {
                assert_eq!(found(&relations, given), searched(&all, given), "{given:?}");
            }
        }
        let task = relations.get("task").unwrap();
        let is_made = |column: usize| task.indices[column].get(&Cell::Null).is_some();
        assert!(is_made(1) && is_made(2) && is_made(3));
        // An index knows of what comes later, too.
        let mut all = all;
        all.extend((900..950).map(row));
        relations.add_rows("task", &columns, (900..950).map(row));
        for given in questions {
            assert_eq!(found(&relations, given), searched(&all, given), "{given:?}");
        }
    }

    #[test]
    fn rows_with_values_for_other_columns_extend_a_relation() {
        let mut relations = Relations::default();
        relations
            .add("task", "{\"task\":1,\"type\":\"going\"}\n")
            .unwrap();
        let row = vec![Cell::Number(2.5), Cell::Int(2)];
        relations.add_rows("task", &["ended", "task"], [row].into_iter());
        let task = relations.get("task").unwrap();
        assert_eq!(task.columns(), ["task", "type", "ended"]);
        let given = [(0, Cell::Int(2))];
        let found: Vec<_> = task.rows(&given).collect();
        assert_eq!(found, [[Cell::Int(2), Cell::Null, Cell::Number(2.5)]]);
    }
}

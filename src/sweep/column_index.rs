//! Finding the rows that have a value in a column, without looking at all of them.

use std::collections::HashMap;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::relations::Cell;

/// How many times all rows have to be looked at for a column before an index of it is worth its making.
const WORTH: usize = 4;
/// Number of rows that are looked at as fast as others are found.
const FEW: usize = 32;

/// A value such that those that are the same, as goals compare them, are equal. A few more may be.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Key {
    /// Nothing, or no.
    No,
    Yes,
    /// The bits of a number.
    Number(u64),
    /// In small letters.
    Text(Box<str>),
}

impl Key {
    fn of(cell: &Cell) -> Key {
        match cell {
            Cell::Null | Cell::Bool(false) => Key::No,
            Cell::Bool(true) => Key::Yes,
            // The sum makes one zero of both.
            Cell::Int(int) => Key::Number((*int as f64 + 0.0).to_bits()),
            Cell::Number(number) => Key::Number((number + 0.0).to_bits()),
            Cell::Text(text) => Key::Text(text.to_ascii_lowercase().into()),
        }
    }
}

/// The index of a column, which is made once questions have looked at so many rows that it would have been worth it.
#[derive(Debug, Default)]
pub(crate) struct ColumnIndex {
    looked_at: AtomicUsize,
    rows: OnceLock<HashMap<Key, Vec<usize>>>,
}

impl Clone for ColumnIndex {
    /// Without what was found out: a copy is made to be changed.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl ColumnIndex {
    /// The numbers of the rows that may have a value in the column, in their order; `None` as long as there is no index.
    pub(crate) fn get(&self, value: &Cell) -> Option<&[usize]> {
        let rows = self.rows.get()?;
        Some(rows.get(&Key::of(value)).map_or(&[], Vec::as_slice))
    }

    /// Forgets what was found out, since there are other rows now.
    pub(crate) fn forget(&mut self) {
        if self.rows.get().is_some() || *self.looked_at.get_mut() > 0 {
            *self = Self::default();
        }
    }

    /// Notes that as many rows are about to be looked at for a value of the column; makes the index of all rows if it
    /// is worth it.
    pub(crate) fn note(&self, count: usize, rows: &[Vec<Cell>], column: usize) {
        if count <= FEW {
            return;
        }
        let before = self.looked_at.fetch_add(count, Ordering::Relaxed);
        if before < rows.len().saturating_mul(WORTH) {
            return;
        }
        self.rows.get_or_init(|| {
            let mut all: HashMap<Key, Vec<usize>> = HashMap::new();
            for (number, row) in rows.iter().enumerate() {
                let key = Key::of(row.get(column).unwrap_or(&Cell::Null));
                all.entry(key).or_default().push(number);
            }
            all
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_that_goals_take_for_the_same_have_one_key() {
        let cells = [
            Cell::Null,
            Cell::Bool(false),
            Cell::Bool(true),
            Cell::Int(0),
            Cell::Number(-0.0),
            Cell::Int(7),
            Cell::Number(7.0),
            Cell::Number(7.5),
            Cell::Text("Cup".into()),
            Cell::Text("CUP".into()),
            Cell::Text("cups".into()),
        ];
        for one in &cells {
            for other in &cells {
                if one.is(other) {
                    assert_eq!(Key::of(one), Key::of(other), "{one:?} {other:?}");
                }
            }
        }
    }
}

//! Sets of the cells of a grid.

/// The bits of a word.
const WORD: usize = u64::BITS as usize;

/// A set of cells by their numbers, of which each up to the greatest takes a bit.
#[derive(Clone, Debug, Default)]
pub(crate) struct CellSet(Vec<u64>);

impl CellSet {
    /// Whether the cell is in the set.
    pub(crate) fn contains(&self, cell: usize) -> bool {
        let word = self.0.get(cell / WORD).copied().unwrap_or_default();
        word >> (cell % WORD) & 1 == 1
    }

    /// Puts the cell into the set; returns whether it was not there.
    pub(crate) fn insert(&mut self, cell: usize) -> bool {
        if self.0.len() <= cell / WORD {
            self.0.resize(cell / WORD + 1, 0);
        }
        let word = &mut self.0[cell / WORD];
        let bit = 1 << (cell % WORD);
        let is_new = *word & bit == 0;
        *word |= bit;
        is_new
    }

    /// Removes all cells from that number on.
    pub(crate) fn truncate(&mut self, end: usize) {
        self.0.truncate(end.div_ceil(WORD));
        self.0.shrink_to_fit();
        let beyond = end % WORD;
        if let Some(last) = self.0.get_mut(end / WORD) {
            *last &= (1 << beyond) - 1;
        }
    }

    /// Puts the cells of another set into this one.
    pub(crate) fn extend(&mut self, other: &CellSet) {
        if self.0.len() < other.0.len() {
            self.0.resize(other.0.len(), 0);
        }
        for (word, more) in self.0.iter_mut().zip(&other.0) {
            *word |= more;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::CellSet;

    #[test]
    fn a_set_holds_what_was_put_into_it() {
        let mut set = CellSet::default();
        assert!(!set.contains(700));
        for cell in [0, 63, 64, 127, 128, 700] {
            assert!(set.insert(cell) && !set.insert(cell));
        }
        let held = |set: &CellSet| {
            (0..1000)
                .filter(|cell| set.contains(*cell))
                .collect::<Vec<_>>()
        };
        assert_eq!(held(&set), [0, 63, 64, 127, 128, 700]);
        let mut other = CellSet::default();
        other.insert(5);
        other.extend(&set);
        assert_eq!(held(&other), [0, 5, 63, 64, 127, 128, 700]);
        for (end, rest) in [
            (701, 7),
            (700, 6),
            (128, 5),
            (127, 4),
            (64, 3),
            (63, 2),
            (0, 0),
        ] {
            other.truncate(end);
            assert_eq!(held(&other).len(), rest, "{end}");
        }
    }
}

//! The description of a place for a thing.

use super::constraint::Constraint;
use super::orientation::Orientation;
use super::support::Support;

/// What is to be put down.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// Nothing: a point is wanted.
    Point,
    /// An object, by its name in the world.
    Object(String),
    /// Something of a type, by its name in the library.
    Kind(String),
}

/// Which board of something that has several; boards are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Any.
    Any,
    /// The highest.
    Topmost,
    /// The one in the middle; of two, the lower one.
    Middle,
    /// Counted from below.
    FromBelow(usize),
    /// Counted from above.
    FromAbove(usize),
}

impl Level {
    /// Those of the heights, which ascend, that are meant.
    pub(super) fn of(self, heights: &[f64]) -> Vec<f64> {
        let count = heights.len();
        let at = |i: Option<usize>| {
            i.and_then(|i| heights.get(i))
                .copied()
                .into_iter()
                .collect()
        };
        match self {
            Self::Any => heights.to_vec(),
            Self::Topmost => at(count.checked_sub(1)),
            Self::Middle => at(count.checked_sub(1).map(|last| last / 2)),
            Self::FromBelow(n) => at(n.checked_sub(1)),
            Self::FromAbove(n) => at(count.checked_sub(n).filter(|_| n > 0)),
        }
    }
}

/// The relation of the place to what it is on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Position {
    /// On its upper face.
    On,
    /// So high (m) above what is on its upper face.
    Above(f64),
    /// Inside, on a board.
    In(Level),
}

impl Position {
    /// Its key as users write it.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::On => "on",
            Self::Above(_) => "above",
            Self::In(_) => "in",
        }
    }
}

/// A place on or in something.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceQuery {
    /// What it is on or in.
    pub support: Support,
    /// Whether on or in it.
    pub position: Position,
    /// What else is demanded.
    pub constraints: Vec<Constraint>,
    /// What the place is for.
    pub what: What,
    /// How that is turned.
    pub orientation: Orientation,
}

#[cfg(test)]
mod tests {
    use super::Level;

    #[test]
    fn boards_are_counted_from_below_or_above() {
        let heights = [0.2, 0.5, 0.8, 1.1];
        assert_eq!(Level::Topmost.of(&heights), [1.1]);
        assert_eq!(Level::Middle.of(&heights), [0.5]);
        assert_eq!(Level::FromBelow(1).of(&heights), [0.2]);
        assert_eq!(Level::FromAbove(2).of(&heights), [0.8]);
        assert!(Level::FromBelow(5).of(&heights).is_empty());
        assert!(Level::FromAbove(0).of(&heights).is_empty());
    }
}

//! The positions of an arm's joints.

use std::ops::{Deref, DerefMut};

use serde::{Serialize, Serializer};

/// The most joints that an arm may have.
pub const MOST_ARM_JOINTS: usize = 8;

/// Positions of the joints of an arm (rad, or m for a joint that slides), from the shoulder to the
/// wrist: a slice of at most [`MOST_ARM_JOINTS`] that is copied like a number.
#[derive(Clone, Copy, Debug)]
pub struct ArmPositions {
    values: [f64; MOST_ARM_JOINTS],
    count: usize,
}

/// There are more positions than an arm may have joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0} positions are more than the {MOST_ARM_JOINTS} joints that an arm may have")]
pub struct TooManyJoints(pub usize);

impl TryFrom<&[f64]> for ArmPositions {
    type Error = TooManyJoints;

    fn try_from(positions: &[f64]) -> Result<Self, TooManyJoints> {
        let mut values = [0.0; MOST_ARM_JOINTS];
        let count = positions.len();
        let room = values.get_mut(..count).ok_or(TooManyJoints(count))?;
        room.copy_from_slice(positions);
        Ok(Self { values, count })
    }
}

impl From<[f64; 7]> for ArmPositions {
    fn from([a, b, c, d, e, f, g]: [f64; 7]) -> Self {
        Self {
            values: [a, b, c, d, e, f, g, 0.0],
            count: 7,
        }
    }
}

/// The first [`MOST_ARM_JOINTS`] of the positions.
impl FromIterator<f64> for ArmPositions {
    fn from_iter<I: IntoIterator<Item = f64>>(positions: I) -> Self {
        let mut values = [0.0; MOST_ARM_JOINTS];
        let mut count = 0;
        for (value, position) in values.iter_mut().zip(positions) {
            *value = position;
            count += 1;
        }
        Self { values, count }
    }
}

impl Deref for ArmPositions {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values[..self.count]
    }
}

impl DerefMut for ArmPositions {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.values[..self.count]
    }
}

impl PartialEq for ArmPositions {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl IntoIterator for ArmPositions {
    type Item = f64;
    type IntoIter = std::iter::Take<std::array::IntoIter<f64, MOST_ARM_JOINTS>>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.into_iter().take(self.count)
    }
}

impl<'a> IntoIterator for &'a ArmPositions {
    type Item = &'a f64;
    type IntoIter = std::slice::Iter<'a, f64>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// A sequence of numbers.
impl Serialize for ArmPositions {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

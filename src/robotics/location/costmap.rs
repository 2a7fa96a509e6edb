//! A grid of values over a part of the floor, the product of functions in 0..1, and why nothing is
//! left of it.

/// The corner (m) from which cells are counted, for x and y.
const ORIGIN: f64 = -6.0;

/// One factor of the product.
pub(super) struct Factor<'a> {
    /// The property that demands it, as users write it.
    pub(super) key: String,
    /// Its value at a point (m, map frame).
    pub(super) value: Box<dyn Fn([f64; 2]) -> f64 + 'a>,
}

/// The values of cells that are not 0.
#[derive(Clone, Debug, Default)]
pub struct Costmap {
    /// Edge length (m) of a cell.
    pub resolution: f64,
    /// Centres (m) of the cells, with their values in 0..1.
    pub cells: Vec<([f64; 2], f64)>,
}

/// A product of which nothing is left.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Emptied {
    /// The factors that leave nothing, two of them if two are enough.
    pub(super) keys: Vec<String>,
}

impl Costmap {
    /// The product of the factors over the cells whose centres are within the limits (m).
    pub(super) fn product(
        resolution: f64,
        limits: [[f64; 2]; 2],
        factors: &[Factor<'_>],
    ) -> Result<Self, Emptied> {
        Self::shifted_product(resolution, 0.0, limits, factors)
    }

    /// The same over cells that lie shifted by a part of a cell along x and y.
    pub(super) fn shifted_product(
        resolution: f64,
        shift: f64,
        [min, max]: [[f64; 2]; 2],
        factors: &[Factor<'_>],
    ) -> Result<Self, Emptied> {
        let mut cells: Vec<([f64; 2], f64)> = Vec::new();
        let columns = centres(resolution, shift, min[0], max[0]);
        let rows = centres(resolution, shift, min[1], max[1]);
        for x in columns {
            cells.extend(rows.iter().map(|y| ([x, *y], 1.0)));
        }
        let all = cells.clone();
        for (i, factor) in factors.iter().enumerate() {
            for (point, value) in &mut cells {
                *value *= (factor.value)(*point);
            }
            cells.retain(|(_, value)| *value > 0.0);
            if cells.is_empty() {
                return Err(Emptied::by(factors, i, &all));
            }
        }
        Ok(Self { resolution, cells })
    }

    /// Area (m²) of the cells.
    pub fn area(&self) -> f64 {
        self.cells.len() as f64 * self.resolution * self.resolution
    }
}

impl Emptied {
    /// Which factors up to number `last` leave nothing of the cells.
    fn by(factors: &[Factor<'_>], last: usize, cells: &[([f64; 2], f64)]) -> Self {
        let key = |i: usize| factors[i].key.clone();
        let is_empty = |wanted: &[usize]| {
            let mut points = cells.iter().map(|(point, _)| *point);
            !points.any(|p| wanted.iter().all(|i| (factors[*i].value)(p) > 0.0))
        };
        if is_empty(&[last]) {
            return Self {
                keys: vec![key(last)],
            };
        }
        let other = (0..last).find(|i| is_empty(&[*i, last]));
        let keys = match other {
            Some(other) => vec![key(other), key(last)],
            None => (0..=last).map(key).collect(),
        };
        Self { keys }
    }
}

/// Centres (m) of the cells, shifted by a part of a cell, between the limits (m) of one coordinate.
fn centres(resolution: f64, shift: f64, min: f64, max: f64) -> Vec<f64> {
    let centre = shift + 0.5;
    // The limits are those of a room.
    let first = ((min - ORIGIN) / resolution - centre).ceil() as i64;
    let last = ((max - ORIGIN) / resolution - centre).floor() as i64;
    (first..=last)
        .map(|i| ORIGIN + (i as f64 + centre) * resolution)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factor(key: &str, value: impl Fn([f64; 2]) -> f64 + 'static) -> Factor<'static> {
        Factor {
            key: key.to_owned(),
            value: Box::new(value),
        }
    }

    #[test]
    fn the_keys_that_leave_nothing_are_named() {
        let factors = [
            factor("(range 1)", |[x, _]| f64::from(x < 1.0)),
            factor("(side left)", |[_, y]| f64::from(y > 0.0)),
            factor("(range-invert 2)", |[x, _]| f64::from(x > 2.0)),
        ];
        let limits = [[-3.0, -3.0], [3.0, 3.0]];
        let map = Costmap::product(0.1, limits, &factors[..2]).unwrap();
        assert!((map.area() - 4.0 * 3.0).abs() < 0.2, "{}", map.area());
        let emptied = Costmap::product(0.1, limits, &factors).unwrap_err();
        assert_eq!(emptied.keys, ["(range 1)", "(range-invert 2)"]);
    }
}

//! What stands on the floor: rectangles, free ways between them, and how much room there is.

/// A rectangle on the floor (m) with sides along the axes of the room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rectangle {
    pub(crate) low: [f64; 2],
    pub(crate) high: [f64; 2],
}

impl Rectangle {
    /// The one with two opposite corners.
    pub(crate) fn of(a: [f64; 2], b: [f64; 2]) -> Self {
        Self {
            low: [a[0].min(b[0]), a[1].min(b[1])],
            high: [a[0].max(b[0]), a[1].max(b[1])],
        }
    }

    /// Whether two overlap by more than a millimetre.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|i| self.low[i] < other.high[i] - 1e-3 && other.low[i] < self.high[i] - 1e-3)
    }

    /// Whether it is inside another one.
    pub(crate) fn is_inside(&self, other: &Self) -> bool {
        (0..2).all(|i| self.low[i] >= other.low[i] - 1e-6 && self.high[i] <= other.high[i] + 1e-6)
    }

    /// The same, larger on all sides (m).
    pub(crate) fn grown(&self, by: f64) -> Self {
        Self {
            low: self.low.map(|x| x - by),
            high: self.high.map(|x| x + by),
        }
    }

    /// The smallest one around two.
    pub(crate) fn with(&self, other: &Self) -> Self {
        Self {
            low: [0, 1].map(|i| self.low[i].min(other.low[i])),
            high: [0, 1].map(|i| self.high[i].max(other.high[i])),
        }
    }

    /// Distance (m) of a point.
    pub(crate) fn distance(&self, point: [f64; 2]) -> f64 {
        self.squared_distance(point).sqrt()
    }

    /// Its square.
    fn squared_distance(&self, [px, py]: [f64; 2]) -> f64 {
        let x = (self.low[0] - px).max(px - self.high[0]).max(0.0);
        let y = (self.low[1] - py).max(py - self.high[1]).max(0.0);
        x * x + y * y
    }
}

/// Distance (m) between the cells of a map.
const CELL: f64 = 0.05;

/// The floor of a room with what stands on it, cell by cell.
pub(crate) struct Floor {
    low: [f64; 2],
    size: [usize; 2],
    /// Distance (m) of each cell to what is nearest, walls among it.
    clear: Vec<f64>,
    /// Whether a robot gets to each cell.
    reached: Vec<bool>,
}

impl Floor {
    /// A room with obstacles.
    pub(crate) fn new(room: &Rectangle, obstacles: &[Rectangle]) -> Self {
        let size = [0, 1].map(|i| ((room.high[i] - room.low[i]) / CELL) as usize + 1);
        let mut floor = Self {
            low: room.low,
            size,
            clear: Vec::new(),
            reached: vec![false; size[0] * size[1]],
        };
        for cell in 0..size[0] * size[1] {
            let point = floor.point(cell);
            let walls = (0..2).map(|i| (point[i] - room.low[i]).min(room.high[i] - point[i]));
            let nearest = obstacles.iter().fold(f64::INFINITY, |nearest, one| {
                nearest.min(one.squared_distance(point))
            });
            floor.clear.push(walls.fold(nearest.sqrt(), f64::min));
        }
        floor
    }

    /// The middle of a cell.
    fn point(&self, cell: usize) -> [f64; 2] {
        [
            self.low[0] + (cell % self.size[0]) as f64 * CELL,
            self.low[1] + (cell / self.size[0]) as f64 * CELL,
        ]
    }

    /// The point with the most room, and how much (m).
    pub(crate) fn widest(&self) -> Option<([f64; 2], f64)> {
        let cells = self.clear.iter().copied().enumerate();
        let best = cells.reduce(|best, one| if one.1 > best.1 { one } else { best })?;
        Some((self.point(best.0), best.1))
    }

    /// Forgets where a robot gets.
    pub(crate) fn forget(&mut self) {
        self.reached.fill(false);
    }

    /// Finds out where a robot gets from a point if it needs so much room (m) to all sides.
    pub(crate) fn explore(&mut self, from: [f64; 2], room: f64) {
        let [width, depth] = self.size;
        let place = [0, 1].map(|i| ((from[i] - self.low[i]) / CELL).round().max(0.0) as usize);
        let start = place[1].min(depth - 1) * width + place[0].min(width - 1);
        let mut pending = vec![start];
        while let Some(cell) = pending.pop() {
            if self.reached[cell] || self.clear[cell] < room {
                continue;
            }
            self.reached[cell] = true;
            let (x, y) = (cell % width, cell / width);
            if x > 0 {
                pending.push(cell - 1);
            }
            if x + 1 < width {
                pending.push(cell + 1);
            }
            if y > 0 {
                pending.push(cell - width);
            }
            if y + 1 < depth {
                pending.push(cell + width);
            }
        }
    }

    /// The cells whose middles are in a rectangle.
    fn cells_in(&self, place: &Rectangle) -> impl Iterator<Item = usize> {
        let [columns, rows] = [0, 1].map(|i| {
            let cell = |at: f64| ((at - self.low[i]) / CELL).max(0.0);
            let from = (cell(place.low[i]) as usize).saturating_sub(1);
            let to = (cell(place.high[i]) as usize).saturating_add(2);
            from..to.min(self.size[i])
        });
        let cells = rows.flat_map(move |y| columns.clone().map(move |x| y * self.size[0] + x));
        cells.filter(|cell| place.distance(self.point(*cell)) == 0.0)
    }

    /// Whether a robot gets to some point of a rectangle.
    pub(crate) fn gets_to(&self, place: &Rectangle) -> bool {
        self.cells_in(place).any(|cell| self.reached[cell])
    }

    /// A point of a rectangle, the one with the most room, where a robot can stand that needs so much room (m) to all sides.
    pub(crate) fn free_in(&self, place: &Rectangle, room: f64) -> Option<[f64; 2]> {
        let cells = self.cells_in(place);
        self.widest_of(cells.filter(|cell| self.clear[*cell] >= room))
    }

    /// The point with the most room where a robot gets.
    pub(crate) fn widest_reached(&self) -> Option<[f64; 2]> {
        self.widest_of((0..self.clear.len()).filter(|cell| self.reached[*cell]))
    }

    fn widest_of(&self, cells: impl Iterator<Item = usize>) -> Option<[f64; 2]> {
        let best = cells.reduce(|best, cell| match self.clear[cell] > self.clear[best] {
            true => cell,
            false => best,
        });
        best.map(|cell| self.point(cell))
    }
}

//! A lattice of poses of the base, searched with A*.
//!
//! There are two grids of positions and headings: one over the whole floor, with its origin at
//! the start, and one around the goal, with its origin there, since a tight place is left
//! straight. The search begins in the first and passes to the nearest cell of the second, in which
//! it ends. Cells are checked when the search reaches them, edges when a path uses them.
//!
//! To find out soon that the goal is enclosed, everything from which it can be reached is explored
//! at the same time: if that comes to an end before the two meet, there is no path. What a search
//! has found out about the first grid, which parts of it are cut off from the start included, is kept
//! for searches from the same start to other goals.

use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap, VecDeque};
use std::f64::consts::FRAC_PI_8;

use super::base_path::Search;
use super::drive_legs::{self, BACK_COST, TURN_COST};
use super::pages::Pages;
use crate::motion::failure::base_place::BasePlace;
use crate::robot::description::DriveKind;
use crate::world::{CellSet, ExploredGrid, Known};
use spatial::trig;

/// Number of headings, and the angle (rad) between neighbouring ones.
const HEADINGS: i32 = 16;
const TURN: f64 = FRAC_PI_8;
/// The second grid extends this far (m) from the goal in x and y.
const AROUND_GOAL: f64 = 0.6;
/// Weight of the heuristic; above 1 the search is faster, and the path may be longer by
/// that factor.
const GREED: f64 = 1.3;
/// Extra cost (m) per pose in collision.
const TOUCH_COST: f64 = 2.0;
/// Number of cells that are expanded before the goal's surroundings are explored, too.
const ONE_SIDED: usize = 400;
/// How many paths with a blocked edge are found before giving up.
const MAX_PATHS: u32 = 40;

/// Number of a cell.
type Cell = u32;

/// A grid of positions and headings.
struct Grid {
    origin: BasePlace,
    spacing: f64,
    /// Smallest steps in x and y from the origin, and their numbers.
    low: [i32; 2],
    counts: [i32; 2],
    /// Number of the first of its cells.
    first: Cell,
}

impl Grid {
    fn new(origin: BasePlace, spacing: f64, min: [f64; 2], max: [f64; 2], first: Cell) -> Self {
        // The floor is some metres wide.
        let steps = |i: usize, end: f64| (end - origin[i]) / spacing;
        let low = [0, 1].map(|i| (steps(i, min[i]).ceil() as i32).min(0));
        let high = [0, 1].map(|i| (steps(i, max[i]).floor() as i32).max(0));
        let counts = [0, 1].map(|i| high[i] - low[i] + 1);
        Self {
            origin,
            spacing,
            low,
            counts,
            first,
        }
    }

    /// Number of its cells.
    fn size(&self) -> Cell {
        (self.counts[0] * self.counts[1] * HEADINGS).unsigned_abs()
    }

    /// The cell at those steps from the origin; the heading may have any number of turns.
    fn cell(&self, [i, j, k]: [i32; 3]) -> Option<Cell> {
        let [i, j] = [i - self.low[0], j - self.low[1]];
        let is_inside = (0..self.counts[0]).contains(&i) && (0..self.counts[1]).contains(&j);
        let number = (i * self.counts[1] + j) * HEADINGS + k.rem_euclid(HEADINGS);
        is_inside.then(|| self.first + number.unsigned_abs())
    }

    /// The steps of one of its cells from the origin.
    fn steps(&self, cell: Cell) -> [i32; 3] {
        // There are far fewer cells than an i32 can count.
        let number = (cell - self.first) as i32;
        let (place, k) = (number / HEADINGS, number % HEADINGS);
        let (i, j) = (place / self.counts[1], place % self.counts[1]);
        [i + self.low[0], j + self.low[1], k]
    }

    fn place(&self, [i, j, k]: [i32; 3]) -> BasePlace {
        let [x, y, yaw] = self.origin;
        [
            x + f64::from(i) * self.spacing,
            y + f64::from(j) * self.spacing,
            yaw + f64::from(k) * TURN,
        ]
    }

    /// Steps from the origin to the place next to the given one.
    fn nearest(&self, place: &BasePlace) -> [i32; 3] {
        // Places are on the floor, so the casts are exact.
        let steps = |i: usize| ((place[i] - self.origin[i]) / self.spacing).round() as i32;
        let turn = trig::wrap(place[2] - self.origin[2]) / TURN;
        [steps(0), steps(1), turn.round() as i32]
    }
}

/// The two grids, and what is known of their cells.
pub(super) struct Lattice<'s, 'a, 'c, P> {
    search: &'s mut Search<'a, 'c, P>,
    floor: Grid,
    around_goal: Grid,
    /// Whether the path may pass through collisions, at extra cost.
    through: bool,
    known: Vec<Known>,
    /// What is kept of the first grid.
    explored: &'s mut ExploredGrid,
    bad_edges: BTreeSet<(Cell, Cell)>,
}

/// The exploration of everything from which the goal can be reached.
struct Backwards {
    queue: VecDeque<Cell>,
    reached: CellSet,
    is_over: bool,
    /// Whether all cells of the first grid are known that can be reached from the start.
    is_last_word: bool,
}

impl<'s, 'a, 'c, P: Clone + PartialEq> Lattice<'s, 'a, 'c, P> {
    /// A lattice with the spacing (m); a path that may go `through` obstacles avoids them if it
    /// can.
    pub(super) fn new(
        search: &'s mut Search<'a, 'c, P>,
        spacing: f64,
        through: bool,
        explored: &'s mut ExploredGrid,
    ) -> Self {
        let (area, goal) = (search.area, search.goal);
        // A base that drives ahead only does so along the lines of the grid.
        let origin = |[x, y, yaw]: BasePlace| match search.drive {
            DriveKind::Omnidirectional | DriveKind::Fixed => [x, y, yaw],
            DriveKind::Differential => [x, y, 0.0],
        };
        let floor = Grid::new(origin(search.start), spacing, area.min, area.max, 0);
        let min = [0, 1].map(|i| area.min[i].max(goal[i] - AROUND_GOAL));
        let max = [0, 1].map(|i| area.max[i].min(goal[i] + AROUND_GOAL));
        let around_goal = Grid::new(origin(goal), spacing, min, max, floor.size());
        let size = (floor.size() + around_goal.size()) as usize;
        explored.cells.resize(floor.size() as usize, Known::Nothing);
        Self {
            search,
            floor,
            around_goal,
            through,
            known: vec![Known::Nothing; size],
            explored,
            bad_edges: BTreeSet::new(),
        }
    }

    /// The cheapest path whose edges are free at full resolution.
    pub(super) fn path(mut self) -> Option<Vec<BasePlace>> {
        for _ in 0..MAX_PATHS {
            let cells = self.cheapest()?;
            let places = self.unwound(&cells);
            if self.through {
                return Some(self.with_ends(places));
            }
            let mut good = true;
            for (leg, cells) in places.windows(2).zip(cells.windows(2)) {
                if self.search.edge(&leg[0], &leg[1]).is_some() {
                    self.bad_edges.insert((cells[0], cells[1]));
                    self.bad_edges.insert((cells[1], cells[0]));
                    good = false;
                }
            }
            if good {
                let path = self.with_ends(places);
                return self.ends_are_free(&path).then_some(path);
            }
        }
        None
    }

    fn grid(&self, cell: Cell) -> &Grid {
        if cell < self.around_goal.first {
            &self.floor
        } else {
            &self.around_goal
        }
    }

    fn place(&self, cell: Cell) -> BasePlace {
        let grid = self.grid(cell);
        grid.place(grid.steps(cell))
    }

    /// The path with start and goal themselves, whose headings may be between those of the grids.
    fn with_ends(&self, mut path: Vec<BasePlace>) -> Vec<BasePlace> {
        if self.search.drive != DriveKind::Differential {
            return path;
        }
        path.insert(0, self.search.start);
        path.push(self.search.goal);
        path
    }

    /// Whether the robot can turn from start to grid and from grid to goal.
    fn ends_are_free(&mut self, path: &[BasePlace]) -> bool {
        let last = path.len().saturating_sub(2);
        let mut turns = [path.get(..2), path.get(last..)].into_iter().flatten();
        self.search.drive != DriveKind::Differential
            || turns.all(|turn| self.search.edge(&turn[0], &turn[1]).is_none())
    }

    /// Poses of the cells, with headings that are continuous from one to the next.
    fn unwound(&self, cells: &[Cell]) -> Vec<BasePlace> {
        let mut yaw = self.search.start[2];
        let mut places: Vec<BasePlace> = Vec::new();
        for &cell in cells {
            let mut place = self.place(cell);
            yaw += trig::wrap(place[2] - yaw);
            place[2] = yaw;
            places.push(place);
        }
        places
    }

    fn is_free(&mut self, cell: Cell) -> bool {
        let index = cell as usize;
        if self.known[index] == Known::Nothing {
            self.known[index] = self.look_up(cell);
        }
        self.known[index] == Known::Free
    }

    fn look_up(&mut self, cell: Cell) -> Known {
        let place = self.place(cell);
        let kept = match self.search.depends_on_goal(&place) {
            true => None,
            false => self.explored.cells.get_mut(cell as usize),
        };
        if let Some(known) = kept.as_deref().copied()
            && known != Known::Nothing
        {
            return known;
        }
        let known = match self.search.place(&place) {
            None => Known::Free,
            Some(_) => Known::Occupied,
        };
        if let Some(kept) = kept {
            *kept = known;
        }
        known
    }

    /// Whether it is kept what can be reached: not if that depends on the goal.
    fn keeps_reached(&self) -> bool {
        !self.through && !self.search.spares_goal()
    }

    /// Keeps that cells of the first grid cannot be reached from the start.
    fn cut_off(&mut self, cells: &CellSet) {
        if !self.keeps_reached() {
            return;
        }
        self.explored.cut_off.extend(cells);
        self.explored.cut_off.truncate(self.explored.cells.len());
    }

    /// Least cost from the pose to the goal if nothing were in the way.
    fn estimate(&self, place: &BasePlace) -> f64 {
        cost_between(place, &self.search.goal)
    }

    /// The neighbouring cells of the same grid, with the costs to get there.
    fn beside(&self, cell: Cell) -> impl Iterator<Item = (Cell, f64)> {
        const DIAGONAL: f64 = std::f64::consts::SQRT_2;
        let grid = self.grid(cell);
        let [i, j, k] = grid.steps(cell);
        let spacing = grid.spacing;
        let turns = [1, -1].map(|turn| ([i, j, k + turn], TURN * TURN_COST));
        let moves = (-1..=1).flat_map(move |di| (-1..=1).map(move |dj| (di, dj)));
        let drive = self.search.drive;
        let moves = moves.filter(|step| *step != (0, 0));
        let moves = moves.filter_map(move |(di, dj)| {
            let length = if di == 0 || dj == 0 { 1.0 } else { DIAGONAL };
            let dearer = match drive {
                DriveKind::Omnidirectional | DriveKind::Fixed => 1.0,
                DriveKind::Differential => along(k, (di, dj))?,
            };
            Some(([i + di, j + dj, k], length * spacing * dearer))
        });
        let all = turns.into_iter().chain(moves);
        all.filter_map(|(steps, cost)| Some((grid.cell(steps)?, cost)))
    }

    /// The cell of the second grid next to that of the first, with the cost to get there.
    fn across(&self, cell: Cell) -> Option<(Cell, f64)> {
        if cell >= self.around_goal.first {
            return None;
        }
        let place = self.place(cell);
        let steps = self.around_goal.nearest(&place);
        let next = self.around_goal.cell(steps)?;
        let there = self.around_goal.place(steps);
        let cost = match self.search.drive {
            DriveKind::Omnidirectional | DriveKind::Fixed => cost_between(&place, &there),
            DriveKind::Differential => drive_legs::cost(self.search.drive, &place, &there),
        };
        Some((next, cost))
    }

    /// The cells of the first grid from which that of the second is the nearest.
    fn across_from(&self, cell: Cell) -> Vec<Cell> {
        if cell < self.around_goal.first {
            return Vec::new();
        }
        let [i, j, k] = self.floor.nearest(&self.place(cell));
        let near = |n: i32| n - 1..=n + 1;
        let cells = near(i).flat_map(|i| near(j).map(move |j| [i, j]));
        let cells = cells.flat_map(|[i, j]| near(k).map(move |k| [i, j, k]));
        let cells = cells.filter_map(|steps| self.floor.cell(steps));
        cells
            .filter(|near| self.across(*near).is_some_and(|(next, _)| next == cell))
            .collect()
    }

    /// A* over free cells; edges are assumed to be free unless known otherwise.
    fn cheapest(&mut self) -> Option<Vec<Cell>> {
        // Both grids have their origin within them.
        let start = self.floor.cell(self.floor.nearest(&self.search.start))?;
        let goal = (self.around_goal).cell(self.around_goal.nearest(&self.search.goal))?;
        self.known[start as usize] = Known::Free;
        self.known[goal as usize] = Known::Free;
        let size = self.known.len();
        let mut costs = Pages::new(size, f64::INFINITY);
        let mut parents = Pages::new(size, start);
        let mut done = CellSet::default();
        let mut backwards = Backwards {
            queue: VecDeque::from([goal]),
            reached: CellSet::default(),
            is_over: self.through,
            is_last_word: self.explored.reached.is_some(),
        };
        if let Some(reached) = self.explored.reached.take() {
            while !backwards.is_over && self.explore(&mut backwards, &reached) {}
            self.explored.reached = Some(reached);
            if !backwards.is_over {
                return None;
            }
        }
        costs.set(start as usize, 0.0);
        let mut open = BinaryHeap::from([Candidate {
            total: 0.0,
            cell: start,
        }]);
        let mut expanded = 0;
        while let Some(Candidate { cell, .. }) = open.pop() {
            if !done.insert(cell as usize) {
                continue;
            }
            if cell == goal {
                return Some(trace(&parents, start, goal));
            }
            expanded += 1;
            if expanded > ONE_SIDED && !self.explore(&mut backwards, &done) {
                return None;
            }
            let so_far = costs.get(cell as usize);
            let next: Vec<_> = self.beside(cell).chain(self.across(cell)).collect();
            for (next, step) in next {
                if so_far + step >= costs.get(next as usize)
                    || done.contains(next as usize)
                    || self.bad_edges.contains(&(cell, next))
                {
                    continue;
                }
                let touch = match (self.is_free(next), self.through) {
                    (true, _) => 0.0,
                    (false, true) => TOUCH_COST,
                    (false, false) => continue,
                };
                let new = so_far + step + touch;
                if new < costs.get(next as usize) {
                    costs.set(next as usize, new);
                    parents.set(next as usize, cell);
                    let total = new + GREED * self.estimate(&self.place(next));
                    open.push(Candidate { total, cell: next });
                }
            }
        }
        if self.keeps_reached() && self.bad_edges.is_empty() {
            if !backwards.is_over {
                self.cut_off(&backwards.reached);
            }
            done.truncate(self.explored.cells.len());
            self.explored.reached = Some(done);
        }
        None
    }

    /// Expands one more cell from which the goal can be reached. Returns whether there may be a
    /// path to one of those that are done.
    fn explore(&mut self, backwards: &mut Backwards, done: &CellSet) -> bool {
        if backwards.is_over {
            return true;
        }
        let Some(cell) = backwards.queue.pop_front() else {
            self.cut_off(&backwards.reached);
            return false;
        };
        if done.contains(cell as usize) {
            backwards.is_over = true;
            return true;
        }
        // What is beside a cell that is cut off is cut off, too.
        let is_on_floor = cell < self.around_goal.first;
        let is_cut_off = backwards.is_last_word || self.explored.cut_off.contains(cell as usize);
        if is_on_floor && is_cut_off {
            return true;
        }
        let before: Vec<Cell> = self.beside(cell).map(|(next, _)| next).collect();
        for next in before.into_iter().chain(self.across_from(cell)) {
            let is_known = backwards.reached.contains(next as usize);
            if !is_known && self.is_free(next) {
                backwards.reached.insert(next as usize);
                backwards.queue.push_back(next);
            }
        }
        true
    }
}

/// How much more a step costs a base that drives ahead only with that heading; `None` if it is not along it.
fn along(heading: i32, (di, dj): (i32, i32)) -> Option<f64> {
    // The step's direction, in eighths of a turn.
    let direction = match (di, dj) {
        (1, 0) => 0,
        (1, 1) => 1,
        (0, 1) => 2,
        (-1, 1) => 3,
        (-1, 0) => 4,
        (-1, -1) => 5,
        (0, -1) => 6,
        _ => 7,
    };
    match (heading - 2 * direction).rem_euclid(HEADINGS) {
        0 => Some(1.0),
        8 => Some(1.0 + BACK_COST),
        _ => None,
    }
}

/// Cost (m) from one pose to the other, driving and turning.
fn cost_between(from: &BasePlace, to: &BasePlace) -> f64 {
    let turn = trig::wrap(to[2] - from[2]).abs() * TURN_COST;
    libm::hypot(to[0] - from[0], to[1] - from[1]) + turn
}

/// The cells from the start to the goal.
fn trace(parents: &Pages<Cell>, start: Cell, goal: Cell) -> Vec<Cell> {
    let mut cells = vec![goal];
    let mut cell = goal;
    while cell != start {
        cell = parents.get(cell as usize);
        cells.push(cell);
    }
    cells.reverse();
    cells
}

/// A cell to expand; the greatest is the one with the least total cost.
#[derive(Debug, PartialEq)]
struct Candidate {
    total: f64,
    cell: Cell,
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .total
            .total_cmp(&self.total)
            .then_with(|| other.cell.cmp(&self.cell))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

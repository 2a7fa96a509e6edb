//! Search for a collision-free joint path between two configurations.
//!
//! The straight path is tried first, then RRT-Connect (Kuffner and LaValle, 2000): if there
//! are several chains of joints, for one after another, then for all at once. The result is
//! shortened. The caller checks for collisions, and says what blocks a configuration where that
//! is told. All randomness comes from the generator passed in, so the same input gives
//! the same path. Nothing here knows of robots or time.

use super::path_test::PathTest;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// One axis of the search space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PathAxis {
    /// Smallest value to try (rad or m).
    pub lower: f64,
    /// Largest value to try (rad or m).
    pub upper: f64,
    /// Upper bound (m) on the motion of any part of the robot per unit of the axis.
    pub reach: f64,
    /// The chain of joints that the axis belongs to, such as one of two arms: axes of
    /// different chains move different parts. [`ALL_CHAINS`] for an axis that moves them all.
    pub chain: usize,
}

impl PathAxis {
    /// The value at a fraction of the part of the range about a value that is within a share of the
    /// range; of all of the range if the share is 1.
    fn about(&self, value: f64, share: f64, fraction: f64) -> f64 {
        let (mut lower, mut upper) = (self.lower, self.upper);
        if share < 1.0 {
            let half = (upper - lower) * share / 2.0;
            lower = (value - half).clamp(lower, upper);
            upper = (value + half).clamp(lower, upper);
        }
        lower + (upper - lower) * fraction
    }
}

/// The chain of an axis that carries all other chains.
pub(crate) const ALL_CHAINS: usize = 0;

/// Why there is no path; `P` is what the caller's check returns.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum JointPathFailure<P> {
    /// The start is blocked.
    Start(P),
    /// The goal is blocked.
    Goal(P),
    /// No path was found.
    NotFound {
        /// What blocks the straight path first.
        blocker: P,
        /// How many random configurations were tried.
        samples: usize,
    },
}

/// Resolution and limits of the search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct JointPathEffort {
    /// Largest motion (m) of any part of the robot between two checked configurations.
    pub resolution: f64,
    /// Maximum number of random configurations.
    pub samples: usize,
    /// Maximum number of configurations checked in total.
    pub(crate) checks: usize,
    /// Attempts to shorten the path.
    pub(crate) shortcuts: usize,
}

impl Default for JointPathEffort {
    fn default() -> Self {
        Self {
            resolution: 0.01,
            samples: 1500,
            checks: 30_000,
            shortcuts: 40,
        }
    }
}

/// Longest new branch of a tree, as a bound (m) on the motion of any part of the robot.
const BRANCH: f64 = 0.5;

/// The same where few configurations keep what the path is to keep: straight edges between two that do soon
/// leave them.
const SETTLED_BRANCH: f64 = 0.25;

/// The share of its length by which a branch whose end was settled comes nearer to its goal at least.
const PROGRESS: f64 = 0.1;

/// Random configurations are drawn from around the straight path, at first within this share of the
/// ranges of the axes: most obstacles are passed by a small detour.
const NARROWEST: f64 = 0.4;

/// How many more random configurations make the share larger by 1; from there on they come from
/// anywhere.
const WIDENING: f64 = 1000.0;

/// One in so many random configurations comes from anywhere in any case.
const FROM_ANYWHERE: usize = 3;

/// A shortcut saves at least this share of the way that it replaces; others are not worth the checks.
const MIN_GAIN: f64 = 0.05;

/// A goal from which no more configurations than this have been reached with so many random ones can hardly be left: the
/// caller may have others. A start is the only one.
const TRAPPED: (usize, usize) = (2, 500);

/// How much coarser the edges are checked during the search than in the result.
const COARSENESS: f64 = 2.5;

/// Number of distinct chains, including [`ALL_CHAINS`].
const CHAINS: usize = 3;

type Point = Vec<f64>;

/// Changes a configuration into one near it that keeps what the path is to keep; returns whether there is one.
pub(crate) type Settle<'a> = dyn Fn(&mut [f64]) -> bool + 'a;

/// A path from `start` to `goal`, both included, on which the test finds nothing. If few configurations
/// keep what it is to keep, `settle` leads others to them (Berenson, Srinivasa and Kuffner: Task Space
/// Regions, 2011).
pub(crate) fn find_joint_path<P>(
    axes: &[PathAxis],
    start: &[f64],
    goal: &[f64],
    effort: JointPathEffort,
    rng: &mut Pcg64,
    test: &mut dyn PathTest<P>,
    settle: Option<&Settle<'_>>,
) -> Result<Vec<Point>, JointPathFailure<P>> {
    if let Some(p) = test.obstacle(goal) {
        return Err(JointPathFailure::Goal(p));
    }
    if let Some(p) = test.obstacle(start) {
        return Err(JointPathFailure::Start(p));
    }
    let mut search = Search {
        axes,
        effort,
        test,
        settle,
        checks: 0,
        samples: 0,
    };
    let Some(blocker) = search.obstacle_on_edge(start, goal) else {
        return Ok(vec![start.to_vec(), goal.to_vec()]);
    };
    // A coarse search usually suffices; if it does not, a fine one follows.
    for coarseness in [COARSENESS, 1.0] {
        search.effort.resolution = effort.resolution * coarseness;
        let found = search.in_turns(start, goal, rng);
        let Some(path) = found.or_else(|| search.connect(start, goal, None, rng)) else {
            break;
        };
        let path = search.shorten(path, rng);
        search.effort.resolution = effort.resolution;
        if path
            .windows(2)
            .all(|leg| search.is_edge_free(&leg[0], &leg[1]))
        {
            return Ok(path);
        }
    }
    Err(JointPathFailure::NotFound {
        blocker,
        samples: search.samples,
    })
}

/// Whether nothing blocks the straight path between two free configurations.
pub(crate) fn is_free_between<P>(
    axes: &[PathAxis],
    from: &[f64],
    to: &[f64],
    resolution: f64,
    test: &mut dyn PathTest<P>,
) -> bool {
    let effort = JointPathEffort {
        resolution,
        ..JointPathEffort::default()
    };
    Search {
        axes,
        effort,
        test,
        settle: None,
        checks: 0,
        samples: 0,
    }
    .is_edge_free(from, to)
}

struct Search<'a, P> {
    axes: &'a [PathAxis],
    effort: JointPathEffort,
    test: &'a mut dyn PathTest<P>,
    settle: Option<&'a Settle<'a>>,
    /// Number of configurations checked.
    checks: usize,
    /// Number of random configurations of the longest attempt.
    samples: usize,
}

/// Configurations connected to the first one, each with its parent's index.
struct Tree(Vec<(Point, usize)>);

enum Growth {
    Reached(usize),
    Advanced(usize),
    Trapped,
}

impl<P> Search<'_, P> {
    /// Bound on how far (m) any part of the robot moves between the two.
    fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let (mut all, mut chains) = (0.0, [0.0; CHAINS]);
        for ((a, b), axis) in a.iter().zip(b).zip(self.axes) {
            let moved = (a - b).abs() * axis.reach;
            match chains.get_mut(axis.chain) {
                Some(chain) if axis.chain != ALL_CHAINS => *chain += moved,
                _ => all += moved,
            }
        }
        chains.into_iter().fold(0.0, f64::max) + all
    }

    /// What blocks the interior points of the edge, if anything does.
    fn obstacle_on_edge(&mut self, from: &[f64], to: &[f64]) -> Option<P> {
        self.find_on_edge(from, to, |test, point| test.obstacle(point))
    }

    /// Whether the interior points of the edge are free.
    fn is_edge_free(&mut self, from: &[f64], to: &[f64]) -> bool {
        let met = self.find_on_edge(from, to, |test, point| (!test.is_free(point)).then_some(()));
        met.is_none()
    }

    /// What is found at an interior point of the edge, coarse steps first.
    fn find_on_edge<T>(
        &mut self,
        from: &[f64],
        to: &[f64],
        look: impl Fn(&mut dyn PathTest<P>, &[f64]) -> Option<T>,
    ) -> Option<T> {
        super::interruption::look();
        let parts = (self.distance(from, to) / self.effort.resolution)
            .ceil()
            .max(1.0) as usize;
        let mut stride = parts.next_power_of_two();
        while stride > 1 {
            for i in (stride / 2..parts).step_by(stride) {
                let point = between(from, to, i as f64 / parts as f64);
                self.checks += 1;
                if let Some(found) = look(&mut *self.test, &point) {
                    return Some(found);
                }
            }
            stride /= 2;
        }
        None
    }

    /// Moves one chain after another, trying each order.
    fn in_turns(&mut self, start: &[f64], goal: &[f64], rng: &mut Pcg64) -> Option<Vec<Point>> {
        for order in [[1, 2], [2, 1]] {
            if !order
                .iter()
                .all(|chain| self.axes.iter().any(|axis| axis.chain == *chain))
            {
                return None;
            }
            // Axes that carry all chains move with the first one.
            let halfway: Point = (start.iter().zip(goal).zip(self.axes))
                .map(|((from, to), axis)| if axis.chain == order[1] { *from } else { *to })
                .collect();
            if !self.test.is_free(&halfway) {
                continue;
            }
            let Some(mut path) = self.leg(start, &halfway, order[0], rng) else {
                continue;
            };
            let Some(rest) = self.leg(&halfway, goal, order[1], rng) else {
                continue;
            };
            path.extend(rest.into_iter().skip(1));
            return Some(path);
        }
        None
    }

    /// A path on which only one chain moves.
    fn leg(
        &mut self,
        from: &[f64],
        to: &[f64],
        chain: usize,
        rng: &mut Pcg64,
    ) -> Option<Vec<Point>> {
        match self.is_edge_free(from, to) {
            true => Some(vec![from.to_vec(), to.to_vec()]),
            false => self.connect(from, to, Some(chain), rng),
        }
    }

    /// RRT-Connect, with all axes or with those of one chain alone.
    fn connect(
        &mut self,
        start: &[f64],
        goal: &[f64],
        chain: Option<usize>,
        rng: &mut Pcg64,
    ) -> Option<Vec<Point>> {
        let mut trees = [
            Tree(vec![(start.to_vec(), 0)]),
            Tree(vec![(goal.to_vec(), 0)]),
        ];
        let share = if chain.is_some() { 3 } else { 1 };
        for round in 0..self.effort.samples / share {
            let is_trapped = round >= TRAPPED.1 && trees[1].0.len() <= TRAPPED.0;
            if self.checks > self.effort.checks || is_trapped {
                return None;
            }
            self.samples = self.samples.max(round + 1);
            let side = round % 2;
            // Both trees have their turn, then the next share.
            let width = match (round / 2) % FROM_ANYWHERE {
                0 => 1.0,
                _ => (NARROWEST + round as f64 / WIDENING).min(1.0),
            };
            let along = unit(rng);
            let mut sample: Point = (self.axes.iter().zip(start).zip(goal))
                .map(|((axis, from), to)| {
                    let stays = chain.is_some_and(|c| axis.chain != c) && from == to;
                    let random = axis.about(from + (to - from) * along, width, unit(rng));
                    if stays { *from } else { random }
                })
                .collect();
            if self.settle.is_some_and(|settle| !settle(&mut sample)) {
                continue;
            }
            let [from_start, from_goal] = &mut trees;
            let (growing, other) = if side == 0 {
                (from_start, from_goal)
            } else {
                (from_goal, from_start)
            };
            let new = match self.extend(growing, &sample) {
                Growth::Reached(node) | Growth::Advanced(node) => node,
                Growth::Trapped => continue,
            };
            let target = growing.0[new].0.clone();
            let met = loop {
                match self.extend(other, &target) {
                    Growth::Reached(node) => break Some(node),
                    Growth::Advanced(_) => {}
                    Growth::Trapped => break None,
                }
            };
            if let Some(met) = met {
                let (mut path, mut rest) = (growing.branch(new), other.branch(met));
                path.reverse();
                rest.remove(0);
                path.append(&mut rest);
                if side == 1 {
                    path.reverse();
                }
                return Some(path);
            }
        }
        None
    }

    /// Grows the tree by one branch towards the target.
    fn extend(&mut self, tree: &mut Tree, target: &[f64]) -> Growth {
        let mut nearest = (0, f64::MAX);
        for (i, (point, _)) in tree.0.iter().enumerate() {
            let d = self.distance(point, target);
            if d < nearest.1 {
                nearest = (i, d);
            }
        }
        let (parent, distance) = nearest;
        let branch = match self.settle {
            None => BRANCH,
            Some(_) => SETTLED_BRANCH,
        };
        let from = &tree.0[parent].0;
        let reaches = distance <= branch;
        let mut to = if reaches {
            target.to_vec()
        } else {
            between(from, target, branch / distance)
        };
        if let Some(settle) = self.settle.filter(|_| !reaches)
            && (!settle(&mut to) || self.distance(&to, target) > distance - branch * PROGRESS)
        {
            return Growth::Trapped;
        }
        self.checks += 1;
        if !self.test.is_free(&to) || !self.is_edge_free(from, &to) {
            return Growth::Trapped;
        }
        tree.0.push((to, parent));
        let node = tree.0.len() - 1;
        if reaches {
            Growth::Reached(node)
        } else {
            Growth::Advanced(node)
        }
    }

    /// Replaces detours by straight edges: between random places, then between corners.
    fn shorten(&mut self, mut path: Vec<Point>, rng: &mut Pcg64) -> Vec<Point> {
        for _ in 0..self.effort.shortcuts {
            if path.len() <= 2 || self.checks > 2 * self.effort.checks {
                break;
            }
            let length = self.length(&path);
            let (a, b) = (unit(rng) * length, unit(rng) * length);
            let (i, from) = self.place(&path, a.min(b));
            let (j, to) = self.place(&path, a.max(b));
            let is_shorter = || {
                let corners = path[i + 1..=j].iter();
                let way = std::iter::once(&from).chain(corners).chain([&to]);
                self.straight(&from, &to) < (1.0 - MIN_GAIN) * self.along(way)
            };
            if i == j || !is_shorter() || !self.is_edge_free(&from, &to) {
                continue;
            }
            path.splice(i + 1..=j, [from, to]);
        }
        let mut i = 0;
        while i + 2 < path.len() {
            if self.is_edge_free(&path[i], &path[i + 2]) {
                path.remove(i + 1);
            } else {
                i += 1;
            }
        }
        path
    }

    /// The length of a straight edge, with the axes as coordinates: unlike the bound on the robot's
    /// motion, no way but the straight one is as short.
    fn straight(&self, a: &[f64], b: &[f64]) -> f64 {
        let moved = a.iter().zip(b).zip(self.axes);
        let squares = moved.map(|((a, b), axis)| ((a - b) * axis.reach).powi(2));
        squares.sum::<f64>().sqrt()
    }

    /// The sum of the lengths of the edges from point to point.
    fn along<'p>(&self, mut points: impl Iterator<Item = &'p Point>) -> f64 {
        let Some(mut last) = points.next() else {
            return 0.0;
        };
        let lengths = points.map(|point| {
            let length = self.straight(last, point);
            last = point;
            length
        });
        lengths.sum()
    }

    fn length(&self, path: &[Point]) -> f64 {
        path.windows(2).map(|w| self.distance(&w[0], &w[1])).sum()
    }

    /// The leg and the point at a distance along the path.
    fn place(&self, path: &[Point], mut along: f64) -> (usize, Point) {
        for (i, leg) in path.windows(2).enumerate() {
            let length = self.distance(&leg[0], &leg[1]);
            if along < length {
                return (i, between(&leg[0], &leg[1], along / length));
            }
            along -= length;
        }
        (
            path.len().saturating_sub(2),
            path.last().cloned().unwrap_or_default(),
        )
    }
}

impl Tree {
    /// The configurations from the node to the root.
    fn branch(&self, mut node: usize) -> Vec<Point> {
        let mut points = vec![self.0[node].0.clone()];
        while node != 0 {
            node = self.0[node].1;
            points.push(self.0[node].0.clone());
        }
        points
    }
}

/// The point at `fraction` of the edge.
pub(crate) fn between(from: &[f64], to: &[f64], fraction: f64) -> Point {
    from.iter()
        .zip(to)
        .map(|(a, b)| a + (b - a) * fraction)
        .collect()
}

/// A random number in 0..1 with 53 bits.
pub(super) fn unit(rng: &mut Pcg64) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

#[cfg(test)]
mod tests;

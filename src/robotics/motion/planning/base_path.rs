//! Search for a collision-free path of the robot's base over the floor.
//!
//! The base may move in any direction and turn in place, or it drives ahead and back only (its legs are those of
//! [`drive_legs`]). The straight path is tried
//! first, then A* on a lattice of positions and headings ([`Lattice`]). The result is shortened.
//! Paths keep a distance from obstacles where they can: the search first requires a margin, then
//! one that is just large enough that nothing is pushed between two checked poses; less only near a start or goal that has
//! less itself. The caller's closure
//! checks for collisions, so the robot's present posture and what its arms hold are taken into account.

use super::base_lattice::Lattice;
use super::drive_legs::{self, legs, with_legs};
use super::interruption;
use crate::motion::failure::base_place::BasePlace;
use crate::robot::description::DriveKind;
use crate::world::ExploredGrids;
use spatial::trig;

/// The part of the floor that is searched, in the map frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FloorArea {
    /// Smallest x and y (m).
    pub min: [f64; 2],
    /// Largest x and y (m).
    pub max: [f64; 2],
}

/// Why there is no path; `P` is what the caller's check returns.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum BasePathFailure<P> {
    /// The robot is in collision at the start.
    StartOccupied(P),
    /// The goal is occupied.
    GoalOccupied(P),
    /// Start and goal are free, but no path connects them.
    Enclosed {
        /// The obstacles on the path with the fewest collisions, without repetition, in order.
        blockers: Vec<P>,
    },
}

/// Clearance (m) that a path keeps where it can.
pub(super) const MARGIN: f64 = 0.04;
/// Clearance (m) that it keeps wherever else: with less than half the resolution, the robot could push
/// something between two checked poses.
pub(crate) const MIN_MARGIN: f64 = RESOLUTION / 2.0;
/// This close (m) to the start, and to the goal on the first lattice, it keeps no more than [`MIN_MARGIN`], and not even
/// that where start or goal has less.
const NEAR_END: f64 = 0.35;
/// Between two checked poses no part of the robot moves by more than this (m).
const RESOLUTION: f64 = 0.01;
/// The same where no margin is kept and something is nearer than [`MIN_MARGIN`]: what a corner may cut off another one
/// between two such poses is less than the overlap at which a step is refused.
const FINE_RESOLUTION: f64 = 0.001;
/// Lattice spacings (m) with the clearance (m) that is kept, in the order in which they are tried.
const SPACINGS: [(f64, f64); 2] = [(0.10, MARGIN), (0.05, MIN_MARGIN)];

type Check<'a, P> = dyn FnMut(&BasePlace, f64) -> Option<P> + 'a;

/// A path from `start` to `goal`, both included; the goal's heading is unwound so that the
/// robot turns in the shorter direction.
///
/// The path consists of legs as the base drives them. `blocked` returns what the robot touches at a pose, or what is closer than the margin
/// (m). `reach` (m) is the largest distance of any part of the robot from the base's axis.
/// `explored` is what earlier searches from the same start, with the same obstacles, have found
/// out, or the default.
pub(crate) fn find_base_path<P: Clone + PartialEq>(
    start: BasePlace,
    goal: BasePlace,
    (drive, area): (DriveKind, FloorArea),
    reach: f64,
    explored: &mut ExploredGrids,
    blocked: &mut Check<'_, P>,
) -> Result<Vec<BasePlace>, BasePathFailure<P>> {
    let goal = [goal[0], goal[1], start[2] + trig::wrap(goal[2] - start[2])];
    if let Some(p) = blocked(&goal, 0.0) {
        return Err(BasePathFailure::GoalOccupied(p));
    }
    if let Some(p) = blocked(&start, 0.0) {
        return Err(BasePathFailure::StartOccupied(p));
    }
    let mut margin_near = |end| match blocked(end, MIN_MARGIN) {
        None => MIN_MARGIN,
        Some(_) => 0.0,
    };
    let near_ends = [margin_near(&start), margin_near(&goal)];
    let mut search = Search {
        start,
        goal,
        area,
        drive,
        reach,
        margin: MARGIN,
        near_ends,
        blocked,
    };
    if search.edge(&start, &goal).is_none() {
        return Ok(with_legs(drive, &[start, goal]));
    }
    let [coarse, fine, through] = explored;
    for ((spacing, margin), grid) in SPACINGS.into_iter().zip([coarse, fine]) {
        search.margin = margin;
        if let Some(path) = Lattice::new(&mut search, spacing, false, grid).path() {
            return Ok(with_legs(drive, &search.shorten(path)));
        }
    }
    let blockers = match Lattice::new(&mut search, SPACINGS[0].0, true, through).path() {
        Some(path) => search.blockers(&path),
        None => Vec::new(),
    };
    Err(BasePathFailure::Enclosed { blockers })
}

/// A search with everything that it needs to know.
pub(super) struct Search<'a, 'c, P> {
    pub(super) start: BasePlace,
    pub(super) goal: BasePlace,
    pub(super) area: FloorArea,
    pub(super) drive: DriveKind,
    reach: f64,
    margin: f64,
    /// The margins near start and goal (m).
    near_ends: [f64; 2],
    blocked: &'a mut Check<'c, P>,
}

impl<P: Clone + PartialEq> Search<'_, '_, P> {
    /// What blocks the pose.
    pub(super) fn place(&mut self, p: &BasePlace) -> Option<P> {
        interruption::look();
        let margin = self.margin_at(p);
        (self.blocked)(p, margin)
    }

    /// The margin (m) that is kept at the pose.
    fn margin_at(&self, p: &BasePlace) -> f64 {
        let [near_start, near_goal] = self.near_ends;
        let mut margin = self.margin;
        if is_near(p, &self.start) {
            margin = margin.min(near_start);
        }
        if self.depends_on_goal(p) {
            margin = margin.min(near_goal);
        }
        margin
    }

    /// Whether it may depend on the goal what blocks a pose.
    pub(super) fn spares_goal(&self) -> bool {
        self.margin > MIN_MARGIN
    }

    /// Whether it depends on the goal what blocks the pose.
    pub(super) fn depends_on_goal(&self, p: &BasePlace) -> bool {
        self.spares_goal() && is_near(p, &self.goal)
    }

    /// What blocks the way from one place to another; the ends are assumed to be free.
    pub(super) fn edge(&mut self, from: &BasePlace, to: &BasePlace) -> Option<P> {
        let mut at = *from;
        let legs = legs(self.drive, from, to);
        let last = legs.len() - 1;
        for (i, to) in legs.into_iter().enumerate() {
            let from = std::mem::replace(&mut at, to);
            if i < last
                && let Some(p) = self.place(&to)
            {
                return Some(p);
            }
            if let Some(p) = self.leg(&from, &to) {
                return Some(p);
            }
        }
        None
    }

    /// What blocks the straight leg, coarse steps first; the ends are assumed to be free.
    fn leg(&mut self, from: &BasePlace, to: &BasePlace) -> Option<P> {
        let way =
            libm::hypot(to[0] - from[0], to[1] - from[1]) + (to[2] - from[2]).abs() * self.reach;
        let parts = (way / RESOLUTION).ceil().max(1.0) as usize;
        let mut stride = parts.next_power_of_two();
        while stride > 1 {
            for i in (stride / 2..parts).step_by(stride) {
                let place = between(from, to, i as f64 / parts as f64);
                if let Some(p) = self.place(&place) {
                    return Some(p);
                }
            }
            stride /= 2;
        }
        self.cut(from, to, parts)
    }

    /// What a part of the robot cuts off between the poses of a straight leg, so many parts of which have been checked,
    /// where no margin is kept.
    fn cut(&mut self, from: &BasePlace, to: &BasePlace, parts: usize) -> Option<P> {
        const FINE: usize = (RESOLUTION / FINE_RESOLUTION) as usize;
        let at = |i: usize| between(from, to, i as f64 / (FINE * parts) as f64);
        let mut was_close = false;
        for i in 0..=parts {
            let place = at(FINE * i);
            let is_close =
                self.margin_at(&place) < MIN_MARGIN && (self.blocked)(&place, MIN_MARGIN).is_some();
            if i > 0 && (was_close || is_close) {
                let mut between = FINE * (i - 1) + 1..FINE * i;
                if let Some(p) = between.find_map(|i| (self.blocked)(&at(i), 0.0)) {
                    return Some(p);
                }
            }
            was_close = is_close;
        }
        None
    }

    /// Replaces detours by free straight legs, the longest first; then cuts the corners that
    /// remain.
    fn shorten(&mut self, path: Vec<BasePlace>) -> Vec<BasePlace> {
        let mut short = self.skip(path);
        for _ in 0..3 {
            let halved = self.halve(&short);
            let next = self.skip(halved);
            if self.cost(&next) > self.cost(&short) - 0.01 {
                break;
            }
            short = next;
        }
        short
    }

    /// Adds the midpoint of every leg that is longer than 20 cm or turns more than 20 degrees.
    fn halve(&self, path: &[BasePlace]) -> Vec<BasePlace> {
        let mut fine: Vec<BasePlace> = path.first().copied().into_iter().collect();
        for leg in path.windows(2) {
            if drive_legs::cost(self.drive, &leg[0], &leg[1]) > 0.2 {
                fine.push(between(&leg[0], &leg[1], 0.5));
            }
            fine.push(leg[1]);
        }
        fine
    }

    fn cost(&self, path: &[BasePlace]) -> f64 {
        let legs = path.windows(2);
        legs.map(|leg| drive_legs::cost(self.drive, &leg[0], &leg[1]))
            .sum()
    }

    fn skip(&mut self, path: Vec<BasePlace>) -> Vec<BasePlace> {
        let mut short = Vec::new();
        let mut i = 0;
        while let Some(&from) = path.get(i) {
            short.push(from);
            let mut next = i + 1;
            for j in (i + 2..path.len()).rev() {
                if self.edge(&from, &path[j]).is_none() {
                    next = j;
                    break;
                }
            }
            i = next;
        }
        short
    }

    fn blockers(&mut self, path: &[BasePlace]) -> Vec<P> {
        let mut all = Vec::new();
        for leg in path.windows(2) {
            let met = self.place(&leg[1]).or_else(|| self.edge(&leg[0], &leg[1]));
            if let Some(p) = met
                && !all.contains(&p)
            {
                all.push(p);
            }
        }
        all
    }
}

/// Whether a pose is so near to another one, start or goal, that its margin counts.
fn is_near(p: &BasePlace, end: &BasePlace) -> bool {
    libm::hypot(p[0] - end[0], p[1] - end[1]) < NEAR_END
}

/// The pose at `fraction` of the leg.
fn between(from: &BasePlace, to: &BasePlace, fraction: f64) -> BasePlace {
    [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * fraction)
}

#[cfg(test)]
mod tests {
    use super::*;
    use spatial::trig;

    const OMNIDIRECTIONAL: DriveKind = DriveKind::Omnidirectional;
    const ROOM: FloorArea = FloorArea {
        min: [-3.0, -3.0],
        max: [3.0, 3.0],
    };

    /// A robot 1.0 m wide (along its own y) and 0.4 m long, as points along its width.
    fn touches(p: &BasePlace, margin: f64, wall: impl Fn(f64, f64, f64) -> bool) -> bool {
        let (s, c) = trig::sin_cos(p[2]);
        (-10..=10)
            .map(|i| f64::from(i) * 0.05)
            .any(|w| wall(p[0] - s * w, p[1] + c * w, 0.2 + margin))
    }

    fn find(
        goal: BasePlace,
        wall: impl Fn(f64, f64, f64) -> bool,
    ) -> Result<Vec<BasePlace>, BasePathFailure<&'static str>> {
        find_by(OMNIDIRECTIONAL, [-2.0, 0.0, 0.0], goal, wall)
    }

    /// A path for a base that drives ahead and back only.
    fn find_ahead(
        goal: BasePlace,
        wall: impl Fn(f64, f64, f64) -> bool,
    ) -> Result<Vec<BasePlace>, BasePathFailure<&'static str>> {
        find_by(DriveKind::Differential, [-2.0, 0.0, 0.3], goal, wall)
    }

    fn find_by(
        drive: DriveKind,
        start: BasePlace,
        goal: BasePlace,
        wall: impl Fn(f64, f64, f64) -> bool,
    ) -> Result<Vec<BasePlace>, BasePathFailure<&'static str>> {
        let mut blocked = |p: &BasePlace, m: f64| touches(p, m, &wall).then_some("wall");
        let explored = &mut ExploredGrids::default();
        find_base_path(start, goal, (drive, ROOM), 0.7, explored, &mut blocked)
    }

    /// A path for a base that drives in any direction, around what the closure finds.
    fn find_around(
        goal: BasePlace,
        explored: &mut ExploredGrids,
        blocked: &mut Check<'_, &'static str>,
    ) -> Result<Vec<BasePlace>, BasePathFailure<&'static str>> {
        let start = [-2.0, 0.0, 0.0];
        find_base_path(start, goal, (OMNIDIRECTIONAL, ROOM), 0.7, explored, blocked)
    }

    #[test]
    fn a_free_straight_way_is_taken() {
        let path = find([2.0, 0.0, 0.0], |_, _, _| false);
        assert_eq!(path, Ok(vec![[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0]]));
    }

    #[test]
    fn a_differential_base_never_drives_sideways_nor_into_a_wall() {
        let (mut found, mut legs) = (0, 0);
        for number in 0..24 {
            let wall = maze(number);
            for goal in [[2.0, 1.0, 0.0], [1.8, 1.1, 2.4], [2.0, -2.0, -1.0]] {
                let Ok(path) = find_ahead(goal, &wall) else {
                    continue;
                };
                found += 1;
                let end = path[path.len() - 1];
                assert_eq!(end[..2], goal[..2]);
                assert!(trig::wrap(end[2] - goal[2]).abs() < 1e-9);
                for leg in path.windows(2) {
                    legs += 1;
                    let [from, to] = [leg[0], leg[1]];
                    let (s, c) = trig::sin_cos(from[2]);
                    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
                    assert!((dy * c - dx * s).abs() < 1e-6, "{number}: {path:?}");
                    assert!(libm::hypot(dx, dy) < 1e-6 || to[2] == from[2]);
                    for i in 0..=100 {
                        let place = between(&from, &to, f64::from(i) / 100.0);
                        assert!(!touches(&place, 0.0, &wall), "{number}: {place:?}");
                    }
                }
            }
        }
        assert!(
            found > 20 && legs > 2 * found,
            "{found} paths of {legs} legs"
        );
    }

    /// A way that only an omnidirectional base can take.
    #[test]
    fn a_gap_that_is_passed_sideways_is_closed_to_a_differential_base() {
        let gap = |x: f64, y: f64, r: f64| x.abs() < 0.3 + r && (y - 1.0).abs() > 0.35 - r;
        let result = find_ahead([2.0, 0.0, 0.0], gap);
        assert!(matches!(result, Err(BasePathFailure::Enclosed { .. })));
    }

    #[test]
    fn the_shorter_turn_is_taken() {
        let path = find([-2.0, 0.0, 1.5 * std::f64::consts::PI], |_, _, _| false).unwrap();
        assert!((path[1][2] + std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    }

    #[test]
    fn a_gap_narrower_than_the_arms_is_passed_sideways() {
        // A gap 0.7 m wide at x = 0: only fits the robot's length.
        let gap = |x: f64, y: f64, r: f64| x.abs() < 0.3 + r && (y - 1.0).abs() > 0.35 - r;
        let path = find([2.0, 0.0, 0.0], gap).unwrap();
        let mut blocked = |p: &BasePlace, _: f64| touches(p, 0.0, gap).then_some(());
        let mut search = Search {
            start: path[0],
            goal: path[0],
            area: ROOM,
            drive: OMNIDIRECTIONAL,
            reach: 0.7,
            margin: 0.0,
            near_ends: [0.0; 2],
            blocked: &mut blocked,
        };
        for leg in path.windows(2) {
            assert_eq!(search.edge(&leg[0], &leg[1]), None);
        }
        assert!(path.len() < 9, "{path:?}");
    }

    /// Between two poses that are checked it moves by a centimetre.
    #[test]
    fn a_gap_in_which_things_would_be_pushed_is_not_taken() {
        // A gap at x = 0 for a robot that is 0.4 m long and goes through sideways.
        let gap = |half: f64| {
            move |x: f64, y: f64, r: f64| x.abs() < 0.3 + r && (y - 1.0).abs() > half - r
        };
        let path = find([2.0, 0.0, 0.0], gap(0.206)).unwrap();
        for leg in path.windows(2) {
            for i in 0..=1000 {
                let place = between(&leg[0], &leg[1], f64::from(i) / 1000.0);
                assert!(!touches(&place, 0.0, gap(0.206)), "{place:?}");
            }
        }
        let result = find([2.0, 0.0, 0.0], gap(0.203));
        assert!(matches!(result, Err(BasePathFailure::Enclosed { .. })));
    }

    /// Near a start that has no margin, none is kept, and poses are a centimetre apart.
    #[test]
    fn a_corner_near_the_start_is_not_cut_between_two_poses() {
        for (beside_start, most) in [(0.003, 0.0008), (0.01, 0.0)] {
            // Two corners that pass each other, each as sharp as that of a square that is turned by 45 degrees, and
            // something beside the start.
            let overlap = |p: &BasePlace| {
                let corner = (p[0] + 1.905).abs() + (p[1] - 0.1965).abs();
                let farther_out = (p[0] + 1.905).abs() + (p[1] - 1.0).abs();
                let beside = beside_start + libm::hypot(p[0] + 2.0, p[1]);
                (0.2 - corner.min(farther_out)).max(-beside)
            };
            let mut blocked =
                |p: &BasePlace, margin: f64| (overlap(p) > -margin).then_some("corner");
            let path = find_around([2.0, 0.0, 0.0], &mut ExploredGrids::default(), &mut blocked);
            for leg in path.unwrap().windows(2) {
                for i in 0..=4000 {
                    let place = between(&leg[0], &leg[1], f64::from(i) / 4000.0);
                    assert!(overlap(&place) < most, "{place:?}: {}", overlap(&place));
                }
            }
        }
    }

    #[test]
    fn an_occupied_goal_names_what_is_there() {
        let result = find([2.0, 0.0, 0.0], |x, _, _| x > 1.5);
        assert_eq!(result, Err(BasePathFailure::GoalOccupied("wall")));
    }

    /// Walls at x = -1 and y = -1 with gaps of many widths at many places, by number.
    fn maze(number: u32) -> impl Fn(f64, f64, f64) -> bool {
        let (width, at) = (f64::from(number % 5) * 0.3, f64::from(number % 7) * 0.4);
        move |x, y, r| {
            let gap = |z: f64| (z - at).abs() < width - r;
            ((x + 1.0).abs() < r && !gap(y)) || ((y + 1.0).abs() < r && !gap(x))
        }
    }

    #[test]
    fn what_earlier_searches_have_found_out_changes_no_path() {
        let (mut checks, mut enclosed) = ([0, 0], 0);
        for number in 0..12 {
            let wall = maze(number);
            let mut explored = ExploredGrids::default();
            for goal in [
                [2.0, 1.0, 0.0],
                [1.8, 1.1, 0.4],
                [2.0, -2.0, 1.0],
                [2.1, 0.8, 0.1],
            ] {
                let find = |explored: &mut ExploredGrids, checks: &mut u32| {
                    let mut blocked = |p: &BasePlace, m: f64| {
                        *checks += 1;
                        touches(p, m, &wall).then_some("wall")
                    };
                    find_around(goal, explored, &mut blocked)
                };
                let found = find(&mut explored, &mut checks[0]);
                assert_eq!(
                    found,
                    find(&mut ExploredGrids::default(), &mut checks[1]),
                    "{number} {goal:?}"
                );
                enclosed += u32::from(found.is_err());
            }
        }
        assert!(enclosed > 10, "{enclosed} goals are enclosed");
        assert!(2 * checks[0] < checks[1], "{checks:?} checks");
    }

    #[test]
    fn an_enclosed_robot_is_told_by_what() {
        let result = find([2.0, 0.0, 0.0], |x, _, r| x.abs() < r);
        assert_eq!(
            result,
            Err(BasePathFailure::Enclosed {
                blockers: vec!["wall"]
            })
        );
    }
}

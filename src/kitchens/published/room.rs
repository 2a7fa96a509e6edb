//! What a robot can do in a room: where it starts, and where it does not get.

use super::fixture::{Fixture, Kind};
use super::layout::Layout;
use crate::floor::{Floor, Rectangle};

/// Height (m) of a robot: what hangs higher is not in its way.
const ROBOT: f64 = 1.6;
/// Room (m) that it needs to all sides on its way.
const WAY: f64 = 0.4;
/// Free strip (m) before a front, and how far its middle is from that in it.
const STAND: [f64; 2] = [0.42, 1.1];
/// How far (m) beside a front it may stand.
const ASIDE: f64 = 0.25;
/// Least length (m) of an edge from which something is to be used.
const EDGE: f64 = 0.6;
/// Greatest height (m) at which something is used.
const HIGH: f64 = 1.3;

/// The room of a layout.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Room {
    /// Where the robot starts (m).
    pub(super) start: [f64; 2],
    /// Fixtures that it does not get to.
    pub(super) cut_off: Vec<String>,
}

impl Room {
    /// That of a layout; `None` if there is no place for the robot.
    pub(super) fn of(layout: &Layout) -> Option<Self> {
        let fixtures = &layout.fixtures;
        let obstacles = fixtures
            .iter()
            .filter(|one| one.span()[0] < ROBOT && one.span()[1] > 0.02);
        let obstacles: Vec<Rectangle> = obstacles.map(Fixture::footprint).collect();
        let rooms = layout.floors.iter().copied();
        let rooms: Vec<Rectangle> = match layout.floors.is_empty() {
            true => obstacles.iter().map(|one| one.grown(1.5)).collect(),
            false => rooms.collect(),
        };
        let around = rooms.into_iter().reduce(|around, one| around.with(&one))?;
        let size = [0, 1].map(|i| around.high[i] - around.low[i]);
        if size.iter().any(|length| !(0.5..=30.0).contains(length)) {
            return None;
        }
        let mut floor = Floor::new(&around, &obstacles);
        let fronts: Vec<(&Fixture, Vec<Rectangle>)> = fixtures
            .iter()
            .map(|fixture| (fixture, stands(fixture, fixtures)))
            .filter(|(_, stands)| !stands.is_empty())
            .collect();
        // The part of the floor from which most is used.
        let mut best: Option<(usize, [f64; 2])> = None;
        for stand in fronts.iter().flat_map(|(_, stands)| stands) {
            // Not once more the part that was explored last.
            let from = floor.free_in(stand, WAY).filter(|_| !floor.gets_to(stand));
            let Some(from) = from else {
                continue;
            };
            floor.forget();
            floor.explore(from, WAY);
            let count = fronts
                .iter()
                .filter(|(_, stands)| stands.iter().any(|one| floor.gets_to(one)));
            let count = count.count();
            if best.is_none_or(|(most, _)| count > most) {
                best = Some((count, from));
            }
        }
        let (_, from) = best?;
        floor.forget();
        floor.explore(from, WAY);
        let cut_off = fronts
            .iter()
            .filter(|(_, stands)| !stands.iter().any(|one| floor.gets_to(one)));
        Some(Self {
            start: floor.widest_reached()?.map(crate::draws::rounded),
            cut_off: cut_off.map(|(fixture, _)| fixture.name.clone()).collect(),
        })
    }
}

/// Where a robot may stand to use a fixture; empty if it is not to be used.
fn stands(fixture: &Fixture, others: &[Fixture]) -> Vec<Rectangle> {
    let [width, depth] = [fixture.size[0] / 2.0, fixture.size[1] / 2.0];
    let front = fixture.area(
        [-width - ASIDE, -depth - STAND[1]],
        [width + ASIDE, -depth - STAND[0]],
    );
    let [low, high] = fixture.span();
    match fixture.kind {
        Kind::Counter(_) if high < HIGH => {
            let sides = [
                (
                    2.0 * width,
                    [-width, -depth - 0.1],
                    [width, -depth - 0.02],
                    front,
                ),
                (
                    2.0 * width,
                    [-width, depth + 0.02],
                    [width, depth + 0.1],
                    fixture.area([-width, depth + STAND[0]], [width, depth + STAND[1]]),
                ),
                (
                    2.0 * depth,
                    [-width - 0.1, -depth],
                    [-width - 0.02, depth],
                    fixture.area([-width - STAND[1], -depth], [-width - STAND[0], depth]),
                ),
                (
                    2.0 * depth,
                    [width + 0.02, -depth],
                    [width + 0.1, depth],
                    fixture.area([width + STAND[0], -depth], [width + STAND[1], depth]),
                ),
            ];
            let is_free = |from: [f64; 2], to: [f64; 2]| {
                let edge = fixture.area(from, to);
                let mut others = others.iter().filter(|other| other.name != fixture.name);
                !others.any(|other| {
                    other.span()[1] > 0.3
                        && other.span()[0] < high
                        && other.footprint().overlaps(&edge)
                })
            };
            let sides = sides
                .into_iter()
                .filter(|(length, from, to, _)| *length >= EDGE && is_free(*from, *to));
            sides.map(|(.., stand)| stand).collect()
        }
        Kind::Drawer
        | Kind::Cabinet { .. }
        | Kind::Fridge(_)
        | Kind::Oven
        | Kind::Stove
        | Kind::Dishwasher
            if low < HIGH =>
        {
            vec![front]
        }
        _ => Vec::new(),
    }
}

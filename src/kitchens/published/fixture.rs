//! A fixture: what it is, how large, and where.

use crate::floor::Rectangle;
use spatial::trig::sin_cos;
use std::f64::consts::FRAC_PI_2;

/// Left and right, front and back, bottom and top: the names of the ends of the axes.
pub(super) const SIDES: [[&str; 2]; 3] = [["left", "right"], ["front", "back"], ["bottom", "top"]];

/// Where the handle of a door is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HandlePlace {
    Bottom,
    Middle,
    Top,
}

/// The doors of a cabinet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Doors {
    /// Two, which meet in the middle.
    Pair,
    /// One; whether its hinge is at the left.
    One { is_left: bool },
}

/// How the doors of a fridge are arranged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fridge {
    /// Two doors above a drawer.
    FrenchDoor,
    /// Two doors, each before a compartment of its own.
    SideBySide,
    /// A door above a drawer.
    BottomFreezer,
}

/// What a fixture is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    Counter(Counter),
    Drawer,
    Cabinet {
        doors: Doors,
        handle: HandlePlace,
        is_knob: bool,
    },
    /// An open one, with so many boards.
    Shelves(usize),
    /// Something solid: a box, an appliance on a counter.
    Solid,
    /// A hollow one behind a panel that does not open.
    Panel,
    /// A frame around something else; how thick it is at either end of each axis (m).
    Housing([[f64; 2]; 3]),
    Stove,
    Stovetop,
    Oven,
    Microwave,
    Hood,
    Sink,
    Fridge(Fridge),
    Dishwasher,
    /// A table, or a stool.
    OnLegs {
        is_table: bool,
    },
    /// A wall; whether only its foot is shown, since it would hide the room.
    Wall {
        is_foot: bool,
    },
}

/// A counter. Its parts are named as one sees them who stands at its front.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Counter {
    /// Whether it lacks a base at the back and at the front, where cabinets stand below it.
    pub(super) hollow: [bool; 2],
    /// Whether there is room for legs at the front and at the back.
    pub(super) opening: [bool; 2],
    /// Whether only the left or the right half of the top is there.
    pub(super) half: [bool; 2],
    /// How far the top stands out ahead of the base (m).
    pub(super) overhang: f64,
    /// Whether something stands below its top, where it is hollow.
    pub(super) is_filled: bool,
    /// A hole for a sink: from its left, front end to its right, back end, from the middle (m).
    pub(super) hole: Option<[[f64; 2]; 2]>,
}

/// A fixture in the room.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fixture {
    /// Its name in the layout, with that of its group.
    pub(super) name: String,
    pub(super) kind: Kind,
    /// Width, depth, height (m).
    pub(super) size: [f64; 3],
    /// The middle (m): to the right, to the back, up.
    pub(super) at: [f64; 3],
    /// By how much it is turned about z (rad); its front looks along -y if by nothing.
    pub(super) turn: f64,
    /// Whether it belongs to an island.
    pub(super) is_island: bool,
    /// Whether something stands on top of it that closes it.
    pub(super) is_covered: bool,
    /// Height of the base on which it stands, set back at the front (m); 0 if it has none.
    pub(super) base: f64,
}

impl Fixture {
    /// One that belongs to no island, stands on no base, and has nothing above it.
    pub(super) fn new(name: String, kind: Kind, size: [f64; 3], at: [f64; 3], turn: f64) -> Self {
        Self {
            name,
            kind,
            size,
            at,
            turn,
            is_island: false,
            is_covered: false,
            base: 0.0,
        }
    }

    /// A point of the room, from one of its own: to the right, to the back, up from its middle (m).
    pub(super) fn point(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [x, y] = turned([x, y], self.turn);
        [self.at[0] + x, self.at[1] + y, self.at[2] + z]
    }

    /// What it takes of the floor, seen from above.
    pub(super) fn footprint(&self) -> Rectangle {
        let [width, depth] = [self.size[0] / 2.0, self.size[1] / 2.0];
        self.area([-width, -depth], [width, depth])
    }

    /// The rectangle of the room around one of its own, between two corners.
    pub(super) fn area(&self, from: [f64; 2], to: [f64; 2]) -> Rectangle {
        let corners = [from, [from[0], to[1]], [to[0], from[1]], to];
        let corners = corners.map(|[x, y]| self.point([x, y, 0.0]));
        corners.iter().fold(
            Rectangle {
                low: [f64::INFINITY; 2],
                high: [f64::NEG_INFINITY; 2],
            },
            |around, corner| Rectangle {
                low: [0, 1].map(|i| around.low[i].min(corner[i])),
                high: [0, 1].map(|i| around.high[i].max(corner[i])),
            },
        )
    }

    /// Its lower and upper end (m).
    pub(super) fn span(&self) -> [f64; 2] {
        [
            self.at[2] - self.size[2] / 2.0,
            self.at[2] + self.size[2] / 2.0,
        ]
    }
}

/// A vector turned by an angle (rad), exactly if that is nearly a quarter turn.
pub(super) fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sine, cosine) = sin_cos(angle);
    let snapped = |x: f64| match x {
        x if x.abs() < 2e-3 => 0.0,
        x if x.abs() > 1.0 - 2e-6 => x.signum(),
        x => x,
    };
    let (sine, cosine) = (snapped(sine), snapped(cosine));
    [x * cosine - y * sine, x * sine + y * cosine]
}

/// An angle (rad) that is a quarter turn if it nearly is one.
pub(super) fn snapped(angle: f64) -> f64 {
    let quarters = (angle / FRAC_PI_2).round();
    match (angle - quarters * FRAC_PI_2).abs() < 2e-3 {
        true => (quarters as i64).rem_euclid(4) as f64 * FRAC_PI_2,
        false => angle,
    }
}

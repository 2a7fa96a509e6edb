//! A house of ProcTHOR: rooms, walls with doorways, and objects by the names of assets, whose sizes are in a
//! database of its own.
//!
//! There, x and z lie in the floor and y points up, in a left-handed frame: so x, z and y are right-handed. Objects look
//! along z if they are not turned, and turn clockwise as seen from above.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;

use super::LayoutError;
use super::fixture::{Counter, Fixture, Fridge, Kind, snapped};
use super::layout::{Layout, plain};
use crate::floor::Rectangle;

/// Depth (m) of a row of counters in a corner.
const DEPTH: f64 = 0.61;
/// Thickness (m) of walls.
const WALL: f64 = 0.06;
/// Greatest coordinate (m).
const FAR: f64 = 200.0;
/// Maximum numbers of walls, of doors and of objects.
const MOST: usize = 1000;

#[derive(Deserialize)]
struct House {
    rooms: Vec<Room>,
    walls: Vec<Wall>,
    #[serde(default)]
    doors: Vec<Door>,
    #[serde(default)]
    objects: Vec<Thing>,
}

#[derive(Clone, Copy, Deserialize)]
struct Point {
    #[serde(default)]
    x: f64,
    #[serde(default)]
    y: f64,
    #[serde(default)]
    z: f64,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Room {
    id: String,
    room_type: String,
    floor_polygon: Vec<Point>,
}

#[derive(Deserialize)]
struct Wall {
    id: String,
    polygon: Vec<Point>,
    /// Whether there is nothing between two rooms.
    #[serde(default)]
    empty: bool,
}

/// A door, by the hole that it fills: along the wall from its first point, and up.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Door {
    wall0: String,
    #[serde(default)]
    hole_polygon: Vec<Point>,
    bounding_box: Option<Corners>,
}

#[derive(Deserialize)]
struct Corners {
    min: Point,
    max: Point,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Thing {
    id: String,
    asset_id: String,
    position: Point,
    #[serde(default)]
    rotation: Option<Point>,
    #[serde(default)]
    children: Vec<Thing>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Asset {
    asset_id: String,
    bounding_box: Point,
    object_type: String,
    #[serde(default)]
    primary_property: Option<String>,
}

/// Reads a house with the database of its assets.
///
/// # Errors
///
/// One of them is no JSON of its kind, or the house has no kitchen.
pub(super) fn read(house: &str, assets: &str) -> Result<Layout, LayoutError> {
    let wrong = |what: &str, error: &serde_json::Error| {
        LayoutError::at(error.line(), format!("this is no {what}: {error}"))
    };
    let house: House = serde_json::from_str(house).map_err(|error| wrong("house", &error))?;
    let assets: BTreeMap<String, Vec<Asset>> = serde_json::from_str(assets)
        .map_err(|error| LayoutError::whole(format!("the database of assets is none: {error}")))?;
    let assets = assets.into_values().flatten();
    let assets: BTreeMap<String, Asset> = assets.map(|one| (one.asset_id.clone(), one)).collect();
    Reader::new(&house)?.read(&house, &assets)
}

#[derive(Default)]
struct Reader {
    layout: Layout,
    /// The floors of the kitchens.
    polygons: Vec<Vec<[f64; 2]>>,
    /// The numbers of the kitchens, with which the names of their objects begin.
    kitchens: BTreeSet<String>,
    picked_up: BTreeSet<String>,
    on_walls: BTreeSet<String>,
    unknown: BTreeSet<String>,
    has_corner: bool,
}

impl Reader {
    fn new(house: &House) -> Result<Self, LayoutError> {
        let mut reader = Self::default();
        let counts = [house.walls.len(), house.doors.len(), house.objects.len()];
        if counts.iter().any(|count| *count > MOST) {
            return Err(LayoutError::whole(format!(
                "a house has at most {MOST} walls, doors and objects each"
            )));
        }
        for room in house
            .rooms
            .iter()
            .filter(|room| room.room_type == "Kitchen")
        {
            let corners = room.floor_polygon.iter().map(|point| place(*point));
            let corners: Vec<[f64; 3]> = corners.collect::<Result<_, _>>()?;
            let floor = corners
                .iter()
                .map(|[x, y, _]| Rectangle::of([*x, *y], [*x, *y]));
            let Some(floor) = floor.reduce(|around, one| around.with(&one)) else {
                continue;
            };
            reader.layout.floors.push(floor);
            reader
                .polygons
                .push(corners.iter().map(|[x, y, _]| [*x, *y]).collect());
            reader.kitchens.insert(number(&room.id).to_owned());
        }
        if reader.layout.floors.is_empty() {
            let kinds: BTreeSet<&str> = house
                .rooms
                .iter()
                .map(|room| room.room_type.as_str())
                .collect();
            let kinds: Vec<&str> = kinds.into_iter().collect();
            return Err(LayoutError::whole(match kinds.as_slice() {
                [] => "this house has no rooms".to_owned(),
                kinds => format!(
                    "this house has no room of the type Kitchen, only {}",
                    kinds.join(", ")
                ),
            }));
        }
        Ok(reader)
    }

    fn read(
        mut self,
        house: &House,
        assets: &BTreeMap<String, Asset>,
    ) -> Result<Layout, LayoutError> {
        self.walls(house)?;
        for thing in &house.objects {
            if self.kitchens.contains(number(&thing.id)) {
                self.thing(thing, assets, true)?;
            }
        }
        let mut remarks = Vec::new();
        let mut tell = |what: &str, names: &BTreeSet<String>| {
            if !names.is_empty() {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                remarks.push(format!("{what}: {}", names.join(", ")));
            }
        };
        tell(
            "what can be picked up is left out, and may be spawned",
            &self.picked_up,
        );
        tell("what hangs on walls is left out", &self.on_walls);
        tell(
            "what the database of assets does not know is left out",
            &self.unknown,
        );
        if self.has_corner {
            remarks.push("counters around a corner are taken to stand along the walls".to_owned());
        }
        remarks.push(
            "the house says nothing of drawers and handles: only fridges and microwaves open"
                .to_owned(),
        );
        self.layout.remarks = remarks;
        self.layout.lower_walls();
        Ok(self.layout)
    }

    /// Adds the walls, with holes for doors.
    fn walls(&mut self, house: &House) -> Result<(), LayoutError> {
        let doorways = doorways(house)?;
        // Each wall is there for every room beside it, and once for the outside.
        let mut known: BTreeSet<[i64; 4]> = BTreeSet::new();
        let mut count = 0;
        for wall in house.walls.iter().filter(|wall| !wall.empty) {
            let Some([from, to, top]) = ends(wall)? else {
                continue;
            };
            let key = |point: [f64; 3]| [0, 1].map(|axis| (point[axis] * 100.0).round() as i64);
            let (a, b) = (key(from), key(to));
            let (a, b) = (a.min(b), a.max(b));
            if !known.insert([a[0], a[1], b[0], b[1]]) {
                continue;
            }
            let away = [0, 1].map(|axis| to[axis] - from[axis]);
            let length = (away[0] * away[0] + away[1] * away[1]).sqrt();
            if length < 0.01 || top[2] < 0.05 {
                continue;
            }
            let along = away.map(|one| one / length);
            let turn = snapped(spatial::trig::atan2(along[1], along[0]));
            // A wall is a plane there, which furniture touches: what makes it thick is outside of the kitchen.
            let across = [-along[1], along[0]];
            let is_kitchen = |side: f64| {
                let point = [0, 1].map(|axis| from[axis] + away[axis] / 2.0 + side * across[axis]);
                self.polygons.iter().any(|floor| contains(floor, point))
            };
            let outside = match (is_kitchen(0.05), is_kitchen(-0.05)) {
                (true, false) => -WALL / 2.0,
                (false, true) => WALL / 2.0,
                _ => 0.0,
            };
            count += 1;
            let mut part = |low: f64, high: f64, foot: f64, head: f64, number: usize| {
                if high - low < 0.02 || head - foot < 0.02 {
                    return;
                }
                let middle = (low + high) / 2.0;
                let name = format!("wall_{count}_{number}");
                let size = [high - low, WALL, head - foot];
                let at = [
                    from[0] + along[0] * middle + across[0] * outside,
                    from[1] + along[1] * middle + across[1] * outside,
                    (foot + head) / 2.0,
                ];
                let wall = Fixture::new(name, Kind::Wall { is_foot: false }, size, at, turn);
                self.layout.fixtures.push(wall);
            };
            let mut at = 0.0;
            let mut number = 1;
            for [low, high, head] in holes(&doorways, [from, to], length) {
                part(at, low, 0.0, top[2], number);
                part(low, high, head, top[2], number + 1);
                (at, number) = (high, number + 2);
            }
            part(at, length, 0.0, top[2], number);
        }
        Ok(())
    }

    /// Adds an object, and what is on it.
    fn thing(
        &mut self,
        thing: &Thing,
        assets: &BTreeMap<String, Asset>,
        is_on_floor: bool,
    ) -> Result<(), LayoutError> {
        if self.layout.fixtures.len() > 2 * MOST {
            return Err(LayoutError::whole(format!(
                "a kitchen has fewer things than {}",
                2 * MOST
            )));
        }
        let Some(asset) = assets.get(&thing.asset_id) else {
            self.unknown.insert(thing.asset_id.clone());
            return self.children(thing, assets);
        };
        let [width, depth, height] = place(asset.bounding_box)?;
        let [x, y, z] = place(thing.position)?;
        let turn = thing.rotation.map_or(0.0, |rotation| rotation.y);
        if !turn.is_finite()
            || [width, depth, height]
                .iter()
                .any(|length| !(0.0005..=30.0).contains(length))
        {
            return Err(LayoutError::whole(format!(
                "{} has no size or direction",
                thing.id
            )));
        }
        if asset.primary_property.as_deref() == Some("CanPickup") {
            self.picked_up.insert(asset.object_type.clone());
            return self.children(thing, assets);
        }
        // What would be in the floor stands on it.
        let z = z.max(height / 2.0);
        if is_on_floor && z - height / 2.0 > 0.3 {
            self.on_walls.insert(asset.object_type.clone());
            return self.children(thing, assets);
        }
        let name: String = asset
            .object_type
            .chars()
            .enumerate()
            .flat_map(|(at, letter)| {
                let gap = (at > 0 && letter.is_ascii_uppercase()).then_some('_');
                gap.into_iter().chain([letter.to_ascii_lowercase()])
            })
            .collect();
        let name = format!("{name}_{}", thing.id);
        let name = plain(&name);
        let kind = match asset.object_type.as_str() {
            "CounterTop" => Kind::Counter(Counter::default()),
            "Fridge" => Kind::Fridge(Fridge::BottomFreezer),
            "Microwave" => Kind::Microwave,
            "DiningTable" | "SideTable" | "CoffeeTable" | "Desk" => Kind::OnLegs { is_table: true },
            "Stool" => Kind::OnLegs { is_table: false },
            _ => Kind::Solid,
        };
        let turn = snapped(std::f64::consts::PI - turn.rem_euclid(360.0).to_radians());
        let fixture = Fixture {
            is_island: thing.asset_id.contains("_Island_"),
            ..Fixture::new(name, kind, [width, depth, height], [x, y, z], turn)
        };
        let is_around_corner = ["_C_", "_L_"]
            .iter()
            .any(|part| thing.asset_id.contains(part));
        if matches!(fixture.kind, Kind::Counter(_)) && is_around_corner && depth > DEPTH + 0.1 {
            self.corner(fixture, thing.asset_id.contains("_C_"));
        } else {
            self.layout.fixtures.push(fixture);
        }
        self.children(thing, assets)
    }

    fn children(
        &mut self,
        thing: &Thing,
        assets: &BTreeMap<String, Asset>,
    ) -> Result<(), LayoutError> {
        for child in &thing.children {
            self.thing(child, assets, false)?;
        }
        Ok(())
    }

    /// A counter with a wing at one end, or at both: the row at the back, and what goes forward from it. One wing is
    /// where a wall is near.
    fn corner(&mut self, whole: Fixture, has_both: bool) {
        self.has_corner = true;
        let [width, depth, height] = whole.size;
        let part = |name: &str, x: f64, y: f64, size: [f64; 3], turn: f64| Fixture {
            name: format!("{}{name}", whole.name),
            size,
            at: whole.point([x, y, 0.0]),
            turn: snapped(whole.turn + turn),
            ..whole.clone()
        };
        let wing = [depth - DEPTH, DEPTH, height];
        let (aside, ahead) = ((width - DEPTH) / 2.0, -DEPTH / 2.0);
        let quarter = std::f64::consts::FRAC_PI_2;
        let left = part("_left", -aside, ahead, wing, quarter);
        let right = part("_right", aside, ahead, wing, -quarter);
        let walls = self
            .layout
            .fixtures
            .iter()
            .filter(|one| matches!(one.kind, Kind::Wall { .. }));
        let walls: Vec<Rectangle> = walls.map(Fixture::footprint).collect();
        let away = |wing: &Fixture| {
            // Behind it.
            let [x, y, _] = wing.point([0.0, DEPTH / 2.0, 0.0]);
            let distances = walls.iter().map(|wall| wall.distance([x, y]));
            distances.fold(f64::INFINITY, f64::min)
        };
        let row = part("", 0.0, (depth - DEPTH) / 2.0, [width, DEPTH, height], 0.0);
        let is_left = away(&left) <= away(&right);
        self.layout.fixtures.push(row);
        if has_both || is_left {
            self.layout.fixtures.push(left);
        }
        if has_both || !is_left {
            self.layout.fixtures.push(right);
        }
    }
}

/// Whether a polygon contains a point: a ray from it crosses an odd number of edges.
fn contains(polygon: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let ends = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let crossed = ends.filter(|([ax, ay], [bx, by])| {
        (*ay > y) != (*by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)
    });
    crossed.count() % 2 == 1
}

/// The number of a room, with which the names of its objects begin, perhaps after what they are.
fn number(id: &str) -> &str {
    let mut parts = id.split('|');
    match parts.next() {
        Some(first) if first.parse::<u32>().is_ok() => first,
        _ => parts.next().unwrap_or_default(),
    }
}

/// A point in a right-handed frame whose z axis points up; an error if it is very far away.
fn place(point: Point) -> Result<[f64; 3], LayoutError> {
    let place = [point.x, point.z, point.y];
    match place.iter().all(|one| one.abs() <= FAR) {
        true => Ok(place),
        false => Err(LayoutError::whole(format!(
            "a house is within {FAR} m, this point is at {} {} {}",
            point.x, point.y, point.z
        ))),
    }
}

/// The first end of a wall, the other one, and its highest point; `None` if it is none.
fn ends(wall: &Wall) -> Result<Option<[[f64; 3]; 3]>, LayoutError> {
    let points = wall.polygon.iter().map(|point| place(*point));
    let points = points.collect::<Result<Vec<_>, _>>()?;
    let Some(first) = points.first().copied() else {
        return Ok(None);
    };
    let away = |point: &[f64; 3]| {
        let [x, y] = [0, 1].map(|axis| point[axis] - first[axis]);
        x * x + y * y
    };
    let last = points
        .iter()
        .copied()
        .max_by(|a, b| away(a).total_cmp(&away(b)));
    let top = points.iter().copied().max_by(|a, b| a[2].total_cmp(&b[2]));
    Ok(Some([first, last.unwrap_or(first), top.unwrap_or(first)]))
}

/// A hole in a wall for a door.
struct Doorway {
    /// The ends of the wall (m).
    wall: [[f64; 3]; 2],
    /// Where it begins and ends along the wall from its first end, and its height (m).
    hole: [f64; 3],
}

/// All doorways of a house.
fn doorways(house: &House) -> Result<Vec<Doorway>, LayoutError> {
    let walls: BTreeMap<&str, &Wall> = house
        .walls
        .iter()
        .map(|one| (one.id.as_str(), one))
        .collect();
    let mut doorways = Vec::new();
    for door in &house.doors {
        let Some(wall) = walls.get(door.wall0.as_str()) else {
            continue;
        };
        let Some([start, end, _]) = ends(wall)? else {
            continue;
        };
        let corners = match &door.bounding_box {
            Some(corners) => vec![corners.min, corners.max],
            None => door.hole_polygon.clone(),
        };
        let corners = corners.into_iter().map(place);
        let corners = corners.collect::<Result<Vec<_>, _>>()?;
        let along = || corners.iter().map(|corner| corner[0]);
        doorways.push(Doorway {
            wall: [start, end],
            hole: [
                along().fold(f64::INFINITY, f64::min),
                along().fold(f64::NEG_INFINITY, f64::max),
                corners.iter().map(|corner| corner[2]).fold(0.0, f64::max),
            ],
        });
    }
    Ok(doorways)
}

/// The holes in a wall of some length (m) from one end to the other, in their order, as in [`Doorway`].
fn holes(doorways: &[Doorway], [from, to]: [[f64; 3]; 2], length: f64) -> Vec<[f64; 3]> {
    let is_near = |a: [f64; 3], b: [f64; 3]| (0..2).all(|axis| (a[axis] - b[axis]).abs() < 0.02);
    let holes = doorways.iter().filter_map(|doorway| {
        let [start, end] = doorway.wall;
        let [low, high, head] = doorway.hole;
        // The same wall may begin at its other end for the room at its other side.
        let [low, high] = if is_near(start, from) && is_near(end, to) {
            [low, high]
        } else if is_near(start, to) && is_near(end, from) {
            [length - high, length - low]
        } else {
            return None;
        };
        let [low, high] = [low.max(0.0), high.min(length)];
        (high > low).then_some([low, high, head])
    });
    let mut holes: Vec<[f64; 3]> = holes.collect();
    holes.sort_by(|a, b| a[0].total_cmp(&b[0]));
    // Two doors in the same place are one.
    holes.dedup_by(|next, hole| next[0] < hole[1]);
    holes
}

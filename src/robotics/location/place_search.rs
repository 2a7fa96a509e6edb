//! The search for places on a support where a thing would stand.

use super::constraint::inset;
use super::costmap::{Costmap, Factor};
use super::draw::Draw;
use super::furniture::container_of;
use super::offered::Offered;
use super::place_query::{PlaceQuery, Position, What};
use super::stream::Scene;
use super::support::Support;
use super::tally::Tally;
use crate::motion::interruption;
use crate::robot::LinkId;
use crate::world::standing_room::STEADY;
use crate::world::{
    BodyName, Closing, Extent, Ground, Load, NoRoom, StandingRoom, World, WorldError,
};
use spatial::Pose;
use spatial::pose::distance_between;

/// Edge lengths (m) of the cells: finer ones are tried if the coarser ones yield nothing.
const RESOLUTIONS: [f64; 3] = [0.04, 0.02, 0.01];
/// A finer grid has no more cells than this.
const MAX_CELLS: usize = 20_000;
/// How far (m) what carries a thing may be above or below the upper face of the support.
const SLACK: f64 = 0.02;
/// What is less far (m) from a pose than this is at it.
const SAME_PLACE: f64 = 0.001;

/// Number of points along each side at which boards are looked for.
const PROBES: u32 = 8;
/// Room (m) that there must be above a board.
const HEADROOM: f64 = 0.03;

/// The search in one state of the world.
pub(super) struct PlaceSearch {
    extent: Extent,
    ground: Ground,
    load: Option<Load>,
    /// Heights (m) at which a thing is lowered, and how far (m) what carries it may be below.
    starts: Vec<[f64; 2]>,
    map: Costmap,
    /// Which grid is in use.
    level: usize,
    /// The cells in the order in which they are tried, and the next one.
    order: Vec<usize>,
    next: usize,
    /// Whether anything has been found in this order, and on this grid.
    is_fruitful: bool,
    is_level_fruitful: bool,
}

impl PlaceSearch {
    /// Begins a search, or tells why there is no such place.
    pub(super) fn new(
        query: &PlaceQuery,
        world: &World,
        draw: &mut Draw,
    ) -> Result<Result<Self, String>, WorldError> {
        let load = match &query.what {
            What::Point => None,
            What::Object(name) => Some(world.load(name)?),
            What::Kind(kind) => {
                let objects = &world.models().objects;
                let known = objects.get(kind).ok_or_else(|| WorldError::UnknownType {
                    name: kind.clone(),
                    closest: objects.closest_name(kind).map(str::to_owned),
                })?;
                Some(Load::of_shapes(&known.shapes))
            }
        };
        let mut search = Self {
            extent: query.support.extent(world)?,
            ground: query.support.ground(world)?,
            load,
            starts: Vec::new(),
            map: Costmap::default(),
            level: 0,
            order: Vec::new(),
            next: 0,
            is_fruitful: false,
            is_level_fruitful: false,
        };
        if let Err(why) = search.find_starts(query, world) {
            return Ok(Err(why));
        }
        let mut why = String::new();
        for level in 0..RESOLUTIONS.len() {
            match search.map_at(query, world, level) {
                Ok(map) => {
                    search.begin_level(level, map, draw);
                    return Ok(Ok(search));
                }
                Err(reason) => why = reason,
            }
        }
        Ok(Err(why))
    }

    /// Finds the heights at which a thing can be put down.
    fn find_starts(&mut self, query: &PlaceQuery, world: &World) -> Result<(), String> {
        let top = self.extent.top();
        let level = match (self.ground, query.position) {
            (Ground::Object(_), _) => {
                self.starts = vec![[top + SLACK, self.extent.size()[2] + SLACK]];
                return Ok(());
            }
            (Ground::Furniture, Position::On | Position::Above(_)) => {
                self.starts = vec![[top + SLACK, 2.0 * SLACK]];
                return Ok(());
            }
            (Ground::Furniture, Position::In(level)) => level,
        };
        let Support::Furniture(link) = &query.support else {
            return Ok(());
        };
        let heights = self.boards(world, *link);
        let name = query.support.name(world);
        if heights.is_empty() {
            return Err(format!("There is no room in {name}."));
        }
        let chosen = level.of(&heights);
        if chosen.is_empty() {
            return Err(format!("{name} has {} levels.", heights.len()));
        }
        self.starts = chosen.iter().map(|h| [h + SLACK, 2.0 * SLACK]).collect();
        Ok(())
    }

    /// Heights (m) of the boards inside of the support, from below.
    fn boards(&self, world: &World, link: LinkId) -> Vec<f64> {
        let room = StandingRoom::new(world, self.limits(), None);
        let (top, bottom) = (self.extent.top(), self.extent.top() - self.extent.size()[2]);
        let Extent { frame, min, max } = &self.extent;
        let share = |i: u32| (f64::from(i) + 0.5) / f64::from(PROBES);
        let parts = world.assembly(link);
        let mut boards: Vec<(f64, u32)> = Vec::new();
        for (i, j) in (0..PROBES).flat_map(|i| (0..PROBES).map(move |j| (i, j))) {
            let x = min[0] + (max[0] - min[0]) * share(i);
            let y = min[1] + (max[1] - min[1]) * share(j);
            let point = frame * nalgebra::Point3::new(x, y, 0.0);
            let heights = [top - HEADROOM, bottom];
            for level in room.levels(&parts, [point.x, point.y], heights) {
                match boards
                    .iter_mut()
                    .find(|(h, _)| (h - level).abs() < SLACK / 2.0)
                {
                    Some((_, count)) => *count += 1,
                    None => boards.push((level, 1)),
                }
            }
        }
        // The rest are rails and fronts.
        boards.retain(|(_, count)| *count * 3 >= PROBES * PROBES);
        boards.sort_by(|a, b| a.0.total_cmp(&b.0));
        boards.into_iter().map(|(height, _)| height).collect()
    }

    /// The map of where to look.
    pub(super) fn map(&self) -> &Costmap {
        &self.map
    }

    /// Height (m) at which the map is shown.
    pub(super) fn height(&self) -> f64 {
        let first = self.starts.first();
        match self.ground {
            Ground::Furniture => first.map_or(self.extent.top(), |[start, _]| start - SLACK),
            Ground::Object(_) => self.extent.top(),
        }
    }

    fn begin_level(&mut self, level: usize, map: Costmap, draw: &mut Draw) {
        self.map = map;
        self.level = level;
        self.is_level_fruitful = false;
        self.begin_pass(draw);
    }

    fn begin_pass(&mut self, draw: &mut Draw) {
        self.order = draw.order(self.map.cells.iter().map(|(_, value)| *value));
        self.next = 0;
        self.is_fruitful = false;
    }

    /// How far (m) from the edges the thing has to be.
    fn margin(&self) -> f64 {
        let margin = self.load.as_ref().map_or(0.0, |load| {
            let [x, y, _] = load.size(&Pose::identity());
            x.max(y) / 2.0
        });
        let [x, y, _] = self.extent.size();
        match self.ground {
            // On a thing that is too small for it, it may stick out.
            Ground::Object(_) if 2.0 * margin > x.min(y) => STEADY.min(x.min(y) / 2.0),
            _ => margin,
        }
    }

    fn map_at(&self, query: &PlaceQuery, world: &World, level: usize) -> Result<Costmap, String> {
        let name = query.support.name(world);
        let margin = self.margin();
        let [x, y, _] = self.extent.size();
        let what = || query.what_name();
        if 2.0 * margin > x.min(y) {
            return Err(format!(
                "{} is {:.2} m across and does not fit on {name}, which is {x:.2} m by {y:.2} m.",
                what(),
                2.0 * margin
            ));
        }
        let factors = query.factors(&self.extent, margin);
        Costmap::product(RESOLUTIONS[level], self.limits(), &factors).map_err(|emptied| {
            let keys = emptied.keys;
            match keys.split_last() {
                Some((last, rest)) if !rest.is_empty() => format!(
                    "{} and {last} leave nothing of {name}: 0.00 m².",
                    rest.join(", ")
                ),
                _ => format!("{} leaves nothing of {name}: 0.00 m².", keys.join("")),
            }
        })
    }

    /// Limits (m) of x and y around the support.
    fn limits(&self) -> [[f64; 2]; 2] {
        let Extent { frame, min, max } = &self.extent;
        let corners = [
            [min[0], min[1]],
            [min[0], max[1]],
            [max[0], min[1]],
            [max[0], max[1]],
        ];
        let corners = corners.map(|[x, y]| frame * nalgebra::Point3::new(x, y, 0.0));
        let border = |pick: fn(f64, f64) -> f64, start: f64| {
            [0, 1].map(|i| corners.iter().map(|c| c[i]).fold(start, pick))
        };
        [
            border(f64::min, f64::INFINITY),
            border(f64::max, f64::NEG_INFINITY),
        ]
    }

    /// The next place that has not been offered.
    pub(super) fn next(
        &mut self,
        query: &PlaceQuery,
        scene: Scene<'_>,
        draw: &mut Draw,
        offered: &Offered,
        tally: &mut Tally,
    ) -> Option<Pose> {
        let room = self.room(query, scene.world);
        loop {
            interruption::look();
            let Some(cell) = self.order.get(self.next) else {
                if self.is_fruitful {
                    self.begin_pass(draw);
                    continue;
                }
                let finer = RESOLUTIONS.len() > self.level + 1 && !self.is_level_fruitful;
                if !finer || self.map.cells.len() * 4 > MAX_CELLS {
                    return None;
                }
                let level = self.level + 1;
                let map = self.map_at(query, scene.world, level).ok()?;
                *tally = Tally::default();
                self.begin_level(level, map, draw);
                continue;
            };
            // The order consists of indices of this list.
            let (point, _) = self.map.cells[*cell];
            let poses = query.orientation.poses(point, &self.extent, draw);
            // One board is as good as another.
            let first = match self.starts.len() {
                0 | 1 => 0,
                count => (draw.unit() * count as f64) as usize,
            };
            let mut found = None;
            for pose in poses.iter().filter(|pose| !offered.has(pose)) {
                match self.try_at(query, &room, pose, first) {
                    Ok(pose) => {
                        found = Some(pose);
                        break;
                    }
                    Err(cause) => tally.add(cause_text(&cause)),
                }
            }
            self.next += 1;
            if found.is_some() {
                self.is_fruitful = true;
                self.is_level_fruitful = true;
                return found;
            }
        }
    }

    /// The thing at the pose, at the height where it stands or is held: on the first of the boards from
    /// that one on where there is room, those below the first one last.
    fn try_at(
        &self,
        query: &PlaceQuery,
        room: &Room<'_>,
        pose: &Pose,
        first: usize,
    ) -> Result<Pose, NoRoom> {
        let mut cause = NoRoom::NoSupport;
        let (later, sooner) = self.starts.split_at(first);
        for start in sooner.iter().chain(later) {
            match self.lower(query, room, pose, *start) {
                Ok(pose) => return Ok(pose),
                Err(reason) => cause = reason,
            }
        }
        Err(cause)
    }

    /// The thing at the pose, lowered from a height (m) until at most `below` (m) lower.
    fn lower(
        &self,
        query: &PlaceQuery,
        Room { standing, closing }: &Room<'_>,
        pose: &Pose,
        [start, below]: [f64; 2],
    ) -> Result<Pose, NoRoom> {
        let t = pose.translation;
        let mut pose = *pose;
        match &self.load {
            None => pose.translation.z = standing.point([t.x, t.y], start, below, self.ground)?,
            Some(load) => pose = standing.stand(load, &pose, start, below, self.ground)?,
        }
        if let Position::Above(height) = query.position {
            pose.translation.z += height;
            if let Some(load) = &self.load {
                standing.check_free(load, &pose)?;
            }
        }
        let load = self.load.as_ref();
        let mut stops = closing
            .iter()
            .filter_map(|closing| closing.stopped_by(load?, &pose));
        match stops.next() {
            Some(body) => Err(NoRoom::Closing(body)),
            None => Ok(pose),
        }
    }

    /// Where the thing could stand, and how what it is put into would be closed.
    fn room<'w>(&self, query: &PlaceQuery, world: &'w World) -> Room<'w> {
        let models = world.models();
        let closing = match (&query.support, query.position) {
            (Support::Furniture(link), Position::In(_)) => container_of(models, *link)
                .and_then(|container| world.closing(container.joint, *link)),
            _ => None,
        };
        Room {
            standing: StandingRoom::new(world, self.limits(), self.load.as_ref()),
            closing,
        }
    }

    /// Whether what the place is for stands at the pose already, on such ground: it may reach beyond
    /// an edge then, or across one.
    fn stands_at(&self, query: &PlaceQuery, world: &World, pose: &Pose) -> bool {
        let (What::Object(name), Some(load)) = (&query.what, &self.load) else {
            return false;
        };
        let (Ok(now), Ok(carriers)) = (world.object_pose(name), world.carriers(name)) else {
            return false;
        };
        let heights = self.starts.iter();
        let mut heights = heights.map(|[start, below]| start - below..=*start);
        let is_support = |body: &BodyName| match &query.support {
            Support::Furniture(_) => matches!(body, BodyName::Furniture(_)),
            Support::Object(name) => body.object() == Some(name),
        };
        let Some(at) = carriers.iter().position(is_support) else {
            return false;
        };
        // What stands on other things is where the lowest of them stands.
        let lowest = at.checked_sub(1).and_then(|below| carriers[below].object());
        let bottom = match lowest {
            None => pose.translation.z - load.depth(pose),
            Some(lowest) => match world.object_extent(lowest) {
                Ok(extent) => extent.bottom(),
                Err(_) => return false,
            },
        };
        distance_between(&now, pose) < SAME_PLACE
            && heights.any(|heights| heights.contains(&bottom))
    }

    /// Why the pose is no such place, if it is none.
    pub(super) fn check(
        &self,
        query: &PlaceQuery,
        scene: Scene<'_>,
        pose: &Pose,
    ) -> Result<(), String> {
        let t = pose.translation;
        let is_there = self.stands_at(query, scene.world, pose);
        let margin = if is_there { 0.0 } else { self.margin() };
        let factors = query.factors(&self.extent, margin);
        let missed = factors.iter().find(|f| (f.value)([t.x, t.y]) <= 0.0);
        if let Some(factor) = missed {
            return Err(format!("not {}", factor.key));
        }
        if is_there {
            return Ok(());
        }
        let room = self.room(query, scene.world);
        let depth = self.load.as_ref().map_or(0.0, |load| load.depth(pose));
        let off = |[start, _]: &[f64; 2]| (start - SLACK + depth - t.z).abs();
        let board = self.starts.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        let stands = match board {
            Some(board) => self.lower(query, &room, pose, *board),
            None => Err(NoRoom::NoSupport),
        };
        let stands = stands.map_err(|cause| cause_text(&cause))?;
        let off = (stands.translation.z - t.z).abs();
        if off > 0.01 {
            return Err(format!("{:.0} cm too high or too low", off * 100.0));
        }
        Ok(())
    }
}

/// Where a thing could stand.
struct Room<'w> {
    standing: StandingRoom<'w>,
    /// How what it is put into would be closed, if that is open.
    closing: Option<Closing<'w>>,
}

impl PlaceQuery {
    /// What is to be put down, as reports name it.
    fn what_name(&self) -> String {
        match &self.what {
            What::Point => "a point".to_owned(),
            What::Object(name) => name.clone(),
            What::Kind(kind) => format!("a {kind}"),
        }
    }

    /// The factors of the map, the cheap ones first; things are `margin` (m) or more from edges.
    fn factors<'a>(&'a self, extent: &'a Extent, margin: f64) -> Vec<Factor<'a>> {
        let on = self.position.key();
        let key = match &self.what {
            What::Point => format!("({on} …)"),
            _ => format!("({on} …) for {}", self.what_name()),
        };
        let mut factors = vec![Factor {
            key,
            value: Box::new(move |point| {
                f64::from(u8::from(inset(extent, extent.local(point)) >= margin))
            }),
        }];
        let mut constraints: Vec<_> = self.constraints.iter().collect();
        constraints.sort_by_key(|c| c.score());
        factors.extend(constraints.into_iter().map(|constraint| Factor {
            key: constraint.key.clone(),
            value: Box::new(move |point| constraint.value(extent, point)),
        }));
        factors
    }
}

fn cause_text(cause: &NoRoom) -> String {
    match cause {
        NoRoom::NoSupport => "with nothing below".to_owned(),
        NoRoom::On(body) => format!("on {body}"),
        NoRoom::Edge => "across an edge or not level".to_owned(),
        NoRoom::Touches(body) => format!("touching {body}"),
        NoRoom::Closing(body) => format!("meeting {body} when that is closed"),
    }
}

//! One pose after another that fulfils a description, in a world that may change meanwhile.

use super::base_query::BaseQuery;
use super::base_search::BaseSearch;
use super::costmap::Costmap;
use super::draw::Draw;
use super::offered::Offered;
use super::out_of_reach::OutOfReach;
use super::place_query::{PlaceQuery, What};
use super::place_search::PlaceSearch;
use super::tally::Tally;
use crate::world::grasp_library::GraspLibrary;
use crate::world::hash::Hasher;
use crate::world::{World, WorldError};
use spatial::Pose;

/// What is wanted.
#[derive(Clone, Debug, PartialEq)]
pub enum Query {
    /// A place for a thing.
    Place(PlaceQuery),
    /// A place for the robot.
    Base(BaseQuery),
}

/// What a search looks at.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// The world.
    pub world: &'a World,
    /// How things are grasped.
    pub grasps: &'a GraspLibrary,
    /// What has been found to be out of reach.
    pub out_of_reach: &'a OutOfReach,
}

/// A search in one state of the world.
enum Search {
    Place(Box<PlaceSearch>),
    Base(Box<BaseSearch>),
    /// There is nothing to search, for this reason.
    Nothing(String),
    /// It has been set aside; the area (m²) in which it searches.
    SetAside(f64),
}

impl Search {
    /// The map of where to look, if it is there.
    fn map(&self) -> Option<&Costmap> {
        match self {
            Self::Place(search) => Some(search.map()),
            Self::Base(search) => Some(search.map()),
            Self::Nothing(_) | Self::SetAside(_) => None,
        }
    }
}

/// What can be shown of a search.
#[derive(Clone, Debug)]
pub struct LocationView {
    /// Where to look.
    pub map: Costmap,
    /// Its height (m).
    pub height: f64,
    /// Whether the poses are those of the robot's base.
    pub is_for_robot: bool,
    /// The poses offered, the last one last.
    pub offered: Vec<Pose>,
}

/// The poses that fulfil a description.
pub struct Stream {
    query: Query,
    draw: Draw,
    offered: Offered,
    last: Option<Pose>,
    tally: Tally,
    /// The search, and the state of the world that it is for.
    search: Option<(u64, Search)>,
}

impl Stream {
    /// The poses that fulfil the description; the same seed gives the same ones.
    pub fn new(query: Query, seed: u64) -> Self {
        Self {
            query,
            draw: Draw::new(seed),
            offered: Offered::default(),
            last: None,
            tally: Tally::default(),
            search: None,
        }
    }

    /// Drops what was prepared for the world as it was.
    pub fn forget(&mut self) {
        self.search = None;
    }

    /// Drops what takes memory of what was prepared: maps, and copies of the world. Whoever goes on
    /// prepares it again; what has been offered is not offered again.
    pub fn set_aside(&mut self) {
        if let Some((_, search)) = &mut self.search
            && let Some(map) = search.map()
        {
            *search = Search::SetAside(map.area());
        }
    }

    /// Makes the search fit the world as it is. What was prepared for another state of the world is
    /// dropped.
    fn prepare(&mut self, scene: Scene<'_>) -> Result<(), WorldError> {
        let state = self.query.state(scene.world);
        let is_there =
            |(s, search): &(u64, Search)| *s == state && !matches!(search, Search::SetAside(_));
        if self.search.as_ref().is_some_and(is_there) {
            if let (Some((_, Search::Base(search))), Query::Base(query)) =
                (&mut self.search, &self.query)
                && !search.is_for_posture(scene.world)
            {
                search.go_on_in_posture(query, scene)?;
            }
            return Ok(());
        }
        self.tally = Tally::default();
        let search = match &self.query {
            Query::Place(query) => PlaceSearch::new(query, scene.world, &mut self.draw)?
                .map(|search| Search::Place(Box::new(search))),
            Query::Base(query) => BaseSearch::new(query, scene, &mut self.draw)?
                .map(|search| Search::Base(Box::new(search))),
        };
        self.search = Some((state, search.unwrap_or_else(Search::Nothing)));
        Ok(())
    }

    /// The next pose in the map frame; `None` if nothing is left.
    pub fn next(&mut self, scene: Scene<'_>) -> Result<Option<Pose>, WorldError> {
        let found = self.next_of_search(scene)?;
        let is_mixed = |search: &Search| match search {
            Search::Base(search) => search.is_of_several_postures(),
            _ => false,
        };
        match (&found, &self.search) {
            // What was rejected in another posture may do in this one.
            (None, Some((_, search))) if is_mixed(search) => {
                self.search = None;
                self.next_of_search(scene)
            }
            _ => Ok(found),
        }
    }

    fn next_of_search(&mut self, scene: Scene<'_>) -> Result<Option<Pose>, WorldError> {
        self.prepare(scene)?;
        let Self {
            query,
            draw,
            offered,
            tally,
            ..
        } = self;
        let found = match (&mut self.search, query) {
            (Some((_, Search::Place(search))), Query::Place(query)) => {
                search.next(query, scene, draw, offered, tally)
            }
            (Some((state, Search::Base(search))), Query::Base(query)) => {
                let state = *state ^ search.posture_state();
                if let Some(known) = scene.out_of_reach.known(state, query) {
                    *tally = known;
                    return Ok(None);
                }
                let found = search.next(query, scene, draw, offered, tally)?;
                if found.is_none() && offered.count() == 0 && query.sees && !tally.was_unseen() {
                    scene.out_of_reach.note(state, query, tally);
                }
                found
            }
            _ => None,
        };
        if let Some(pose) = found {
            self.offer(pose);
        }
        Ok(found)
    }

    fn offer(&mut self, pose: Pose) {
        self.offered.add(pose);
        self.last = Some(pose);
    }

    /// Why there is nothing left.
    pub fn why(&self) -> String {
        if let Some((_, Search::Nothing(why))) = &self.search {
            return why.clone();
        }
        let total = self.tally.total();
        let more = match self.offered.count() {
            0 => String::new(),
            n => format!(" {n} have been offered before."),
        };
        match total {
            1 if self.tally.is_of_only_place() => format!("{}.{more}", self.tally),
            0 => format!("There are no candidates left.{more}"),
            n => format!("{n} of {n} candidates were rejected: {}.{more}", self.tally),
        }
    }

    /// Why a pose (map frame) does not fulfil the description, if it does not.
    pub fn check(
        &mut self,
        scene: Scene<'_>,
        pose: &Pose,
    ) -> Result<Result<(), String>, WorldError> {
        let is_fresh = self.search.as_ref().is_some_and(|(s, search)| {
            let is_for_posture = match search {
                Search::Base(search) => search.is_for_posture(scene.world),
                _ => true,
            };
            is_for_posture && *s == self.query.state(scene.world)
        });
        if is_fresh && self.last.as_ref() == Some(pose) {
            return Ok(Ok(()));
        }
        self.prepare(scene)?;
        match (&mut self.search, &self.query) {
            (Some((_, Search::Place(search))), Query::Place(query)) => {
                Ok(search.check(query, scene, pose))
            }
            (Some((_, Search::Base(search))), Query::Base(query)) => {
                search.check(query, scene, pose)
            }
            (Some((_, Search::Nothing(why))), _) => Ok(Err(why.clone())),
            _ => Ok(Ok(())),
        }
    }

    /// The present base pose (map frame) if a place for the robot is wanted and this is one.
    pub fn here(&mut self, scene: Scene<'_>) -> Result<Option<Pose>, WorldError> {
        if !matches!(self.query, Query::Base(_)) {
            return Ok(None);
        }
        let base = scene.world.robot_configuration().base;
        if self.check(scene, &base)?.is_err() {
            return Ok(None);
        }
        self.offer(base);
        Ok(Some(base))
    }

    /// Whether the demands leave nothing to look at.
    pub fn is_empty(&self) -> bool {
        matches!(self.search, Some((_, Search::Nothing(_))))
    }

    /// Number of poses offered so far.
    pub fn count(&self) -> usize {
        self.offered.count()
    }

    /// What can be shown of the search in the world as it is; `None` if nothing is left of the map.
    pub fn view(&mut self, scene: Scene<'_>) -> Result<Option<LocationView>, WorldError> {
        self.prepare(scene)?;
        let (map, height) = match &self.search {
            Some((_, Search::Place(search))) => (search.map().clone(), search.height()),
            Some((_, Search::Base(search))) => (search.map().clone(), 0.0),
            _ => return Ok(None),
        };
        let last = self.last;
        let before = self
            .offered
            .all()
            .copied()
            .filter(|pose| Some(*pose) != last);
        Ok(Some(LocationView {
            map,
            height,
            is_for_robot: matches!(self.query, Query::Base(_)),
            offered: before.chain(last).collect(),
        }))
    }

    /// How large the area is in which is searched, and how many poses have been offered.
    pub fn summary(&self) -> String {
        let area = match &self.search {
            Some((_, Search::SetAside(area))) => *area,
            Some((_, search)) => search.map().map_or(0.0, Costmap::area),
            None => 0.0,
        };
        let count = self.offered.count();
        format!("Area to look in: {area:.2} m²\nPoses offered: {count}")
    }
}

impl Query {
    /// A hash of everything in the world that decides about poses, but the robot.
    fn state(&self, world: &World) -> u64 {
        let mut hasher = Hasher::default();
        for position in world.kitchen_positions().as_slice() {
            hasher.number(*position);
        }
        let own = match self {
            Self::Place(query) => match &query.what {
                What::Object(name) => Some(name.as_str()),
                _ => None,
            },
            Self::Base(_) => None,
        };
        for object in world.objects() {
            let is_held = object.attachment().is_some();
            if own == Some(object.name()) && (is_held || matches!(self, Self::Place(_))) {
                continue;
            }
            hasher.integer(object.key().code());
            match object.attachment() {
                Some(attachment) => hasher.pose(&attachment.at),
                None => {
                    if let Ok(pose) = world.object_pose(object.name()) {
                        hasher.pose(&pose);
                    }
                }
            }
        }
        hasher.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::super::base_query::{Distances, Item, Target};
    use super::*;
    use crate::robot::Side;
    use crate::world::grasp_library::GRASPS;
    use crate::world::{Models, RobotConfiguration};
    use std::sync::Arc;

    #[test]
    fn a_search_goes_on_where_it_was_when_the_robot_has_moved_its_joints() {
        let models = Arc::new(Models::pr2_in_kitchen().unwrap());
        let joints = models.description.start_positions(&models.robot);
        let base = Pose::identity();
        let mut world = World::new(Arc::clone(&models), RobotConfiguration { base, joints });
        let grasps = GraspLibrary::from_sexp(GRASPS, "grasps.sexp").unwrap();
        let out_of_reach = OutOfReach::default();
        let mut stream = Stream::new(
            Query::Base(BaseQuery {
                target: Target {
                    item: Item::Point,
                    pose: Pose::translation(1.7, 0.9, 0.9),
                    name: "a place".to_owned(),
                },
                arms: Some(vec![Side::Right]),
                grasps: None,
                held: None,
                sees: false,
                distances: Distances::default(),
                from: [0.0, 0.0],
            }),
            1,
        );
        let mut rejected = 0;
        for turned in 0..4 {
            let mut robot = world.robot_configuration().clone();
            let neck = models.description.neck.joints[0];
            robot.joints.set(neck, 0.1 * f64::from(turned));
            if turned == 2 {
                models.description.torso.set_height(&mut robot.joints, 0.2);
            }
            world.teleport_robot(&robot);
            let scene = Scene {
                world: &world,
                grasps: &grasps,
                out_of_reach: &out_of_reach,
            };
            assert!(stream.next(scene).unwrap().is_some());
            // A search that begins anew has rejected nothing.
            assert!(stream.tally.total() >= rejected);
            rejected = stream.tally.total();
            let Some((_, Search::Base(search))) = &stream.search else {
                panic!("it searches for places to stand");
            };
            assert_eq!(search.is_of_several_postures(), turned >= 2);
        }
        assert!(rejected > 10, "{rejected}");
        assert_eq!(stream.count(), 4);
    }
}

//! The search for base poses from which a target is within reach or in sight.

use std::collections::VecDeque;

use super::base_query::{BaseQuery, Item};
use super::base_walk::Walk;
use super::costmap::{Costmap, Factor};
use super::draw::Draw;
use super::offered::Offered;
use super::reach::{Goal, NoReach, Reach, imagined};
use super::sight::hidden;
use super::stream::Scene;
use super::tally::Tally;
use crate::motion::{BaseChecker, Effort, MIN_MARGIN, interruption};
use crate::robot::description::DriveKind;
use crate::world::hash::Hasher;
use crate::world::{KnownStands, World, WorldError};
use spatial::{Pose, pose};

/// Edge length (m) of a cell.
const RESOLUTION: f64 = 0.05;
/// The most comfortable distance (m) of the base's axis from a target within reach, and its spread.
const COMFORT: [f64; 2] = [0.65, 0.15];
/// Variance (m²) of the distance to what is to be seen.
const SIGHT_VARIANCE: f64 = 0.5;
/// Distance (m) from where the robot is over which the preference for a place falls to 37 %.
const NEAR: f64 = 0.8;
/// A search ends when so many base poses in a row, free and near enough, have been checked in vain.
const MAX_CHECKS: u32 = 5000;
/// How many base poses at which something is in the way of a few postures are examined again when all
/// others have been tried.
const MAX_AGAIN: usize = 1000;
/// A part of the search ends when so many postures of the arms have been checked for collisions: most
/// of the time goes there, about 10 µs for each. Where there is a place, hundreds are enough most of the
/// time; a cup in a corner with boxes in front of it takes 6,000 and then 28,000.
const MAX_POSTURES: [u32; 3] = [15_000, 36_000, 8_000];
/// The same for points of ways along which drawers and doors are followed, about 35 µs for each: some 800 are enough to
/// find a base pose, or to leave it for later; some 4,000 are followed from one that is examined again.
const MAX_POINTS: [u32; 3] = [16_000, 16_000, 8_000];
/// A search also ends when the target has been in reach from so many base poses, but out of sight from all of them:
/// looking takes a millisecond, and whoever asks may do without sight.
const MAX_UNSEEN: u32 = 400;
/// A base pose is no higher (m) than this.
const FLOOR: f64 = 0.05;
/// A base that does not drive is at a pose if that is as near (m, rad) as this.
const SAME_PLACE: f64 = 1e-3;
/// How far (m) the map of a base that does not drive extends around it.
const AT_BASE: f64 = 0.1;
/// From where such a base reaches or sees something, or does not.
const FROM_HERE: &str = "from where the robot stands, whose base does not move";
/// Why such a base is nowhere else.
const ELSEWHERE: &str = "elsewhere than where the robot stands, whose base does not move";

/// The search in one state of the world.
pub(super) struct BaseSearch {
    map: Costmap,
    /// The world as it would be.
    imagined: World,
    /// What is to be reached there.
    goal: Goal,
    /// Number of base poses for which it was checked in vain whether the target can be reached.
    checks: u32,
    /// Number of postures that have been checked in each part, in the first one since it has found one.
    postures: [u32; 3],
    /// Number of base poses from which only sight was wanting, since one has been found.
    unseen: u32,
    walk: Walk,
    /// Base poses near the one that the walk has come to, if the arms need such.
    beside: VecDeque<Pose>,
    /// Base poses that are to be examined again.
    again: VecDeque<Pose>,
    /// Whether all others of the walk have been tried.
    is_second_look: bool,
    /// The robot's posture, as [`posture_of`] has it.
    posture: Vec<f64>,
    /// Whether base poses have been rejected in other postures.
    is_of_several_postures: bool,
}

/// The parts of a search.
#[derive(Clone, Copy)]
enum Part {
    /// The base poses of the first lattice.
    First,
    /// Base poses that are examined again.
    Again,
    /// The base poses between.
    Between,
}

/// Why a base pose is no solution.
struct Rejection {
    cause: String,
    /// Whether other postures might do.
    may_pass: bool,
    /// Whether only sight is wanting.
    is_unseen: bool,
}

impl Rejection {
    fn of(cause: String) -> Self {
        Self {
            cause,
            may_pass: false,
            is_unseen: false,
        }
    }
}

impl BaseSearch {
    /// Begins a search, or tells why there is no such place.
    pub(super) fn new(
        query: &BaseQuery,
        scene: Scene<'_>,
        draw: &mut Draw,
    ) -> Result<Result<Self, String>, WorldError> {
        let factors = factors(query, scene.world);
        let limits = limits(query, scene.world);
        let map = match Costmap::product(RESOLUTION, limits, &factors) {
            Ok(map) => map,
            Err(emptied) => {
                return Ok(Err(format!(
                    "{} leave nothing of the floor: 0.00 m².",
                    emptied.keys.join(" and ")
                )));
            }
        };
        let imagined = imagined(query, scene)?;
        Ok(Ok(Self {
            goal: Goal::new(query, scene, &imagined),
            imagined,
            checks: 0,
            postures: [0; 3],
            unseen: 0,
            walk: Walk::first(query, map.cells.clone(), draw),
            map,
            beside: VecDeque::new(),
            again: VecDeque::new(),
            is_second_look: false,
            posture: posture_of(scene.world),
            is_of_several_postures: false,
        }))
    }

    /// Whether the search is for the robot in its present posture.
    pub(super) fn is_for_posture(&self, world: &World) -> bool {
        self.posture == posture_of(world)
    }

    /// A hash of the robot's posture.
    pub(super) fn posture_state(&self) -> u64 {
        let mut hasher = Hasher::default();
        for position in &self.posture {
            hasher.number(*position);
        }
        hasher.finish()
    }

    /// Whether base poses have been rejected in other postures than the present one.
    pub(super) fn is_of_several_postures(&self) -> bool {
        self.is_of_several_postures
    }

    /// Goes on with the robot in its present posture, and all else as it was: base poses that have been rejected are not
    /// tried again.
    pub(super) fn go_on_in_posture(
        &mut self,
        query: &BaseQuery,
        scene: Scene<'_>,
    ) -> Result<(), WorldError> {
        self.posture = posture_of(scene.world);
        self.is_of_several_postures = true;
        self.imagined = imagined(query, scene)?;
        Ok(())
    }

    /// The map of where to look.
    pub(super) fn map(&self) -> &Costmap {
        &self.map
    }

    /// The next base pose that has not been offered.
    pub(super) fn next(
        &mut self,
        query: &BaseQuery,
        scene: Scene<'_>,
        draw: &mut Draw,
        offered: &Offered,
        tally: &mut Tally,
    ) -> Result<Option<Pose>, WorldError> {
        if is_fixed(scene.world) {
            return self.next_where_it_stands(query, scene, offered, tally);
        }
        scene.world.with_known_stands(|stands| {
            self.next_of_walk(query, scene, draw, (offered, stands), tally)
        })
    }

    fn next_of_walk(
        &mut self,
        query: &BaseQuery,
        scene: Scene<'_>,
        draw: &mut Draw,
        (offered, stands): (&Offered, &mut KnownStands),
        tally: &mut Tally,
    ) -> Result<Option<Pose>, WorldError> {
        let Self {
            imagined,
            goal,
            checks,
            postures,
            unseen,
            walk,
            beside,
            again,
            is_second_look,
            ..
        } = self;
        let arms = &scene.world.models().description.arms;
        let has_planar_arm = arms.iter().any(|arm| arm.kinematics.plane().is_some());
        let mut test = Test::new(query, scene, goal, imagined)?;
        let mut counted = 0;
        loop {
            interruption::look();
            let count = test.reach.postures();
            let part = match (*is_second_look, walk.is_first()) {
                (true, _) => Part::Again,
                (false, true) => Part::First,
                (false, false) => Part::Between,
            };
            postures[part as usize] += count - counted;
            counted = count;
            let most = match test.reach.follows_ways() {
                true => MAX_POINTS[part as usize],
                false => MAX_POSTURES[part as usize],
            };
            if postures[part as usize] >= most {
                tally.give_up();
                match part {
                    Part::First => *is_second_look = true,
                    Part::Again => again.clear(),
                    Part::Between => return Ok(None),
                }
            }
            if *is_second_look {
                let Some(base) = again.pop_front() else {
                    let Some(between) = between(query, scene.world, walk, draw) else {
                        return Ok(None);
                    };
                    (*walk, *is_second_look, *checks) = (between, false, 0);
                    continue;
                };
                if offered.has(&base) {
                    continue;
                }
                match test.run(&base, Effort::PATIENT, (&mut *checks, &mut *stands))? {
                    Ok(()) => return Ok(Some(base)),
                    Err(rejection) if rejection.is_unseen => tally.note_unseen(),
                    Err(_) => {}
                }
                if test.reach.has_no_room() {
                    tally.add(no_room(query));
                    return Ok(None);
                }
                continue;
            }
            let base = match beside.pop_front() {
                Some(base) => base,
                None => {
                    let Some(base) = walk.next(draw) else {
                        *is_second_look = true;
                        continue;
                    };
                    if has_planar_arm {
                        beside.extend(test.reach.bases_near(&base));
                        continue;
                    }
                    base
                }
            };
            if offered.has(&base) {
                continue;
            }
            match test.run(&base, Effort::QUICK, (&mut *checks, &mut *stands))? {
                Ok(()) => {
                    (*checks, *unseen) = (0, 0);
                    postures[Part::First as usize] = 0;
                    return Ok(Some(base));
                }
                Err(rejection) => {
                    if rejection.may_pass && again.len() < MAX_AGAIN {
                        again.push_back(base);
                    }
                    if rejection.is_unseen {
                        tally.note_unseen();
                        *unseen += 1;
                        if *unseen >= MAX_UNSEEN {
                            tally.add(rejection.cause);
                            tally.give_up();
                            return Ok(None);
                        }
                    }
                    tally.add(rejection.cause);
                    if test.reach.has_no_room() {
                        tally.add(no_room(query));
                        return Ok(None);
                    }
                }
            }
            if *checks >= MAX_CHECKS {
                *is_second_look = true;
                tally.give_up();
            }
        }
    }

    /// Where the base stands, if it does not drive and that has not been offered.
    fn next_where_it_stands(
        &mut self,
        query: &BaseQuery,
        scene: Scene<'_>,
        offered: &Offered,
        tally: &mut Tally,
    ) -> Result<Option<Pose>, WorldError> {
        let here = scene.world.robot_configuration().base;
        // However often it is asked, there is one place.
        if offered.has(&here) {
            *tally = Tally::of_only_place(ELSEWHERE);
            return Ok(None);
        }
        match self.check_where_it_stands(query, scene)? {
            Ok(()) => Ok(Some(here)),
            Err(rejection) => {
                *tally = Tally::of_only_place(rejection.cause);
                if rejection.is_unseen {
                    tally.note_unseen();
                }
                Ok(None)
            }
        }
    }

    /// Why a base that does not drive stands in no such place, if it does not.
    fn check_where_it_stands(
        &mut self,
        query: &BaseQuery,
        scene: Scene<'_>,
    ) -> Result<Result<(), Rejection>, WorldError> {
        let here = scene.world.robot_configuration().base;
        let mut test = Test::new(query, scene, &self.goal, &self.imagined)?;
        // There is no other place to try.
        let nothing = (&mut 0, &mut KnownStands::default());
        let found = test.run(&here, Effort::THOROUGH, nothing)?;
        let of_bare_place = query.target.item == Item::Point;
        Ok(found.map_err(|rejection| Rejection {
            // One of many points of a surface needs no name.
            cause: match of_bare_place && rejection.is_unseen {
                true => format!("out of sight {FROM_HERE}"),
                false => format!("{} {FROM_HERE}", rejection.cause),
            },
            ..rejection
        }))
    }

    /// Why the pose is no such place, if it is none.
    pub(super) fn check(
        &mut self,
        query: &BaseQuery,
        scene: Scene<'_>,
        base: &Pose,
    ) -> Result<Result<(), String>, WorldError> {
        let t = base.translation;
        if is_fixed(scene.world) {
            let here = scene.world.robot_configuration().base;
            let way = pose::distance_between(base, &here);
            if way.max(pose::angle_between(base, &here)) > SAME_PLACE {
                return Ok(Err(ELSEWHERE.to_owned()));
            }
            let found = self.check_where_it_stands(query, scene)?;
            return Ok(found.map_err(|rejection| rejection.cause));
        }
        if t.z.abs() >= FLOOR {
            return Ok(Err("not on the floor".to_owned()));
        }
        let factors = factors(query, scene.world);
        let missed = factors.iter().find(|f| (f.value)([t.x, t.y]) <= 0.0);
        if let Some(factor) = missed {
            return Ok(Err(format!("not {}", factor.key)));
        }
        let on_floor = pose::from_xy_yaw(t.x, t.y, pose::yaw(base));
        let mut test = Test::new(query, scene, &self.goal, &self.imagined)?;
        let mut stands = KnownStands::default();
        let mut found = test.run(&on_floor, Effort::QUICK, (&mut 0, &mut stands))?;
        if found.as_ref().is_err_and(|rejection| rejection.may_pass) {
            found = test.run(&on_floor, Effort::PATIENT, (&mut 0, &mut stands))?;
        }
        Ok(found.map_err(|rejection| rejection.cause))
    }
}

/// The exact tests of a base pose, the cheap ones first.
struct Test<'a> {
    query: &'a BaseQuery,
    checker: BaseChecker<'a>,
    reach: Reach<'a>,
    imagined: &'a World,
    /// A copy of it in which the robot looks about, once that is needed.
    looking: Option<World>,
    is_fixed: bool,
}

impl<'a> Test<'a> {
    fn new(
        query: &'a BaseQuery,
        scene: Scene<'a>,
        goal: &'a Goal,
        imagined: &'a World,
    ) -> Result<Self, WorldError> {
        Ok(Self {
            query,
            checker: BaseChecker::new(scene.world),
            reach: Reach::new(goal, imagined)?,
            imagined,
            looking: None,
            is_fixed: is_fixed(scene.world),
        })
    }

    /// Why the base pose is no solution, if it is none; counts the checks that take long.
    fn run(
        &mut self,
        base: &Pose,
        effort: Effort,
        (checks, stands): (&mut u32, &mut KnownStands),
    ) -> Result<Result<(), Rejection>, WorldError> {
        if let Err(cause) = self.reach.is_near(base) {
            return Ok(Err(Rejection::of(self.cause(&cause))));
        }
        let t = base.translation;
        let place = [t.x, t.y, pose::yaw(base)];
        // A base that does not drive is where it is.
        let hit = match self.is_fixed {
            true => None,
            false => stands.obstacle(&place, || self.checker.blocker(&place, MIN_MARGIN)),
        };
        if let Some(other) = hit {
            let cause = format!("in collision with {other}");
            return Ok(Err(Rejection::of(cause)));
        }
        *checks += 1;
        if let Err(cause) = self.reach.test(base, effort) {
            return Ok(Err(Rejection {
                cause: self.cause(&cause),
                may_pass: matches!(cause, NoReach::InTheWay | NoReach::NoFit),
                is_unseen: false,
            }));
        }
        if self.query.sees {
            let imagined = self.imagined;
            let looking = self.looking.get_or_insert_with(|| imagined.clone());
            let mut robot = looking.robot_configuration().clone();
            robot.base = *base;
            looking.teleport_robot(&robot);
            if let Some(cause) = hidden(looking, self.query)? {
                return Ok(Err(Rejection {
                    is_unseen: true,
                    ..Rejection::of(cause)
                }));
            }
        }
        Ok(Ok(()))
    }

    fn cause(&self, cause: &NoReach) -> String {
        let name = &self.query.target.name;
        match cause {
            NoReach::NoGrasp => format!("without a known grasp of {name}"),
            NoReach::TooHeavy => format!("with {name} too heavy for the fingers by any grasp"),
            NoReach::TooFar => format!("out of reach of {name}"),
            NoReach::NoFit => format!("with no grasp by which the hand fits around {name}"),
            NoReach::InTheWay => format!("with something in the way to {name}"),
        }
    }
}

/// Whether the robot's base does not drive.
fn is_fixed(world: &World) -> bool {
    world.models().description.base.kind == DriveKind::Fixed
}

/// The positions of all joints but those of the neck, which turns at every place where the robot looks at something.
fn posture_of(world: &World) -> Vec<f64> {
    let mut joints = world.robot_configuration().joints.clone();
    for joint in &world.models().description.neck.joints {
        joints.set(*joint, 0.0);
    }
    joints.as_slice().to_vec()
}

/// Why no base pose will do if the hands have no room.
fn no_room(query: &BaseQuery) -> String {
    format!("with no room for a hand at {}", query.target.name)
}

/// The part of the floor (m) that is searched.
fn limits(query: &BaseQuery, world: &World) -> [[f64; 2]; 2] {
    if is_fixed(world) {
        let t = world.robot_configuration().base.translation;
        return [
            [t.x - AT_BASE, t.y - AT_BASE],
            [t.x + AT_BASE, t.y + AT_BASE],
        ];
    }
    let t = query.target.pose.translation;
    let far = match &query.arms {
        Some(_) => query.distances.reach[1],
        None => query.distances.sight,
    };
    [[t.x - far, t.y - far], [t.x + far, t.y + far]]
}

/// The walk between the base poses of the one before, if there is one. There are places where the robot
/// fits only there; what is to be seen only is seen from much of the floor.
fn between(query: &BaseQuery, world: &World, before: &Walk, draw: &mut Draw) -> Option<Walk> {
    query.arms.as_ref()?;
    let factors = factors(query, world);
    before.between(draw, |shift| {
        let map = Costmap::shifted_product(RESOLUTION, shift, limits(query, world), &factors);
        map.map_or_else(|_| Vec::new(), |map| map.cells)
    })
}

/// The factors of the map.
fn factors<'a>(query: &'a BaseQuery, world: &'a World) -> Vec<Factor<'a>> {
    let t = query.target.pose.translation;
    let target = [t.x, t.y];
    let distance = move |[x, y]: [f64; 2]| libm::hypot(x - target[0], y - target[1]);
    let name = &query.target.name;
    let mut factors = Vec::new();
    if is_fixed(world) {
        // The exact tests decide.
        factors.push(Factor {
            key: "where the base stands".to_owned(),
            value: Box::new(|_| 1.0),
        });
        return factors;
    }
    if query.arms.is_some() {
        factors.push(Factor {
            key: format!("within {} m of {name}", query.distances.reach[1]),
            value: Box::new(move |p| {
                let [best, spread] = COMFORT;
                let d = distance(p);
                let [least, most] = query.distances.reach;
                let is_in_reach = (least..=most).contains(&d);
                f64::from(u8::from(is_in_reach)) * gauss(d - best, spread * spread)
            }),
        });
    }
    if query.sees {
        factors.push(Factor {
            key: format!("within {} m of {name}", query.distances.sight),
            value: Box::new(move |p| {
                let d = distance(p);
                f64::from(u8::from(d <= query.distances.sight)) * gauss(d, SIGHT_VARIANCE)
            }),
        });
    }
    factors.push(Factor {
        key: "on the map".to_owned(),
        value: Box::new(move |p| {
            let [x, y] = query.from;
            let way = libm::hypot(p[0] - x, p[1] - y);
            let nearness = libm::exp(-way / NEAR).max(1e-3);
            f64::from(u8::from(world.models().map.contains(p))) * nearness
        }),
    });
    factors
}

/// A bell curve with the value 1 at 0 and never quite 0.
fn gauss(x: f64, variance: f64) -> f64 {
    libm::exp(-x * x / (2.0 * variance)).max(1e-6)
}

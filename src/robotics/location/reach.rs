//! Whether the robot could pick something up, or put it down, from a base pose.

use super::base_query::{BaseQuery, Item};
use super::stream::Scene;
use crate::motion::{
    Candidates, Effort, GraspChooser, GraspObstacle, GraspPart, GraspQuestion, GraspReach,
    HandleChooser, HandleObstacle, HandleQuestion, HeldGrip, NoGraspHere, PutReach, Station,
};
use crate::robot::Side;
use crate::world::{World, WorldError};
use spatial::{Pose, pose, trig};

/// How high (m) above a bare place the tool must be able to be.
const OVER: f64 = 0.1;
/// Name of an object that is only imagined.
const IMAGINED: &str = "the object that is to be there";

/// Why a target cannot be reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum NoReach {
    /// No wanted grasp of such an object is known.
    NoGrasp,
    /// Its weight is more than fingers transmit by any grasp.
    TooHeavy,
    /// Too far away, or at an impossible angle.
    TooFar,
    /// The hand itself would be in the target by every grasp that is near enough.
    NoFit,
    /// Something is in the way.
    InTheWay,
}

/// The world as it would be with the target where it is to be.
pub(super) fn imagined(query: &BaseQuery, scene: Scene<'_>) -> Result<World, WorldError> {
    let mut world = scene.world.clone();
    let target = &query.target;
    match &target.item {
        Item::Object(_) | Item::Point | Item::Handle { .. } => {}
        Item::Moved(name) => {
            world.detach(name)?;
            world.move_object(name, &target.pose)?;
        }
        Item::Kind(kind) => {
            world.spawn(IMAGINED, kind, &target.pose, None, None)?;
        }
    }
    Ok(world)
}

/// The type of the target.
fn kind_of(query: &BaseQuery, world: &World) -> Option<String> {
    let name = object_of(query)?;
    let object = world.object(name).ok()?;
    Some(object.type_name().to_owned())
}

/// The name of the target in the imagined world.
pub(super) fn object_of(query: &BaseQuery) -> Option<&str> {
    match &query.target.item {
        Item::Object(name) | Item::Moved(name) => Some(name),
        Item::Kind(_) => Some(IMAGINED),
        Item::Point | Item::Handle { .. } => None,
    }
}

/// What is to be reached, and what has been found out about it.
pub(super) enum Goal {
    /// An object is to be grasped.
    Grasp(Box<(GraspQuestion, Candidates)>),
    /// A held object is to be put down.
    Put(Box<HeldGrip>),
    /// A drawer or door is to be opened or closed.
    Open(Box<HandleQuestion>),
    /// A hand is to be over a bare place.
    Point(Pose, Vec<Side>),
    /// Nothing is to be reached.
    Nothing,
}

impl Goal {
    /// In an imagined world.
    pub(super) fn new(query: &BaseQuery, scene: Scene<'_>, world: &World) -> Self {
        let Some(arms) = query.arms.clone() else {
            return Self::Nothing;
        };
        if let Some(held) = &query.held {
            return Self::Put(held.clone());
        }
        if let Item::Handle {
            container,
            position,
        } = &query.target.item
        {
            return Self::Open(Box::new(HandleQuestion {
                part: world.part(container.joint),
                handle: container.handle,
                position: *position,
                arms,
                grasps: query.grasps.clone().unwrap_or_default(),
            }));
        }
        let (Some(name), Some(kind)) = (object_of(query), kind_of(query, world)) else {
            return Self::Point(query.target.pose, arms);
        };
        // An object that is imagined elsewhere stands on what is there.
        let in_map = match &query.target.item {
            Item::Object(_) => query.target.pose,
            _ => world.object_pose(name).unwrap_or(query.target.pose),
        };
        let question = GraspQuestion {
            object: name.to_owned(),
            kind,
            in_map,
            arms,
            grasps: query.grasps.clone().unwrap_or_default(),
            torso_moves: true,
            failed: Vec::new(),
        };
        let candidates = Candidates::new(world.models(), scene.grasps, &question);
        Self::Grasp(Box::new((question, candidates)))
    }
}

/// Tests base poses for one target.
pub(super) enum Reach<'a> {
    Grasp(Box<GraspChooser<'a>>, &'a Candidates),
    Put(Box<PutReach<'a>>),
    Open(Box<HandleChooser<'a>>),
    Point(Box<GraspReach<'a>>, Pose, &'a [Side]),
    Nothing,
}

impl<'a> Reach<'a> {
    /// Prepares tests in an imagined world.
    pub(super) fn new(goal: &'a Goal, imagined: &'a World) -> Result<Self, WorldError> {
        Ok(match goal {
            Goal::Grasp(grasp) => {
                let (question, candidates) = &**grasp;
                let chooser = GraspChooser::new(imagined, question, candidates);
                Self::Grasp(Box::new(chooser), candidates)
            }
            Goal::Put(grip) => Self::Put(Box::new(PutReach::new(imagined, grip)?)),
            Goal::Open(question) => Self::Open(Box::new(HandleChooser::new(
                imagined,
                question,
                Effort::QUICK,
            ))),
            Goal::Point(point, arms) => {
                let reach = GraspReach::new(imagined, None, true);
                Self::Point(Box::new(reach), *point, arms)
            }
            Goal::Nothing => Self::Nothing,
        })
    }

    /// Whether the target may be near enough to the base pose (map frame). Cheap.
    pub(super) fn is_near(&self, base: &Pose) -> Result<(), NoReach> {
        let is_near = match self {
            Self::Grasp(_, candidates) if candidates.is_empty() => return Err(NoReach::NoGrasp),
            Self::Grasp(chooser, _) if chooser.is_too_heavy() => return Err(NoReach::TooHeavy),
            Self::Grasp(chooser, _) => chooser.is_near(base),
            Self::Put(put) => put.is_near(base),
            Self::Open(chooser) => chooser.is_near(base),
            Self::Point(..) | Self::Nothing => true,
        };
        is_near.then_some(()).ok_or(NoReach::TooFar)
    }

    /// Whether it has been found that the hands have no room at the target, wherever the base is.
    pub(super) fn has_no_room(&self) -> bool {
        match self {
            Self::Grasp(chooser, _) => chooser.is_barred_everywhere(),
            Self::Put(put) => put.is_barred_everywhere(),
            Self::Open(_) | Self::Point(..) | Self::Nothing => false,
        }
    }

    /// The base poses near one (map frame) from which the target may be reached: that one, unless the arms
    /// have to be turned towards it.
    pub(super) fn bases_near(&self, base: &Pose) -> Vec<Pose> {
        match self {
            Self::Grasp(chooser, _) => chooser.bases_near(base),
            Self::Put(put) => put.bases_near(base),
            Self::Open(chooser) => chooser.bases_near(base),
            Self::Point(..) | Self::Nothing => vec![*base],
        }
    }

    /// Whether arms are followed along the ways of drawers and doors.
    pub(super) fn follows_ways(&self) -> bool {
        matches!(self, Self::Open(_))
    }

    /// Number of postures of the arms that have been checked, or of points along which arms have been followed.
    pub(super) fn postures(&self) -> u32 {
        match self {
            Self::Grasp(chooser, _) => chooser.postures(),
            Self::Put(put) => put.postures(),
            Self::Point(reach, ..) => reach.postures(),
            Self::Open(chooser) => chooser.points(),
            Self::Nothing => 0,
        }
    }

    /// Whether the target can be reached with the base at a pose (map frame).
    pub(super) fn test(&self, base: &Pose, effort: Effort) -> Result<(), NoReach> {
        match self {
            Self::Grasp(chooser, _) => {
                let found = chooser.with_base_at(base, effort).map(|_| ());
                found.map_err(|nothing| match nothing {
                    NoGraspHere::OutOfReach => NoReach::TooFar,
                    NoGraspHere::NoFit => NoReach::NoFit,
                    NoGraspHere::InTheWay => NoReach::InTheWay,
                })
            }
            Self::Put(put) => put
                .glancing_from(base, effort)
                .map(|_| ())
                .map_err(|obstacle| cause(&obstacle)),
            Self::Open(chooser) => {
                chooser
                    .as_one_of_many(base, effort)
                    .map(|_| ())
                    .map_err(|nothing| match nothing.main() {
                        Some(HandleObstacle::OutOfReach) | None => NoReach::TooFar,
                        Some(_) => NoReach::InTheWay,
                    })
            }
            Self::Point(reach, point, arms) => test_point(reach, base, effort, point, arms),
            Self::Nothing => Ok(()),
        }
    }
}

fn is_far(obstacle: &GraspObstacle) -> bool {
    matches!(obstacle, GraspObstacle::OutOfReach { .. })
}

fn cause(obstacle: &GraspObstacle) -> NoReach {
    match is_far(obstacle) {
        true => NoReach::TooFar,
        false => NoReach::InTheWay,
    }
}

/// Whether a tool can be over a bare place, pointing down or forward.
fn test_point(
    reach: &GraspReach<'_>,
    base: &Pose,
    effort: Effort,
    point: &Pose,
    arms: &[Side],
) -> Result<(), NoReach> {
    let mut worst = NoReach::TooFar;
    let p = (base.inverse() * point).translation;
    let ahead = trig::atan2(p.y, p.x);
    let down = std::f64::consts::FRAC_PI_2;
    let tools = [
        [0.0, down, ahead],
        [0.0, 0.0, ahead],
        [0.0, 0.0, ahead + 0.7],
        [0.0, 0.0, ahead - 0.7],
    ];
    let mut from = reach.glancing_from(base, effort);
    for side in arms {
        for rpy in tools {
            let station = Station {
                part: GraspPart::Approach,
                tool: pose::from_xyz_rpy([p.x, p.y, p.z + OVER], rpy),
            };
            match from.check(*side, f64::INFINITY, &[station]) {
                Ok(_) => return Ok(()),
                Err(obstacle) if is_far(&obstacle) => {}
                Err(_) => worst = NoReach::InTheWay,
            }
        }
    }
    Err(worst)
}

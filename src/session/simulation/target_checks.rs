//! Whether an object can be put down at its target with the grasps by which it could be picked up.

use super::Simulation;
use super::imagined::Imagined;
use robotics::motion::{
    Candidates, Effort, GraspChooser, GraspObstacle, GraspPart, GraspQuestion, HeldGrip, PutReach,
};
use robotics::robot::Side;
use robotics::world::{World, WorldError};
use spatial::Pose;

/// A grasp is given up for a target when so many postures have been checked. Where it suits, some hundreds are
/// enough but for one in a hundred.
const MAX_POSTURES: u32 = 1400;
/// Base poses at which something is in the way of a few postures are examined again, with more postures,
/// when no other will do; so many (about 40 to 350 are needed).
const MAX_AGAIN: u32 = 400;

/// Where an object is to be put down.
#[derive(Clone, Debug)]
pub(crate) struct PlacingTarget {
    /// Pose of the object in the map frame.
    pub pose: Pose,
    /// The base pose in the map frame; if there is none, any around the target will do.
    pub base: Option<Pose>,
}

/// One way to hold an object: a hand, a grasp, and the angle (rad) by which it is turned.
#[derive(Clone, Copy)]
pub(super) struct Way<'a> {
    pub(super) side: Side,
    pub(super) grasp: &'a str,
    pub(super) turn: f64,
}

/// By which grasps an object can be put down at a target.
#[derive(Debug, Default)]
pub(crate) struct TargetGrasps {
    /// The hands and grasps that will do.
    pub(crate) suiting: Vec<(Side, String)>,
    /// Those that will not, and why.
    pub(crate) others: Vec<(Side, String, GraspObstacle)>,
    /// Whether there are others, and the hand has no room at the target for any of them, wherever the base is.
    pub(crate) is_certain: bool,
    /// Whether the object is taken from all angles, as a round one is unless grasps are named.
    pub(crate) is_from_all_angles: bool,
}

/// The world with an object at its target, and the base poses from which it may be put down.
struct AtTarget {
    world: World,
    bases: Vec<Pose>,
}

/// Whether an object can be put down at its target, for each hand and grasp for which that has been
/// asked. How the grasp is turned does not matter, since a round object may be turned there, too.
#[derive(Default)]
pub(super) struct TargetChecks {
    done: Vec<(Side, String, Result<(), GraspObstacle>)>,
    /// The same for grips, of which several grasps of a round object may be one.
    grips: Vec<(HeldGrip, Result<(), GraspObstacle>)>,
    /// The world with the object at its target, as it is for each hand, and where the robot could
    /// stand there.
    there: [Option<Option<AtTarget>>; 2],
    /// Whether anything but the room for the hand has kept a grasp from the target: not all base poses are tried.
    is_doubtful: bool,
}

impl Simulation {
    /// The hands and grasps by which an object can be put down at the target, from anywhere, of those for which
    /// the hand has room where the object is.
    pub(crate) fn grasps_for_target(
        &self,
        question: &GraspQuestion,
        target: &PlacingTarget,
    ) -> TargetGrasps {
        let candidates = Candidates::new(&self.models, &self.grasps, question);
        let chooser = GraspChooser::new(&self.world, question, &candidates);
        let mut checks = TargetChecks::default();
        let mut grasps = TargetGrasps::default();
        for (side, grasp, turn) in chooser.with_room() {
            let way = Way {
                side,
                grasp: &grasp,
                turn,
            };
            match checks.check(self, question, target, way) {
                Ok(()) => grasps.suiting.push((side, grasp)),
                Err(obstacle) => grasps.others.push((side, grasp, obstacle)),
            }
        }
        let kind = self.models.objects.get(&question.kind);
        grasps.is_from_all_angles =
            question.grasps.is_empty() && kind.is_some_and(|kind| kind.is_round);
        grasps.is_certain = !checks.is_doubtful && !grasps.others.is_empty();
        grasps
    }

    /// Whether a hand that holds an object has room to put it down at a pose in the map frame, wherever the base is;
    /// true where that cannot be told.
    pub(crate) fn has_room_to_put(
        &self,
        object: &str,
        side: Side,
        pose: Pose,
    ) -> Result<bool, WorldError> {
        let grip = self.grip_on(object, side)?;
        let Some(world) = self.with_object_at(object, pose, side) else {
            return Ok(true);
        };
        PutReach::new(&world, &grip).map(|put| put.has_room())
    }

    /// The world with an object at a pose in the map frame; `None` if something else is there.
    fn with_object_at(&self, object: &str, pose: Pose, side: Side) -> Option<World> {
        let imagined = Imagined {
            object,
            object_pose: Some(pose),
            base_pose: None,
            side,
            opening: f64::INFINITY,
        };
        let mut world = imagined.world(&self.world).ok()??;
        world.teleport_robot(self.world.robot_configuration());
        Some(world)
    }

    /// The world with the object at its target, and the base poses from which it may be put down;
    /// `None` if something else is there.
    fn at_target(&self, object: &str, target: &PlacingTarget, side: Side) -> Option<AtTarget> {
        let world = self.with_object_at(object, target.pose, side)?;
        let stands = world.object_pose(object).ok()?;
        let bases = match &target.base {
            Some(base) => vec![*base],
            None => self.places_around(&stands),
        };
        Some(AtTarget { world, bases })
    }
}

impl TargetChecks {
    /// Whether the object can be put down at the target when it is held like that.
    pub(super) fn check(
        &mut self,
        simulation: &Simulation,
        question: &GraspQuestion,
        target: &PlacingTarget,
        way: Way<'_>,
    ) -> Result<(), GraspObstacle> {
        let mut done = self.done.iter();
        let known = done.find(|(side, grasp, _)| *side == way.side && grasp == way.grasp);
        if let Some((_, _, known)) = known {
            return known.clone();
        }
        let checked = self
            .test(simulation, question, target, way)
            .map_err(|obstacle| GraspObstacle::NotAtTarget {
                obstacle: Box::new(obstacle),
            });
        self.done
            .push((way.side, way.grasp.to_owned(), checked.clone()));
        checked
    }

    fn test(
        &mut self,
        simulation: &Simulation,
        question: &GraspQuestion,
        target: &PlacingTarget,
        way: Way<'_>,
    ) -> Result<(), GraspObstacle> {
        let there = self.there[way.side.index()]
            .get_or_insert_with(|| simulation.at_target(&question.object, target, way.side));
        let Some(AtTarget { world, bases }) = there else {
            self.is_doubtful = true;
            return Err(GraspObstacle::NoPath {
                report: "something else is there".to_owned(),
            });
        };
        let part = GraspPart::Grasp;
        let nowhere = GraspObstacle::OutOfReach { part };
        let kind = &question.kind;
        let Some(grasp) = simulation.definition(kind, way.side, way.grasp) else {
            return Err(nowhere);
        };
        let object = (question.object.as_str(), kind.as_str());
        let opening = simulation.grasps.opening(kind, &grasp);
        let models = &simulation.models;
        let grip = HeldGrip::by(models, way.side, object, &grasp, way.turn, opening);
        let Ok(grip) = grip.map(|grip| grip.letting_go(world)) else {
            return Err(nowhere);
        };
        let known = self
            .grips
            .iter()
            .find(|(known, _)| known.is_same_but_turned(&grip));
        if let Some((_, known)) = known {
            return known.clone();
        }
        let put = PutReach::new(world, &grip).map_err(|_| nowhere)?;
        let has_room = put.has_room();
        let tested = match has_room {
            true => put_from(&put, bases),
            false => Err(put.known_obstacle().unwrap_or(GraspObstacle::NotTried)),
        };
        drop(put);
        self.is_doubtful |= has_room && tested.is_err();
        self.grips.push((grip, tested.clone()));
        tested
    }
}

/// Whether the object can be put down from one of the base poses, and why not.
fn put_from(put: &PutReach<'_>, bases: &[Pose]) -> Result<(), GraspObstacle> {
    let part = GraspPart::Grasp;
    let mut obstacle = GraspObstacle::OutOfReach { part };
    let mut again = Vec::new();
    for base in bases.iter().filter(|base| put.is_near(base)) {
        match put.with_base_at(base, Effort::QUICK) {
            Ok(_) => return Ok(()),
            Err(GraspObstacle::OutOfReach { .. }) => {}
            Err(other) => {
                obstacle = other;
                again.push(base);
            }
        }
        if put.is_barred_everywhere() || put.postures() > MAX_POSTURES {
            break;
        }
    }
    let most = put.postures() + MAX_AGAIN;
    for base in again {
        if put.is_barred_everywhere() || put.postures() > most {
            break;
        }
        if put.with_base_at(base, Effort::PATIENT).is_ok() {
            return Ok(());
        }
    }
    Err(obstacle)
}

//! Whether a hand could put down what it holds with the base at some pose, without moving
//! anything.

use std::cell::{Cell, RefCell};
use std::f64::consts::{PI, TAU};

use nalgebra::{Translation3, Vector3};

use super::aligned_bases::AlignedBases;
use super::grasp_candidates::{TURNS, about_z};
use super::grasp_reach::{Effort, GraspReach, GraspReachFrom, Station};
use super::lone_hand::{LoneHand, Looked};
use super::overhead::{Overhead, over};
use super::shoulder::Shoulder;
use crate::motion::contact::grip_torque::Pads;
use crate::motion::contact::hand::{releasing_from, releasing_opening};
use crate::motion::failure::grasp_obstacle::{GraspObstacle, GraspPart};
use crate::robot::Side;
use crate::world::grasp_library::{GraspDefinition, Lift, NotARotation};
use crate::world::{Models, World, WorldError};
use spatial::{Pose, pose};

/// How far (m) the hand lifts and withdraws if it is not known how it has grasped the object.
const UP: [f64; 3] = [0.0, 0.0, 0.15];

/// How much farther out and up (m) a hand must also be able to be where it puts something down:
/// what it holds has moved a little in the hand, or comes to stand a little higher.
const SLACK: f64 = 0.005;

/// How a hand holds an object, as far as it matters for putting it down.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldGrip {
    /// Name of the object.
    pub object: String,
    /// The hand.
    pub side: Side,
    /// The pose of the tool in the frame of the object.
    tool_in_object: Pose,
    lift: Lift,
    /// The tool's way off the object, in the frame of the object (m).
    second_pregrasp: [f64; 3],
    pregrasp: [f64; 3],
    /// The angle (rad) by which the grasp is turned about the axis of a round object.
    turn: f64,
    is_round: bool,
    /// How far (m) the fingers are apart when they have let go of the object.
    pub opening: f64,
}

impl HeldGrip {
    /// The grip of a hand on an object of the world. `grasp` is what it was grasped by, if that is
    /// known, turned (rad) about the object's axis.
    pub fn of(
        world: &World,
        side: Side,
        object: &str,
        grasp: Option<&GraspDefinition>,
        turn: f64,
    ) -> Result<Self, WorldError> {
        let models = world.models();
        // The grasps use a tool frame of their own, ahead of the wrist.
        let arm = models.description.arm(side);
        let tool = arm.tool_for_wrist(&world.link_pose(arm.wrist));
        let kind = models.objects.get(world.object(object)?.type_name());
        Ok(Self {
            object: object.to_owned(),
            side,
            tool_in_object: world.object_pose(object)?.inv_mul(&tool),
            lift: grasp.map_or(Lift::along_object(UP), |grasp| grasp.lift),
            second_pregrasp: grasp.map_or(UP, |grasp| grasp.second_pregrasp),
            pregrasp: grasp.map_or(UP, |grasp| grasp.pregrasp),
            turn,
            is_round: kind.is_some_and(|kind| kind.is_round),
            opening: releasing_opening(world, side),
        })
    }

    /// The grip as the robot takes it to be, with the tool at the pose in the frame of the object.
    #[must_use]
    pub fn as_believed(mut self, tool_in_object: Pose) -> Self {
        self.tool_in_object = tool_in_object;
        self
    }

    /// The grip that a hand has after picking an object up by a grasp, turned (rad) about the axis of
    /// a round object. How far the fingers will be apart on it is not known: they open as far (m) to let
    /// go as to grasp.
    pub fn by(
        models: &Models,
        side: Side,
        (object, kind): (&str, &str),
        grasp: &GraspDefinition,
        turn: f64,
        opening: f64,
    ) -> Result<Self, NotARotation> {
        let axes = &models.description.arm(side).tool_axes;
        let upright = Pose::identity() * about_z(turn);
        let kind = models.objects.get(kind);
        Ok(Self {
            object: object.to_owned(),
            side,
            tool_in_object: grasp.tool_poses(&upright, axes)?.grasp,
            lift: grasp.lift,
            second_pregrasp: grasp.second_pregrasp,
            pregrasp: grasp.pregrasp,
            turn,
            is_round: kind.is_some_and(|kind| kind.is_round),
            opening,
        })
    }

    /// The grip with the fingers opened as far as they will be to let go of the object, whose shape tells how far
    /// apart they are when they hold it.
    #[must_use]
    pub fn letting_go(mut self, world: &World) -> Self {
        let gripper = &world.models().description.arm(self.side).gripper;
        let (Ok(object), Ok(at)) = (world.object(&self.object), world.object_pose(&self.object))
        else {
            return self;
        };
        let tool = at * self.tool_in_object;
        let pads = Pads::closing(gripper, object, &at, &tool, self.opening, gripper.effort);
        if let Some(gap) = pads
            .map(|pads| pads.gap())
            .filter(|gap| *gap < self.opening)
        {
            self.opening = releasing_from(gripper, gap);
        }
        self
    }

    /// Whether the hand holds the object as in another grip, but for an angle about the axis of a round object, by which
    /// it may be turned where it is put down.
    pub fn is_same_but_turned(&self, other: &Self) -> bool {
        const NEAR: (f64, f64) = (1e-6, 1e-6);
        const OPENING: f64 = 2e-3;
        let is_alike = self.object == other.object && self.side == other.side;
        if !is_alike || (self.opening - other.opening).abs() > OPENING {
            return false;
        }
        let upright = Pose::identity();
        let [own, others] = [self, other].map(|grip| grip.poses(&upright));
        self.headings().into_iter().any(|heading| {
            let turned = others.iter().map(|pose| about_z(heading) * *pose);
            own.iter().zip(turned).all(|(a, b)| {
                pose::distance_between(a, &b) < NEAR.0 && pose::angle_between(a, &b) < NEAR.1
            })
        })
    }

    /// The headings (rad, relative to the one that is wanted) at which the object may be put down,
    /// the nearest first.
    pub fn headings(&self) -> Vec<f64> {
        let count = if self.is_round { TURNS } else { 1 };
        let step = TAU / f64::from(count);
        let nearest_first = |i: i32| match i % 2 {
            0 => -step * f64::from(i / 2),
            _ => step * f64::from(i / 2 + 1),
        };
        let headings = (0..count).map(nearest_first);
        headings.map(|heading| heading.min(PI)).collect()
    }

    /// The poses of the tool for an object at a pose, in the same frame: over the place, at it, and
    /// the two on the way off the object.
    pub fn poses(&self, object: &Pose) -> [Pose; 4] {
        let turn = about_z(self.turn);
        let tool = |offset: [f64; 3]| {
            let offset = turn * Vector3::from(offset);
            object * Translation3::from(offset) * self.tool_in_object
        };
        let at = tool([0.0; 3]);
        [
            over(&at, self.lift.in_base * tool(self.lift.offset)),
            at,
            tool(self.second_pregrasp),
            tool(self.pregrasp),
        ]
    }
}

/// Tells from which base poses an object could be put down at a place.
pub struct PutReach<'w> {
    world: &'w World,
    grip: &'w HeldGrip,
    target: Pose,
    reach: GraspReach<'w>,
    shoulder: Shoulder,
    /// How far (m) the wrist is from the object.
    span: f64,
    overhead: Overhead<'w>,
    /// What keeps the hand from each heading wherever the base is, as far as that has been looked at.
    barred: RefCell<Vec<Option<GraspObstacle>>>,
    looked: Cell<Looked>,
}

impl<'w> PutReach<'w> {
    /// In a world in which the object stands at the place already, and the hand has let it go.
    pub fn new(world: &'w World, grip: &'w HeldGrip) -> Result<Self, WorldError> {
        let arm = world.models().description.arm(grip.side);
        let wrist = arm.wrist_for_tool(&grip.tool_in_object);
        let target = world.object_pose(&grip.object)?;
        Ok(Self {
            span: wrist.translation.vector.norm(),
            overhead: Overhead::of(world, &grip.object, &target)?,
            world,
            grip,
            target,
            reach: GraspReach::new(world, Some(&grip.object), true),
            shoulder: Shoulder::of(world, grip.side, true),
            barred: RefCell::new(vec![None; grip.headings().len()]),
            looked: Cell::default(),
        })
    }

    /// Whether the hand is kept from every heading wherever the base is, as far as that has been looked at.
    pub fn is_barred_everywhere(&self) -> bool {
        self.barred.borrow().iter().all(Option::is_some)
    }

    /// Whether the hand has room there at any heading, wherever the base is. For whoever then asks for a few base
    /// poses only: room for the forearm is not looked for any more, which takes longer than those.
    pub fn has_room(&self) -> bool {
        if self.looked.get() < Looked::Hand {
            self.bar_where(Looked::Hand);
        }
        self.looked.set(Looked::Forearm);
        !self.is_barred_everywhere()
    }

    /// What keeps the hand from the place at the heading that is wanted, wherever the base is, as far as that has
    /// been looked at.
    pub fn known_obstacle(&self) -> Option<GraspObstacle> {
        self.barred.borrow().first().cloned().flatten()
    }

    /// After a base pose in vain, rules the headings out at which the hand, or the forearm, has no room where
    /// the hand lets go and on its way off the object.
    fn bar_without_room(&self) {
        if let Some(next) = self.looked.get().next(self.postures()) {
            self.bar_where(next);
        }
    }

    /// Rules the headings out that have no room where it is looked for.
    fn bar_where(&self, next: Looked) {
        self.looked.set(next);
        let HeldGrip { side, opening, .. } = *self.grip;
        let object = Some(self.grip.object.as_str());
        let Some(mut hand) = LoneHand::new(self.world, side, opening, object) else {
            return;
        };
        let mut barred = self.barred.borrow_mut();
        for (heading, barred) in self.grip.headings().into_iter().zip(barred.iter_mut()) {
            if barred.is_some() {
                continue;
            }
            let poses = self.grip.poses(&(self.target * about_z(heading)));
            // With the base at the origin, the poses of the tool are those in the map. The lift is along the
            // axes of the base.
            let [_, off @ ..] = self.overhead.putting(&Pose::identity(), poses);
            let part = GraspPart::Lift;
            *barred = hand.obstacle(&off.map(|tool| Station { part, tool }), next);
        }
    }

    /// Number of postures that have been checked for collisions.
    pub fn postures(&self) -> u32 {
        self.reach.postures()
    }

    /// Whether the place may be near enough to the base at a pose in the map frame. Cheap.
    pub fn is_near(&self, base: &Pose) -> bool {
        let place = base.inverse_transform_point(&self.target.translation.vector.into());
        self.shoulder.reaches(&place.coords, self.span)
    }

    /// The base poses near one (map frame) from which the object may be put down: that one, unless the
    /// arm has to be turned towards the place.
    pub fn bases_near(&self, base: &Pose) -> Vec<Pose> {
        let mut aligned = AlignedBases::new(self.world, base);
        for heading in self.grip.headings() {
            let [_, tool, ..] = self.grip.poses(&(self.target * about_z(heading)));
            aligned.add(self.grip.side, &tool);
        }
        aligned.bases()
    }

    /// The nearest heading (rad, relative to the one that is wanted) at which the object can be put
    /// down there with the base at a pose in the map frame.
    pub fn with_base_at(&self, base: &Pose, effort: Effort) -> Result<f64, GraspObstacle> {
        self.heading_from(self.reach.with_base_at(base, effort), base)
    }

    /// As [`Self::with_base_at`], for whoever does not tell what is met: how far bodies overlap is meaningless then.
    pub(crate) fn glancing_from(&self, base: &Pose, effort: Effort) -> Result<f64, GraspObstacle> {
        self.heading_from(self.reach.glancing_from(base, effort), base)
    }

    fn heading_from(
        &self,
        mut from: GraspReachFrom<'_>,
        base: &Pose,
    ) -> Result<f64, GraspObstacle> {
        let object = base.inverse() * self.target;
        let mut nearest = None;
        for (index, heading) in self.grip.headings().into_iter().enumerate() {
            if let Some(Some(obstacle)) = self.barred.borrow().get(index) {
                nearest = Some(obstacle.clone());
                continue;
            }
            let poses = self.grip.poses(&(object * about_z(heading)));
            let poses = self.overhead.putting(base, poses);
            // Things come to stand a little farther away than planned.
            let poses = poses.into_iter().flat_map(|tool| [tool, farther(&tool)]);
            // The hand may touch the object all the time.
            let part = GraspPart::Lift;
            let stations: Vec<Station> = poses.map(|tool| Station { part, tool }).collect();
            match from.check(self.grip.side, self.grip.opening, &stations) {
                Ok(_) => return Ok(heading),
                Err(GraspObstacle::OutOfReach { part }) => {
                    nearest = nearest.or(Some(GraspObstacle::OutOfReach { part }));
                }
                Err(obstacle) => nearest = Some(obstacle),
            }
        }
        self.bar_without_room();
        let part = GraspPart::Lift;
        Err(nearest.unwrap_or(GraspObstacle::OutOfReach { part }))
    }
}

/// The pose in the frame of the base, `SLACK` further out and up.
fn farther(tool: &Pose) -> Pose {
    let at = tool.translation.vector;
    let out = Vector3::new(at.x, at.y, 0.0).try_normalize(1e-9);
    let out = out.unwrap_or_else(Vector3::zeros);
    Translation3::from((out + Vector3::z()) * SLACK) * tool
}

//! A motion that a fault strikes in its middle.

use std::rc::Rc;

use nalgebra::Vector3;

use super::{Blow, SharedInjection};
use crate::simulation::obstacle::obstacle;
use robotics::motion::Progress;
use robotics::motion::{Motion, MotionFailure, MotionStatus, PlannedTrajectory, ProcessModule};
use robotics::robot::Side;
use robotics::world::World;
use spatial::Pose;
use spatial::pose::from_xy_yaw;

/// How far ahead (m) of the base's centre the centre of an obstacle appears.
const AHEAD: f64 = 0.9;
/// Edges (m) of an obstacle.
const SIZE: [f64; 3] = [0.3, 0.3, 1.0];
/// The base moves if it has moved by this much (m) in a step.
const MOVES: f64 = 1e-5;

/// What a fault does.
#[derive(Clone, Debug)]
pub(super) enum Strike {
    /// The object falls out of the hand.
    Slip(String),
    /// The hand misses what it is to grip.
    Miss(Side),
    /// A box appears ahead of the base, until a time (s) if one is given.
    Block(Option<f64>),
    /// The motion stops.
    Stall,
}

/// A motion that a fault strikes in its middle.
pub(super) struct Faulty {
    inner: Box<dyn Motion>,
    strike: Strike,
    path: String,
    /// The share of the motion after which it strikes.
    at: f64,
    injection: SharedInjection,
    stage: Stage,
    /// Where the base was before the last step.
    base: Option<Pose>,
}

#[derive(Clone, Copy, PartialEq)]
enum Stage {
    /// The fault has not struck yet.
    Before,
    /// It has, and the motion brakes.
    Braking,
    /// It has, and the motion goes on by itself.
    After,
}

impl Faulty {
    pub(super) fn new(
        inner: Box<dyn Motion>,
        strike: Strike,
        mut blow: Blow,
        injection: SharedInjection,
    ) -> Self {
        Self {
            inner,
            strike,
            at: blow.numbers.unit(),
            path: blow.path,
            injection,
            stage: Stage::Before,
            base: None,
        }
    }

    /// The fault strikes, if it can; returns how the motion ends, if it does.
    fn strike(&mut self, world: &mut World) -> Option<MotionStatus> {
        match &self.strike {
            Strike::Slip(object) => {
                if !world.loosen(object) {
                    return None;
                }
                self.stage = Stage::After;
            }
            Strike::Miss(side) => {
                let side = *side;
                self.injection.borrow_mut().note(&self.path);
                self.inner.cancel();
                self.stage = Stage::After;
                let failure = MotionFailure::NothingGripped { side };
                return Some(MotionStatus::Failed(Box::new(failure)));
            }
            Strike::Block(until) => {
                let name = block_way(world, self.base.as_ref())?;
                if let Some(until) = until {
                    let mut injection = self.injection.borrow_mut();
                    injection.obstacles.push((name, *until));
                }
                self.stage = Stage::After;
            }
            Strike::Stall => {
                self.inner.cancel();
                self.stage = Stage::Braking;
            }
        }
        self.injection.borrow_mut().note(&self.path);
        None
    }
}

/// Puts a box in the way of the base, which was at a pose one step ago. Returns its name, if the base
/// moves and there is room.
fn block_way(world: &mut World, before: Option<&Pose>) -> Option<String> {
    let now = world.robot_configuration().base;
    let way: Vector3<f64> = now.translation.vector - before?.translation.vector;
    let length = way.xy().norm();
    if length < MOVES {
        return None;
    }
    let ahead = now.translation.vector + way * (AHEAD / length);
    let number = world.steps();
    let name = format!("OBSTACLE-{number}");
    let kind = obstacle(SIZE);
    let report = world
        .spawn_kind(&name, &kind, &from_xy_yaw(ahead.x, ahead.y, 0.0))
        .ok()?;
    if report.blocked_by.is_some() {
        // It has just been added.
        let _gone = world.remove(&name);
        return None;
    }
    Some(name)
}

impl Motion for Faulty {
    fn module(&self) -> ProcessModule {
        self.inner.module()
    }

    fn tick(&mut self, world: &mut World) -> MotionStatus {
        if self.stage == Stage::Braking {
            if self.inner.is_moving() {
                self.inner.brake(world);
                return MotionStatus::Running;
            }
            let module = self.module();
            return MotionStatus::Failed(Box::new(MotionFailure::Stalled { module }));
        }
        let is_due = matches!(self.strike, Strike::Miss(_))
            || (self.inner.is_moving() && self.inner.progress().fraction >= self.at);
        if self.stage == Stage::Before
            && is_due
            && let Some(end) = self.strike(world)
        {
            return end;
        }
        if self.stage == Stage::Braking {
            return self.tick(world);
        }
        self.base = Some(world.robot_configuration().base);
        self.inner.tick(world)
    }

    fn cancel(&mut self) {
        self.inner.cancel();
    }

    fn is_moving(&self) -> bool {
        self.inner.is_moving()
    }

    fn brake(&mut self, world: &mut World) {
        self.inner.brake(world);
    }

    fn progress(&self) -> Progress {
        self.inner.progress()
    }

    fn planned(&self) -> Option<PlannedTrajectory<'_>> {
        self.inner.planned()
    }

    /// A fault strikes once.
    fn copied(&self) -> Option<Box<dyn Motion>> {
        None
    }

    fn before_planning(&self) -> Option<Box<dyn Motion>> {
        let inner = self.inner.before_planning()?;
        Some(Box::new(Self {
            inner,
            strike: self.strike.clone(),
            path: self.path.clone(),
            at: self.at,
            injection: Rc::clone(&self.injection),
            stage: self.stage,
            base: self.base,
        }))
    }
}

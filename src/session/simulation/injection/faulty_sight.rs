//! A look whose result faults spoil.

use nalgebra::{UnitQuaternion, Vector3};

use super::{Fault, FaultKind, SharedInjection};
use robotics::motion::Progress;
use robotics::motion::{
    DetectQuery, DetectedObject, Motion, MotionFailure, MotionOutcome, MotionStatus,
    PlannedTrajectory, ProcessModule,
};
use robotics::world::World;
use spatial::Pose;
use sweep::normal_quantile;

/// A look whose result faults spoil.
pub(super) struct FaultySight {
    inner: Box<dyn Motion>,
    query: DetectQuery,
    injection: SharedInjection,
    faults: Vec<Fault>,
    /// When (s) after the plan began the look begins.
    now: f64,
}

impl FaultySight {
    pub(super) fn new(
        inner: Box<dyn Motion>,
        query: DetectQuery,
        injection: SharedInjection,
        faults: Vec<Fault>,
        now: f64,
    ) -> Self {
        Self {
            inner,
            query,
            injection,
            faults,
            now,
        }
    }

    /// What becomes of an object that is in sight; `None` if it is not seen after all.
    fn seen(&self, world: &World, mut object: DetectedObject) -> Option<DetectedObject> {
        let mut injection = self.injection.borrow_mut();
        for fault in &self.faults {
            let spoils = matches!(
                fault.kind,
                FaultKind::PerceptionMiss
                    | FaultKind::PerceptionNoise
                    | FaultKind::PerceptionConfusion
            );
            if !spoils || !fault.concerns(world, &object.name) {
                continue;
            }
            let Some(mut blow) = injection.strikes(fault, Some(&object.name), self.now) else {
                continue;
            };
            injection.note(&blow.path);
            match fault.kind {
                FaultKind::PerceptionMiss => return None,
                FaultKind::PerceptionConfusion if !self.query.types.is_empty() => return None,
                FaultKind::PerceptionConfusion => {
                    let types = world.models().objects.types();
                    let others: Vec<&str> = types
                        .map(|kind| kind.name.as_str())
                        .filter(|name| *name != object.type_name)
                        .collect();
                    // The cast rounds down.
                    let at = (blow.numbers.unit() * others.len() as f64) as usize;
                    if let Some(other) = others.get(at) {
                        object.type_name = (*other).to_owned();
                    }
                }
                _ => {
                    let mut normal = || normal_quantile(blow.numbers.unit().max(f64::MIN_POSITIVE));
                    let error = Vector3::from([(); 3].map(|()| normal() * fault.position));
                    let turn = Vector3::z() * (normal() * fault.yaw);
                    let to_base = object.pose_in_base * object.pose_in_map.inverse();
                    let moved = object.pose_in_map.translation.vector + error;
                    let turned =
                        UnitQuaternion::from_scaled_axis(turn) * object.pose_in_map.rotation;
                    object.pose_in_map = Pose::from_parts(moved.into(), turned);
                    object.pose_in_base = to_base * object.pose_in_map;
                }
            }
        }
        Some(object)
    }
}

impl Motion for FaultySight {
    fn module(&self) -> ProcessModule {
        self.inner.module()
    }

    fn tick(&mut self, world: &mut World) -> MotionStatus {
        let status = self.inner.tick(world);
        let MotionStatus::Done(MotionOutcome::Detected(objects)) = status else {
            return status;
        };
        let seen = objects.into_iter();
        let seen: Vec<DetectedObject> =
            seen.filter_map(|object| self.seen(world, object)).collect();
        if !seen.is_empty() {
            return MotionStatus::Done(MotionOutcome::Detected(seen));
        }
        MotionStatus::Failed(Box::new(MotionFailure::ObjectNotFound {
            wanted: self.query.description.clone(),
            candidates: Vec::new(),
            meant: None,
            may_err: true,
        }))
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
        // A look plans nothing.
        None
    }
}

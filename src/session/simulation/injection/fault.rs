//! One kind of fault, and when it strikes.

use super::is_named;
use robotics::world::World;

/// What goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FaultKind {
    /// A hand loses what it holds in the middle of a motion: the object falls.
    GripperSlip,
    /// The fingers close beside the object.
    GripperMisses,
    /// An object in sight is overlooked.
    PerceptionMiss,
    /// An object appears to be somewhat elsewhere.
    PerceptionNoise,
    /// An object is taken for one of another type.
    PerceptionConfusion,
    /// A box appears in the way of the base.
    NavigationBlocked,
    /// The base stops on its way.
    NavigationStopsShort,
    /// The arms stop on their way.
    ArmStuck,
    /// The torso stops on its way.
    TorsoStuck,
}

impl FaultKind {
    /// All of them.
    pub(crate) const ALL: [FaultKind; 9] = [
        Self::GripperSlip,
        Self::GripperMisses,
        Self::PerceptionMiss,
        Self::PerceptionNoise,
        Self::PerceptionConfusion,
        Self::NavigationBlocked,
        Self::NavigationStopsShort,
        Self::ArmStuck,
        Self::TorsoStuck,
    ];

    /// Its name in sweeps.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::GripperSlip => "gripper-slip",
            Self::GripperMisses => "gripper-misses",
            Self::PerceptionMiss => "perception-miss",
            Self::PerceptionNoise => "perception-noise",
            Self::PerceptionConfusion => "perception-confusion",
            Self::NavigationBlocked => "navigation-blocked",
            Self::NavigationStopsShort => "navigation-stops-short",
            Self::ArmStuck => "arm-stuck",
            Self::TorsoStuck => "torso-stuck",
        }
    }
}

/// A fault that may strike.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fault {
    /// What goes wrong.
    pub(crate) kind: FaultKind,
    /// The probability with which it strikes a motion that it could strike.
    pub(crate) probability: f64,
    /// When (s) after the plan has begun it may strike first; at any time if absent.
    pub(crate) after: Option<f64>,
    /// The meetings with an object that it strikes, counted from 1, whatever the probability; drawn if
    /// there are none.
    pub(crate) at: Vec<u64>,
    /// How long (s): from then on, or else from when it has struck.
    pub(crate) duration: Option<f64>,
    /// The object, or the type of objects, that it concerns; any if absent.
    pub(crate) of: Option<String>,
    /// Standard deviation of perceived positions (m).
    pub(crate) position: f64,
    /// Standard deviation of perceived yaw angles (rad).
    pub(crate) yaw: f64,
}

impl Fault {
    /// The fault that records name with that path: `inject.KIND.OBJECT.COUNT`, where it was about an
    /// object, or `inject.KIND.COUNT`. `None` if it is none, or its errors are not in its path.
    pub(crate) fn of_path(path: &str) -> Option<Self> {
        let (kind, rest) = path.strip_prefix("inject.")?.split_once('.')?;
        let kind = FaultKind::ALL.into_iter().find(|k| k.name() == kind)?;
        let (of, count) = match rest.rsplit_once('.') {
            Some((object, count)) => (Some(object.to_owned()), count),
            None => (None, rest),
        };
        let count: u64 = count.parse().ok()?;
        (count > 0 && kind != FaultKind::PerceptionNoise).then(|| Self {
            kind,
            probability: 0.0,
            after: None,
            duration: None,
            of,
            at: vec![count],
            position: 0.0,
            yaw: 0.0,
        })
    }

    /// Whether it concerns the object with that name.
    pub(super) fn concerns(&self, world: &World, object: &str) -> bool {
        let wanted = self.of.as_deref();
        wanted.is_none_or(|wanted| is_named(world, object, wanted))
    }
}

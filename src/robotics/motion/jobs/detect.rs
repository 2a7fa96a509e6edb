//! Looking for objects with the camera. Nothing moves.

use super::job::{Activity, DetectedObject, Job, MotionOutcome, MotionStatus, Progress};
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::perception::Sight;
use crate::world::noise::{Perceived, Sighting};
use crate::world::{Object, World};

/// Which objects are looked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DetectQuery {
    /// Name in the world; any if absent.
    pub name: Option<String>,
    /// Acceptable types of the object library; any if empty.
    pub types: Vec<String>,
    /// How failures refer to the object, for example by its designator.
    pub description: String,
}

/// Finds all objects that match the query and are seen by the camera, in the order in which
/// they were added to the world.
pub(crate) type Detect = Job<Search>;

/// A detection of objects.
#[derive(Clone, Debug)]
pub(crate) struct Search {
    query: DetectQuery,
}

impl Detect {
    /// Detects once, with the head as it is.
    pub fn new(query: DetectQuery) -> Self {
        Self::begin(Search { query })
    }
}

impl Search {
    /// Whether an object of that name is looked for, if it is taken for one of the type.
    fn matches(&self, name: &str, type_name: &str) -> bool {
        let same = |a: &String, b: &str| a.eq_ignore_ascii_case(b);
        self.query.name.as_ref().is_none_or(|n| same(n, name))
            && (self.query.types.is_empty() || self.query.types.iter().any(|t| same(t, type_name)))
    }

    /// The known type whose name is most similar to a requested type that is unknown.
    fn type_that_was_meant(&self, world: &World) -> Option<String> {
        let known = &world.models().objects;
        let [wanted] = self.query.types.as_slice() else {
            return None;
        };
        let is_known = known.get(wanted).is_some() || known.lineage(wanted).nth(1).is_some();
        let name = known.closest_name(wanted).filter(|_| !is_known)?;
        Some(name.to_owned())
    }

    fn look(&self, world: &World) -> Result<Vec<DetectedObject>, MotionFailure> {
        let base = world.robot_configuration().base;
        let sight = Sight::of_robot(world);
        let (mut seen, mut candidates) = (Vec::new(), Vec::new());
        for object in world.objects() {
            let perceived = perceived(world, &sight, object);
            let type_name = apparent_type(world, object, perceived.as_ref());
            if !self.matches(object.name(), type_name) || perceived.is_some_and(|p| p.is_missed) {
                continue;
            }
            // The names come from the world, so they exist.
            let Ok(visibility) = sight.visibility(object.name()) else {
                continue;
            };
            let Ok(pose) = world.object_pose(object.name()) else {
                continue;
            };
            let pose = perceived.map_or(pose, |perceived| perceived.pose(&pose));
            if visibility.is_seen() {
                seen.push(DetectedObject {
                    name: object.name().to_owned(),
                    type_name: type_name.to_owned(),
                    pose_in_base: base.inverse() * pose,
                    pose_in_map: world.to_belief(&pose),
                });
            }
            candidates.push(visibility);
        }
        if seen.is_empty() {
            let wanted = self.query.description.clone();
            return Err(MotionFailure::ObjectNotFound {
                wanted,
                candidates,
                meant: self.type_that_was_meant(world),
                may_err: world.noise().is_some(),
            });
        }
        Ok(seen)
    }
}

/// What the camera makes of the object if it errs.
fn perceived(world: &World, sight: &Sight<'_>, object: &Object) -> Option<Perceived> {
    let noise = world.noise()?;
    let at = world.object_pose(object.name()).ok()?;
    let camera = sight.picture().camera();
    let at = camera
        .pose
        .inverse_transform_point(&at.translation.vector.into());
    let distance = at.coords.norm();
    let sighting = Sighting {
        distance,
        cosine: at.z / distance.max(f64::EPSILON),
    };
    Some(noise.perceived(object.name(), &sighting))
}

/// The type that an object is taken for.
fn apparent_type<'w>(
    world: &'w World,
    object: &'w Object,
    perceived: Option<&Perceived>,
) -> &'w str {
    let truth = object.type_name();
    let Some(chosen) = perceived.and_then(|perceived| perceived.other_type) else {
        return truth;
    };
    let others: Vec<&str> = world
        .models()
        .objects
        .types()
        .map(|kind| kind.name.as_str())
        .filter(|name| *name != truth)
        .collect();
    // The cast rounds down.
    others
        .get((chosen * others.len() as f64) as usize)
        .copied()
        .unwrap_or(truth)
}

impl Activity for Search {
    const MODULE: ProcessModule = ProcessModule::Perception;

    fn step(&mut self, world: &mut World) -> Option<MotionStatus> {
        if let Some(noise) = world.noise_mut() {
            noise.look();
        }
        Some(match self.look(world) {
            Ok(seen) => MotionStatus::Done(MotionOutcome::Detected(seen)),
            Err(failure) => MotionStatus::failed(failure),
        })
    }

    fn progress(&self) -> Progress {
        Progress {
            what: "detecting",
            fraction: 0.0,
        }
    }
}

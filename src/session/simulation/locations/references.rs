//! What the Lisp part of a location's description has worked out: the poses of locations that it
//! refers to, and numbers.

use crate::simulation::Simulation;
use cram::pose::value::as_placement;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use spatial::Pose;

/// One entry: `(key pose-or-nil number…)`.
struct Reference {
    key: String,
    pose: Option<Pose>,
    numbers: Vec<f64>,
}

/// The entries of a list.
#[derive(Default)]
pub(super) struct References(Vec<Reference>);

impl References {
    /// Reads a list of entries; poses are transformed to the map frame.
    pub(super) fn read(
        simulation: &Simulation,
        image: &Image,
        list: &Value,
    ) -> Result<References, Box<Raise>> {
        let mut all = Vec::new();
        for entry in list.iter_list() {
            let Some(key) = entry.car_or_nil().as_symbol() else {
                continue;
            };
            let rest = entry.cdr_or_nil();
            let pose = rest.car_or_nil();
            let pose = match as_placement(&pose) {
                Some(_) => Some(simulation.pose_in_map(image, &pose)?),
                None => None,
            };
            let numbers = rest.cdr_or_nil();
            all.push(Reference {
                key: image.name(key).to_owned(),
                pose,
                numbers: numbers
                    .iter_list()
                    .filter_map(|n| number::to_f64(&n))
                    .filter(|n| n.is_finite())
                    .collect(),
            });
        }
        Ok(References(all))
    }

    fn find(&self, key: &str) -> Option<&Reference> {
        self.0.iter().find(|entry| entry.key == key)
    }

    /// The pose (map frame) of a location that a key refers to.
    pub(super) fn pose(&self, key: &str) -> Option<Pose> {
        self.find(key)?.pose
    }

    /// The numbers of a key; none if there is no such entry.
    pub(super) fn numbers(&self, key: &str) -> &[f64] {
        self.find(key).map_or(&[], |entry| &entry.numbers)
    }
}

//! Who answers the questions of somebody who types.

use super::wording::lower;
use crate::simulation::Simulation;
use cram::designator::schema;
use cram::designator::value::Class;
use lisp::image::Image;

/// Answers questions about what is being typed from an image and a world, both of which stay as
/// they are.
pub(crate) struct Assistant<'s> {
    pub(super) image: &'s Image,
    pub(super) simulation: &'s Simulation,
}

impl<'s> Assistant<'s> {
    pub(crate) fn new(image: &'s Image, simulation: &'s Simulation) -> Self {
        Self { image, simulation }
    }

    /// Whether the name is that of a type of action, motion or object.
    pub(crate) fn is_type_name(&self, name: &str) -> bool {
        let upper = name.to_uppercase();
        let mut described = [Class::Action, Class::Motion].into_iter();
        described.any(|class| schema::is_type(self.image, class, &upper))
            || self.simulation.object_types().get(&lower(name)).is_some()
    }
}

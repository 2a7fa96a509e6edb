//! Known grasps for hands whose fingers are too short for them.
//!
//! Grasps say how far the tool goes beyond the axis of what it grasps. Where the palm would be in the object
//! then, the hand is drawn back by so much that it is not, if the fingers still reach beyond the middle.

use nalgebra::{UnitQuaternion, Vector3};

use super::hand_shape::HandShape;
use crate::robot::Side;
use crate::world::Models;
use crate::world::grasp_library::{GraspDefinition, GraspLibrary};
use crate::world::object_library::ObjectType;
use crate::world::solid::{Solid, bounds_of, from_parry_vector};
use spatial::Pose;

/// Step (m) by which a hand is drawn back, number of steps, and how many more leave room to the palm.
const STEP: f64 = 0.001;
const STEPS: u32 = 40;
const ROOM: u32 = 2;
/// How far (m) beyond the middle of an object the fingers reach at least.
const BEYOND: f64 = 0.005;

/// Draws hands back from the objects in which their palms would be.
pub fn fit_grasps(library: &mut GraspLibrary, models: &Models) {
    let sides = models.description.sides();
    let hands: Vec<Hand> = sides.map(|side| Hand::new(models, side)).collect();
    library.fit(|kind, side, definition, opening| {
        let hand = hands.iter().find(|hand| hand.side == side)?;
        hand.drawn_back(models, models.objects.get(kind)?, definition, opening)
    });
}

/// What of a hand decides.
struct Hand {
    side: Side,
    palm: HandShape,
    axes: UnitQuaternion<f64>,
}

impl Hand {
    fn new(models: &Models, side: Side) -> Self {
        Self {
            side,
            palm: HandShape::palm(models, side),
            axes: models.description.arm(side).tool_axes,
        }
    }

    /// The grasp with the hand drawn back, if it has to be and can be.
    fn drawn_back(
        &self,
        models: &Models,
        kind: &ObjectType,
        definition: &GraspDefinition,
        opening: f64,
    ) -> Option<GraspDefinition> {
        let orientation = definition.orientation().ok()?;
        // In the frame of a grasp, the hand points along z.
        let (rotation, ahead) = (orientation * self.axes, orientation * Vector3::z());
        let at = |back: f64| Vector3::from(definition.translation) - ahead * back;
        let solids = Solid::all(&kind.shapes);
        let is_in = |back: f64| {
            let tool = Pose::from_parts(at(back).into(), rotation);
            self.palm.touches(&tool, &solids)
        };
        if !is_in(0.0) {
            return None;
        }
        let free = (1..=STEPS).find(|step| !is_in(f64::from(*step) * STEP))?;
        let place = at(f64::from(free + ROOM) * STEP);
        let gripper = &models.description.arm(self.side).gripper;
        let gap = gripper.gap(gripper.position_for_opening(opening));
        let bounds = bounds_of(&solids)?;
        let middle = from_parry_vector(bounds.center());
        let tip = HandShape::new(models, self.side, gap).ahead();
        let is_held = (middle - place).dot(&ahead) + BEYOND <= tip;
        is_held.then(|| GraspDefinition {
            translation: place.into(),
            ..definition.clone()
        })
    }
}

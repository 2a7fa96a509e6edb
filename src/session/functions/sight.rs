//! Builtins for what the robot knows of its own view.

use crate::simulation::Simulation;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;
use nalgebra::Point3;
use robotics::perception::Sight;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-MOBILE-PICK-PLACE-PLANS`.
pub(super) static TABLE: &[Builtin] = builtins![own_body_hides_p];

/// Does the robot's own body, a forearm for example, hide a place from the camera as the head is turned now?
/// The robot knows that from its joints.
///
/// `(progn (pp-tut:init-projection) (pp-plans::own-body-hides-p (cl-tf:make-pose-stamped "map" 0.0 (cl-tf:make-3d-vector 2 0 1) (cl-tf:make-identity-rotation))))` => `NIL`
#[builtin]
fn own_body_hides_p(simulation: &mut Simulation, image: &mut Image, pose: &Value) -> Result<bool> {
    let pose = simulation.pose_in_map(image, pose)?;
    let point = Point3::from(pose.translation.vector);
    Ok(Sight::is_behind_own_body(&simulation.world, &point))
}

//! Builtins for what the robot knows of its own view.

use crate::host::call::{done, host};
use crate::simulation::Simulation;
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use nalgebra::Point3;
use robotics::perception::Sight;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-MOBILE-PICK-PLACE-PLANS`.
pub(super) static TABLE: &[Builtin] = &[control(
    "OWN-BODY-HIDES-P",
    "pose",
    "Does the robot's own body, a forearm for example, hide a place from the camera as the head is turned now? The robot knows that from its joints.",
    &[
        "(progn (pp-tut:init-projection) (pp-plans::own-body-hides-p (cl-tf:make-pose-stamped \"map\" 0.0 (cl-tf:make-3d-vector 2 0 1) (cl-tf:make-identity-rotation)))) => NIL",
    ],
    host!(own_body_hides),
)];

fn own_body_hides(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let pose = simulation.pose_in_map(image, &args[0])?;
    let point = Point3::from(pose.translation.vector);
    done(Sight::is_behind_own_body(&simulation.world, &point))
}

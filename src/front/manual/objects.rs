//! The chapter on objects: what can be spawned, and how the robot grasps it.

use super::line;
use robotics::world::grasp_library::GraspLibrary;
use robotics::world::object_library::ObjectLibrary;

pub(crate) fn write(to: &mut String, objects: &ObjectLibrary, grasps: &GraspLibrary) {
    line(to, "\n## Objects and grasps\n");
    line(to, "| type | mass (kg) | grasps |\n|---|---|---|");
    for object in objects.types() {
        let shown: Vec<String> = grasps
            .grasps(&object.name)
            .iter()
            .map(|grasp| format!("`:{}`", grasp.to_lowercase()))
            .collect();
        let shown = if shown.is_empty() {
            "none".to_owned()
        } else {
            shown.join(", ")
        };
        line(
            to,
            &format!("| `:{}` | {} | {shown} |", object.name, object.mass),
        );
    }
}

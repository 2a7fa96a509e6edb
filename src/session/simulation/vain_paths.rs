//! Grasps to which no path has been found, as long as nothing has moved: whoever asks for one again, as for a grasp that
//! need not suit a target any more, need not search for it again.

use std::cell::RefCell;

use robotics::motion::{GraspChoice, PathSearch};
use robotics::robot::Side;
use robotics::world::grasp_library::ToolPoses;
use robotics::world::{Arrangement, World};

/// The searches in vain in the last arrangement in which there were any.
#[derive(Default)]
pub(super) struct VainPaths(RefCell<Option<(Arrangement, Vec<VainPath>)>>);

/// A search in vain.
struct VainPath {
    /// Name of the object.
    object: String,
    side: Side,
    /// The poses of the tool in the frame of the base.
    poses: ToolPoses,
    /// How wide (m) the hand opens.
    opening: f64,
    search: PathSearch,
    /// What it has reported.
    report: String,
}

impl VainPath {
    fn is_for(&self, object: &str, choice: &GraspChoice, search: PathSearch) -> bool {
        self.object == object
            && self.side == choice.side
            && self.poses == choice.poses
            && self.opening.to_bits() == choice.opening.to_bits()
            && self.search == search
    }
}

impl VainPaths {
    /// What a search has reported that found no path to a grasp of an object, if there was one and nothing has moved.
    pub(super) fn known(
        &self,
        world: &World,
        object: &str,
        choice: &GraspChoice,
        search: PathSearch,
    ) -> Option<String> {
        let noted = self.0.borrow();
        let (then, paths) = noted.as_ref()?;
        let path = paths
            .iter()
            .find(|path| path.is_for(object, choice, search))?;
        (*then == world.arrangement()).then(|| path.report.clone())
    }

    /// Notes that no path has been found.
    pub(super) fn note(
        &self,
        world: &World,
        object: &str,
        choice: &GraspChoice,
        search: PathSearch,
        report: &str,
    ) {
        let now = world.arrangement();
        let mut noted = self.0.borrow_mut();
        let paths = noted.take().filter(|(then, _)| *then == now);
        let mut paths = paths.map(|(_, paths)| paths).unwrap_or_default();
        paths.push(VainPath {
            object: object.to_owned(),
            side: choice.side,
            poses: choice.poses.clone(),
            opening: choice.opening,
            search,
            report: report.to_owned(),
        });
        *noted = Some((now, paths));
    }
}

#[cfg(test)]
mod tests {
    use super::super::starting_world;
    use super::*;
    use robotics::world::Models;
    use spatial::Pose;
    use std::sync::Arc;

    #[test]
    fn a_search_in_vain_is_remembered_until_something_moves() {
        let mut world = starting_world(&Arc::new(Models::pr2_in_kitchen().unwrap()));
        let at = Pose::identity();
        let choice = GraspChoice {
            side: Side::Left,
            grasp: "front".to_owned(),
            turn: 0.0,
            poses: ToolPoses {
                pregrasp: at,
                second_pregrasp: at,
                grasp: at,
                lift: at,
                second_lift: at,
            },
            opening: 0.08,
            torso: 0.0,
            cost: 0.0,
        };
        let paths = VainPaths::default();
        let known = |world: &World, choice: &GraspChoice, search| {
            paths.known(world, "CUP-1", choice, search)
        };
        assert_eq!(known(&world, &choice, PathSearch::Short), None);
        paths.note(&world, "CUP-1", &choice, PathSearch::Short, "none");
        let other = GraspChoice {
            side: Side::Right,
            ..choice.clone()
        };
        assert_eq!(
            known(&world, &choice, PathSearch::Short),
            Some("none".to_owned())
        );
        assert_eq!(known(&world, &choice, PathSearch::Long), None);
        assert_eq!(known(&world, &other, PathSearch::Short), None);
        let mut robot = world.robot_configuration().clone();
        robot.base.translation.x += 0.01;
        world.teleport_robot(&robot);
        assert_eq!(known(&world, &choice, PathSearch::Short), None);
    }
}

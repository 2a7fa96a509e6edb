//! What a thing has touched below it, and how hard: noted in every step for the things for which somebody
//! wants to know. So what was wiped is known from where a tool was, not from where it was to go.

use std::sync::Arc;

use nalgebra::Vector3;

use super::error::WorldError;
use super::hash::Hasher;
use super::object::Object;
use super::part_key::PartKey;
use super::scene::World;

/// Force (N) above which a thing counts as touching something.
const FORCE: f64 = 0.05;
/// How far (m) a thing moves before another patch is noted.
const MOVED: f64 = 0.002;
/// How far (m) above or below a patch a point may be that belongs to it.
const HEIGHT: f64 = 0.01;
/// Smallest area (m²) of a patch: a thing that stands on an edge wipes nothing.
const AREA: f64 = 1e-5;
/// Rounding (m) at the border of a patch.
const ROUNDING: f64 = 1e-6;

/// What a thing has touched since somebody wanted to know.
#[derive(Clone, Debug)]
pub struct Touches {
    object: String,
    /// The range of forces (N) that counts as right.
    range: (f64, f64),
    steps: u64,
    within: u64,
    sum: f64,
    peak: f64,
    aside: f64,
    now: f64,
    patches: Arc<Vec<Patch>>,
}

/// A level convex polygon in which a thing has touched another one.
#[derive(Clone, Debug, PartialEq)]
struct Patch {
    /// The key of what was touched.
    other: u64,
    /// Its corners (m, x and y in the map), counter-clockwise.
    corners: Vec<[f64; 2]>,
    /// Its height (m).
    height: f64,
}

impl Touches {
    /// Number of steps in which it has touched something.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// In how many of these steps the force was in the range.
    pub fn within(&self) -> u64 {
        self.within
    }

    /// The mean of the forces (N) while it touched something.
    pub fn mean(&self) -> f64 {
        // Exact for any number of steps that can be simulated.
        self.sum / (self.steps.max(1) as f64)
    }

    /// The greatest force (N).
    pub fn peak(&self) -> f64 {
        self.peak
    }

    /// The greatest force (N) from a side.
    pub fn aside(&self) -> f64 {
        self.aside
    }

    /// The force (N) in the last step.
    pub fn now(&self) -> f64 {
        self.now
    }

    /// Whether it has touched something at a point (m, in the map).
    pub fn has_touched(&self, point: [f64; 3]) -> bool {
        self.patches.iter().any(|patch| patch.contains(point))
    }

    pub(super) fn hash_into(&self, hasher: &mut Hasher) {
        hasher.text(&self.object);
        hasher.integer(self.steps);
        hasher.integer(self.within);
        hasher.number(self.sum);
    }
}

impl Patch {
    fn contains(&self, [x, y, z]: [f64; 3]) -> bool {
        if (z - self.height).abs() > HEIGHT {
            return false;
        }
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).all(|(a, b)| {
            let side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
            side >= -ROUNDING
        })
    }

    /// Whether a corner is farther from that of another patch than a thing moves unnoticed.
    fn differs(&self, other: &Self) -> bool {
        let mut pairs = self.corners.iter().zip(&other.corners);
        self.corners.len() != other.corners.len()
            || (self.height - other.height).abs() > MOVED
            || pairs.any(|(a, b)| (a[0] - b[0]).abs() + (a[1] - b[1]).abs() > MOVED)
    }
}

impl World {
    /// From now on, notes what the object touches below it, and in how many steps the force on it is in the
    /// range (N); forgets what it has touched before.
    pub fn watch_touches(&mut self, name: &str, range: (f64, f64)) -> Result<(), WorldError> {
        self.object(name)?;
        self.state.touches.retain(|known| known.object != name);
        self.state.touches.push(Touches {
            object: name.to_owned(),
            range,
            steps: 0,
            within: 0,
            sum: 0.0,
            peak: 0.0,
            aside: 0.0,
            now: 0.0,
            patches: Arc::default(),
        });
        Ok(())
    }

    /// Notes no more what the object touches.
    pub fn end_touches(&mut self, name: &str) {
        self.state.touches.retain(|known| known.object != name);
    }

    /// What the object has touched since that is noted; `None` if it is not.
    pub fn touches_of(&self, name: &str) -> Option<&Touches> {
        self.state.touches.iter().find(|known| known.object == name)
    }

    /// Notes what has been touched in the last step.
    pub(super) fn note_touches(&mut self) {
        let mut all = std::mem::take(&mut self.state.touches);
        all.retain(|touches| self.state.objects.contains_key(&touches.object));
        for touches in &mut all {
            if let Some(object) = self.state.objects.get(&touches.object) {
                self.note(object, touches);
            }
        }
        self.state.touches = all;
    }

    fn note(&self, object: &Object, touches: &mut Touches) {
        let mut push = Vector3::zeros();
        let mut points: Vec<(u64, Vector3<f64>)> = Vec::new();
        self.physics.visit_touch_points(object.body, |point| {
            let other = PartKey::from_code(point.other);
            if matches!(other, PartKey::Robot(_) | PartKey::Grain) {
                return;
            }
            push += point.push;
            if point.is_level {
                points.push((point.other, point.at));
            }
        });
        let up = push.z;
        touches.aside = touches.aside.max(push.xy().norm());
        touches.now = up.max(0.0);
        if up < FORCE {
            return;
        }
        touches.steps += 1;
        touches.sum += up;
        touches.peak = touches.peak.max(up);
        let (least, most) = touches.range;
        if (least..=most).contains(&up) {
            touches.within += 1;
        }
        let mut others: Vec<u64> = points.iter().map(|(other, _)| *other).collect();
        others.sort_unstable();
        others.dedup();
        for other in others {
            let of_other = points.iter().filter(|(code, _)| *code == other);
            let of_other: Vec<Vector3<f64>> = of_other.map(|(_, at)| *at).collect();
            let Some(patch) = patch_of(other, &of_other) else {
                continue;
            };
            let last = touches.patches.iter().rev().find(|p| p.other == other);
            if last.is_none_or(|last| patch.differs(last)) {
                Arc::make_mut(&mut touches.patches).push(patch);
            }
        }
    }

    /// The least and the greatest x, y and z (m) of an object in its own frame.
    pub fn own_box(&self, name: &str) -> Result<[[f64; 3]; 2], WorldError> {
        let bounds = self.object(name)?.bounds;
        Ok([bounds.mins.to_array(), bounds.maxs.to_array()])
    }
}

/// The convex hull of points, if it has an area.
fn patch_of(other: u64, points: &[Vector3<f64>]) -> Option<Patch> {
    let mut flat: Vec<[f64; 2]> = points.iter().map(|p| [p.x, p.y]).collect();
    flat.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let lower = half_hull(flat.iter().copied());
    let upper = half_hull(flat.iter().rev().copied());
    let corners: Vec<[f64; 2]> = lower.into_iter().chain(upper).collect();
    let count = points.len() as f64;
    let height = points.iter().map(|p| p.z).sum::<f64>() / count;
    let next = corners.iter().cycle().skip(1);
    let doubled: f64 = corners
        .iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
        .sum();
    (corners.len() > 2 && doubled / 2.0 > AREA).then_some(Patch {
        other,
        corners,
        height,
    })
}

/// One side of the hull of points in their order, without its last point.
fn half_hull(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut side: Vec<[f64; 2]> = Vec::new();
    for point in points {
        while let [.., a, b] = side.as_slice() {
            let turn = (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]);
            if turn > 0.0 {
                break;
            }
            side.pop();
        }
        side.push(point);
    }
    side.pop();
    side
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::world::fixture;
    use crate::world::physics::GRAVITY;
    use spatial::pose::from_xyz_rpy;

    fn patch(points: &[[f64; 3]]) -> Option<Patch> {
        let points: Vec<_> = points.iter().map(|p| Vector3::from(*p)).collect();
        patch_of(1, &points)
    }

    #[test]
    fn a_patch_is_the_hull_of_its_points() {
        let square = [
            [0.0, 0.0, 1.0],
            [0.1, 0.1, 1.0],
            [0.05, 0.05, 1.0],
            [0.1, 0.0, 1.0],
            [0.0, 0.1, 1.0],
        ];
        let patch = patch(&square).unwrap();
        assert_eq!(patch.corners.len(), 4);
        assert!(patch.contains([0.02, 0.09, 1.005]));
        assert!(!patch.contains([0.02, 0.09, 1.02]));
        assert!(!patch.contains([0.11, 0.05, 1.0]));
    }

    #[test]
    fn a_cube_touches_the_floor_where_it_has_come_to_rest() {
        let models = fixture::models();
        let robot = fixture::tucked(&models, [0.0, 0.0, 0.0], 0.1);
        let mut world = World::new(models, robot);
        let above = from_xyz_rpy([1.0, 0.5, 0.3], [0.0; 3]);
        fixture::spawn(&mut world, "BOX", "cube", &above);
        world.watch_touches("BOX", (1.5, 2.5)).unwrap();
        assert_eq!(world.touches_of("BOX").unwrap().steps(), 0);
        assert!(world.settle(3.0));
        let at = world.object_pose("BOX").unwrap().translation;
        let touches = world.touches_of("BOX").unwrap();
        assert!(touches.has_touched([at.x + 0.02, at.y - 0.02, 0.0]));
        assert!(!touches.has_touched([at.x + 0.04, at.y, 0.0]));
        assert!(!touches.has_touched([at.x, at.y, 0.05]));
        let weight = 0.2 * GRAVITY;
        assert!((touches.now() - weight).abs() < 0.05, "{}", touches.now());
        assert!(touches.peak() > weight && touches.within() <= touches.steps());
        // A copy goes on by itself, and what was noted comes back with the world.
        let before = world.snapshot();
        let steps = touches.steps();
        world.end_touches("BOX");
        assert!(world.touches_of("BOX").is_none());
        world.restore(&before);
        assert_eq!(world.touches_of("BOX").unwrap().steps(), steps);
    }

    #[test]
    fn an_edge_is_no_patch() {
        assert_eq!(patch(&[[0.0, 0.0, 1.0], [0.1, 0.0, 1.0]]), None);
        let line = [[0.0, 0.0, 1.0], [0.1, 0.0, 1.0], [0.2, 0.0, 1.0]];
        assert_eq!(patch(&line), None);
    }
}

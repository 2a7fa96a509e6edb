//! Where something could be put down: what is below it, whether it would stand level, and what
//! would be in its way. The robot does not count, since it moves.

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::{Pose as ParryPose, Vector};
use parry3d_f64::query::Ray;

use super::body_name::BodyName;
use super::error::WorldError;
use super::object::Object;
use super::part_key::{PartKey, index};
use super::scene::World;
use super::separation::{lowest_point, separation};
use super::solid::{Solid, to_parry};
use super::spawn::{Neighbour, drop_onto, first_overlap};
use crate::robot::LinkId;
use spatial::{PlacedShape, Pose, trig};

/// Height (m) above the lowest point up to which parts of a thing count as what it stands on.
const FOOT: f64 = 0.003;
/// Directions in which the foot of a thing is looked for.
const DIRECTIONS: u32 = 16;
/// How much (m) what is below the points of the foot may differ in height.
const LEVEL: f64 = 0.0015;
/// Gap (m) to everything beside it.
const GAP: f64 = 0.003;
/// Step (m) by which a search for levels goes down inside of something.
const INSIDE_STEP: f64 = 0.01;
/// How far (m) above the foot its rays begin.
const ABOVE: f64 = 0.01;
/// What stands on another thing may stick out beyond its edges if what carries it reaches at least this far (m)
/// beyond where its weight acts, on all sides.
pub(crate) const STEADY: f64 = 0.012;
/// Shares of the way from there to the edge of the foot at which it is looked for what carries it.
const INWARD: [f64; 4] = [1.0, 0.75, 0.5, 0.25];

/// Something to be put down.
pub struct Load {
    solids: Vec<Solid>,
    /// Its key if it is in the world.
    key: Option<PartKey>,
}

impl Load {
    /// A thing with shapes in its own frame, which is not in the world.
    pub fn of_shapes(shapes: &[PlacedShape]) -> Self {
        Self {
            solids: Solid::all(shapes),
            key: None,
        }
    }

    /// An object of the world.
    pub fn of_object(object: &Object) -> Self {
        Self {
            solids: object.solids.to_vec(),
            key: Some(object.key()),
        }
    }

    /// Its solids, in its own frame.
    pub(super) fn solids(&self) -> &[Solid] {
        &self.solids
    }

    /// Its key if it is in the world.
    pub(super) fn key(&self) -> Option<PartKey> {
        self.key
    }

    /// How far (m) it extends along x, y and z if it is turned like the pose.
    pub fn size(&self, turned: &Pose) -> [f64; 3] {
        let size = self.bounds(&to_parry(turned)).extents();
        size.to_array()
    }

    /// How far (m) the lowest point is below the origin if it is turned like the pose.
    pub fn depth(&self, turned: &Pose) -> f64 {
        let mut turned = *turned;
        turned.translation.vector = nalgebra::Vector3::zeros();
        let turned = to_parry(&turned);
        let lowest = self
            .solids
            .iter()
            .map(|s| lowest_point(&(turned * s.pose), s).z);
        -lowest.fold(f64::INFINITY, f64::min)
    }

    fn bounds(&self, at: &ParryPose) -> Aabb {
        let mut all = Aabb::new_invalid();
        for solid in &self.solids {
            all.merge(&solid.shape.compute_aabb(&(at * solid.pose)));
        }
        all
    }

    /// The point (m) at which its weight acts, at the pose.
    fn balance(&self, at: &ParryPose) -> Vector {
        let volume: f64 = self.solids.iter().map(|solid| solid.volume).sum();
        let moments = self.solids.iter().map(|solid| {
            let middle = solid.shape.mass_properties(1.0).local_com;
            (at * solid.pose).transform_point(middle) * (solid.volume / volume)
        });
        moments.fold(Vector::new(0.0, 0.0, 0.0), |sum, moment| sum + moment)
    }

    /// Whether something of it is at most so little above a point (m) at the height of its foot.
    fn reaches_down_to(&self, at: &ParryPose, point: &Vector) -> bool {
        let below = Vector::new(point.x, point.y, point.z - ABOVE);
        let ray = Ray::new(below, Vector::Z);
        self.solids.iter().any(|solid| {
            let pose = at * solid.pose;
            let met = solid.shape.cast_ray(&pose, &ray, ABOVE + FOOT, true);
            met.is_some()
        })
    }

    /// Whether it stands although parts of its foot stick out: what carries the others surrounds the point at
    /// which its weight acts.
    fn is_steady(
        &self,
        at: &ParryPose,
        foot: &[Vector],
        is_carried: impl Fn(&Vector) -> bool,
    ) -> bool {
        let balance = self.balance(at);
        let carried: Vec<Vector> = foot
            .iter()
            .flat_map(|point| {
                let middle = Vector::new(balance.x, balance.y, point.z);
                INWARD.map(|share| middle + (*point - middle) * share)
            })
            .filter(|point| is_carried(point) && self.reaches_down_to(at, point))
            .collect();
        (0..DIRECTIONS).all(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(DIRECTIONS);
            let (y, x) = trig::sin_cos(angle);
            let reach = |point: &Vector| (point.x - balance.x) * x + (point.y - balance.y) * y;
            carried.iter().any(|point| reach(point) >= STEADY)
        })
    }

    /// The lowest points (m) of the thing at the pose, and those almost as low around them.
    fn foot(&self, at: &ParryPose) -> Vec<Vector> {
        let lowest = |solid: &Solid| lowest_point(&(at * solid.pose), solid);
        let bottom = self.solids.iter().map(|s| lowest(s).z);
        let bottom = bottom.fold(f64::INFINITY, f64::min);
        let mut points = Vec::new();
        for solid in &self.solids {
            if lowest(solid).z > bottom + FOOT {
                continue;
            }
            points.push(lowest(solid));
            let Some(shape) = solid.shape.as_support_map() else {
                continue;
            };
            for i in 0..DIRECTIONS {
                let angle = std::f64::consts::TAU * f64::from(i) / f64::from(DIRECTIONS);
                let (y, x) = trig::sin_cos(angle);
                let point = shape.support_point(&(at * solid.pose), Vector::new(x, y, -0.1));
                if point.z <= bottom + FOOT {
                    points.push(point);
                }
            }
        }
        points
    }
}

/// Why something cannot be put down at a place.
#[derive(Clone, Debug, PartialEq)]
pub enum NoRoom {
    /// Nothing is below it, or not close enough.
    NoSupport,
    /// It would stand on something else.
    On(BodyName),
    /// It would stick out beyond an edge, or not stand level.
    Edge,
    /// Something is where it would be.
    Touches(BodyName),
    /// What it is put into could not be closed: one would meet that.
    Closing(BodyName),
}

/// What it may stand on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// Furniture.
    Furniture,
    /// The object with the key.
    Object(PartKey),
}

/// A part of the world with everything in it that something could stand on or touch.
pub struct StandingRoom<'w> {
    world: &'w World,
    around: Vec<Neighbour>,
}

impl<'w> StandingRoom<'w> {
    /// The part of the world within the limits (m) of x and y; the load is not in its own way.
    pub fn new(
        world: &'w World,
        [min, max]: [[f64; 2]; 2],
        load: Option<&Load>,
    ) -> StandingRoom<'w> {
        let bounds = Aabb::new(
            Vector::new(min[0], min[1], 0.0),
            Vector::new(max[0], max[1], 0.0),
        );
        let own = load.and_then(|load| load.key);
        let mut around = world.neighbours(own, &bounds);
        let held = |key| {
            world
                .objects()
                .any(|o| o.key() == key && o.attachment().is_some())
        };
        around.retain(|n| !matches!(n.key, PartKey::Robot(_)) && !held(n.key));
        Self { world, around }
    }

    /// Height (m) of the ground below the point (m, map frame), which lies within `below` (m), and
    /// whose it is.
    fn ground(&self, point: Vector, below: f64) -> Option<(f64, PartKey)> {
        let ray = Ray::new(point, -Vector::Z);
        let hits = self.around.iter().filter_map(|n| {
            let bounds = &n.bounds;
            let is_above = bounds.mins.x <= point.x
                && point.x <= bounds.maxs.x
                && bounds.mins.y <= point.y
                && point.y <= bounds.maxs.y;
            if !is_above {
                return None;
            }
            let way = n.solid.shape.cast_ray(&n.pose, &ray, below, true)?;
            Some((point.z - way, n.key))
        });
        hits.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The height (m) of the ground at a point (m) of the map: at most `below` (m) below the height
    /// (m), with nothing in between, and of that kind.
    pub fn point(
        &self,
        [x, y]: [f64; 2],
        height: f64,
        below: f64,
        ground: Ground,
    ) -> Result<f64, NoRoom> {
        let found = self.ground(Vector::new(x, y, height), below);
        let (top, key) = found.ok_or(NoRoom::NoSupport)?;
        if top >= height {
            // The point is inside something.
            return Err(self.touches(key));
        }
        self.check_ground(key, ground)?;
        Ok(top)
    }

    /// The heights (m) at which one of some links of the kitchen could carry something at a point (m) of the
    /// map, from above, between two heights (m).
    pub fn levels(&self, links: &[LinkId], [x, y]: [f64; 2], [top, bottom]: [f64; 2]) -> Vec<f64> {
        let is_own = |key| {
            links
                .iter()
                .any(|link| PartKey::Furniture(index(*link)) == key)
        };
        let mut levels = Vec::new();
        let mut height = top;
        while height > bottom {
            let found = self.ground(Vector::new(x, y, height), height - bottom);
            match found {
                None => break,
                // Inside something.
                Some((level, _)) if level >= height => height -= INSIDE_STEP,
                Some((level, key)) => {
                    if is_own(key) {
                        levels.push(level);
                    }
                    height = level - INSIDE_STEP;
                }
            }
        }
        levels
    }

    /// Lowers the load, from a height (m) of its lowest point, until something carries it. Returns
    /// the pose where it stands: on ground of that kind, at most `below` (m) lower, level, and free
    /// on all sides.
    pub fn stand(
        &self,
        load: &Load,
        at: &Pose,
        height: f64,
        below: f64,
        ground: Ground,
    ) -> Result<Pose, NoRoom> {
        let mut pose = *at;
        pose.translation.z = height + load.depth(at);
        let start = to_parry(&pose);
        let beneath = self.below(&load.bounds(&start));
        let (gap, key) = drop_onto(&load.solids, &start, &beneath).ok_or(NoRoom::NoSupport)?;
        self.check_ground(key, ground)?;
        if gap > below {
            return Err(NoRoom::NoSupport);
        }
        pose.translation.z -= gap;
        let place = to_parry(&pose);
        let foot = load.foot(&place);
        let bottom = height - gap;
        let is_carried = |point: &Vector| {
            let from = Vector::new(point.x, point.y, bottom + ABOVE);
            let found = self.ground(from, ABOVE + LEVEL);
            found.is_some_and(|(top, _)| (top - bottom).abs() <= LEVEL)
        };
        let stands = foot.iter().all(is_carried)
            || matches!(ground, Ground::Object(_)) && load.is_steady(&place, &foot, is_carried);
        if !stands {
            return Err(NoRoom::Edge);
        }
        self.check_free(load, &pose)?;
        Ok(pose)
    }

    /// Whether the load would be free on all sides at the pose. What is just below does not count.
    pub(crate) fn check_free(&self, load: &Load, at: &Pose) -> Result<(), NoRoom> {
        // Its own ground is as far below as the gap that everything else must keep.
        let mut raised = to_parry(at);
        raised.translation.z += GAP;
        let near = self.below(&load.bounds(&raised).loosened(GAP));
        if let Some(key) = first_overlap(&load.solids, &raised, &near) {
            return Err(self.touches(key));
        }
        for solid in &load.solids {
            let pose = raised * solid.pose;
            let objects = near.iter().filter(|n| matches!(n.key, PartKey::Object(_)));
            for other in objects {
                if separation(&pose, solid, &other.pose, &other.solid, GAP * 0.9).is_some() {
                    return Err(self.touches(other.key));
                }
            }
        }
        Ok(())
    }

    /// The first object that is nearer to the load at the pose than the gap (m), but for the ground.
    pub fn too_near(&self, load: &Load, at: &Pose, gap: f64, ground: Ground) -> Option<BodyName> {
        let at = to_parry(at);
        let objects = self.around.iter();
        let objects = objects.filter(|n| matches!(n.key, PartKey::Object(_)));
        let objects = objects.filter(|n| !matches!(ground, Ground::Object(key) if key == n.key));
        for other in objects {
            let is_near = |solid: &Solid| {
                separation(&(at * solid.pose), solid, &other.pose, &other.solid, gap).is_some()
            };
            if gap > 0.0 && load.solids.iter().any(is_near) {
                return self.world.body_name(other.key);
            }
        }
        None
    }

    /// What is within the bounds or below them.
    fn below(&self, bounds: &Aabb) -> Vec<Neighbour> {
        let mut column = *bounds;
        column.mins.z = f64::NEG_INFINITY;
        let near = self.around.iter();
        near.filter(|n| n.bounds.intersects(&column))
            .cloned()
            .collect()
    }

    fn check_ground(&self, key: PartKey, wanted: Ground) -> Result<(), NoRoom> {
        match (key, wanted) {
            (PartKey::Furniture(_), Ground::Furniture) => Ok(()),
            (key, Ground::Object(object)) if key == object => Ok(()),
            (PartKey::Floor, _) => Err(NoRoom::NoSupport),
            (PartKey::Furniture(_), Ground::Object(_)) => Err(NoRoom::Edge),
            (key, _) => {
                let name = self.world.body_name(key);
                Err(name.map_or(NoRoom::NoSupport, NoRoom::On))
            }
        }
    }

    fn touches(&self, key: PartKey) -> NoRoom {
        self.world
            .body_name(key)
            .map_or(NoRoom::NoSupport, NoRoom::Touches)
    }
}

impl World {
    /// The load that an object is.
    pub fn load(&self, name: &str) -> Result<Load, WorldError> {
        Ok(Load::of_object(self.object(name)?))
    }
}

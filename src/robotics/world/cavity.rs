//! The inner shape of vessels: what they hold, upright and tilted.
//!
//! A cavity is a stack of slices about a vertical axis, each as wide as its walls leave on average. It is
//! found from the solids alone: rays from the axis meet the walls, and the floor is where the axis enters
//! a solid. What has no wall all around, no floor, or is covered at its top has no cavity.

use parry3d_f64::query::Ray;

use super::inside::Inside;
use super::solid::{Solid, bounds_of, to_parry};
use parry3d_f64::math::Vector;
use spatial::{Pose, trig};

/// Number of slices of the height of a vessel.
const SLICES: usize = 64;
/// Number of rays in a slice.
const RAYS: usize = 32;
/// A wall farther from the axis than this (m) is none.
const FARTHEST: f64 = 1.0;
/// The lowest cavity (m) that counts.
const LOWEST: f64 = 0.004;

/// The room inside a vessel, in the vessel's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Cavity {
    /// Where its axis is (m, x and y).
    pub axis: [f64; 2],
    /// Height (m) of the rim.
    pub rim: f64,
    /// Height (m) of what the vessel stands on.
    pub foot: f64,
    /// Radius (m) of the mouth at the rim, of a disc of the same area.
    pub mouth: f64,
    /// How far (m) the rim is from the axis at least.
    pub narrowest: f64,
    /// Height (m) of a slice.
    thickness: f64,
    /// Radii (m) of the slices, the uppermost first.
    radii: Vec<f64>,
    /// How much (ml) falls out of its holes each time it is shaken; `None` for a mouth that is open.
    pub portion: Option<f64>,
    /// How far (m) the farthest part of the vessel is beyond its mouth, level.
    pub shoulder: f64,
}

impl Cavity {
    /// The cavity of solids; `None` if there is none that is open at the top.
    pub fn of(solids: &[Solid]) -> Option<Self> {
        let bounds = bounds_of(solids)?;
        let (low, high) = (bounds.mins.z, bounds.maxs.z);
        let thickness = (high - low) / SLICES as f64;
        let height_of = |slice: usize| high - (slice as f64 + 0.5) * thickness;
        // Walls may be about an axis beside the origin, and a handle shifts the middle of the bounds.
        let top = (0..SLICES).find(|slice| walls(solids, [0.0; 2], height_of(*slice)).is_some())?;
        let first = walls(solids, [0.0; 2], height_of(top))?;
        let shift = middle(&first);
        let mut radii = Vec::new();
        let mut narrowest = None;
        for slice in top..SLICES {
            let height = height_of(slice);
            if is_solid(solids, shift, height) {
                break;
            }
            // A hole in a wall ends the cavity, as the floor does; without a floor there is none.
            let walls = walls(solids, shift, height)?;
            narrowest.get_or_insert_with(|| walls.iter().copied().fold(f64::INFINITY, f64::min));
            let mean = walls.iter().map(|r| r * r).sum::<f64>() / RAYS as f64;
            radii.push(mean.sqrt());
        }
        let has_floor = top + radii.len() < SLICES;
        let mouth = *radii.first()?;
        (has_floor && radii.len() as f64 * thickness >= LOWEST).then_some(Self {
            axis: shift,
            rim: high - top as f64 * thickness,
            foot: low,
            mouth,
            narrowest: narrowest.unwrap_or(mouth),
            thickness,
            radii,
            portion: None,
            shoulder: 0.0,
        })
    }

    /// The room inside solids that are closed, behind an opening in the middle of their top. `None` if the walls leave
    /// none.
    pub fn behind(solids: &[Solid], inside: &Inside) -> Option<Self> {
        let bounds = bounds_of(solids)?;
        let (low, high) = (bounds.mins.z, bounds.maxs.z);
        let thickness = (high - low) / SLICES as f64;
        let tops: Vec<Solid> = solids
            .iter()
            .filter(|solid| {
                let one = bounds_of(std::slice::from_ref(*solid));
                one.is_some_and(|one| one.maxs.z > high - thickness)
            })
            .cloned()
            .collect();
        let middle = bounds_of(&tops)?.center();
        let axis = [middle.x, middle.y];
        let mut radii = Vec::new();
        let mut farthest = 0.0_f64;
        for slice in 0..SLICES {
            let height = high - (slice as f64 + 0.5) * thickness;
            if height < low + inside.wall {
                break;
            }
            let ends = far_sides(solids, axis, height)?;
            farthest = ends.iter().copied().fold(farthest, f64::max);
            let mean = ends.iter().map(|r| r * r).sum::<f64>() / RAYS as f64;
            let within = (mean.sqrt() - inside.wall).max(0.0);
            radii.push(match height > high - inside.wall {
                true => within.min(inside.radius),
                false => within,
            });
        }
        let mouth = radii.first()?.min(inside.radius);
        (mouth > 0.0).then_some(Self {
            axis,
            rim: high,
            foot: low,
            mouth,
            narrowest: mouth,
            thickness,
            radii,
            portion: inside.portion,
            shoulder: farthest - mouth,
        })
    }

    /// Height (m) of its floor.
    pub fn floor(&self) -> f64 {
        self.rim - self.radii.len() as f64 * self.thickness
    }

    /// How far (m) the walls are from the axis at a height (m), on average; 0 above the rim and below the floor.
    pub fn radius_at(&self, height: f64) -> f64 {
        let slice = ((self.rim - height) / self.thickness).floor();
        let radius = match slice >= 0.0 {
            true => self.radii.get(slice as usize),
            false => None,
        };
        radius.copied().unwrap_or(0.0)
    }

    /// How much (ml) it holds when it is upright.
    pub fn capacity(&self) -> f64 {
        self.volume_at(0.0)
    }

    /// How much (ml) it can hold when it is tilted by an angle (rad): what is below the plane through the
    /// lowest point of its rim.
    pub fn volume_at(&self, tilt: f64) -> f64 {
        let (sine, cosine) = trig::sin_cos(tilt.clamp(0.0, std::f64::consts::PI));
        let slices = self.radii.iter().enumerate();
        let areas = slices.map(|(i, radius)| {
            let below = (i as f64 + 0.5) * self.thickness;
            // How far the surface reaches from the far wall, to the side of the lip.
            let edge = match sine > 1e-9 {
                true => self.mouth - below * cosine / sine,
                false if cosine > 0.0 => f64::NEG_INFINITY,
                false => f64::INFINITY,
            };
            segment(*radius, edge)
        });
        areas.sum::<f64>() * self.thickness * 1e6
    }

    /// Where the lowest point of the rim is in the map, and the level direction in which it is from the
    /// axis, for a vessel at a pose; any direction if it is upright.
    pub fn lip(&self, at: &Pose) -> (nalgebra::Point3<f64>, nalgebra::Vector3<f64>) {
        let down = at.rotation.inverse() * -nalgebra::Vector3::z();
        let level = libm::hypot(down.x, down.y);
        let way = match level > 1e-9 {
            true => [down.x / level, down.y / level],
            false => [1.0, 0.0],
        };
        let [x, y] = self.axis;
        let lip = [x + self.mouth * way[0], y + self.mouth * way[1], self.rim];
        let mut out = at.rotation * nalgebra::Vector3::new(way[0], way[1], 0.0);
        out.z = 0.0;
        let length = out.norm();
        let out = match length > 1e-9 {
            true => out / length,
            false => nalgebra::Vector3::zeros(),
        };
        (at * nalgebra::Point3::from(lip), out)
    }

    /// Where the middle of its mouth is in the map, for a vessel at a pose.
    pub fn mouth_at(&self, at: &Pose) -> nalgebra::Point3<f64> {
        let [x, y] = self.axis;
        at * nalgebra::Point3::new(x, y, self.rim)
    }
}

/// The area (m²) of the part of a disc that is beyond an edge at a distance from its middle.
fn segment(radius: f64, edge: f64) -> f64 {
    let whole = std::f64::consts::PI * radius * radius;
    if edge <= -radius {
        return whole;
    }
    if edge >= radius {
        return 0.0;
    }
    let half = trig::acos(edge / radius);
    // Rounding may leave less than nothing of a sliver.
    (radius * radius * half - edge * (radius * radius - edge * edge).sqrt()).max(0.0)
}

/// Sine and cosine of the direction of a level ray.
fn direction(ray: usize) -> (f64, f64) {
    trig::sin_cos(std::f64::consts::TAU * (ray as f64 + 0.5) / RAYS as f64)
}

/// The distance (m) of the first solid in a direction of length 1; infinite if none is near.
fn first_hit(solids: &[Solid], from: Vector, along: Vector) -> f64 {
    let ray = Ray::new(from, along);
    let hits = solids
        .iter()
        .filter_map(|solid| solid.shape.cast_ray(&solid.pose, &ray, FARTHEST, true));
    hits.fold(f64::INFINITY, f64::min)
}

/// The distances (m) of the walls from a vertical axis at a height; `None` if the axis is inside a solid,
/// or not surrounded.
fn walls(solids: &[Solid], axis: [f64; 2], height: f64) -> Option<[f64; RAYS]> {
    if is_solid(solids, axis, height) {
        return None;
    }
    let mut distances = [0.0; RAYS];
    for (ray, distance) in distances.iter_mut().enumerate() {
        let (sine, cosine) = direction(ray);
        let from = Vector::new(axis[0], axis[1], height);
        *distance = first_hit(solids, from, Vector::new(cosine, sine, 0.0));
        if !distance.is_finite() {
            return None;
        }
    }
    Some(distances)
}

/// The distances (m) at which solids around a vertical axis end at a height; `None` if the axis is in none.
fn far_sides(solids: &[Solid], axis: [f64; 2], height: f64) -> Option<[f64; RAYS]> {
    if !is_solid(solids, axis, height) {
        return None;
    }
    let mut distances = [0.0; RAYS];
    for (ray, distance) in distances.iter_mut().enumerate() {
        let (sine, cosine) = direction(ray);
        // From far outside, so that parts which overlap count as one.
        let from = Vector::new(
            axis[0] + FARTHEST * cosine,
            axis[1] + FARTHEST * sine,
            height,
        );
        let met = first_hit(solids, from, Vector::new(-cosine, -sine, 0.0));
        *distance = FARTHEST - met.min(FARTHEST);
    }
    Some(distances)
}

/// The middle (m) of walls about an axis at the origin.
fn middle(walls: &[f64; RAYS]) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for (ray, distance) in walls.iter().enumerate() {
        let (sine, cosine) = direction(ray);
        sum[0] += cosine * distance;
        sum[1] += sine * distance;
    }
    sum.map(|s| s * 2.0 / RAYS as f64)
}

/// Whether a point on a vertical axis is inside a solid.
fn is_solid(solids: &[Solid], axis: [f64; 2], height: f64) -> bool {
    let point = to_parry(&Pose::translation(axis[0], axis[1], height)).translation;
    solids
        .iter()
        .any(|solid| solid.shape.contains_point(&solid.pose, point))
}

#[cfg(test)]
mod tests {
    use super::*;
    use spatial::PlacedShape;

    fn built_in(name: &str) -> Option<Cavity> {
        let models = crate::world::Models::pr2_in_kitchen().expect("it is built in");
        let kind = models.objects.get(name).expect("the type is known");
        Cavity::of(&Solid::all(&kind.shapes))
    }

    #[test]
    fn vessels_hold_what_their_walls_enclose() {
        let capacity = |name| built_in(name).map(|cavity| cavity.capacity().round());
        for (name, least, most) in [
            ("cup", 220.0, 290.0),
            ("mug", 300.0, 380.0),
            ("bowl", 400.0, 1200.0),
            ("pot", 6000.0, 7400.0),
        ] {
            let holds = capacity(name).expect("it is a vessel");
            assert!((least..most).contains(&holds), "{name} holds {holds} ml");
        }
    }

    #[test]
    fn cartons_and_bottles_hold_what_is_behind_their_opening() {
        let models = crate::world::Models::pr2_in_kitchen().expect("it is built in");
        for (name, least, most) in [
            ("milk", 1100.0, 1300.0),
            ("bottle", 450.0, 620.0),
            ("breakfast-cereal", 1500.0, 2000.0),
            ("salt-shaker", 100.0, 180.0),
        ] {
            let kind = models.objects.get(name).expect("the type is known");
            let inside = kind.inside.expect("it has one");
            let cavity = Cavity::behind(&Solid::all(&kind.shapes), &inside).expect("it has room");
            let holds = cavity.capacity();
            assert!((least..most).contains(&holds), "{name} holds {holds} ml");
            // Lying, it keeps some; upside down, nothing.
            let lying = cavity.volume_at(std::f64::consts::FRAC_PI_2);
            assert!(
                lying > 0.05 * holds && lying < 0.6 * holds,
                "{name} {lying}"
            );
            let turned = cavity.volume_at(std::f64::consts::PI);
            assert!(turned < 0.05 * holds, "{name} {turned}");
        }
    }

    #[test]
    fn closed_and_flat_things_hold_nothing() {
        for name in ["spoon", "bread", "cube", "mondamin", "sponge"] {
            assert_eq!(built_in(name), None, "{name}");
        }
    }

    #[test]
    fn a_tilted_cylinder_keeps_what_geometry_says() {
        // A thin ring of many staves around a radius of 3 cm, 10 cm high above its floor.
        let stave = spatial::Shape::Box {
            size: [0.002, 0.0075, 0.1],
        };
        let mut shapes = vec![PlacedShape {
            shape: spatial::Shape::Cylinder {
                radius: 0.031,
                length: 0.01,
            },
            pose: Pose::translation(0.0, 0.0, -0.005),
            color: None,
        }];
        shapes.extend((0..32).map(|i| {
            let turn = std::f64::consts::TAU * f64::from(i) / 32.0;
            PlacedShape {
                shape: stave.clone(),
                pose: spatial::pose::from_xyz_rpy([0.0; 3], [0.0, 0.0, turn])
                    * Pose::translation(0.031, 0.0, 0.05),
                color: None,
            }
        }));
        let cavity = Cavity::of(&Solid::all(&shapes)).expect("it is a vessel");
        let full = std::f64::consts::PI * 0.03 * 0.03 * 0.1 * 1e6;
        assert!((cavity.capacity() - full).abs() < 0.03 * full);
        // At 45 degrees, pi r2 (h - r) remain.
        let tilted = std::f64::consts::PI * 0.03 * 0.03 * 0.07 * 1e6;
        let kept = cavity.volume_at(std::f64::consts::FRAC_PI_4);
        assert!((kept - tilted).abs() < 0.03 * tilted, "{kept} {tilted}");
        let left = cavity.volume_at(std::f64::consts::FRAC_PI_2);
        assert!((0.0..1e-6).contains(&left), "{left}");
        let mut last = f64::INFINITY;
        for degree in 0..180 {
            let now = cavity.volume_at(f64::from(degree).to_radians());
            assert!(now <= last + 1e-9, "at {degree} degrees");
            last = now;
        }
    }
}

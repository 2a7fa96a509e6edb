//! Bodies defined by cross-sections: covers of robots, cartons, spoons, tubes.

use nalgebra::{Point3, Vector3};

use super::smooth::smoothed;
use super::surface::Surface;
use spatial::trig;

/// Segments in a quarter of a section's outline.
const QUARTER: u32 = 3;

/// Steps by which the end of a body is rounded.
const END_STEPS: u32 = 2;

/// Corners of a tube's section.
const TUBE: u32 = 10;

/// The axis along which sections follow each other. The first and second directions of a
/// section are the next two axes: y, z for x; z, x for y; x, y for z.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Along {
    X,
    Y,
    Z,
}

impl Along {
    fn point(self, along: f64, [u, v]: [f64; 2]) -> Point3<f64> {
        match self {
            Self::X => Point3::new(along, u, v),
            Self::Y => Point3::new(v, along, u),
            Self::Z => Point3::new(u, v, along),
        }
    }
}

/// A rectangle with rounded corners, perpendicular to the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Section {
    /// Position on the axis (m).
    pub along: f64,
    /// Its centre (m).
    pub middle: [f64; 2],
    /// Half of its edge lengths (m).
    pub half: [f64; 2],
    /// Radius of its corners (m), at most its shorter half length.
    pub round: f64,
}

/// A section centred on the axis.
pub(super) fn section(along: f64, half: [f64; 2], round: f64) -> Section {
    let middle = [0.0; 2];
    Section {
        along,
        middle,
        half,
        round,
    }
}

impl Section {
    /// The section with another centre.
    pub(super) fn at(self, middle: [f64; 2]) -> Self {
        Self { middle, ..self }
    }

    fn outline(&self) -> Vec<[f64; 2]> {
        let least = self.half[0].min(self.half[1]);
        let round = self.round.min(least);
        let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        let mut outline = Vec::with_capacity(4 * (QUARTER as usize + 1));
        for (quarter, [u, v]) in (0u32..).zip(corners) {
            for step in 0..=QUARTER {
                let turn = f64::from(quarter) + f64::from(step) / f64::from(QUARTER);
                let (s, c) = trig::sin_cos(turn * std::f64::consts::FRAC_PI_2);
                outline.push([
                    self.middle[0] + u * (self.half[0] - round) + round * c,
                    self.middle[1] + v * (self.half[1] - round) + round * s,
                ]);
            }
        }
        outline
    }

    fn inset(&self, along: f64, by: f64) -> Self {
        let half = self.half.map(|h| (h - by).max(h * 0.05));
        Self {
            along,
            half,
            round: (self.round - by).max(self.round * 0.25),
            ..*self
        }
    }
}

/// The body through the sections, which ascend along the axis, with flat ends whose edges are
/// rounded by `ends` (m) at the first and the last section.
pub(crate) fn lofted(axis: Along, sections: &[Section], ends: [f64; 2]) -> Surface {
    let (Some(first), Some(last)) = (sections.first(), sections.last()) else {
        return Surface::default();
    };
    let mut all = Vec::new();
    all.extend(rounded_end(first, ends[0], 1.0));
    if ends[0] <= 0.0 {
        all.push(*first);
    }
    let inner = sections.get(1..sections.len() - 1).unwrap_or_default();
    all.extend(inner);
    if sections.len() > 1 && ends[1] <= 0.0 {
        all.push(*last);
    }
    let mut end = rounded_end(last, ends[1], -1.0);
    end.reverse();
    all.extend(end);

    let mut points = Vec::new();
    for section in &all {
        let outline = section.outline().into_iter();
        points.extend(outline.map(|place| axis.point(section.along, place)));
    }
    let around = 4 * (QUARTER + 1);
    let ends = [first, last].map(|section| section.middle);
    let alongs = [all.first(), all.last()].map(|s| s.map_or(0.0, |s| s.along));
    for (along, middle) in alongs.into_iter().zip(ends) {
        points.push(axis.point(along, middle));
    }
    smoothed(&points, &ring_triangles(all.len() as u32, around))
}

/// The sections of a rounded end, from the outermost to the full one.
fn rounded_end(section: &Section, radius: f64, direction: f64) -> Vec<Section> {
    if radius <= 0.0 {
        return Vec::new();
    }
    let step = |step: u32| {
        let share = f64::from(step) / f64::from(END_STEPS);
        let (s, c) = trig::sin_cos(share * std::f64::consts::FRAC_PI_2);
        let along = section.along + direction * radius * (1.0 - c);
        section.inset(along, radius * (1.0 - s))
    };
    (0..=END_STEPS).map(step).collect()
}

/// The triangles of `rings` rings of `around` points each, and of the two ends, whose centres
/// are the last two points.
fn ring_triangles(rings: u32, around: u32) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    for i in 0..around {
        let j = (i + 1) % around;
        for ring in 1..rings {
            let (below, above) = ((ring - 1) * around, ring * around);
            triangles.push([below + i, below + j, above + j]);
            triangles.push([below + i, above + j, above + i]);
        }
        let (last, middle) = (rings.saturating_sub(1) * around, rings * around);
        triangles.push([j, i, middle]);
        triangles.push([last + i, last + j, middle + 1]);
    }
    triangles
}

/// A tube along points in a plane, rounded at both ends. `aside` (a unit vector) is
/// perpendicular to the plane; each point has its own radius (m).
pub(crate) fn tube(path: &[([f64; 3], f64)], aside: [f64; 3]) -> Surface {
    let aside = Vector3::from(aside);
    let point = |i: usize| path.get(i).map(|(p, _)| Vector3::from(*p));
    let mut points = Vec::new();
    for (i, (middle, radius)) in path.iter().enumerate() {
        let before = i.checked_sub(1).and_then(point);
        let after = point(i + 1);
        let middle = Vector3::from(*middle);
        let along = after.unwrap_or(middle) - before.unwrap_or(middle);
        let out = aside
            .cross(&along)
            .try_normalize(1e-12)
            .unwrap_or_else(Vector3::x);
        for step in 0..TUBE {
            let (s, c) = trig::sin_cos(std::f64::consts::TAU * f64::from(step) / f64::from(TUBE));
            points.push(Point3::from(middle + (aside * c - out * s) * *radius));
        }
    }
    for end in [path.first(), path.last()] {
        points.push(end.map_or_else(Point3::origin, |(p, _)| Point3::from(*p)));
    }
    smoothed(&points, &ring_triangles(path.len() as u32, TUBE))
}

#[cfg(test)]
mod tests {
    use crate::picture::loft::*;

    #[test]
    fn a_body_through_equal_sections_is_a_box() {
        for axis in [Along::X, Along::Y, Along::Z] {
            let sections = [
                section(-1.0, [1.0, 2.0], 0.0),
                section(2.0, [1.0, 2.0], 0.0),
            ];
            assert!((lofted(axis, &sections, [0.0; 2]).volume() - 24.0).abs() < 1e-9);
        }
    }

    #[test]
    fn round_corners_and_ends_take_a_little_away() {
        let sections = [section(0.0, [0.5, 0.5], 0.5), section(1.0, [0.5, 0.5], 0.5)];
        let cylinder = lofted(Along::X, &sections, [0.0; 2]).volume();
        assert!((cylinder / (std::f64::consts::PI / 4.0) - 1.0).abs() < 0.05);
        let pill = lofted(Along::X, &sections, [0.2; 2]).volume();
        assert!(pill < cylinder && pill > 0.8 * cylinder);
    }

    #[test]
    fn a_straight_tube_encloses_its_volume() {
        let path = [([0.0, 0.0, 0.0], 0.1), ([0.0, 0.0, 1.0], 0.1)];
        let straight = tube(&path, [0.0, 1.0, 0.0]).volume();
        assert!((straight / (std::f64::consts::PI * 0.01) - 1.0).abs() < 0.1);
    }
}

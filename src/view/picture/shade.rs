//! How much light a surface sends to the eye: a lamp with a shadow, light from the sky where
//! nothing blocks it, and a little ambient light.

use nalgebra::Vector3;

use super::facet::Facets;
use super::floor::{boards, faded};
use super::lamp::{Lamp, LampPlan};
use super::scene::{Body, Finish};
use spatial::trig;

/// Linear red, green and blue; 1 is white paper in full light.
pub(crate) type Color = [f32; 3];

/// Direction towards the lamp.
pub(crate) const LAMP: [f64; 3] = [-0.55, -0.42, 1.25];
const KEY_COLOR: Color = [0.80, 0.74, 0.65];
/// Maximum number of cells along its shadow map, for each row of the picture and in all, and the least distance
/// between them (m). About as fine as the pixels: what is finer takes time and is not seen.
const KEY_CELLS_PER_ROW: f64 = 2.1;
const KEY_CELLS: f64 = 3000.0;
const KEY_CELL: f64 = 0.0025;

/// Colours of the sky's light, of light reflected by the floor, and of ambient light.
const SKY_COLOR: Color = [0.42, 0.45, 0.50];
const BOUNCE_COLOR: Color = [0.14, 0.12, 0.10];
const REST: f32 = 0.05;
/// The same for each of the sky's lights; finer shadows would show that there are few of them.
const SKY_CELLS: f64 = 300.0;
const SKY_CELL: f64 = 0.02;

/// Rings of directions of the sky: how many, their elevation above the horizon (degrees), and
/// the azimuth of the first one (degrees).
const SKY: [(usize, f64, f64); 2] = [(5, 28.0, 20.0), (3, 62.0, 75.0)];

/// Light that is not visible beside other light.
const FAINT: f32 = 1e-4;

/// Colours of the far distance.
const HORIZON: Color = [0.62, 0.66, 0.70];
const ZENITH: Color = [0.36, 0.44, 0.55];

/// The light that reaches a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    /// Share (0..1) of the sky's light.
    open: f32,
    /// Share (0 or 1) of the lamp's light, if it is the same all around.
    key: Option<f32>,
}

impl Reach {
    /// Whether the light of the lamp is the same all around.
    pub(crate) fn is_even(&self) -> bool {
        self.key.is_some()
    }
}

/// What is known of the light on a piece of a surface before any place on it is looked at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foreknown {
    /// The light of those lights of the sky that reach all of it, or nothing.
    open: f32,
    /// The other lights of the sky, as bits.
    unsure: u32,
    /// Share (0 or 1) of the lamp's light, if it is the same everywhere.
    key: Option<f32>,
}

impl Foreknown {
    /// Whether the light is the same everywhere.
    pub(crate) fn is_all(&self) -> bool {
        self.unsure == 0 && self.key.is_some()
    }
}

/// How the light at a place makes the colour of what is there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shading {
    /// What is scattered, if the surface is white.
    light: Color,
    /// What is reflected of the lamp's light.
    shine: f32,
}

impl Shading {
    /// The light that a point (m, map frame) of the body sends to the eye; `grain` is the size (m) of
    /// a pixel there.
    pub(crate) fn color(
        &self,
        body: &Body,
        point: &Vector3<f32>,
        eye: &Vector3<f32>,
        grain: f32,
    ) -> Color {
        let shone = |albedo: Color| {
            [0, 1, 2].map(|i| albedo[i] * self.light[i] + KEY_COLOR[i] * self.shine)
        };
        match body.finish {
            Finish::Boards => mix(shone(boards(point, grain)), HORIZON, faded(point, eye)),
            _ => shone([0, 1, 2].map(|i| unit(body.color[i]))),
        }
    }
}

/// All lights of a scene.
pub(crate) struct Lights {
    key: Lamp,
    sky: Vec<Lamp>,
    /// The light of the whole sky on the floor.
    full: f32,
}

impl Lights {
    /// The plans of all lamps for a picture with this number of rows, the key lamp first.
    pub(crate) fn plans(rows: usize) -> Vec<LampPlan> {
        let mut plans = vec![LampPlan {
            towards: Vector3::from(LAMP),
            most: (KEY_CELLS_PER_ROW * rows.max(1) as f64).min(KEY_CELLS),
            least: KEY_CELL,
            is_sky: false,
        }];
        for (count, height, first) in SKY {
            let (up, out) = trig::sin_cos(height.to_radians());
            for i in 0..count {
                let turn = first + 360.0 * i as f64 / count as f64;
                let (s, c) = trig::sin_cos(turn.to_radians());
                plans.push(LampPlan {
                    towards: Vector3::new(out * c, out * s, up),
                    most: SKY_CELLS,
                    least: SKY_CELL,
                    is_sky: true,
                });
            }
        }
        plans
    }

    /// One lamp of the plans, for a picture that shows these points.
    pub(crate) fn lamp(plan: LampPlan, facets: &Facets, seen: &[Vector3<f32>]) -> Lamp {
        let blocking = match plan.is_sky {
            true => facets.large(),
            false => facets.solid(),
        };
        Lamp::new(plan, blocking, seen)
    }

    /// The lights, from the lamps of the plans in their order.
    pub(crate) fn new(lamps: Vec<Lamp>) -> Option<Self> {
        let mut lamps = lamps.into_iter();
        let key = lamps.next()?;
        let sky: Vec<_> = lamps.collect();
        let full = sky.iter().map(|lamp| lamp.towards.z).sum();
        Some(Self { key, sky, full })
    }

    /// Nothing is known.
    pub(crate) fn nothing_known(&self) -> Foreknown {
        Foreknown {
            open: 0.0,
            // There are less than 32 lights.
            unsure: (1 << self.sky.len()) - 1,
            key: None,
        }
    }

    /// What is known of the light on the flat piece of a surface with these corners and this unit
    /// normal, given what is known of a larger piece.
    pub(crate) fn foreknown(
        &self,
        corners: &[Vector3<f32>; 4],
        normal: &Vector3<f32>,
        larger: &Foreknown,
    ) -> Foreknown {
        let mut foreknown = *larger;
        foreknown.key = larger
            .key
            .or_else(|| self.key.reaches_all::<4>(corners, normal));
        for (i, lamp) in self.unsure(larger) {
            if let Some(share) = lamp.reaches_all::<2>(corners, normal) {
                foreknown.open += lamp.towards.dot(normal) * share;
                foreknown.unsure &= !(1 << i);
            }
        }
        foreknown
    }

    /// The lights of the sky whose light on a piece of a surface is not known.
    fn unsure(&self, foreknown: &Foreknown) -> impl Iterator<Item = (usize, &Lamp)> {
        let unsure = foreknown.unsure;
        let lamps = self.sky.iter().enumerate();
        lamps.filter(move |(i, _)| unsure >> i & 1 == 1)
    }

    /// The light that reaches the point with this normal and its neighbourhood of `grain` (m).
    pub(crate) fn reach(
        &self,
        foreknown: &Foreknown,
        [point, normal]: [&Vector3<f32>; 2],
        grain: f32,
    ) -> Reach {
        let mut open = foreknown.open;
        for (_, lamp) in self.unsure(foreknown) {
            let facing = lamp.towards.dot(normal);
            if facing > 0.0 {
                open += facing * lamp.reaches::<2>(point, normal);
            }
        }
        let key = foreknown.key.or_else(|| {
            (grain < 1.5 * self.key.grain())
                .then(|| self.key.reaches::<4>(point, normal))
                .filter(|key| *key == 0.0 || *key == 1.0)
        });
        let open = open / self.full;
        Reach { open, key }
    }

    /// Whether a surface reflects the lamp visibly to the eye, at a point (m, map frame) of it.
    pub(crate) fn shines(
        &self,
        finish: Finish,
        normal: &Vector3<f32>,
        view: &Vector3<f32>,
    ) -> bool {
        self.gloss(finish, normal, view) > FAINT
    }

    /// The light that the point of the body sends to the eye; `reach` is the light that reaches
    /// the point, `grain` the size (m) of a pixel there.
    pub(crate) fn shade(
        &self,
        body: &Body,
        place: [&Vector3<f32>; 2],
        eye: &Vector3<f32>,
        reach: Reach,
        grain: f32,
    ) -> Color {
        self.shading(body, place, eye, reach)
            .color(body, place[0], eye, grain)
    }

    /// How the light at a point of the body, with this normal, makes its colour.
    pub(crate) fn shading(
        &self,
        body: &Body,
        [point, normal]: [&Vector3<f32>; 2],
        eye: &Vector3<f32>,
        reach: Reach,
    ) -> Shading {
        let facing = self.key.towards.dot(normal);
        let mut lit = 0.0;
        if facing > 0.0 {
            lit = match reach.key {
                Some(lit) => lit,
                None => self.key.reaches::<3>(point, normal),
            };
        }
        let below = (1.0 - normal.z) / 2.0;
        let shine = match lit > 0.0 {
            true => lit * self.gloss(body.finish, normal, &(eye - point)),
            false => 0.0,
        };
        Shading {
            light: [0, 1, 2].map(|i| {
                KEY_COLOR[i] * facing.max(0.0) * lit
                    + SKY_COLOR[i] * reach.open
                    + BOUNCE_COLOR[i] * below
                    + REST
            }),
            shine,
        }
    }

    /// The lamp's light reflected along `view`, of any length.
    fn gloss(&self, finish: Finish, normal: &Vector3<f32>, view: &Vector3<f32>) -> f32 {
        let strength = match finish {
            Finish::Matt | Finish::Boards => return 0.0,
            Finish::Satin => 0.04,
            Finish::Gloss => 0.16,
        };
        let half = self.key.towards + view / view.norm();
        let mut power = half.dot(normal).max(0.0) / half.norm().max(1e-6);
        // Raises it to the power of 32.
        for _ in 0..5 {
            power *= power;
        }
        strength * power
    }
}

/// The colour of a direction in which nothing is visible.
pub fn background(ray: &Vector3<f64>) -> Color {
    let height = ray.z / ray.norm();
    mix(HORIZON, ZENITH, smooth((height * 1.6) as f32))
}

/// The number clamped to 0..1; 0 for NaN.
pub fn unit(value: f32) -> f32 {
    value.clamp(0.0, 1.0)
}

/// A smooth step from 0 to 1 as the value goes from 0 to 1.
pub(super) fn smooth(value: f32) -> f32 {
    let v = value.clamp(0.0, 1.0);
    v * v * (3.0 - 2.0 * v)
}

fn mix(a: Color, b: Color, share: f32) -> Color {
    [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * share)
}

//! How much light a surface sends to the eye: a lamp with a shadow, light from the sky where
//! nothing blocks it, and a little ambient light.

use nalgebra::Vector3;

use super::facet::Facets;
use super::lamp::Lamp;
use super::scene::{Body, Finish};
use crate::spatial::trig;

/// Linear red, green and blue; 1 is white paper in full light.
pub(crate) type Color = [f32; 3];

/// Direction towards the lamp.
const KEY: [f64; 3] = [-0.55, -0.42, 1.25];
const KEY_COLOR: Color = [0.80, 0.74, 0.65];
const KEY_GRID: usize = 1100;

/// Colours of the sky's light, of light reflected by the floor, and of ambient light.
const SKY_COLOR: Color = [0.42, 0.45, 0.50];
const BOUNCE_COLOR: Color = [0.14, 0.12, 0.10];
const REST: f32 = 0.05;
const SKY_GRID: usize = 320;

/// Rings of directions of the sky: how many, their elevation above the horizon (degrees), and
/// the azimuth of the first one (degrees).
const SKY: [(usize, f64, f64); 2] = [(5, 28.0, 20.0), (3, 62.0, 75.0)];

/// Colours of the floor and of the far distance.
const BOARD: Color = [0.40, 0.27, 0.165];
const HORIZON: Color = [0.62, 0.66, 0.70];
const ZENITH: Color = [0.36, 0.44, 0.55];

/// Width and length (m) of a floor board, and width of the gap between two boards.
const BOARD_WIDTH: f64 = 0.16;
const BOARD_LENGTH: f64 = 1.9;
const BOARD_GAP: f64 = 0.005;

/// Distances (m from the eye, along the floor) between which the floor fades out.
const FADE: [f64; 2] = [7.0, 22.0];

/// The light that reaches a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    /// Share (0..1) of the sky's light.
    open: f32,
    /// Share (0 or 1) of the lamp's light, if it is the same all around.
    key: Option<f32>,
}

/// All lights of a scene.
pub(crate) struct Lights {
    key: Lamp,
    sky: Vec<Lamp>,
}

impl Lights {
    /// Directions and grid sizes of all lamps, the key lamp first.
    pub(crate) fn plan() -> Vec<(Vector3<f64>, usize)> {
        let mut plan = vec![(Vector3::from(KEY), KEY_GRID)];
        for (count, height, first) in SKY {
            let (up, out) = trig::sin_cos(height.to_radians());
            for i in 0..count {
                let turn = first + 360.0 * i as f64 / count as f64;
                let (s, c) = trig::sin_cos(turn.to_radians());
                plan.push((Vector3::new(out * c, out * s, up), SKY_GRID));
            }
        }
        plan
    }

    /// One lamp of the plan.
    pub(crate) fn lamp((towards, grid): (Vector3<f64>, usize), facets: &Facets) -> Lamp {
        let facets = match grid {
            KEY_GRID => facets.solid(),
            _ => facets.large(),
        };
        Lamp::new(towards, grid, facets)
    }

    /// The lights, from the lamps of the plan in its order.
    pub(crate) fn new(lamps: Vec<Lamp>) -> Option<Self> {
        let mut lamps = lamps.into_iter();
        Some(Self {
            key: lamps.next()?,
            sky: lamps.collect(),
        })
    }

    /// The light that reaches the point with this normal and its neighbourhood of `grain` (m).
    pub(crate) fn reach(&self, point: &Vector3<f64>, normal: &Vector3<f64>, grain: f64) -> Reach {
        let (mut open, mut full) = (0.0, 0.0);
        for lamp in &self.sky {
            let facing = lamp.towards.dot(normal);
            if facing > 0.0 {
                open += facing as f32 * lamp.reaches::<2>(point, normal);
            }
            full += lamp.towards.z as f32;
        }
        let key = (grain < 1.5 * self.key.grain())
            .then(|| self.key.reaches::<4>(point, normal))
            .filter(|key| *key == 0.0 || *key == 1.0);
        let open = open / full;
        Reach { open, key }
    }

    /// The light that the point of the body sends to the eye; `reach` is the light that reaches
    /// the point, `grain` the size (m) of a pixel there.
    pub(crate) fn shade(
        &self,
        body: &Body,
        point: &Vector3<f64>,
        normal: &Vector3<f64>,
        eye: &Vector3<f64>,
        reach: Reach,
        grain: f64,
    ) -> Color {
        let view = (eye - point).normalize();
        let facing = self.key.towards.dot(normal) as f32;
        let mut lit = 0.0;
        if facing > 0.0 {
            lit = match reach.key {
                Some(lit) => lit,
                None => self.key.reaches::<3>(point, normal),
            };
        }
        let below = (1.0 - normal.z as f32) / 2.0;
        let albedo = match body.finish {
            Finish::Boards => boards(point, grain),
            _ => [0, 1, 2].map(|i| unit(body.color[i])),
        };
        let shine = lit * self.gloss(body.finish, normal, &view);
        let mut color = [0, 1, 2].map(|i| {
            let light = KEY_COLOR[i] * facing.max(0.0) * lit
                + SKY_COLOR[i] * reach.open
                + BOUNCE_COLOR[i] * below
                + REST;
            albedo[i] * light + KEY_COLOR[i] * shine
        });
        if body.finish == Finish::Boards {
            let far = (point - eye).xy().norm();
            let share = smooth((far - FADE[0]) / (FADE[1] - FADE[0])) as f32;
            color = mix(color, HORIZON, share);
        }
        color
    }

    /// The lamp's light reflected to the eye.
    fn gloss(&self, finish: Finish, normal: &Vector3<f64>, view: &Vector3<f64>) -> f32 {
        let strength = match finish {
            Finish::Matt => return 0.0,
            Finish::Boards => 0.03,
            Finish::Satin => 0.04,
            Finish::Gloss => 0.16,
        };
        let Some(half) = (self.key.towards + view).try_normalize(1e-9) else {
            return 0.0;
        };
        let mut power = half.dot(normal).max(0.0);
        // Raises it to the power of 32.
        for _ in 0..5 {
            power *= power;
        }
        strength * power as f32
    }
}

/// The colour of a direction in which nothing is visible.
pub(crate) fn background(ray: &Vector3<f64>) -> Color {
    let height = ray.z / ray.norm();
    mix(HORIZON, ZENITH, smooth(height * 1.6) as f32)
}

/// The colour of the floor, averaged where a pixel shows much of it.
fn boards(point: &Vector3<f64>, grain: f64) -> Color {
    let row = (point.y / BOARD_WIDTH).floor();
    let shift = tone(row, 0.0);
    let along = point.x / BOARD_LENGTH + shift;
    let column = along.floor();
    let inside = |value: f64, size: f64| {
        let part = value - value.floor();
        part.min(1.0 - part) * size
    };
    let seam = inside(point.y / BOARD_WIDTH, BOARD_WIDTH).min(inside(along, BOARD_LENGTH));
    let width = BOARD_GAP.max(grain);
    let dark = (1.0 - seam / width).max(0.0) * (BOARD_GAP / width) * 0.45;
    let fine = 1.0 - smooth(grain / BOARD_WIDTH * 1.5);
    let light = (1.0 + (tone(row, column + 1.0) - 0.5) * 0.28 * fine) * (1.0 - dark);
    BOARD.map(|c| c * light as f32)
}

/// A pseudo-random number in 0..1 that is always the same for a board.
fn tone(row: f64, column: f64) -> f64 {
    let mut bits = (row as i64 as u64)
        .wrapping_mul(0x9E37_79B9_7F4A_7C15)
        .wrapping_add((column as i64 as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F));
    bits ^= bits >> 29;
    bits = bits.wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits ^= bits >> 32;
    f64::from((bits & 0xFFFF) as u16) / 65535.0
}

/// The number clamped to 0..1; 0 for NaN.
pub(crate) fn unit(value: f32) -> f32 {
    value.clamp(0.0, 1.0)
}

/// A smooth step from 0 to 1 as the value goes from 0 to 1.
fn smooth(value: f64) -> f64 {
    let v = value.clamp(0.0, 1.0);
    v * v * (3.0 - 2.0 * v)
}

fn mix(a: Color, b: Color, share: f32) -> Color {
    [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * share)
}

//! Colours the pixels of a picture, of which it is known what is seen where.
//!
//! A square that shows a single flat face is coloured at once if the light on it is the same everywhere;
//! else its quarters are, down to single pixels.

use std::ops::Range;

use nalgebra::Vector3;

use super::image::Rgb;
use super::projector::{Plane, Projector, SAMPLES, Seen};
use super::scene::{Body, Finish, Scene};
use super::shade::{Color, Foreknown, Lights, Reach, Shading, background, unit};

/// Edge length (pixels) of the largest squares that are coloured at once.
pub(crate) const TILE: usize = 32;

/// Edge length (pixels) of the squares that are coloured pixel by pixel.
const MIN_TILE: usize = 8;

/// Edge length (pixels) of a square in which a surface gets the same light from the sky.
const BLOCK: usize = 2;

/// Brightness above which it grows more slowly, so that nothing is plain white.
const SHOULDER: f32 = 0.72;

/// Number of steps in the table that converts light to bytes.
const TONES: usize = 4096;

/// A square of pixels, clipped to the picture.
#[derive(Clone)]
struct Tile {
    /// Its rows in the band.
    rows: Range<usize>,
    columns: Range<usize>,
}

impl Tile {
    /// The squares of this size (pixels) in the tile.
    fn squares(&self, size: usize) -> impl Iterator<Item = Self> + use<> {
        let Self { rows, columns } = self.clone();
        rows.clone().step_by(size).flat_map(move |row| {
            let (rows, columns) = (row..(row + size).min(rows.end), columns.clone());
            columns.clone().step_by(size).map(move |column| Self {
                rows: rows.clone(),
                columns: column..(column + size).min(columns.end),
            })
        })
    }

    /// Row and column of all its pixels.
    fn pixels(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let columns = self.columns.clone();
        let row = move |row| columns.clone().map(move |column| (row, column));
        self.rows.clone().flat_map(row)
    }
}

/// A flat face that is seen on a whole tile.
struct Face<'a> {
    seen: &'a Seen,
    plane: Plane,
    body: &'a Body,
}

/// What is known of the light on a triangle within a block.
struct Known {
    /// The triangle.
    id: u32,
    reach: Reach,
    /// The light that it sends to the eye, if that is the same in the whole block.
    color: Option<Color>,
}

/// A band of rows while it is drawn.
pub(crate) struct Band<'a> {
    /// Its first row of pixels in the picture.
    pub first: usize,
    /// The faces seen at its samples, row by row.
    pub(crate) samples: &'a [u32],
    /// Its pixels, which cover the same rows.
    pub pixels: &'a mut [Rgb],
}

/// What is needed to draw a picture.
pub(crate) struct Painter<'a> {
    scene: &'a Scene,
    lights: &'a Lights,
    projector: &'a Projector,
    seen: &'a [Seen],
    /// Width of the picture (pixels).
    width: usize,
    /// Position of the eye (m, map frame).
    eye: Vector3<f32>,
    /// Size (m) of a pixel at a distance of a metre.
    per_pixel: f32,
    tones: Vec<u8>,
}

impl<'a> Painter<'a> {
    /// A painter of pictures in which the samples show the triangles.
    pub(super) fn new(
        scene: &'a Scene,
        lights: &'a Lights,
        projector: &'a Projector,
        seen: &'a [Seen],
    ) -> Self {
        Self {
            scene,
            lights,
            projector,
            seen,
            width: projector.width / SAMPLES,
            eye: projector.eye.cast(),
            per_pixel: (SAMPLES as f64 / projector.focal) as f32,
            tones: tones(),
        }
    }

    /// Colours all pixels of a band.
    pub(super) fn paint(&self, mut band: Band<'_>) {
        let whole = Tile {
            rows: 0..band.pixels.len() / self.width,
            columns: 0..self.width,
        };
        for tile in whole.squares(TILE) {
            self.paint_tile(&mut band, &tile, None);
        }
    }

    /// Colours a tile; what it shows, and what is known of the light there, if it shows a single flat
    /// face.
    fn paint_tile(&self, band: &mut Band<'_>, tile: &Tile, shown: Option<(&Face<'_>, Foreknown)>) {
        let size = tile.rows.len().max(tile.columns.len());
        let found = match shown {
            Some(_) => None,
            None => self.only_face(band, tile),
        };
        let nothing = self.lights.nothing_known();
        let shown = shown.or_else(|| found.as_ref().map(|face| (face, nothing)));
        let shown = shown.and_then(|(face, larger)| {
            let corners = self.corners(&face.plane, band, tile)?;
            let foreknown = self.lights.foreknown(&corners, &face.plane.normal, &larger);
            Some((face, foreknown, corners))
        });
        match shown {
            Some((face, foreknown, corners))
                if foreknown.is_all() && self.is_even(face, &corners) =>
            {
                self.fill(band, tile, face, &corners[0], &foreknown);
            }
            _ if size > MIN_TILE => {
                let shown = shown.map(|(face, foreknown, _)| (face, foreknown));
                for tile in tile.squares(size.div_ceil(2).next_power_of_two()) {
                    self.paint_tile(band, &tile, shown);
                }
            }
            Some((face, foreknown, _)) => self.paint_face(band, tile, face, &foreknown),
            None => self.paint_pixels(band, tile),
        }
    }

    /// The flat face that all samples of a tile show, if they show one.
    fn only_face(&self, band: &Band<'_>, tile: &Tile) -> Option<Face<'_>> {
        let width = self.projector.width;
        let columns = tile.columns.start * SAMPLES..tile.columns.end * SAMPLES;
        let rows = tile.rows.start * SAMPLES..tile.rows.end * SAMPLES;
        // Samples cover the same rows and columns as the pixels.
        let mut rows = rows.map(|row| &band.samples[row * width..][columns.clone()]);
        let id = *rows.clone().next()?.first()?;
        let seen = self.seen.get(id as usize).filter(|seen| seen.is_flat)?;
        rows.all(|row| row.iter().fold(0, |differ, other| differ | (other ^ id)) == 0)
            .then(|| Face {
                seen,
                plane: seen.plane(),
                // Every triangle belongs to a body of the scene.
                body: &self.scene.bodies[seen.body],
            })
    }

    /// The points (m, map frame) of a plane at the corners of a tile; `None` at the horizon.
    fn corners(&self, plane: &Plane, band: &Band<'_>, tile: &Tile) -> Option<[Vector3<f32>; 4]> {
        let at = |column: usize, row: usize| {
            let place = [column, band.first + row].map(|pixel| (pixel * SAMPLES) as f64);
            plane.at(place[0], place[1])
        };
        let (rows, columns) = (&tile.rows, &tile.columns);
        Some([
            at(columns.start, rows.start)?,
            at(columns.end, rows.start)?,
            at(columns.start, rows.end)?,
            at(columns.end, rows.end)?,
        ])
    }

    /// Whether a face has the same colour everywhere between points if it gets the same light.
    fn is_even(&self, face: &Face<'_>, points: &[Vector3<f32>]) -> bool {
        let (finish, normal) = (face.body.finish, &face.plane.normal);
        let shines = |point| self.lights.shines(finish, normal, &(self.eye - point));
        finish != Finish::Boards && !points.iter().any(shines)
    }

    /// Gives a tile the colour that a face has at a point.
    fn fill(
        &self,
        band: &mut Band<'_>,
        tile: &Tile,
        face: &Face<'_>,
        point: &Vector3<f32>,
        foreknown: &Foreknown,
    ) {
        let place = [point, &face.plane.normal];
        let reach = self.lights.reach(foreknown, place, 0.0);
        let light = self.lights.shade(face.body, place, &self.eye, reach, 0.0);
        let color = light.map(|light| self.byte(tone(light)));
        for row in tile.rows.clone() {
            // Tiles are within the band.
            band.pixels[row * self.width..][tile.columns.clone()].fill(color);
        }
    }

    /// Colours a tile that shows a single flat face.
    fn paint_face(&self, band: &mut Band<'_>, tile: &Tile, face: &Face<'_>, foreknown: &Foreknown) {
        let normal = &face.plane.normal;
        let is_boards = face.body.finish == Finish::Boards;
        let at = |row: usize, column: usize| {
            let x = (column * SAMPLES) as f64 + 1.0;
            let y = ((band.first + row) * SAMPLES) as f64 + 1.0;
            // Not beyond the horizon, since it is seen.
            face.plane.at(x, y).unwrap_or(face.seen.at(x, y).0)
        };
        for block in tile.squares(BLOCK) {
            let point = at(block.rows.start, block.columns.start);
            let grain = self.grain(&point);
            let reach = self.lights.reach(foreknown, [&point, normal], grain);
            let shading = |point: &Vector3<f32>| {
                self.lights
                    .shading(face.body, [point, normal], &self.eye, reach)
            };
            let color = |shading: Shading, point: &Vector3<f32>| {
                let light = shading.color(face.body, point, &self.eye, grain);
                light.map(|light| self.byte(tone(light)))
            };
            let first = shading(&point);
            let same = color(first, &point);
            for row in block.rows.clone() {
                for column in block.columns.clone() {
                    let color = match (reach.is_even(), is_boards) {
                        (true, false) => same,
                        (true, true) => color(first, &at(row, column)),
                        (false, _) => {
                            let point = at(row, column);
                            color(shading(&point), &point)
                        }
                    };
                    // Tiles are within the band.
                    band.pixels[row * self.width + column] = color;
                }
            }
        }
    }

    /// Colours a tile pixel by pixel.
    fn paint_pixels(&self, band: &mut Band<'_>, tile: &Tile) {
        let width = self.projector.width;
        let mut known = Vec::new();
        for block in tile.squares(BLOCK) {
            known.clear();
            for (row, column) in block.pixels() {
                let place = (row * width + column) * SAMPLES;
                // Samples cover the same rows and columns as the pixels.
                let four = [0, 1, width, width + 1].map(|step| band.samples[place + step]);
                let color = self.pixel(column, band.first + row, four, &mut known);
                band.pixels[row * self.width + column] = color.map(|c| self.byte(c));
            }
        }
    }

    /// Size (m) of a pixel at a point.
    fn grain(&self, point: &Vector3<f32>) -> f32 {
        (point - self.eye).norm() * self.per_pixel
    }

    /// The colour of a pixel whose samples show the triangles.
    fn pixel(&self, column: usize, row: usize, samples: [u32; 4], known: &mut Vec<Known>) -> Color {
        if samples == [samples[0]; 4] {
            let x = (column * SAMPLES) as f64 + 1.0;
            let y = (row * SAMPLES) as f64 + 1.0;
            return self.light(samples[0], x, y, known).map(tone);
        }
        let mut sum = [0.0; 3];
        let samples = self.merged(samples);
        for (i, id) in samples.iter().enumerate() {
            if samples[..i].contains(id) {
                continue;
            }
            // The position on the surface is the mean of the samples that show it.
            let (mut x, mut y, mut count) = (0.0, 0.0, 0.0);
            for (j, _) in samples.iter().enumerate().filter(|(_, s)| *s == id) {
                x += (j % SAMPLES) as f64 + 0.5;
                y += (j / SAMPLES) as f64 + 0.5;
                count += 1.0;
            }
            let x = (column * SAMPLES) as f64 + x / count;
            let y = (row * SAMPLES) as f64 + y / count;
            let color = self.light(*id, x, y, known);
            for (sum, light) in sum.iter_mut().zip(color) {
                *sum += tone(light) * (count / 4.0) as f32;
            }
        }
        sum
    }

    /// The light at a place in the grid of samples that shows the triangle, or the background.
    fn light(&self, id: u32, x: f64, y: f64, known: &mut Vec<Known>) -> Color {
        match self.seen.get(id as usize) {
            None => background(&self.projector.ray(x, y)),
            Some(seen) => self.surface(id, seen, x, y, known),
        }
    }

    /// The samples, with neighbours on a gently bent surface merged.
    fn merged(&self, mut samples: [u32; 4]) -> [u32; 4] {
        for i in 1..4 {
            // An ID that is no triangle's is not among those that are seen.
            let Some(here) = self.seen.get(samples[i] as usize) else {
                continue;
            };
            let is_near = |id: &&u32| {
                let other = self.seen.get(**id as usize);
                other.is_some_and(|other| other.continues(here))
            };
            let found = samples[..i].iter().find(is_near).copied();
            samples[i] = found.unwrap_or(samples[i]);
        }
        samples
    }

    /// The light of a triangle at a column and row of the grid of samples.
    fn surface(&self, id: u32, seen: &Seen, x: f64, y: f64, known: &mut Vec<Known>) -> Color {
        let own = known.iter().find(|known| known.id == id);
        if let Some(color) = own.and_then(|own| own.color) {
            return color;
        }
        let (point, normal) = seen.at(x, y);
        let grain = self.grain(&point);
        let continues = |known: &&Known| {
            let other = self.seen.get(known.id as usize);
            known.id == id || other.is_some_and(|other| other.continues(seen))
        };
        let reach = match known.iter().find(continues) {
            Some(known) => known.reach,
            None => self
                .lights
                .reach(&self.lights.nothing_known(), [&point, &normal], grain),
        };
        // Every triangle belongs to a body of the scene.
        let body = &self.scene.bodies[seen.body];
        let color = self
            .lights
            .shade(body, [&point, &normal], &self.eye, reach, grain);
        let is_even = seen.is_flat && reach.is_even() && body.finish != Finish::Boards;
        if own.is_none() {
            known.push(Known {
                id,
                reach,
                color: is_even.then_some(color),
            });
        }
        color
    }

    fn byte(&self, light: f32) -> u8 {
        let step = (unit(light) * (TONES - 1) as f32 + 0.5) as usize;
        // The index of a value in 0..1 is within the table.
        self.tones[step]
    }
}

/// Maps light of any strength into 0..1.
fn tone(light: f32) -> f32 {
    if light <= SHOULDER {
        return light;
    }
    let room = 1.0 - SHOULDER;
    let over = (light - SHOULDER) / room;
    SHOULDER + room * over / (1.0 + over)
}

/// The sRGB bytes for linear light in equal steps.
fn tones() -> Vec<u8> {
    (0..TONES)
        .map(|step| {
            let light = step as f64 / (TONES - 1) as f64;
            let value = match light {
                l if l <= 0.003_130_8 => 12.92 * l,
                l => 1.055 * libm::pow(l, 1.0 / 2.4) - 0.055,
            };
            (value * 255.0 + 0.5) as u8
        })
        .collect()
}

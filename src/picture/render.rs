//! Draws a scene.
//!
//! Each pixel has 2 x 2 samples, which smooths edges; a surface is shaded once for each pixel
//! that it covers. The picture is drawn in bands of rows, each by whichever thread is free: a
//! band depends only on the scene.

use std::ops::Range;
use std::sync::Mutex;
use std::thread;

use nalgebra::Vector3;

use super::facet::Facets;
use super::image::Image;
use super::projector::{Projector, SAMPLES, Seen};
use super::scene::{Finish, Scene};
use super::shade::{Color, Lights, Reach, background, unit};
use crate::perception::camera::Camera;

/// Rows of pixels in a band; a multiple of [`BLOCK`].
const BAND: usize = 16;

/// Distance (samples) between those whose points tell which shadows are seen.
const SPARSE: usize = 8;

/// Edge length (pixels) of a square in which a surface gets the same light from the sky.
const BLOCK: usize = 2;

/// Brightness above which it grows more slowly, so that nothing is plain white.
const SHOULDER: f32 = 0.72;

/// Number of steps in the table that converts light to bytes.
const TONES: usize = 4096;

/// The scene as the camera sees it. The camera's far limit is ignored.
pub(crate) fn render(scene: &Scene, camera: &Camera) -> Image {
    render_with(
        scene,
        camera,
        thread::available_parallelism().map_or(1, usize::from),
    )
}

fn render_with(scene: &Scene, camera: &Camera, threads: usize) -> Image {
    let mut image = Image::black(camera.width, camera.height);
    let facets = Facets::of(scene);
    let projector = Projector::new(camera);
    let seen = projector.project(&facets.all);
    let rows = (0..projector.height).step_by(BAND * SAMPLES);
    let bands = rows.map(|row| row..(row + BAND * SAMPLES).min(projector.height));
    let bands = in_parallel(threads, bands.collect(), |rows| {
        samples(scene, &seen, projector.width, rows)
    });
    let points = some_points(&bands, &seen, projector.width);
    let lamps = in_parallel(threads, Lights::plans(), |plan| {
        Lights::lamp(plan, &facets, &points)
    });
    let Some(lights) = Lights::new(lamps) else {
        return image;
    };
    let painter = Painter {
        scene,
        lights: &lights,
        projector: &projector,
        seen: &seen,
        tones: tones(),
    };
    let band_bytes = (camera.width * 3 * BAND).max(1);
    let bytes = image.bytes_mut().chunks_mut(band_bytes);
    let bands = bytes.zip(&bands).enumerate();
    in_parallel(threads, bands.collect(), |(i, (bytes, samples))| {
        painter.paint(i * BAND, samples, bytes);
    });
    image
}

/// Points (m, map frame) of all that is seen: those of some samples.
fn some_points(bands: &[Vec<u32>], seen: &[Seen], width: usize) -> Vec<Vector3<f32>> {
    let rows = bands.iter().flat_map(|band| band.chunks(width.max(1)));
    let rows = rows.enumerate().step_by(SPARSE);
    let samples = rows.flat_map(|(row, samples)| {
        let samples = samples.iter().enumerate().step_by(SPARSE);
        samples.map(move |(column, id)| (column, row, *id))
    });
    samples
        .filter_map(|(column, row, id)| {
            let seen = seen.get(id as usize)?;
            Some(seen.at(column as f64 + 0.5, row as f64 + 0.5).0)
        })
        .collect()
}

/// The body that each pixel shows, as an index into the scene, row by row from the top; `None`
/// for the background. The first of a pixel's samples decides.
#[cfg(test)]
pub(crate) fn segments(scene: &Scene, camera: &Camera) -> Vec<Option<usize>> {
    let projector = Projector::new(camera);
    let seen = projector.project(&Facets::of(scene).all);
    let (width, height) = (projector.width, projector.height);
    let samples = samples(scene, &seen, width, 0..height);
    let body = |id: &u32| seen.get(*id as usize).map(|seen| seen.body);
    let rows = samples.chunks(width.max(1)).step_by(SAMPLES);
    rows.flat_map(|row| row.iter().step_by(SAMPLES).map(body))
        .collect()
}

/// Applies `work` to every item, on several threads; the results are in the order of the items.
fn in_parallel<I: Send, R: Send>(
    threads: usize,
    items: Vec<I>,
    work: impl Fn(I) -> R + Sync,
) -> Vec<R> {
    let queue = Mutex::new(items.into_iter().enumerate());
    let take = || queue.lock().ok().and_then(|mut queue| queue.next());
    let run = || {
        let mut done = Vec::new();
        while let Some((place, item)) = take() {
            done.push((place, work(item)));
        }
        done
    };
    let mut done = thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(run)).collect();
        let mut done = run();
        for other in others {
            match other.join() {
                Ok(more) => done.extend(more),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        done
    });
    done.sort_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, result)| result).collect()
}

/// No triangle.
const NOTHING: u32 = u32::MAX;

/// What is known of the light on a triangle within a block.
struct Known {
    /// The triangle.
    id: u32,
    reach: Reach,
    /// The light that it sends to the eye, if that is the same in the whole block.
    color: Option<Color>,
}

/// What is needed to draw a band.
struct Painter<'a> {
    scene: &'a Scene,
    lights: &'a Lights,
    projector: &'a Projector,
    seen: &'a [Seen],
    tones: Vec<u8>,
}

impl Painter<'_> {
    /// Draws rows of pixels, from `first` on, as many as fit into `bytes`, with the triangles
    /// seen at their samples.
    fn paint(&self, first: usize, samples: &[u32], bytes: &mut [u8]) {
        let width = self.projector.width;
        let pixels = width / SAMPLES;
        let rows = bytes.len() / (pixels * 3);
        let mut known = Vec::new();
        for block_row in (0..rows).step_by(BLOCK) {
            for block_column in (0..pixels).step_by(BLOCK) {
                known.clear();
                for row in block_row..(block_row + BLOCK).min(rows) {
                    for column in block_column..(block_column + BLOCK).min(pixels) {
                        let place = row * SAMPLES * width + column * SAMPLES;
                        // Samples cover the same rows and columns as the bytes.
                        let four = [0, 1, width, width + 1].map(|step| samples[place + step]);
                        let color = self.pixel(column, first + row, four, &mut known);
                        let at = (row * pixels + column) * 3;
                        bytes[at..at + 3].copy_from_slice(&color.map(|c| self.byte(c)));
                    }
                }
            }
        }
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
        let eye = self.projector.eye.cast();
        let grain = (point - eye).norm() * SAMPLES as f32 / self.projector.focal as f32;
        let continues = |known: &&Known| {
            let other = self.seen.get(known.id as usize);
            known.id == id || other.is_some_and(|other| other.continues(seen))
        };
        let reach = match known.iter().find(continues) {
            Some(known) => known.reach,
            None => self.lights.reach(&point, &normal, grain),
        };
        // Every triangle belongs to a body of the scene.
        let body = &self.scene.bodies[seen.body];
        let color = self
            .lights
            .shade(body, [&point, &normal], &eye, reach, grain);
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

/// The nearest triangle at each sample of the rows.
fn samples(scene: &Scene, seen: &[Seen], width: usize, rows: Range<usize>) -> Vec<u32> {
    let mut nearness = vec![0f32; rows.len() * width];
    let mut nearest = vec![NOTHING; rows.len() * width];
    for (i, seen) in (0u32..).zip(seen) {
        let covered = seen.patch.rows();
        // Every triangle belongs to a body of the scene.
        let alpha = unit(scene.bodies[seen.body].color[3]);
        for row in covered.start.max(rows.start)..covered.end.min(rows.end) {
            let columns = seen.patch.columns(row, width);
            if columns.is_empty() {
                continue;
            }
            let (start, slope) = seen.patch.nearness(columns.start, row);
            let places = (row - rows.start) * width..;
            // Rows and columns were clipped to the grid by the patch.
            let nearness = &mut nearness[places.clone()][columns.clone()];
            let nearest = &mut nearest[places][columns.clone()];
            let places = nearness.iter_mut().zip(nearest).enumerate();
            if alpha == 1.0 {
                for (j, (near, who)) in places {
                    let here = start + slope * j as i32 as f32;
                    let wins = here > *near;
                    *near = if wins { here } else { *near };
                    *who = if wins { i } else { *who };
                }
            } else {
                for (j, (near, who)) in places {
                    let here = start + slope * j as i32 as f32;
                    if here > *near && shows(columns.start + j, row, alpha) {
                        (*near, *who) = (here, i);
                    }
                }
            }
        }
    }
    nearest
}

/// Whether a translucent surface is drawn at the sample: the more opaque it is, the more
/// samples of each pixel show it.
fn shows(column: usize, row: usize, alpha: f32) -> bool {
    let rank = match (column % 2, row % 2) {
        (0, 0) => 0.125,
        (1, 1) => 0.375,
        (1, 0) => 0.625,
        _ => 0.875,
    };
    rank < alpha
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

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::picture::render::*;
    use crate::picture::scene::{Body, Kind, Owner};
    use crate::picture::surface::Surface;
    use crate::spatial::Pose;

    fn ball(color: [f32; 4]) -> Scene {
        let ball = crate::spatial::Shape::Sphere { radius: 0.5 };
        Scene {
            bodies: vec![Body {
                owner: Owner::new(Kind::Object, "ball"),
                surface: Arc::new(Surface::of(&ball, 0.0)),
                pose: Pose::translation(0.0, 0.0, 2.0),
                color,
                finish: Finish::Matt,
            }],
        }
    }

    fn camera() -> Camera {
        Camera {
            pose: Pose::identity(),
            width: 33,
            height: 21,
            vertical_fov: 1.0,
            near: 0.1,
            far: 10.0,
        }
    }

    #[test]
    fn any_number_of_threads_gives_the_same_picture() {
        let scene = ball([0.5, 0.1, 0.1, 1.0]);
        let one = render_with(&scene, &camera(), 1);
        assert_eq!(one, render_with(&scene, &camera(), 3));
        assert_eq!(one, render_with(&scene, &camera(), 8));
    }

    #[test]
    fn a_half_transparent_ball_lets_half_of_the_background_through() {
        let red = |alpha| {
            let image = render(&ball([1.0, 0.0, 0.0, alpha]), &camera());
            image.pixel(16, 10).map(|p| (p[0] as i32, p[2] as i32))
        };
        let (nothing, half, full) = (red(0.0).unwrap(), red(0.5).unwrap(), red(1.0).unwrap());
        assert!(nothing.1 > half.1 && half.1 > full.1, "{half:?}");
        assert_eq!(full.1, 0);
    }

    #[test]
    fn a_picture_without_rows_is_empty() {
        let camera = Camera {
            width: 0,
            height: 0,
            ..camera()
        };
        assert!(render(&Scene::default(), &camera).bytes().is_empty());
    }
}

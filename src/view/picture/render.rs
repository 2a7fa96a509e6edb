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
use super::painter::{Band, Painter, TILE};
use super::projector::{Projector, SAMPLES, Seen};
use super::scene::Scene;
use super::shade::{Lights, unit};
use robotics::perception::camera::Camera;

/// Rows of pixels in a band.
const BAND: usize = TILE;

/// Distance (samples) between those whose points tell which shadows are seen.
const SPARSE: usize = 8;

/// The scene as the camera sees it. The camera's far limit is ignored.
pub fn render(scene: &Scene, camera: &Camera) -> Image {
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
    let seen = projector.project(facets.all());
    let rows = (0..projector.height).step_by(BAND * SAMPLES);
    let bands = rows.map(|row| row..(row + BAND * SAMPLES).min(projector.height));
    let bands = bands.zip(by_band(&seen, projector.height));
    let bands = in_parallel(threads, bands.collect(), |(rows, some)| {
        samples(scene, &some, projector.width, rows)
    });

    let points = some_points(&bands, &seen, projector.width);
    let lamps = in_parallel(threads, Lights::plans(camera.height), |plan| {
        Lights::lamp(plan, &facets, &points)
    });

    let Some(lights) = Lights::new(lamps) else {
        return image;
    };
    let painter = Painter::new(scene, &lights, &projector, &seen);
    let band_pixels = (camera.width * BAND).max(1);
    let pixels = image.bytes_mut().as_chunks_mut().0.chunks_mut(band_pixels);
    let bands = pixels.zip(&bands).enumerate();
    in_parallel(threads, bands.collect(), |(i, (pixels, samples))| {
        painter.paint(Band {
            first: i * BAND,
            samples,
            pixels,
        });
    });
    image
}

/// The triangles that each band may show, in order.
fn by_band(seen: &[Seen], height: usize) -> Vec<Vec<&Seen>> {
    let mut bands = vec![Vec::new(); height.div_ceil(BAND * SAMPLES)];
    for seen in seen {
        let rows = seen.patch.rows();
        let covered = rows.start / (BAND * SAMPLES)..rows.end.div_ceil(BAND * SAMPLES);
        // Rows were clipped to the grid by the patch.
        bands[covered].iter_mut().for_each(|band| band.push(seen));
    }
    bands
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
pub fn segments(scene: &Scene, camera: &Camera) -> Vec<Option<usize>> {
    let projector = Projector::new(camera);
    let seen = projector.project(Facets::of(scene).all());
    let (width, height) = (projector.width, projector.height);
    let samples = samples(scene, &seen.iter().collect::<Vec<_>>(), width, 0..height);
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

/// The nearest triangle at each sample of the rows.
fn samples(scene: &Scene, seen: &[&Seen], width: usize, rows: Range<usize>) -> Vec<u32> {
    let mut nearness = vec![0f32; rows.len() * width];
    let mut nearest = vec![NOTHING; rows.len() * width];
    for seen in seen {
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
                    *who = if wins { seen.face } else { *who };
                }
            } else {
                for (j, (near, who)) in places {
                    let here = start + slope * j as i32 as f32;
                    if here > *near && shows(columns.start + j, row, alpha) {
                        (*near, *who) = (here, seen.face);
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

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::picture::render::*;
    use crate::picture::scene::{Body, Finish, Kind, Owner};
    use crate::picture::surface::Surface;
    use spatial::Pose;

    fn ball(color: [f32; 4]) -> Scene {
        let ball = spatial::Shape::Sphere { radius: 0.5 };
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

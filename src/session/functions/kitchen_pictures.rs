//! A picture of several generated kitchens, side by side.

use std::sync::Arc;

use nalgebra::{Point3, Vector3};

use super::kitchens::{models_of, seed_of};
use super::picture_request::PictureRequest;
use super::pictures::publish_as;
use crate::host::SimulationHost;
use crate::simulation::starting_world;
use kitchens::{Facts, Kitchen, Settings};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use spatial::trig;
use view::picture::view::FIELD_OF_VIEW;
use view::picture::{self, Line, Looks, View, render};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The file, unless another one is named.
const FILE: &str = "planwright-kitchens.png";
/// Usual size (pixels) of each kitchen, and how many are beside each other.
const WIDTH: usize = 200;
const HEIGHT: usize = 160;
const COLUMNS: usize = 5;
/// Maximum number of kitchens in a picture, and of its pixels.
const MAX_KITCHENS: usize = 100;
const MAX_PIXELS: usize = 20_000_000;
/// From where a kitchen is seen: over its lower walls, at the left of the doorway.
const DIRECTION: [f64; 3] = [-0.5, -0.72, 0.85];
/// Height (m) of the point that is looked at.
const MIDDLE: f64 = 0.5;
/// Height (pixels) of the seeds, and their colour.
const LETTERS: usize = 16;
const INK: [u8; 3] = [40, 40, 40];
/// Colour between kitchens, and its width (pixels).
const PAPER: [u8; 3] = [255; 3];
const GAP: usize = 4;
/// Colours of the file: few, since there may be many kitchens in it.
const COLORS: usize = 48;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![kitchens_picture];

/// Draws the generated kitchens of some seeds side by side into a PNG file and returns the file's name:
/// `(kitchens-picture ["file.png"] :seeds '(0 1 2) :columns n :width n :height n)`, with the size of each in
/// pixels. The robot stands where it starts.
#[builtin]
fn kitchens_picture(
    host: &mut SimulationHost,
    image: &mut Image,
    arguments: &[Value],
) -> Result<Value> {
    let request = PictureRequest::of(image, arguments, &["SEEDS", "COLUMNS", "WIDTH", "HEIGHT"])?;
    let width = request.size(image, "WIDTH", WIDTH)?;
    let height = request.size(image, "HEIGHT", HEIGHT)?;
    let columns = match request.get("COLUMNS") {
        None => COLUMNS,
        Some(Value::Int(columns @ 1..=50)) => usize::try_from(*columns).unwrap_or(COLUMNS),
        Some(_) => {
            return Err(Raise::simple(
                "Kitchens are drawn in columns: a whole number from 1 to 50 was expected.",
            ));
        }
    };
    let seeds = request.get("SEEDS").map(Value::iter_list);
    let seeds: Vec<u64> = seeds
        .into_iter()
        .flatten()
        .map(|seed| seed_of(&seed))
        .collect::<Result<_>>()?;
    if seeds.is_empty() || seeds.len() > MAX_KITCHENS {
        return Err(Raise::simple(format!(
            "{} kitchens make no picture: a list of 1 to {MAX_KITCHENS} seeds was expected, as in (kitchens-picture \
             :seeds '(0 1 2)).",
            seeds.len()
        )));
    }
    let columns = columns.min(seeds.len());
    let rows = seeds.len().div_ceil(columns);
    let size = [columns * (width + GAP) - GAP, rows * (height + GAP) - GAP];
    if size[0] * size[1] > MAX_PIXELS {
        return Err(Raise::simple(format!(
            "A picture of {} x {} pixels is too large: at most {MAX_PIXELS} pixels were expected.",
            size[0], size[1]
        )));
    }
    let mut all = picture::Image::filled(size[0], size[1], PAPER);
    for (number, seed) in seeds.iter().enumerate() {
        if image.take_interrupt() {
            return Err(Raise::new(known::INTERACTIVE_INTERRUPT, "Interrupted."));
        }
        let kitchen = Kitchen::with(*seed, &Settings::default()).map_err(Raise::reporting)?;
        let one = picture_of(host, *seed, &kitchen, width, height)?;
        let at = [number % columns, number / columns];
        all.paste(&one, at[0] * (width + GAP), at[1] * (height + GAP));
    }
    publish_as(
        all.to_small_png(COLORS),
        &*image.files,
        &mut host.audience,
        all,
        request.file.as_deref().unwrap_or(FILE),
    )
}

/// A picture of a kitchen, with its seed.
fn picture_of(
    host: &SimulationHost,
    seed: u64,
    kitchen: &Kitchen,
    width: usize,
    height: usize,
) -> Result<picture::Image> {
    let models = Arc::new(models_of(&host.simulation, seed, kitchen)?);
    let world = starting_world(&models);
    let Facts { room, start, .. } = kitchen.facts;
    let at = Point3::new(room[0] / 2.0 - start[0], room[1] / 2.0 - start[1], MIDDLE);
    // Far enough for the room's diagonal.
    let diagonal = (room[0] * room[0] + room[1] * room[1]).sqrt();
    let (sin, cos) = trig::sin_cos(FIELD_OF_VIEW / 2.0);
    let far = 0.55 * diagonal * cos / sin;
    let view = View::Free {
        from: at + Vector3::from(DIRECTION).normalize() * far,
        at,
        vertical_fov: FIELD_OF_VIEW,
    };
    let camera = view
        .camera(&world, width, height)
        .map_err(Raise::reporting)?;
    let mut picture = render(&Looks::of(&models).scene(&world), &camera);
    let text = seed.to_string();
    let line = Line {
        text: &text,
        size: LETTERS,
        color: INK,
    };
    line.draw(&mut picture, 4, 2);
    Ok(picture)
}

//! Draws the world as plan files leave it.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use nalgebra::Point3;

use super::failure::{CommandError, Status};
use super::options::Options;
use super::outputs::Outputs;
use super::paint::Paint;
use super::run::run_in;
use lisp::visible::visible;
use session::{Filming, Session};
use view::picture::View;
use view::picture::animation::{Shot, write_gif};
use view::picture::view::FIELD_OF_VIEW;

/// What to draw, from which viewpoint, and to which file.
#[derive(Args, Debug)]
pub(crate) struct PictureArguments {
    /// Files to load, in order
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Form to evaluate after loading the files; its values are shown
    #[arg(long, value_name = "FORM")]
    eval: Vec<String>,
    /// PNG file to write, showing the final state of the world
    #[arg(short, long, value_name = "PNG", required_unless_present_any = ["gif", "frames"])]
    output: Option<PathBuf>,
    /// GIF file to write, showing the whole run
    #[arg(long, value_name = "GIF")]
    gif: Option<PathBuf>,
    /// Folder for PNG files of the whole run, one per frame
    #[arg(long, value_name = "FOLDER")]
    frames: Option<PathBuf>,
    /// Simulated time between two frames
    #[arg(long, value_name = "SECONDS", default_value_t = 0.2, value_parser = interval)]
    every: f64,
    /// Simulated seconds per second of the GIF
    #[arg(long, value_name = "FACTOR", default_value_t = 3.0, value_parser = interval)]
    speed: f64,
    /// View to draw
    #[arg(
        long,
        value_name = "NAME",
        default_value = "kitchen",
        conflicts_with_all = ["from", "at"],
        value_parser = PossibleValuesParser::new(View::NAMED.map(|view| view.name()))
            .try_map(|name| named(&name))
    )]
    view: View,
    /// Position of the eye (m, map frame)
    #[arg(long, value_name = "X,Y,Z", requires = "at", allow_hyphen_values = true, value_parser = point)]
    from: Option<Point3<f64>>,
    /// Point in the middle of the picture (m, map frame)
    #[arg(long, value_name = "X,Y,Z", requires = "from", allow_hyphen_values = true, value_parser = point)]
    at: Option<Point3<f64>>,
    /// Vertical field of view, with --from
    #[arg(long, value_name = "DEGREES", requires = "from", value_parser = angle)]
    fov: Option<f64>,
    /// Width in pixels
    #[arg(long, value_name = "N", default_value_t = 640, value_parser = size())]
    width: u16,
    /// Height in pixels
    #[arg(long, value_name = "N", default_value_t = 480, value_parser = size())]
    height: u16,
}

impl PictureArguments {
    fn view(&self) -> View {
        match (self.from, self.at) {
            (Some(from), Some(at)) => View::Free {
                from,
                at,
                vertical_fov: self.fov.map_or(FIELD_OF_VIEW, f64::to_radians),
            },
            _ => self.view,
        }
    }
}

/// Runs the files as `run` does and writes the pictures.
pub(crate) fn picture(
    options: &Options,
    wanted: &PictureArguments,
) -> Result<Status, CommandError> {
    Outputs::reading(wanted.files.iter().chain(options.files()))
        .file("--output", wanted.output.as_ref())
        .file("--gif", wanted.gif.as_ref())
        .folder("--frames", wanted.frames.as_ref())
        .check()?;
    if let Some(folder) = &wanted.frames {
        refuse_other_frames(folder)?;
    }
    let (width, height) = (wanted.width.into(), wanted.height.into());
    let view = wanted.view();
    let is_film = wanted.gif.is_some() || wanted.frames.is_some();
    let begin = |session: &mut Session| {
        if is_film {
            session.start_film(Filming {
                view,
                width,
                height,
                every: wanted.every,
            })?;
        }
        Ok(())
    };
    let (status, mut session) = run_in(options, &wanted.files, &wanted.eval, begin)?;
    let shots = session.end_film();
    if let Some(folder) = &wanted.frames {
        write_frames(folder, &shots)?;
    }
    if let Some(path) = &wanted.gif {
        let delay = (100.0 * wanted.every / wanted.speed)
            .round()
            .clamp(2.0, 1000.0);
        let mut gif = Vec::new();
        // The delay is small enough for the cast.
        write_gif(&shots, delay as u16, &mut gif)?;
        write(path, &gif)?;
    }
    if let Some(path) = &wanted.output {
        let simulation = session.simulation();
        let (picture, obstruction) = simulation.judged_picture(view, None, width, height)?;
        write(path, &picture.to_png()?)?;
        if let Some(obstruction) = obstruction {
            let paint = Paint::new(options.color, &io::stderr());
            let label = paint.bad("warning:");
            let obstruction = visible(&obstruction.to_string()).into_owned();
            writeln!(io::stderr(), "{label} {obstruction}; choose another --from")?;
        }
    }
    Ok(status)
}

/// An error if there are frames in a folder: there may be more of them than will be written.
fn refuse_other_frames(folder: &Path) -> Result<(), CommandError> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let frames = names.filter(|name| {
        let number = name
            .strip_prefix(FRAME)
            .and_then(|name| name.strip_suffix(PNG));
        number
            .is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()))
    });
    match frames.min() {
        Some(example) => Err(CommandError::OtherFrames {
            folder: folder.to_owned(),
            example,
        }),
        None => Ok(()),
    }
}

/// How the names of frames begin and end.
const FRAME: &str = "frame-";
const PNG: &str = ".png";

fn write_frames(folder: &Path, shots: &[Shot]) -> Result<(), CommandError> {
    fs::create_dir_all(folder).map_err(|error| CommandError::Rewrite {
        path: folder.to_owned(),
        error,
    })?;
    for (place, shot) in shots.iter().enumerate() {
        let path = folder.join(format!("{FRAME}{:04}{PNG}", place + 1));
        write(&path, &shot.image().to_png()?)?;
    }
    Ok(())
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), CommandError> {
    fs::write(path, bytes).map_err(|error| CommandError::Rewrite {
        path: path.to_owned(),
        error,
    })
}

fn interval(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.01..=1000.0).contains(&value) => Ok(value),
        _ => Err("expected a number from 0.01 to 1000".to_owned()),
    }
}

fn size() -> clap::builder::RangedI64ValueParser<u16> {
    clap::value_parser!(u16).range(16..=8192)
}

fn named(name: &str) -> Result<View, String> {
    let view = View::NAMED.into_iter().find(|view| view.name() == name);
    view.ok_or_else(|| format!("there is no view named {name}"))
}

fn point(text: &str) -> Result<Point3<f64>, String> {
    let wrong = || "expected three numbers separated by commas (m)".to_owned();
    let mut parts = text.split(',').map(|part| part.trim().parse::<f64>());
    match (parts.next(), parts.next(), parts.next(), parts.next()) {
        (Some(Ok(x)), Some(Ok(y)), Some(Ok(z)), None) if (x + y + z).is_finite() => {
            Ok(Point3::new(x, y, z))
        }
        _ => Err(wrong()),
    }
}

fn angle(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(degrees) if (1.0..=150.0).contains(&degrees) => Ok(degrees),
        _ => Err("expected an angle from 1 to 150 degrees".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use crate::command::picture::*;

    #[test]
    fn a_point_is_three_numbers() {
        assert_eq!(point("-1,2.5, 3"), Ok(Point3::new(-1.0, 2.5, 3.0)));
        for text in ["", "1,2", "1,2,3,4", "1,2,x", "1,2,nan", "1,2,inf"] {
            assert!(point(text).is_err(), "{text}");
        }
    }

    #[test]
    fn an_angle_is_one_that_a_picture_can_have() {
        assert_eq!(angle("50"), Ok(50.0));
        assert!(angle("0").is_err() && angle("180").is_err() && angle("nan").is_err());
    }
}

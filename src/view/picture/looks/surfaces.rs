//! The kinds of surfaces that a look may name.

use std::sync::Arc;

use indexmap::IndexMap;

use super::look::{Color, Look};
use crate::picture::loft::{Along, Section, lofted, section, tube};
use crate::picture::surface::Surface;
use closest_name::closest_name;
use robotics::sexp::{DataError, DataProblem, Node, Record};
use spatial::Pose;

/// A surface as the data says it.
#[derive(Clone, Debug)]
pub(super) enum Drawn {
    /// A surface with a shape of its own.
    Surface {
        surface: Arc<Surface>,
        /// Pose of the surface's frame in the frame of the link or object.
        at: Pose,
        /// Its colour; none for that of its bearer.
        color: Option<Color>,
    },
    /// The round vessel that rings of boxes stand for.
    Vessel,
}

/// The kinds of surfaces, each with its keys.
const SURFACES: &[(&str, &[&str])] = &[
    ("turned", &["axis", "at", "line", "color"]),
    ("disc", &["axis", "at", "span", "radius", "color"]),
    ("bar", &["axis", "at", "span", "half", "round", "color"]),
    ("lofted", &["axis", "sections", "ends", "color"]),
    ("tube", &["path", "up", "color"]),
    ("vessel", &[]),
];

/// The surface that a record describes; `colors` are those with names.
pub(super) fn surface(
    node: Node<'_>,
    colors: &IndexMap<String, Color>,
) -> Result<Drawn, DataError> {
    let record = node.record("surface", SURFACES)?;
    let (surface, at) = match record.head() {
        "turned" => {
            let line = record.required("line")?;
            turned(&record, &points(line)?)?
        }
        "disc" => {
            let radius = record.required("radius")?.positive()?;
            turned(&record, &outline_of_disc(span(&record)?, radius))?
        }
        "bar" => (bar(&record)?, Pose::identity()),
        "lofted" => {
            let sections = sections(record.required("sections")?)?;
            let ends = optional(&record, "ends")?;
            (lofted(axis(&record)?, &sections, ends), Pose::identity())
        }
        "tube" => (bent(&record)?, Pose::identity()),
        _ => return Ok(Drawn::Vessel),
    };
    let color = record.optional("color");
    Ok(Drawn::Surface {
        surface: Arc::new(surface),
        at,
        color: color.map(|node| color_of(node, colors)).transpose()?,
    })
}

/// A colour: its name, or red, green, blue and optionally alpha.
pub(crate) fn color_of(
    node: Node<'_>,
    colors: &IndexMap<String, Color>,
) -> Result<Color, DataError> {
    match node.symbol() {
        Ok(name) => colors.get(name).copied().ok_or_else(|| {
            let closest = closest_name(name, colors.keys().map(String::as_str));
            node.unknown("colour", name, closest)
        }),
        Err(_) => node.color(),
    }
}

/// The surface of revolution of a line about the record's axis, and its pose.
fn turned(record: &Record<'_>, line: &[[f64; 2]]) -> Result<(Surface, Pose), DataError> {
    let at = Look::pose_of_axis(axis(record)?, optional(record, "at")?);
    Ok((Surface::lathed(line), at))
}

/// Half of the section through a disc with bevelled edges.
fn outline_of_disc([from, to]: [f64; 2], radius: f64) -> [[f64; 2]; 6] {
    let bevel = (0.2 * (to - from)).min(0.006);
    [
        [0.0, from],
        [radius - bevel, from],
        [radius, from + bevel],
        [radius, to - bevel],
        [radius - bevel, to],
        [0.0, to],
    ]
}

/// A straight body with rounded ends.
fn bar(record: &Record<'_>) -> Result<Surface, DataError> {
    let span = span(record)?;
    let half: [f64; 2] = record.required("half")?.numbers()?;
    let round = record.required("round")?.number()?;
    let at = optional(record, "at")?;
    let ends = [
        0.012_f64,
        0.3 * (span[1] - span[0]),
        half[0] * 0.4,
        half[1] * 0.4,
    ];
    let end = ends.into_iter().fold(f64::INFINITY, f64::min);
    let sections = span.map(|place| section(place, half, round).at(at));
    Ok(lofted(axis(record)?, &sections, [end; 2]))
}

/// A round body along a path.
fn bent(record: &Record<'_>) -> Result<Surface, DataError> {
    let path = record.required("path")?;
    let place = |node: &Node<'_>| match node.list()?.as_slice() {
        [point, radius] => Ok((point.numbers()?, radius.positive()?)),
        _ => Err(node.expected("((x y z) radius)")),
    };
    let nodes = path.list()?;
    if nodes.len() < 2 {
        return Err(path.expected("at least two points"));
    }
    let places: Vec<_> = nodes.iter().map(place).collect::<Result<_, _>>()?;
    Ok(tube(&places, record.required("up")?.numbers()?))
}

fn axis(record: &Record<'_>) -> Result<Along, DataError> {
    let node = record.required("axis")?;
    match node.symbol() {
        Ok("x") => Ok(Along::X),
        Ok("y") => Ok(Along::Y),
        Ok("z") => Ok(Along::Z),
        _ => Err(node.expected("x, y or z")),
    }
}

fn span(record: &Record<'_>) -> Result<[f64; 2], DataError> {
    let node = record.required("span")?;
    match node.numbers()? {
        [from, to] if from < to => Ok([from, to]),
        _ => Err(node.expected("two numbers, the lesser first")),
    }
}

/// Two numbers, or zeros.
fn optional(record: &Record<'_>, key: &str) -> Result<[f64; 2], DataError> {
    let node = record.optional(key);
    node.map_or(Ok([0.0; 2]), |node| node.numbers())
}

fn points(node: Node<'_>) -> Result<Vec<[f64; 2]>, DataError> {
    let points = node.list()?;
    if points.len() < 2 {
        return Err(node.expected("at least two points"));
    }
    points.iter().map(Node::numbers).collect()
}

fn sections(node: Node<'_>) -> Result<Vec<Section>, DataError> {
    let sections = node.list()?;
    if sections.len() < 2 {
        return Err(node.expected("at least two sections"));
    }
    sections.iter().map(one_section).collect()
}

fn one_section(node: &Node<'_>) -> Result<Section, DataError> {
    let items = node.list()?;
    let (given, at) = match items.as_slice() {
        [given @ .., at] if given.len() == 3 => (given, at.numbers()?),
        given => (given, [0.0; 2]),
    };
    match given {
        [along, half, round] => {
            Ok(section(along.number()?, half.numbers()?, round.number()?).at(at))
        }
        _ => Err(node.error(DataProblem::Invalid(
            "a section is (along (half half) round) or (along (half half) round (at at))"
                .to_owned(),
        ))),
    }
}

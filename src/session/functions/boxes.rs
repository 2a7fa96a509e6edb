//! The boxes around bodies, and which of them are above others.

use std::rc::Rc;

use super::asking::{is_kitchen, name_of};
use crate::simulation::Simulation;
use crate::simulation::names::name_text;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use lisp::value::string::LispString;
use robotics::world::{BodyName, World};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The least and the greatest x, y and z of a box (m, map frame).
type Corners = [[f64; 3]; 2];

/// How far (m) the lower side of what is above may be below the upper side of what is under it.
const DIP: f64 = 0.005;

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static TABLE: &[Builtin] = builtins![bounding_box, all_boxes, above];

/// The box around a body in the map: the least and the greatest x, y and z (m), as two lists; NIL if it has
/// no shape. :KITCHEN and :ROBOT are given with a link, and without one stand for all of them.
///
/// `(btr::%box :kitchen "no_such_link")` => `NIL`
#[builtin("%BOX")]
fn bounding_box(
    simulation: &mut Simulation,
    image: &mut Image,
    body: &Value,
    link: Option<&Value>,
) -> Result<Option<Value>> {
    let world = &simulation.world;
    let found = match is_kitchen(image, body) {
        None => {
            let name = simulation.object_named(image, body)?;
            world.box_of(&BodyName::Object(name))
        }
        Some(kitchen) => {
            let wanted: Option<&Rc<LispString>> = typed::optional(image, link)?;
            let wanted = wanted.map(|link| link.text());
            let boxes = link_boxes(world, kitchen);
            around(boxes.into_iter().filter_map(|(body, corners)| {
                let is_meant = wanted.as_ref().is_none_or(|name| body.to_string() == *name);
                is_meant.then_some(corners)
            }))
        }
    };
    Ok(found.map(|corners| Value::list(lists(corners))))
}

/// The boxes around all links of :ROBOT or :KITCHEN that have a shape, or, for any other body, around all
/// objects: a list of (name least most).
///
/// `(progn (pp-tut:init-projection) (btr::%boxes :objects))` => `NIL`
#[builtin("%BOXES")]
fn all_boxes(simulation: &mut Simulation, image: &mut Image, body: &Value) -> Result<Value> {
    let world = &simulation.world;
    let boxes: Vec<(Value, Corners)> = match is_kitchen(image, body) {
        Some(kitchen) => link_boxes(world, kitchen)
            .into_iter()
            .map(|(body, corners)| (name_of(body), corners))
            .collect(),
        None => {
            let names = world.objects().map(|object| object.name().to_owned());
            names
                .filter_map(|name| {
                    let symbol = simulation.symbol_of(&name);
                    Some((symbol, world.box_of(&BodyName::Object(name))?))
                })
                .collect()
        }
    };
    let rows = boxes.into_iter().map(|(name, corners)| {
        let [least, most] = lists(corners);
        Value::list([name, least, most])
    });
    Ok(Value::list(rows))
}

/// What is asked about.
enum Meant {
    /// An object, with the box around it.
    Object(Corners),
    /// The robot or the kitchen, with the boxes around the links.
    Tree(Vec<(BodyName, Corners)>),
    Floor,
}

impl Meant {
    fn of(simulation: &Simulation, image: &Image, body: &Value) -> Result<Option<Self>> {
        let world = &simulation.world;
        if let Some(kitchen) = is_kitchen(image, body) {
            return Ok(Some(Self::Tree(link_boxes(world, kitchen))));
        }
        if name_text(image, body).as_deref() == Some("FLOOR") {
            return Ok(Some(Self::Floor));
        }
        let name = simulation.object_named(image, body)?;
        Ok(world.box_of(&BodyName::Object(name)).map(Self::Object))
    }

    /// The bodies of a list that have a shape, each with what it is.
    fn all(simulation: &Simulation, image: &Image, bodies: &Value) -> Result<Vec<(Value, Self)>> {
        let mut all = Vec::new();
        for body in bodies.iter_list() {
            if let Some(meant) = Self::of(simulation, image, &body)? {
                all.push((body, meant));
            }
        }
        Ok(all)
    }

    /// The box around all of it; `None` for the floor.
    fn corners(&self) -> Option<Corners> {
        match self {
            Self::Object(corners) => Some(*corners),
            Self::Tree(links) => around(links.iter().map(|(_, corners)| *corners)),
            Self::Floor => None,
        }
    }
}

/// Which bodies are above which: a list of (upper lower . links), with the links that the upper one is above
/// if the lower one is :KITCHEN or :ROBOT. A body is an object, :KITCHEN, :ROBOT or, as a lower one, :FLOOR.
/// Their boxes overlap from above, and the lower side of the one is not below the upper side of the other;
/// or, if MIDDLES is a number, the middle of the one is at most so much (m) below that of the other, wherever
/// they are.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (btr::%above '(bottle-1) '(:floor :robot bottle-1) nil))` => `((BOTTLE-1 :FLOOR))`
#[builtin("%ABOVE")]
fn above(
    simulation: &mut Simulation,
    image: &mut Image,
    uppers: &Value,
    lowers: &Value,
    middles: &Value,
) -> Result<Vec<Value>> {
    let middles = number::to_f64(middles);
    let uppers = Meant::all(simulation, image, uppers)?;
    let lowers = Meant::all(simulation, image, lowers)?;
    let mut rows = Vec::new();
    for (upper, meant) in &uppers {
        let Some(corners) = meant.corners() else {
            continue;
        };
        for (lower, meant) in lowers.iter().filter(|(lower, _)| !lower.is_eq(upper)) {
            let links: Vec<Value> = match meant {
                Meant::Floor if corners[0][2] >= -DIP => Vec::new(),
                Meant::Object(other) if is_above(&corners, other, middles) => Vec::new(),
                Meant::Tree(links) => {
                    let below = |(_, other): &&(_, Corners)| is_above(&corners, other, middles);
                    let below = links.iter().filter(below);
                    below.map(|(link, _)| name_of(link.clone())).collect()
                }
                Meant::Floor | Meant::Object(_) => continue,
            };
            if matches!(meant, Meant::Tree(_)) && links.is_empty() {
                continue;
            }
            let pair = [upper.clone(), lower.clone()];
            rows.push(Value::list(pair.into_iter().chain(links)));
        }
    }
    Ok(rows)
}

/// Whether a box is above another one: their middles decide if a number says how much (m) that of the one
/// may be below that of the other.
fn is_above(upper: &Corners, lower: &Corners, middles: Option<f64>) -> bool {
    let [least, most] = upper;
    let [other_least, other_most] = lower;
    match middles {
        Some(deeper) => {
            (least[2] + most[2]) / 2.0 + deeper >= (other_least[2] + other_most[2]) / 2.0
        }
        None => {
            let overlap = |i: usize| least[i] < other_most[i] && other_least[i] < most[i];
            overlap(0) && overlap(1) && least[2] >= other_most[2] - DIP
        }
    }
}

/// The boxes around the links of the kitchen, or else the robot, that have a shape.
fn link_boxes(world: &World, kitchen: bool) -> Vec<(BodyName, Corners)> {
    let bodies: Vec<BodyName> = match kitchen {
        true => world.solid_kitchen_links().collect(),
        false => world.solid_robot_links().collect(),
    };
    let with_box = |body: BodyName| {
        let corners = world.box_of(&body)?;
        Some((body, corners))
    };
    bodies.into_iter().filter_map(with_box).collect()
}

/// The box around others; `None` if there are none.
fn around(boxes: impl Iterator<Item = Corners>) -> Option<Corners> {
    boxes.reduce(|a, b| {
        let least = [0, 1, 2].map(|i| a[0][i].min(b[0][i]));
        [least, [0, 1, 2].map(|i| a[1][i].max(b[1][i]))]
    })
}

/// Both corners, each as a list.
fn lists(corners: Corners) -> [Value; 2] {
    corners.map(|corner| Value::list(corner.map(Value::Double)))
}

//! The arguments of the functions that make pictures.

use cram::pose::names;
use nalgebra::Point3;

use crate::simulation::Simulation;
use crate::simulation::names::{name_text, suggestion};
use cram::pose::argument;
use cram::pose::value::{as_placement, as_vector};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::raise::Raise;
use view::picture::View;
use view::picture::view::FIELD_OF_VIEW;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Minimum and maximum number of pixels along a side.
const SIZES: std::ops::RangeInclusive<i64> = 16..=4096;

/// Least and greatest vertical field of view (degrees).
const ANGLES: std::ops::RangeInclusive<f64> = 5.0..=140.0;

/// Default distance (m) of the eye from the point it looks at.
const ASIDE: [f64; 3] = [-1.15, -1.25, 0.95];

/// A picture's arguments: a file and a view, both optional, then keys with their values.
pub(super) struct PictureRequest {
    /// The requested file, if any.
    pub file: Option<String>,
    view: Option<Value>,
    keys: Vec<(&'static str, Value)>,
}

impl PictureRequest {
    /// Parses the arguments; `keys` are the permitted keys.
    pub(super) fn of(image: &Image, args: &[Value], keys: &[&'static str]) -> Result<Self> {
        let mut request = Self {
            file: None,
            view: None,
            keys: Vec::new(),
        };
        let mut left = args;
        if let [Value::Str(file), rest @ ..] = left {
            request.file = Some(file.text());
            left = rest;
        }
        let key_of = |value: &Value| {
            let name = value.as_symbol().map(|sym| image.name(sym).to_owned())?;
            keys.iter().find(|key| **key == name).copied()
        };
        if let [view, rest @ ..] = left
            && key_of(view).is_none()
        {
            if !keys.contains(&"VIEW") {
                return Err(unexpected(image, view, keys));
            }
            request.view = Some(view.clone());
            left = rest;
        }
        for pair in left.chunks(2) {
            let Some(key) = pair.first().and_then(key_of) else {
                // A chunk is never empty.
                return Err(unexpected(image, &pair[0], keys));
            };
            let [_, value] = pair else {
                let shown = key.to_lowercase();
                return Err(Raise::program(format!(":{shown} lacks its value.")));
            };
            if request.get(key).is_none() {
                request.keys.push((key, value.clone()));
            }
        }
        Ok(request)
    }

    /// The value of a key, if given.
    pub(super) fn get(&self, key: &str) -> Option<&Value> {
        let found = self.keys.iter().find(|(known, _)| *known == key);
        found.map(|(_, value)| value)
    }

    /// A number of pixels.
    pub(super) fn size(&self, image: &Image, key: &str, otherwise: usize) -> Result<usize> {
        let Some(value) = self.get(key) else {
            return Ok(otherwise);
        };
        match value {
            Value::Int(pixels) if SIZES.contains(pixels) => {
                Ok(usize::try_from(*pixels).unwrap_or(otherwise))
            }
            other => Err(Raise::simple(format!(
                "{} is no {} of a picture: a whole number of pixels from {} to {} was expected.",
                print::to_string(image, other, true),
                key.to_lowercase(),
                SIZES.start(),
                SIZES.end()
            ))),
        }
    }

    /// The vertical field of view (rad), if it is given, in degrees.
    pub(crate) fn field_of_view(&self, image: &Image) -> Result<Option<f64>> {
        let Some(value) = self.get("FOV") else {
            return Ok(None);
        };
        match number::to_f64(value).filter(|degrees| ANGLES.contains(degrees)) {
            Some(degrees) => Ok(Some(degrees.to_radians())),
            None => Err(Raise::simple(format!(
                "{} is no field of view of a picture: a number of degrees from {} to {} was expected.",
                print::to_string(image, value, true),
                ANGLES.start(),
                ANGLES.end()
            ))),
        }
    }

    /// The viewpoint.
    pub(super) fn view(&self, simulation: &Simulation, image: &Image) -> Result<View> {
        let named = self.view.as_ref().or_else(|| self.get("VIEW"));
        let (from, at) = (self.get("FROM"), self.get("AT"));
        match (named, from, at) {
            (Some(name), None, None) => view_named(image, name),
            (Some(_), _, _) => Err(Raise::simple(
                "A picture is either of a named view or from a place: leave out the view's name, or :from and :at.",
            )),
            (None, None, None) => Ok(View::Kitchen),
            (None, Some(from), None)
                if from.as_symbol().is_some() && !is_object(simulation, image, from) =>
            {
                view_named(image, from)
            }
            (None, from, at) => {
                let at = match at {
                    Some(at) => place(simulation, image, at)?,
                    None => simulation.base() * Point3::new(0.0, 0.0, 0.8),
                };
                let from = match from {
                    Some(from) => place(simulation, image, from)?,
                    None => at + nalgebra::Vector3::from(ASIDE),
                };
                Ok(View::Free {
                    from,
                    at,
                    vertical_fov: FIELD_OF_VIEW,
                })
            }
        }
    }
}

fn unexpected(image: &Image, value: &Value, keys: &[&str]) -> Box<Raise> {
    let keys: Vec<String> = keys
        .iter()
        .map(|k| format!(":{}", k.to_lowercase()))
        .collect();
    let first = match keys.contains(&":view".to_owned()) {
        true => "a file name, a view",
        false => "a file name",
    };
    Raise::program(format!(
        "{} is not understood by a picture: {first} and {} are.",
        print::to_string(image, value, true),
        keys.join(", ")
    ))
}

fn view_named(image: &Image, name: &Value) -> Result<View> {
    let text = name_text(image, name).map(|text| text.to_lowercase());
    let found = View::NAMED
        .into_iter()
        .find(|view| text.as_deref() == Some(view.name()));
    found.ok_or_else(|| {
        let names: Vec<String> = View::NAMED
            .iter()
            .map(|v| format!(":{}", v.name()))
            .collect();
        let near = suggestion(
            text.as_deref().unwrap_or_default(),
            View::NAMED.iter().map(View::name),
            |name| format!(":{name}"),
        );
        let near = match near.is_empty() {
            true => "; there".to_owned(),
            false => format!("{near} There"),
        };
        Raise::simple(format!(
            "{} is no view{near} are {}.",
            print::to_string(image, name, true),
            names.join(", ")
        ))
    })
}

fn is_object(simulation: &Simulation, image: &Image, value: &Value) -> bool {
    name_text(image, value).is_some_and(|name| simulation.world.object(&name).is_ok())
}

/// A position (m, map frame) from a point, a pose, or the name of an object or a frame.
fn place(simulation: &Simulation, image: &Image, value: &Value) -> Result<Point3<f64>> {
    let point = match value {
        Value::Str(frame) => origin(&simulation.frame_in_map(image, &frame.text())?),
        Value::Symbol(known::NIL, ..) => return Err(Raise::type_error(value, names::VECTOR_3D)),
        Value::Symbol(..) => {
            let name = simulation.object_named(image, value)?;
            let pose = simulation.world.object_pose(&name);
            origin(&pose.map_err(Raise::reporting)?)
        }
        _ if as_vector(value).is_some() || is_list_of_numbers(value) => {
            Point3::from(argument::vector(image, value)?.0)
        }
        _ => {
            // A pose is taken to be in the map frame; a list is checked to be a pose.
            let pose = match as_placement(value) {
                Some(_) => simulation.pose_in_map(image, value)?,
                None => simulation.pose_as_given(image, value)?,
            };
            origin(&pose)
        }
    };
    Ok(point)
}

fn origin(pose: &spatial::Pose) -> Point3<f64> {
    pose.translation.vector.into()
}

fn is_list_of_numbers(value: &Value) -> bool {
    let first = value.iter_list().next();
    first.is_some_and(|first| number::to_f64(&first).is_some() || first.list_to_vec().is_none())
}

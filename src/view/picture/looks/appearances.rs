//! The looks that are said in `world/looks.sexp`: of types of objects, of links of a robot, and
//! of what furniture shows besides its model.

use std::sync::LazyLock;

use indexmap::IndexMap;

use super::look::{Color, Look};
use super::surfaces::{Drawn, color_of, surface};
use super::vessel::{Part, parts_of};
use crate::picture::scene::Finish;
use robotics::sexp::{DataError, DataFile, DataProblem, Node, Record};
use spatial::PlacedShape;

/// The text of the built-in looks.
use descriptions::LOOKS;

/// Maximum width (m) of bevelled edges of objects without a record.
const BEVEL: f64 = 0.006;

/// The looks of a file.
#[derive(Debug, Default)]
pub(crate) struct Appearances {
    colors: IndexMap<String, Color>,
    /// By type of object.
    objects: IndexMap<String, Vec<Drawn>>,
    /// By names of robot and link.
    links: IndexMap<(String, String), Vec<Look>>,
    /// By link.
    furniture: IndexMap<String, Vec<Look>>,
}

/// The records of a file, each with its keys.
const RECORDS: &[(&str, &[&str])] = &[
    ("colors", &[]),
    ("object", &["surfaces"]),
    ("link", &["of", "own", "surfaces"]),
    ("furniture", &["surfaces"]),
];

impl Appearances {
    /// The looks of `world/looks.sexp`, read once.
    pub(crate) fn built_in() -> &'static Self {
        static BUILT_IN: LazyLock<Appearances> = LazyLock::new(|| {
            Appearances::from_sexp(LOOKS, "looks.sexp").expect("the built-in looks are right")
        });
        &BUILT_IN
    }

    /// Reads a file; `file_name` is used only in errors.
    pub(super) fn from_sexp(text: &str, file_name: &str) -> Result<Self, DataError> {
        let mut looks = Self::default();
        for node in DataFile::read(text, file_name)?.nodes() {
            let record = node.record("record", RECORDS)?;
            match record.head() {
                "colors" => looks.add_colors(&record)?,
                "object" => looks.add_objects(&record)?,
                "link" => looks.add_links(&record)?,
                _ => looks.add_furniture(&record)?,
            }
        }
        Ok(looks)
    }

    /// The looks of an object of this type with these shapes, which is shown as `own` if that is given.
    pub(crate) fn of_object(
        &self,
        kind: &str,
        shapes: &[PlacedShape],
        own: Option<&[PlacedShape]>,
    ) -> Vec<Look> {
        if let Some(own) = own {
            return as_described(own);
        }
        let Some(surfaces) = self.objects.get(kind) else {
            return as_described(shapes);
        };
        let looks = surfaces.iter().flat_map(|drawn| match drawn {
            Drawn::Surface { surface, at, color } => {
                vec![Look::of_surface(surface.clone(), *at, *color)]
            }
            Drawn::Vessel => vessels(shapes),
        });
        looks.collect()
    }

    /// The looks of a robot's link; `None` if it looks as its model says.
    pub(crate) fn of_link(&self, robot: &str, link: &str) -> Option<&[Look]> {
        let looks = self.links.get(&(robot.to_owned(), link.to_owned()));
        looks.map(Vec::as_slice)
    }

    /// What a piece of furniture shows in addition to its model.
    pub(crate) fn of_furniture(&self, link: &str) -> &[Look] {
        self.furniture.get(link).map_or(&[], Vec::as_slice)
    }

    fn add_colors(&mut self, record: &Record<'_>) -> Result<(), DataError> {
        for node in record.things() {
            let items = node.list()?;
            let [name, color] = items.as_slice() else {
                return Err(node.expected("(name (red green blue))"));
            };
            let (name, color) = (name.symbol()?, color.color()?);
            if self.colors.insert(name.to_owned(), color).is_some() {
                return Err(node.error(DataProblem::Repeated(format!("the colour {name}"))));
            }
        }
        Ok(())
    }

    fn add_objects(&mut self, record: &Record<'_>) -> Result<(), DataError> {
        let surfaces = self.surfaces(record)?;
        for node in names(record)? {
            let name = node.symbol()?.to_owned();
            once(node, self.objects.insert(name, surfaces.clone()))?;
        }
        Ok(())
    }

    fn add_links(&mut self, record: &Record<'_>) -> Result<(), DataError> {
        let surfaces = self.surfaces(record)?;
        let robot = record.required("of")?.symbol()?;
        let names = names(record)?;
        let own = match record.optional("own") {
            Some(node) => node.list()?,
            None => Vec::new(),
        };
        for (index, node) in names.iter().enumerate() {
            let own = own.get(index).map(|node| color_of(*node, &self.colors));
            let looks = plain(record, &surfaces, own.transpose()?)?;
            let key = (robot.to_owned(), node.symbol()?.to_owned());
            once(node, self.links.insert(key, looks))?;
        }
        Ok(())
    }

    fn add_furniture(&mut self, record: &Record<'_>) -> Result<(), DataError> {
        let surfaces = self.surfaces(record)?;
        let looks = plain(record, &surfaces, None)?;
        for node in names(record)? {
            let name = node.symbol()?.to_owned();
            once(node, self.furniture.insert(name, looks.clone()))?;
        }
        Ok(())
    }

    fn surfaces(&self, record: &Record<'_>) -> Result<Vec<Drawn>, DataError> {
        let nodes = record.required("surfaces")?.list()?;
        nodes
            .into_iter()
            .map(|node| surface(node, &self.colors))
            .collect()
    }
}

/// The names that a record begins with.
fn names<'r, 'a>(record: &'r Record<'a>) -> Result<&'r [Node<'a>], DataError> {
    match record.things() {
        [] => Err(record.node().expected("a name before the keys")),
        names => Ok(names),
    }
}

/// An error if there was something before.
fn once<T>(node: &Node<'_>, before: Option<T>) -> Result<(), DataError> {
    match before {
        None => Ok(()),
        Some(_) => {
            let what = format!("the look of {}", node.symbol()?);
            Err(node.error(DataProblem::Repeated(what)))
        }
    }
}

/// The looks of something without shapes of objects; `own` is the colour of surfaces without
/// one.
fn plain(
    record: &Record<'_>,
    surfaces: &[Drawn],
    own: Option<Color>,
) -> Result<Vec<Look>, DataError> {
    let look = |drawn: &Drawn| match drawn {
        Drawn::Surface { surface, at, color } => color
            .or(own)
            .map(|color| Look::of_surface(surface.clone(), *at, Some(color)))
            .ok_or("a surface without :color needs an :own colour for each link"),
        Drawn::Vessel => Err("only objects can be shown as a (vessel)"),
    };
    let looks = surfaces.iter().map(look).collect::<Result<_, _>>();
    looks.map_err(|wrong| record.node().error(DataProblem::Invalid(wrong.to_owned())))
}

/// The shapes themselves, hollow where they form rings.
fn as_described(shapes: &[PlacedShape]) -> Vec<Look> {
    let look = |part| match part {
        Part::Shape(placed) => Look::of_shape(placed, BEVEL, Finish::Gloss),
        Part::Vessel { surface, at } => Look::of_surface(surface.into(), at, None),
    };
    parts_of(shapes).into_iter().map(look).collect()
}

/// The vessels among the shapes.
fn vessels(shapes: &[PlacedShape]) -> Vec<Look> {
    let look = |part| match part {
        Part::Vessel { surface, at } => Some(Look::of_surface(surface.into(), at, None)),
        Part::Shape(_) => None,
    };
    parts_of(shapes).into_iter().filter_map(look).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use robotics::world::object_library::{OBJECTS, ObjectLibrary};

    fn error(text: &str) -> String {
        match Appearances::from_sexp(text, "l.sexp") {
            Ok(_) => "no error".to_owned(),
            Err(error) => error.to_string(),
        }
    }

    /// Least and greatest coordinates (m) of the corners.
    fn bounds(looks: &[Look]) -> [[f64; 3]; 2] {
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for look in looks {
            for corner in &look.surface.corners {
                let point = look.at * corner.point;
                for axis in 0..3 {
                    bounds[0][axis] = bounds[0][axis].min(point[axis]);
                    bounds[1][axis] = bounds[1][axis].max(point[axis]);
                }
            }
        }
        bounds
    }

    #[test]
    fn objects_are_as_large_as_what_touches() {
        let library = ObjectLibrary::from_sexp(OBJECTS, "objects.sexp").unwrap();
        for kind in library.types() {
            let shapes: Vec<_> = kind.shapes.iter().collect();
            let plain: Vec<_> = shapes
                .iter()
                .map(|s| Look::of_shape(s, 0.0, Finish::Matt))
                .collect();
            let looks = Appearances::built_in().of_object(&kind.name, &kind.shapes, None);
            let (seen, touched) = (bounds(&looks), bounds(&plain));
            // A cup's handle is only drawn; cutlery is drawn thinner than its boxes.
            let most = if kind.name == "cup" { 0.022 } else { 0.012 };
            for axis in 0..3 {
                let low = seen[0][axis] - touched[0][axis];
                let high = touched[1][axis] - seen[1][axis];
                let fits = |gap: f64| (-most..0.012).contains(&gap);
                assert!(
                    fits(low) && fits(high),
                    "{} along {axis}: {low:.4} {high:.4}",
                    kind.name
                );
            }
        }
    }

    #[test]
    fn every_name_in_the_built_in_looks_exists() {
        let models = robotics::world::Models::pr2_in_kitchen().unwrap();
        let looks = Appearances::built_in();
        for name in looks.objects.keys() {
            assert!(models.objects.get(name).is_some(), "{name}");
        }
        for (robot, link) in looks.links.keys() {
            assert_eq!(robot, models.robot.name());
            assert!(models.robot.link_named(link).is_some(), "{link}");
        }
        for link in looks.furniture.keys() {
            assert!(models.kitchen.link_named(link).is_some(), "{link}");
        }
    }

    #[test]
    fn errors_name_the_place_and_the_nearest_name() {
        assert_eq!(
            error("(colors (white (1 1 1)))\n(object cup :surfaces ((disk)))"),
            "l.sexp:2:24: there is no surface named disk; did you mean disc?"
        );
        assert_eq!(
            error(
                "(colors (white (1 1 1)))
(object cup :surfaces ((disc :axis z :span (0 1) :radius 1 :color wite)))"
            ),
            "l.sexp:2:67: there is no colour named wite; did you mean white?"
        );
        assert_eq!(
            error("(furniture stove :surfaces ((disc :axis z :span (0 1) :radius 1)))"),
            "l.sexp:1:1: a surface without :color needs an :own colour for each link"
        );
        assert_eq!(
            error("(object cup :surfaces ((vessel)))\n(object cup :surfaces ())"),
            "l.sexp:2:9: the look of cup is given twice; keep one"
        );
    }
}

//! The kinds of objects that can be spawned: their shapes, masses and colours, and the
//! hierarchy of types.
//!
//! Names are lower-case and without a colon: `bottle`. The built-in library is
//! `world/objects.sexp`.

use indexmap::IndexMap;

use super::inside::{Inside, inside_of};
use super::object_shapes::ObjectShapes;
use super::solid::{Solid, bounds_of};
use crate::mesh::MeshLibrary;
use crate::sexp::{DataError, DataFile, DataProblem, Record};
use closest_name::closest_name;
use spatial::PlacedShape;

/// The text of the built-in library, `world/objects.sexp`.
pub use descriptions::OBJECTS;

/// Coefficient of friction of things that give none.
pub const FRICTION: f64 = 0.6;

/// One kind of object.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectType {
    /// Name of the type, such as `bottle`.
    pub name: String,
    /// Its solids, in the object's frame; never empty.
    pub shapes: Vec<PlacedShape>,
    /// Mass (kg).
    pub mass: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Linear colour, red green blue alpha in 0..1.
    pub color: [f32; 4],
    /// Whether it is the same from all sides: it can be grasped from any of them, and turned
    /// when it is put down.
    pub is_round: bool,
    /// What is shown of it, in its frame; `None` for a type that looks as `world/looks.sexp` says, or else
    /// as its shapes.
    pub looks: Option<Vec<PlacedShape>>,
    /// The point (m, its frame) at which its weight acts.
    pub balance: [f64; 3],
    /// The room inside it, if its solids do not show that.
    pub inside: Option<Inside>,
    /// Which definition of the session it comes from; 0 for those that are built in.
    pub edition: u32,
}

impl ObjectType {
    /// Edge lengths (m) of the box around it in its own frame.
    pub fn size(&self) -> [f64; 3] {
        let bounds = bounds_of(&Solid::all(&self.shapes));
        bounds.map_or([0.0; 3], |bounds| bounds.extents().to_array())
    }
}

/// The kinds of objects, in the order of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectLibrary {
    objects: IndexMap<String, ObjectType>,
    /// Names of the listed types, in order.
    available: Vec<String>,
    /// The supertype of each type.
    kind_of: IndexMap<String, String>,
    /// How many types have been defined since the library was read.
    editions: u32,
}

/// The records of a library, each with its keys.
const RECORDS: &[(&str, &[&str])] = &[("available", &[]), ("kinds", &[]), ("object", OBJECT_KEYS)];

/// The keys of a type.
pub(super) const OBJECT_KEYS: &[&str] = &["mass", "friction", "color", "shapes", "inside"];

impl ObjectLibrary {
    /// Reads a library; `file_name` is used only in errors.
    pub fn from_sexp(text: &str, file_name: &str) -> Result<Self, DataError> {
        let file = DataFile::read(text, file_name)?;
        let mut library = Self {
            objects: IndexMap::new(),
            available: Vec::new(),
            kind_of: IndexMap::new(),
            editions: 0,
        };
        let mut listed = Vec::new();
        for node in file.nodes() {
            let record = node.record("record", RECORDS)?;
            match record.head() {
                "available" => listed.extend_from_slice(record.things()),
                "kinds" => library.add_kinds(&record)?,
                _ => library.add_object(&record)?,
            }
        }
        for node in listed {
            let name = node.symbol()?;
            if library.get(name).is_none() {
                return Err(node.unknown("object", name, library.closest_name(name)));
            }
            library.available.push(name.to_owned());
        }
        Ok(library)
    }

    /// The types that are listed to the user, in order.
    pub fn types(&self) -> impl ExactSizeIterator<Item = &ObjectType> {
        // The reader has checked that every listed name is an object.
        self.available.iter().map(|name| &self.objects[name])
    }

    /// The names of all types, listed or not, and of their supertypes.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let kinds = self.kind_of.iter().flat_map(|(one, of)| [one, of]);
        self.objects.keys().chain(kinds).map(String::as_str)
    }

    /// The type with that name, listed or not.
    pub fn get(&self, name: &str) -> Option<&ObjectType> {
        self.objects.get(name)
    }

    /// The name most similar to a mistyped one.
    pub fn closest_name(&self, wanted: &str) -> Option<&str> {
        closest_name(wanted, self.objects.keys().map(String::as_str))
    }

    /// The type itself, then its supertype, and so on.
    pub fn lineage<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a str> {
        let parent = |name: &&'a str| self.kind_of.get(*name).map(String::as_str);
        std::iter::successors(Some(name), parent)
    }

    /// Whether the type is `other` or a subtype of it.
    pub fn is_kind_of(&self, name: &str, other: &str) -> bool {
        self.lineage(name).any(|n| n == other)
    }

    /// Takes a record `(kinds SUPERTYPE TYPE …)`.
    pub(super) fn add_kinds(&mut self, record: &Record<'_>) -> Result<(), DataError> {
        let Some((of, kinds)) = record.things().split_first() else {
            return Err(record.node().expected("(kinds type kind …)"));
        };
        let of = of.symbol()?;
        for node in kinds {
            let kind = node.symbol()?;
            if self.is_kind_of(of, kind) {
                let problem = format!("{of} is a kind of {kind} already, or the same");
                return Err(node.error(DataProblem::Invalid(problem)));
            }
            if self
                .kind_of
                .insert(kind.to_owned(), of.to_owned())
                .is_some()
            {
                return Err(node.error(DataProblem::Repeated(format!("the type of {kind}"))));
            }
        }
        Ok(())
    }

    /// Adds a type, or replaces the one of that name; it is listed last if it is new.
    pub(super) fn define(&mut self, mut object: ObjectType) {
        self.editions += 1;
        object.edition = self.editions;
        if !self.available.contains(&object.name) {
            self.available.push(object.name.clone());
        }
        self.objects.insert(object.name.clone(), object);
    }

    /// Makes a type one of a more general kind, whatever it was before. An error says why it cannot be.
    pub(super) fn set_kind(&mut self, name: &str, of: &str) -> Result<(), String> {
        if self.is_kind_of(of, name) {
            return Err(format!("{of} is a kind of {name} already, or the same"));
        }
        self.kind_of.insert(name.to_owned(), of.to_owned());
        Ok(())
    }

    fn add_object(&mut self, record: &Record<'_>) -> Result<(), DataError> {
        let node = record.thing("name")?;
        let shapes = ObjectShapes::read(record.required("shapes")?, &MeshLibrary::none())?;
        let object = ObjectType {
            name: node.symbol()?.to_owned(),
            is_round: shapes.is_round,
            shapes: shapes.solids,
            mass: record.required("mass")?.positive()?,
            friction: friction_of(record)?,
            color: record.required("color")?.color()?,
            looks: None,
            balance: [0.0; 3],
            inside: inside_of(record)?,
            edition: 0,
        };
        match self.objects.insert(object.name.clone(), object) {
            None => Ok(()),
            Some(object) => {
                let what = format!("the object {}", object.name);
                Err(node.error(DataProblem::Repeated(what)))
            }
        }
    }
}

/// The friction that a record gives.
pub(super) fn friction_of(record: &Record<'_>) -> Result<f64, DataError> {
    record
        .optional("friction")
        .map_or(Ok(FRICTION), |node| node.positive())
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;
    use spatial::Shape;

    use super::*;

    fn library() -> ObjectLibrary {
        ObjectLibrary::from_sexp(OBJECTS, "objects.sexp").expect("the built-in library is right")
    }

    fn error(text: &str) -> String {
        match ObjectLibrary::from_sexp(text, "o.sexp") {
            Ok(_) => "no error".to_owned(),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn lists_types_in_crams_order() {
        let library = library();
        let names: Vec<&str> = library.types().map(|t| t.name.as_str()).collect();
        assert_eq!(names.len(), 25);
        assert_eq!(names[..3], ["tray", "tray-base", "spoon"]);
        assert_eq!(names[10], "bottle");
        assert_eq!(names[24], "shoe");
    }

    #[test]
    fn staves_lean_outwards() {
        let text = "(object o :mass 1 :color (0 0 0)
                     :shapes ((ring :count 4 :radius 1 :stave (0.1 1 2) :lean 0.5)))";
        let library = ObjectLibrary::from_sexp(text, "o.sexp").expect("it is right");
        for stave in &library.get("o").expect("it is there").shapes {
            let top = stave.pose * Point3::new(0.0, 0.0, 1.0);
            let radius = libm::hypot(top.x, top.y);
            assert!((radius - 1.0 - libm::sin(0.5)).abs() < 1e-12, "{top}");
            assert!((top.z - libm::cos(0.5)).abs() < 1e-12, "{top}");
        }
        assert_eq!(
            error(&text.replace("0.5", "1.6")),
            "o.sexp:2:79: expected an angle (rad) below a quarter turn, found 1.6"
        );
    }

    #[test]
    fn the_bottle_stands_10_cm_above_its_bottom() {
        let library = library();
        let bottle = library.get("bottle").expect("there are bottles");
        let bottoms = bottle.shapes.iter().map(|s| match s.shape {
            Shape::Cylinder { length, .. } => s.pose.translation.z - length / 2.0,
            _ => f64::NAN,
        });
        let lowest = bottoms.fold(f64::INFINITY, f64::min);
        assert!((lowest + 0.1008).abs() < 1e-12, "{lowest}");
        assert_eq!(bottle.mass, 0.2);
    }

    #[test]
    fn a_ring_is_a_circle_of_boxes() {
        let library = ObjectLibrary::from_sexp(
            "(object o :mass 1 :color (0 0 0)
              :shapes ((ring :count 4 :radius 2 :stave (0.1 1 1) :at (1 0 0))))",
            "o.sexp",
        );
        let library = library.expect("the text is right");
        let centres: Vec<[f64; 2]> = library.objects["o"]
            .shapes
            .iter()
            .map(|s| [s.pose.translation.x, s.pose.translation.y])
            .collect();
        let expected = [[3.0, 0.0], [1.0, 2.0], [-1.0, 0.0], [1.0, -2.0]];
        for (centre, expected) in centres.iter().zip(expected) {
            assert!((centre[0] - expected[0]).abs() < 1e-12, "{centres:?}");
            assert!((centre[1] - expected[1]).abs() < 1e-12, "{centres:?}");
        }
    }

    #[test]
    fn a_mug_is_a_kitchen_item() {
        let library = library();
        let lineage: Vec<&str> = library.lineage("mug").collect();
        assert_eq!(lineage, ["mug", "cup", "kitchen-item", "household-item"]);
        assert!(library.is_kind_of("spoon", "cutlery"));
        assert!(!library.is_kind_of("cutlery", "spoon"));
    }

    #[test]
    fn a_mistyped_name_finds_its_nearest() {
        assert_eq!(library().closest_name("botle"), Some("bottle"));
    }

    #[test]
    fn mistakes_are_reported_with_their_place() {
        assert_eq!(
            error("(object o :mass 1 :color (0 0 0)\n :shapes ((bax :size (1 1 1))))"),
            "o.sexp:2:11: there is no shape named bax; did you mean box?"
        );
        assert_eq!(
            error("(object o :mass -1 :color (0 0 0) :shapes ((sphere :radius 1)))"),
            "o.sexp:1:17: expected a number above 0, found -1"
        );
        assert_eq!(
            error("(available o)"),
            "o.sexp:1:12: there is no object named o"
        );
        assert_eq!(
            error("(kinds a b) (kinds b a)"),
            "o.sexp:1:22: b is a kind of a already, or the same"
        );
    }
}

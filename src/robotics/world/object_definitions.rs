//! Types of objects that users define: files in the form of `world/objects.sexp`, in which shapes may be
//! meshes, and in which grasps may stand, too.

use super::grasp_library::{GRASP_RECORDS, GraspLibrary};
use super::inside::inside_of;
use super::object_library::{FRICTION, ObjectLibrary, ObjectType, friction_of};
use super::object_shapes::ObjectShapes;
use super::solid::Solid;
use crate::mesh::MeshLibrary;
use crate::sexp::{DataError, DataFile, DataProblem, Node, Record};
use spatial::{PlacedShape, Shape};

/// Mass (kg) and colour of types that give none.
const MASS: f64 = 0.2;
const COLOR: [f32; 4] = [0.5, 0.5, 0.5, 1.0];

/// What is known of objects, after definitions have been read.
pub struct ObjectDefinitions {
    /// The types.
    pub objects: ObjectLibrary,
    /// Their grasps.
    pub grasps: GraspLibrary,
    /// The types that were defined, in order.
    pub defined: Vec<DefinedType>,
}

/// A type that was defined.
#[derive(Clone, Debug, PartialEq)]
pub struct DefinedType {
    /// Its name.
    pub name: String,
    /// How its objects are grasped.
    pub grasping: Grasping,
}

/// How objects of a type are grasped.
#[derive(Clone, Debug, PartialEq)]
pub enum Grasping {
    /// As their shape allows.
    AsShaped,
    /// As their shape allows, by the grasps of these names, in that order.
    Among(Vec<String>),
    /// As is said elsewhere, if it is.
    AsDefined,
}

/// The records of a file of objects, besides those of grasps.
const RECORDS: &[(&str, &[&str])] = &[
    ("available", &[]),
    ("kinds", &[]),
    (
        "object",
        &[
            "mass", "friction", "color", "shapes", "looks", "kind", "grasps", "inside",
        ],
    ),
];

impl ObjectDefinitions {
    /// Reads definitions and adds them to what is known; `file_name` is used only in errors.
    ///
    /// # Errors
    ///
    /// The first mistake.
    pub fn read(
        text: &str,
        file_name: &str,
        meshes: &MeshLibrary<'_>,
        objects: &ObjectLibrary,
        grasps: &GraspLibrary,
    ) -> Result<Self, DataError> {
        let file = DataFile::read(text, file_name)?;
        let mut known = Self {
            objects: objects.clone(),
            grasps: grasps.clone(),
            defined: Vec::new(),
        };
        let records = [RECORDS, GRASP_RECORDS].concat();
        let mut of_grasps = Vec::new();
        let mut listed: Vec<Node<'_>> = Vec::new();
        for node in file.nodes() {
            let record = node.record("record", &records)?;
            match record.head() {
                "object" => known.add_object(&record, meshes)?,
                "kinds" => known.objects.add_kinds(&record)?,
                "available" => listed.extend_from_slice(record.things()),
                _ => of_grasps.push(record),
            }
        }
        // All that is defined is listed.
        for node in listed {
            let name = node.symbol()?;
            if known.objects.get(name).is_none() {
                return Err(node.unknown("object", name, known.objects.closest_name(name)));
            }
        }
        let mut own = GraspLibrary::empty();
        for record in &of_grasps {
            known.grasps.add_record(record)?;
            if record.head() == "grasp" {
                own.add_order_of(record)?;
            }
        }
        for defined in &mut known.defined {
            if defined.grasping == Grasping::AsShaped && !own.grasps(&defined.name).is_empty() {
                defined.grasping = Grasping::AsDefined;
            }
        }
        Ok(known)
    }

    fn add_object(
        &mut self,
        record: &Record<'_>,
        meshes: &MeshLibrary<'_>,
    ) -> Result<(), DataError> {
        let node = record.thing("name")?;
        let name = node.symbol()?.to_owned();
        if self.defined.iter().any(|defined| defined.name == name) {
            let what = format!("the object {name}");
            return Err(node.error(DataProblem::Repeated(what)));
        }
        let shapes_node = record.required("shapes")?;
        let shapes = ObjectShapes::read(shapes_node, meshes)?;
        let looks = match record.optional("looks") {
            Some(node) => ObjectShapes::read(node, meshes)?.looks,
            None => shapes.looks,
        };
        let Some(balance) = balance_of(&shapes.solids) else {
            return Err(shapes_node.error(DataProblem::Invalid(
                "the shapes have no volume: give them some".to_owned(),
            )));
        };
        let object = ObjectType {
            name: name.clone(),
            is_round: shapes.is_round,
            shapes: shapes.solids,
            mass: record.optional("mass").map_or(Ok(MASS), |n| n.positive())?,
            friction: friction_of(record)?,
            color: record.optional("color").map_or(Ok(COLOR), |n| n.color())?,
            looks: Some(looks),
            balance,
            inside: inside_of(record)?,
            edition: 0,
        };
        self.grasps.forget(&name);
        self.objects.define(object);
        if let Some(kind) = record.optional("kind") {
            let set = self.objects.set_kind(&name, kind.symbol()?);
            set.map_err(|problem| kind.error(DataProblem::Invalid(problem)))?;
        }
        let grasping = match record.optional("grasps") {
            None => Grasping::AsShaped,
            Some(node) => match node.symbols()?.as_slice() {
                [] => Grasping::AsDefined,
                names => Grasping::Among(names.iter().map(|name| (*name).to_owned()).collect()),
            },
        };
        self.defined.push(DefinedType { name, grasping });
        Ok(())
    }
}

/// The point (m) at which the weight of shapes acts, if they have a volume: the mean of the middles of
/// all, each as heavy as it is large.
fn balance_of(shapes: &[PlacedShape]) -> Option<[f64; 3]> {
    let solids = Solid::all(shapes);
    let volume: f64 = solids.iter().map(|solid| solid.volume).sum();
    let moments = solids.iter().fold([0.0; 3], |sum, solid| {
        let middle = solid.shape.mass_properties(1.0).local_com;
        let middle = solid.pose.transform_point(middle);
        let middle = [middle.x, middle.y, middle.z];
        std::array::from_fn(|i| sum[i] + solid.volume * middle[i])
    });
    (volume > 0.0).then(|| moments.map(|moment| moment / volume))
}

/// A type of objects that is a single shape.
pub fn plain_type(name: &str, shape: Shape, mass: f64, color: [f32; 4]) -> ObjectType {
    ObjectType {
        name: name.to_owned(),
        is_round: matches!(shape, Shape::Sphere { .. }),
        shapes: vec![PlacedShape {
            shape,
            pose: spatial::Pose::identity(),
            color: None,
        }],
        mass,
        friction: FRICTION,
        color,
        looks: None,
        balance: [0.0; 3],
        inside: None,
        edition: 0,
    }
}

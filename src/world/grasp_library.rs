//! How objects are grasped: where the hand goes, how hard it grips, which grasp is tried first.
//!
//! Names are lower-case and without a colon: type `bottle`, grasp `left-side`. The built-in
//! library is `world/grasps.sexp`; plans add and override grasps at run time. Nothing here
//! knows of a particular robot: the hand is the gripper frame of a grasp (z forward, x
//! across the palm), which the robot description turns into its tool frame.

use indexmap::IndexMap;
use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use thiserror::Error;

use crate::closest_name::closest_name;
use crate::robot::Side;
use crate::sexp::{DataError, DataFile, DataProblem, Node, Record};
use crate::spatial::Pose;

/// The text of the built-in library, `world/grasps.sexp`.
pub const GRASPS: &str = include_str!("../../world/grasps.sexp");

/// How far the rows of a rotation may be from unit length and right angles; hand-written
/// matrices such as those with 0.707 are within.
const ROTATION_SLACK: f64 = 0.01;

/// One way to grasp objects of one type with one arm; lengths in m, along the object's axes.
#[derive(Clone, Debug, PartialEq)]
pub struct GraspDefinition {
    /// Place of the hand in the object's frame.
    pub translation: [f64; 3],
    /// Orientation of the hand in the object's frame: the rows of the matrix as written.
    pub rotation: [[f64; 3]; 3],
    /// First pregrasp, relative to `translation`.
    pub pregrasp: [f64; 3],
    /// Second pregrasp, relative to `translation`.
    pub second_pregrasp: [f64; 3],
    /// First lift, relative to `translation`.
    pub lift: [f64; 3],
    /// Second lift, relative to `translation`.
    pub second_lift: [f64; 3],
}

/// Where the robot's tool goes for a grasp, in the frame in which the object was given.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolPoses {
    /// The tool comes here first.
    pub pregrasp: Pose,
    /// Then here.
    pub second_pregrasp: Pose,
    /// Here the gripper closes.
    pub grasp: Pose,
    /// The tool leaves to here.
    pub lift: Pose,
    /// Then to here.
    pub second_lift: Pose,
}

/// A matrix that is no rotation, by its rows.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "{0:?} is not a rotation: its rows must have length 1, be at right angles to each other \
     and make a right-handed frame"
)]
pub struct NotARotation(pub [[f64; 3]; 3]);

impl GraspDefinition {
    /// Orientation of the hand in the object's frame; small flaws of the matrix are evened out.
    pub fn orientation(&self) -> Result<UnitQuaternion<f64>, NotARotation> {
        let matrix = Matrix3::from(self.rotation).transpose();
        let flaw = (matrix * matrix.transpose() - Matrix3::identity()).amax();
        // Not a number is a flaw too.
        let sound = flaw <= ROTATION_SLACK && matrix.determinant() > 0.0;
        if !sound {
            return Err(NotARotation(self.rotation));
        }
        // Squared up from the third column, the approach direction, on.
        let z = matrix.column(2).normalize();
        let x: Vector3<f64> = matrix.column(0) - z * z.dot(&matrix.column(0));
        let x = x.normalize();
        let square = Matrix3::from_columns(&[x, z.cross(&x), z]);
        let rotation = Rotation3::from_matrix_unchecked(square);
        Ok(UnitQuaternion::from_rotation_matrix(&rotation))
    }

    /// The five poses of the tool for an object at `object`, in the frame in which that is
    /// given; `tool_axes` is the tool's orientation in the hand's frame.
    pub fn tool_poses(
        &self,
        object: &Pose,
        tool_axes: &UnitQuaternion<f64>,
    ) -> Result<ToolPoses, NotARotation> {
        let orientation = self.orientation()? * tool_axes;
        let at = |offset: [f64; 3]| {
            let place = Vector3::from(self.translation) + Vector3::from(offset);
            object * Pose::from_parts(Translation3::from(place), orientation)
        };
        Ok(ToolPoses {
            pregrasp: at(self.pregrasp),
            second_pregrasp: at(self.second_pregrasp),
            grasp: at([0.0; 3]),
            lift: at(self.lift),
            second_lift: at(self.second_lift),
        })
    }
}

/// How hard to grip and how wide to open before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// Effort (N).
    pub effort: f64,
    /// Opening (m).
    pub opening: f64,
}

/// All that is known of grasping.
#[derive(Clone, Debug, PartialEq)]
pub struct GraspLibrary {
    rotations: IndexMap<String, [[f64; 3]; 3]>,
    default_grip: Grip,
    grips: IndexMap<String, Grip>,
    /// Names of grasps by type, in the order in which they are tried.
    order: IndexMap<String, Vec<String>>,
    /// By type, arm and name.
    grasps: IndexMap<(String, Side, String), GraspDefinition>,
}

/// Records that a library consists of, each with its keys.
const RECORDS: &[(&str, &[&str])] = &[
    ("rotation", &[]),
    ("default-grip", &["effort", "opening"]),
    ("grip", &["effort", "opening"]),
    ("order", &[]),
    (
        "grasp",
        &[
            "types",
            "arms",
            "translation",
            "rotation",
            "pregrasp",
            "second-pregrasp",
            "lift",
            "second-lift",
        ],
    ),
];

impl GraspLibrary {
    /// Reads a library; `file_name` is only used in errors.
    pub fn from_sexp(text: &str, file_name: &str) -> Result<Self, DataError> {
        let file = DataFile::read(text, file_name)?;
        let mut default_grip = None;
        let mut library = Self {
            rotations: IndexMap::new(),
            default_grip: Grip {
                effort: 0.0,
                opening: 0.0,
            },
            grips: IndexMap::new(),
            order: IndexMap::new(),
            grasps: IndexMap::new(),
        };
        for node in file.nodes() {
            let head = node.head()?;
            let Some((_, keys)) = RECORDS.iter().find(|(name, _)| *name == head) else {
                let closest = closest_name(head, RECORDS.iter().map(|r| r.0));
                return Err(node.unknown("record", head, closest));
            };
            let record = node.record(keys)?;
            match head {
                "rotation" => library.add_rotation(&record)?,
                "default-grip" => default_grip = Some(grip(&record)?),
                "grip" => {
                    let grip = grip(&record)?;
                    for name in record.thing("list of types")?.symbols()? {
                        library.grips.insert(name.to_owned(), grip);
                    }
                }
                "order" => library.add_order(&record)?,
                _ => library.add_grasp(&record)?,
            }
        }
        library.default_grip = default_grip
            .ok_or_else(|| file.error(DataProblem::MissingRecord("default-grip".to_owned())))?;
        Ok(library)
    }

    /// The grasps of a type in the order in which they are tried; none for an unknown type.
    pub fn grasps(&self, object_type: &str) -> &[String] {
        self.order.get(object_type).map_or(&[], Vec::as_slice)
    }

    /// The grasp of that name for objects of that type with that arm.
    pub fn get(&self, object_type: &str, arm: Side, grasp: &str) -> Option<&GraspDefinition> {
        let key = (object_type.to_owned(), arm, grasp.to_owned());
        self.grasps.get(&key)
    }

    /// Effort and opening for a type.
    pub fn grip(&self, object_type: &str) -> Grip {
        let grip = self.grips.get(object_type).copied();
        grip.unwrap_or(self.default_grip)
    }

    /// The rows of the rotation of that name.
    pub fn rotation(&self, name: &str) -> Option<[[f64; 3]; 3]> {
        self.rotations.get(name).copied()
    }

    /// Adds a grasp, or overrides the one that the type has under that name for that arm. A
    /// new name comes last in the order in which grasps are tried.
    pub fn define(
        &mut self,
        object_type: &str,
        arm: Side,
        grasp: &str,
        definition: GraspDefinition,
    ) -> Result<(), NotARotation> {
        definition.orientation()?;
        let order = self.order.entry(object_type.to_owned()).or_default();
        if !order.iter().any(|name| name == grasp) {
            order.push(grasp.to_owned());
        }
        let key = (object_type.to_owned(), arm, grasp.to_owned());
        self.grasps.insert(key, definition);
        Ok(())
    }

    fn add_rotation(&mut self, record: &Record<'_>) -> Result<(), DataError> {
        let [name, rows] = record.things() else {
            return Err(record.node().expected("(rotation name rows)"));
        };
        let rows = rotation_rows(*rows)?;
        self.rotations.insert(name.symbol()?.to_owned(), rows);
        Ok(())
    }

    fn add_order(&mut self, record: &Record<'_>) -> Result<(), DataError> {
        let Some((types, names)) = record.things().split_first() else {
            return Err(record.node().expected("(order (type …) grasp …)"));
        };
        let names = names.iter().map(|n| n.symbol().map(str::to_owned));
        let names: Vec<String> = names.collect::<Result<_, _>>()?;
        for name in types.symbols()? {
            self.order.insert(name.to_owned(), names.clone());
        }
        Ok(())
    }

    fn add_grasp(&mut self, record: &Record<'_>) -> Result<(), DataError> {
        let name = record.thing("name")?.symbol()?;
        let numbers = |key: &str| record.required(key)?.numbers::<3>();
        let rotation = record.required("rotation")?;
        let definition = GraspDefinition {
            translation: numbers("translation")?,
            rotation: match rotation.symbol() {
                Ok(name) => self.rotation(name).ok_or_else(|| {
                    let names = self.rotations.keys().map(String::as_str);
                    rotation.unknown("rotation", name, closest_name(name, names))
                })?,
                Err(_) => rotation_rows(rotation)?,
            },
            pregrasp: numbers("pregrasp")?,
            second_pregrasp: numbers("second-pregrasp")?,
            lift: numbers("lift")?,
            second_lift: numbers("second-lift")?,
        };
        let types = record.required("types")?.symbols()?;
        for arm in record.required("arms")?.list()? {
            let side = Side::named(arm.symbol()?).ok_or_else(|| arm.expected("left or right"))?;
            for object_type in &types {
                let key = ((*object_type).to_owned(), side, name.to_owned());
                if self.grasps.insert(key, definition.clone()).is_some() {
                    let what = format!("the grasp {name} of {object_type} with the {side} arm");
                    return Err(record.node().error(DataProblem::Repeated(what)));
                }
            }
        }
        Ok(())
    }
}

fn grip(record: &Record<'_>) -> Result<Grip, DataError> {
    Ok(Grip {
        effort: record.required("effort")?.positive()?,
        opening: record.required("opening")?.positive()?,
    })
}

fn rotation_rows(node: Node<'_>) -> Result<[[f64; 3]; 3], DataError> {
    let wrong = || node.expected("the three rows of a rotation matrix");
    let rows = node.list().map_err(|_| wrong())?;
    let rows = rows.iter().map(Node::numbers::<3>);
    let rows: Vec<[f64; 3]> = rows.collect::<Result<_, _>>()?;
    let rotation = <[[f64; 3]; 3]>::try_from(rows).map_err(|_| wrong())?;
    let probe = GraspDefinition {
        translation: [0.0; 3],
        rotation,
        pregrasp: [0.0; 3],
        second_pregrasp: [0.0; 3],
        lift: [0.0; 3],
        second_lift: [0.0; 3],
    };
    let sound = probe.orientation();
    sound.map_err(|e| node.error(DataProblem::Invalid(e.to_string())))?;
    Ok(rotation)
}

//! How objects are grasped: where the hand goes, how hard it grips, which grasp is tried first.
//!
//! Names are lower-case and without a colon: type `bottle`, grasp `left-side`. The built-in
//! library is `world/grasps.sexp`; plans add and override grasps at run time.

use indexmap::IndexMap;

use crate::robot::Side;
use crate::sexp::{DataError, DataFile, DataProblem, Node, Record};
use closest_name::closest_name;

pub use super::grasp_definition::{GraspDefinition, Lift, NotARotation, ToolPoses};
/// The text of the built-in library, `world/grasps.sexp`.
pub use descriptions::GRASPS;

/// Above all third components of the directions in which a hand approaches from above, 45 degrees off
/// the vertical at most (-0.707).
const MIN_DOWN: f64 = -0.7;

/// How hard to grip, and how wide to open beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// Effort (N).
    pub effort: f64,
    /// Opening (m).
    pub opening: f64,
}

/// The grasps, grips and named rotations.
#[derive(Clone, Debug, PartialEq)]
pub struct GraspLibrary {
    rotations: IndexMap<String, [[f64; 3]; 3]>,
    default_grip: Grip,
    grips: IndexMap<String, Grip>,
    /// Names of grasps by type, in the order in which they are tried.
    order: IndexMap<String, Vec<String>>,
    /// By type, arm and name.
    grasps: IndexMap<(String, Side, String), GraspDefinition>,
    /// What stands for some of these with the hands of the robot.
    fitted: IndexMap<(String, Side, String), GraspDefinition>,
    /// Why no hand can grasp objects of a type.
    refusals: IndexMap<String, String>,
}

/// The records of a library, each with its keys.
pub(super) const GRASP_RECORDS: &[(&str, &[&str])] = &[
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
            "opening",
        ],
    ),
];

impl GraspLibrary {
    /// A library without grasps.
    pub fn empty() -> Self {
        Self {
            rotations: IndexMap::new(),
            default_grip: Grip {
                effort: 0.0,
                opening: 0.0,
            },
            grips: IndexMap::new(),
            order: IndexMap::new(),
            grasps: IndexMap::new(),
            fitted: IndexMap::new(),
            refusals: IndexMap::new(),
        }
    }

    /// Reads a library; `file_name` is used only in errors.
    pub fn from_sexp(text: &str, file_name: &str) -> Result<Self, DataError> {
        let file = DataFile::read(text, file_name)?;
        let mut library = Self::empty();
        let mut has_default = false;
        for node in file.nodes() {
            let record = node.record("record", GRASP_RECORDS)?;
            has_default |= record.head() == "default-grip";
            library.add_record(&record)?;
        }
        match has_default {
            true => Ok(library),
            false => Err(file.error(DataProblem::MissingRecord("default-grip".to_owned()))),
        }
    }

    /// Takes one of [`GRASP_RECORDS`].
    pub(super) fn add_record(&mut self, record: &Record<'_>) -> Result<(), DataError> {
        match record.head() {
            "rotation" => self.add_rotation(record),
            "default-grip" => {
                self.default_grip = grip(record)?;
                Ok(())
            }
            "grip" => {
                let grip = grip(record)?;
                for name in record.thing("list of types")?.symbols()? {
                    self.grips.insert(name.to_owned(), grip);
                }
                Ok(())
            }
            "order" => self.add_order(record),
            _ => self.add_grasp(record),
        }
    }

    /// Notes that the types of a record `(grasp …)` have a grasp of that name.
    pub(super) fn add_order_of(&mut self, record: &Record<'_>) -> Result<(), DataError> {
        let name = record.thing("name")?.symbol()?;
        for of in record.required("types")?.symbols()? {
            self.list(of, name);
        }
        Ok(())
    }

    /// A grasp of a type that is not listed yet is tried last.
    fn list(&mut self, object_type: &str, grasp: &str) {
        let order = self.order.entry(object_type.to_owned()).or_default();
        if !order.iter().any(|name| name == grasp) {
            order.push(grasp.to_owned());
        }
    }

    /// Drops all that is said of a type.
    pub(super) fn forget(&mut self, object_type: &str) {
        self.order.shift_remove(object_type);
        self.grips.shift_remove(object_type);
        self.refusals.shift_remove(object_type);
        self.grasps.retain(|(of, _, _), _| of != object_type);
        self.fitted.retain(|(of, _, _), _| of != object_type);
    }

    /// Sets how hard to grip objects of a type, and how wide to open beforehand.
    pub fn set_grip(&mut self, object_type: &str, grip: Grip) {
        self.grips.insert(object_type.to_owned(), grip);
    }

    /// Says why no hand can grasp objects of a type.
    pub fn refuse(&mut self, object_type: &str, why: String) {
        self.refusals.insert(object_type.to_owned(), why);
    }

    /// Why no hand can grasp objects of a type, if its shape was looked at in vain.
    pub fn refusal(&self, object_type: &str) -> Option<&str> {
        self.refusals.get(object_type).map(String::as_str)
    }

    /// Whether a grip is said for a type.
    pub fn has_grip(&self, object_type: &str) -> bool {
        self.grips.contains_key(object_type)
    }

    /// The names of all grasps, of any type.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.grasps.keys().map(|(_, _, name)| name.as_str())
    }

    /// The grasps of a type in the order in which they are tried; empty for an unknown type.
    pub fn grasps(&self, object_type: &str) -> &[String] {
        self.order.get(object_type).map_or(&[], Vec::as_slice)
    }

    /// The grasps of a type by which a hand comes from above, straight or at up to 45 degrees, in the
    /// order in which they are defined: also those that are not tried unless they are asked for.
    pub fn grasps_from_above(&self, object_type: &str) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for ((kind, _, name), definition) in &self.grasps {
            // The hand approaches along the third column.
            let is_downward = definition.rotation[2][2] < MIN_DOWN;
            if kind == object_type && is_downward && !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        names
    }

    /// The grasp with that name for objects of that type with that arm.
    pub fn get(&self, object_type: &str, arm: Side, grasp: &str) -> Option<&GraspDefinition> {
        let key = (object_type.to_owned(), arm, grasp.to_owned());
        self.fitted.get(&key).or_else(|| self.grasps.get(&key))
    }

    /// Lets other definitions stand for some of the grasps that are known now; those that did so before do no
    /// longer. `fitted` is asked for each of them, with its type, its arm and how wide (m) the hand opens.
    pub(crate) fn fit(
        &mut self,
        fitted: impl Fn(&str, Side, &GraspDefinition, f64) -> Option<GraspDefinition>,
    ) {
        let all = self.grasps.iter().filter_map(|(key, definition)| {
            let (kind, side, _) = key;
            let opening = self.opening(kind, definition);
            Some((key.clone(), fitted(kind, *side, definition, opening)?))
        });
        self.fitted = all.collect();
    }

    /// Effort and opening for a type.
    pub fn grip(&self, object_type: &str) -> Grip {
        let grip = self.grips.get(object_type).copied();
        grip.unwrap_or(self.default_grip)
    }

    /// How wide (m) the hand opens for a grasp of a type.
    pub fn opening(&self, object_type: &str, grasp: &GraspDefinition) -> f64 {
        grasp.opening.unwrap_or(self.grip(object_type).opening)
    }

    /// The rows of the rotation with that name.
    pub fn rotation(&self, name: &str) -> Option<[[f64; 3]; 3]> {
        self.rotations.get(name).copied()
    }

    /// Adds a grasp, or replaces the one that the type has under that name for that arm. A
    /// new name is tried last.
    pub fn define(
        &mut self,
        object_type: &str,
        arm: Side,
        grasp: &str,
        definition: GraspDefinition,
    ) -> Result<(), NotARotation> {
        definition.orientation()?;
        self.list(object_type, grasp);
        // What somebody says counts more than what the shape seemed to say.
        self.refusals.shift_remove(object_type);
        let key = (object_type.to_owned(), arm, grasp.to_owned());
        self.fitted.shift_remove(&key);
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
            lift: Lift::along_object(numbers("lift")?),
            second_lift: Lift::along_object(numbers("second-lift")?),
            opening: record
                .optional("opening")
                .map(|n| n.positive())
                .transpose()?,
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
        lift: Lift::along_object([0.0; 3]),
        second_lift: Lift::along_object([0.0; 3]),
        opening: None,
    };
    let sound = probe.orientation();
    sound.map_err(|e| node.error(DataProblem::Invalid(e.to_string())))?;
    Ok(rotation)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{UnitQuaternion, Vector3};
    use spatial::Pose;
    use spatial::pose::from_xyz_rpy;

    fn library() -> GraspLibrary {
        GraspLibrary::from_sexp(GRASPS, "grasps.sexp").expect("the built-in library is right")
    }

    fn definition(rotation: [[f64; 3]; 3]) -> GraspDefinition {
        GraspDefinition {
            translation: [0.0; 3],
            rotation,
            pregrasp: [0.0; 3],
            second_pregrasp: [0.0; 3],
            lift: Lift::along_object([0.0; 3]),
            second_lift: Lift::along_object([0.0; 3]),
            opening: None,
        }
    }

    /// A gripper frame whose z axis is the tool's x axis, like the PR2's.
    fn tool_axes() -> UnitQuaternion<f64> {
        let turn = definition([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
        turn.orientation().expect("a rotation")
    }

    fn place(pose: &Pose) -> [f64; 3] {
        // To the nanometre, without a negative zero.
        let rounded = |x: f64| (x * 1e9).round() / 1e9 + 0.0;
        [0, 1, 2].map(|i| rounded(pose.translation.vector[i]))
    }

    #[test]
    fn grasps_are_listed_in_crams_order() {
        let library = library();
        assert_eq!(
            library.grasps("bottle"),
            ["left-side", "right-side", "back", "front"]
        );
        assert_eq!(
            library.grasps("cup"),
            ["back", "front", "left-side", "right-side"]
        );
        assert!(library.grasps("bread").is_empty());
    }

    #[test]
    fn grasps_from_above_need_not_be_listed() {
        let library = library();
        assert_eq!(
            library.grasps_from_above("cup"),
            [
                "top",
                "top-around",
                "top-around-left",
                "top-around-low",
                "top-around-left-low"
            ]
        );
        assert_eq!(
            library.grasps_from_above("spoon"),
            ["top", "top-back", "top-front"]
        );
        assert_eq!(library.grasps("spoon"), ["top"]);
        assert_eq!(
            library.grasps_from_above("bowl"),
            ["top", "top-front", "top-left", "top-right"]
        );
        assert_eq!(
            library.grasps_from_above("milk"),
            [
                "back-above",
                "left-side-above",
                "right-side-above",
                "front-above"
            ]
        );
        assert!(library.grasps_from_above("tray-base").is_empty());
    }

    #[test]
    fn every_listed_grasp_is_defined_for_an_arm_except_that_of_the_tray() {
        let library = library();
        for (object_type, names) in &library.order {
            for name in names {
                let defined = Side::BOTH.map(|s| library.get(object_type, s, name).is_some());
                let expected = (object_type.as_str(), name.as_str()) != ("tray", "right-side");
                assert_eq!(defined.contains(&true), expected, "{object_type} {name}");
            }
        }
    }

    #[test]
    fn a_bottle_is_approached_from_its_left() {
        let library = library();
        let grasp = library
            .get("bottle", Side::Right, "left-side")
            .expect("defined");
        let bottle = from_xyz_rpy([1.0, 2.0, 3.0], [0.0; 3]);
        let poses = grasp.tool_poses(&bottle, &tool_axes()).expect("a rotation");
        assert_eq!(place(&poses.pregrasp), [1.0, 2.13, 3.155]);
        assert_eq!(place(&poses.second_pregrasp), [1.0, 2.13, 3.005]);
        assert_eq!(place(&poses.grasp), [1.0, 1.98, 3.005]);
        assert_eq!(place(&poses.lift), [1.0, 1.98, 3.155]);
        assert_eq!(place(&poses.second_lift), [1.0, 1.98, 3.155]);
        // The tool points along -y, with its z axis up.
        let axes = [Vector3::x(), Vector3::z()].map(|axis| poses.grasp.rotation * axis);
        assert!((axes[0] + Vector3::y()).norm() < 1e-12);
        assert!((axes[1] - Vector3::z()).norm() < 1e-12);
    }

    #[test]
    fn hands_come_from_where_their_pregrasps_are() {
        let library = library();
        for ((object_type, side, name), grasp) in &library.grasps {
            let hand = grasp.orientation().expect("a rotation") * Vector3::z();
            let offset = Vector3::from(grasp.second_pregrasp);
            assert!(
                hand.dot(&offset) < 0.0,
                "{name} of {object_type} with the {side} arm"
            );
        }
    }

    #[test]
    fn offsets_are_along_the_axes_of_the_object() {
        let library = library();
        let grasp = library
            .get("bottle", Side::Left, "left-side")
            .expect("defined");
        let lying = from_xyz_rpy([0.0; 3], [std::f64::consts::FRAC_PI_2, 0.0, 0.0]);
        let poses = grasp.tool_poses(&lying, &tool_axes()).expect("a rotation");
        let lift = poses.lift.translation.vector - poses.grasp.translation.vector;
        assert!((lift + Vector3::new(0.0, 0.15, 0.0)).norm() < 1e-12);
    }

    #[test]
    fn a_lift_in_the_base_leads_upwards_however_the_object_lies() {
        let mut grasp = definition([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]);
        grasp.lift.in_base = Pose::translation(0.0, 0.0, 0.1);
        grasp.second_lift = Lift {
            offset: [0.0, 0.05, 0.0],
            in_base: Pose::translation(0.0, 0.0, 0.2),
        };
        let lying = from_xyz_rpy([1.0, 0.0, 0.5], [std::f64::consts::FRAC_PI_2, 0.0, 0.0]);
        let poses = grasp.tool_poses(&lying, &tool_axes()).expect("a rotation");
        assert_eq!(place(&poses.lift), [1.0, 0.0, 0.6]);
        assert_eq!(place(&poses.second_lift), [1.0, 0.0, 0.75]);
        assert!(poses.lift.rotation.angle_to(&poses.grasp.rotation) < 1e-12);
    }

    #[test]
    fn grips_fall_back_to_the_default() {
        let library = library();
        let grip = |effort, opening| Grip { effort, opening };
        assert_eq!(library.grip("bottle"), grip(60.0, 0.1));
        assert_eq!(library.grip("fork"), grip(100.0, 0.04));
        assert_eq!(library.grip("bread"), grip(35.0, 0.1));
    }

    #[test]
    fn a_new_grasp_is_tried_last_and_an_old_one_is_overridden() {
        let mut library = library();
        // The tutorial's diagonal grasp, whose matrix is accurate to four digits only.
        let s = 7071.0 / 10_000.0;
        let diagonal = definition([[s, 0.0, -s], [-s, 0.0, -s], [0.0, 1.0, 0.0]]);
        for _ in 0..2 {
            let defined = library.define("bottle", Side::Left, "fl-diagonal", diagonal.clone());
            assert_eq!(defined, Ok(()));
        }
        assert_eq!(library.grasps("bottle").len(), 5);
        assert_eq!(library.grasps("bottle")[4], "fl-diagonal");
        assert_eq!(
            library.get("bottle", Side::Left, "fl-diagonal"),
            Some(&diagonal)
        );
        assert_eq!(library.get("bottle", Side::Right, "fl-diagonal"), None);
        let orientation = diagonal.orientation().expect("close enough to a rotation");
        assert!((orientation.norm() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_matrix_that_mirrors_is_refused() {
        let mirror = definition([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]);
        let mut library = library();
        let refused = library.define("bottle", Side::Left, "mirror", mirror.clone());
        assert_eq!(refused, Err(NotARotation(mirror.rotation)));
        assert_eq!(library.get("bottle", Side::Left, "mirror"), None);
        let nothing = definition([[f64::NAN; 3]; 3]);
        assert!(nothing.orientation().is_err());
    }

    #[test]
    fn mistakes_are_reported_with_their_place() {
        let error = |text: &str| match GraspLibrary::from_sexp(text, "g.sexp") {
            Ok(_) => "no error".to_owned(),
            Err(error) => error.to_string(),
        };
        assert_eq!(
            error(""),
            "g.sexp:1:1: the file has no (default-grip …); add one"
        );
        assert_eq!(
            error("(rotation r ((1 0 0) (0 1 0)))"),
            "g.sexp:1:13: expected the three rows of a rotation matrix, found ((1 0 0) (0 1 0))"
        );
        assert_eq!(
            error(
                "(rotation up ((1 0 0) (0 1 0) (0 0 1)))\n(grasp g :rotation upp
                   :translation (0 0 0) :types (a) :arms (left))"
            ),
            "g.sexp:2:20: there is no rotation named upp; did you mean up?"
        );
    }
}

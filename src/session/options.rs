//! What a session starts with.

use std::path::Path;
use std::sync::Arc;

use closest_name::closest_name;
use descriptions::{KITCHEN_URDF, PR2_DESCRIPTION, PR2_URDF, ROBOTS, robot_named};
use kitchens::{Kitchen, LayoutError, Published, Settings};
use thiserror::Error;

use super::log_level::LogLevel;
use super::mesh_files::SessionMeshes;
use super::outside::Outside;
use lisp::guard::heap::HeapLimit;
use robotics::mesh::MeshLibrary;
use robotics::robot::{
    DerivedRobot, KinematicTree, MissingNames, PostureSample, RobotDescription, Srdf, UrdfReading,
    UrdfUse,
};
use robotics::sexp::DataError;
use robotics::world::noise::NoiseLevels;
use robotics::world::object_library::{OBJECTS, ObjectLibrary};
use robotics::world::self_touching::SelfTouching;
use robotics::world::{KitchenDescription, Models};

/// What a session starts with.
#[derive(Clone, Debug)]
pub struct SessionOptions {
    /// Seed of everything random.
    pub seed: u64,
    /// Name and text of a URDF in place of the built-in robot's.
    pub robot: Option<(String, String)>,
    /// Name and text of a description of the robot's links and joints, in place of the
    /// built-in robot's.
    pub robot_description: Option<(String, String)>,
    /// Name and text of a URDF in place of the built-in kitchen's.
    pub world: Option<(String, String)>,
    /// Name and text of a description of the kitchen's furniture. Without one, what of the built-in
    /// kitchen's description names only furniture that is there is true of a given kitchen, too.
    pub world_description: Option<(String, String)>,
    /// What is to be said of the kitchen at the start, besides what its URDF gives reason to.
    pub world_remarks: Vec<String>,
    /// Name and text of a file with further types of objects.
    pub objects: Option<(String, String)>,
    /// Folders in which the packages are that URDFs name in `package://…`, or which are such packages;
    /// the folders around a URDF are looked through, too.
    pub package_paths: Vec<String>,
    /// The folder in which is kept what meshes are made into, so that it need not be made again; nothing
    /// is kept if `None`.
    pub mesh_cache: Option<String>,
    /// How large the errors of the robot's sensors and motors are, such as
    /// `position=0.01,misses=0.1`; an empty text stands for usual errors, `None` for none.
    pub noise: Option<String>,
    /// Whether no joint moves faster than its URDF says.
    pub is_faithful: bool,
    /// Folders in which systems, the libraries of Common Lisp, are looked for.
    pub systems: Vec<String>,
    /// The least severe log lines that are shown.
    pub log_level: LogLevel,
    /// How many simulated seconds pass per real second; as many as possible if `None`.
    pub realtime: Option<f64>,
    /// The port of the live view; any that is free if `None`.
    pub view_port: Option<u16>,
    /// How much memory may be in use before a condition `HEAP-EXHAUSTED-ERROR` is signalled; as
    /// much as there is if `None`, and then the process is aborted.
    pub heap: Option<HeapLimit>,
    /// Files, and a clock.
    pub outside: Outside,
}

impl Default for SessionOptions {
    fn default() -> SessionOptions {
        SessionOptions {
            seed: 0,
            robot: None,
            robot_description: None,
            world: None,
            world_description: None,
            world_remarks: Vec::new(),
            objects: None,
            package_paths: Vec::new(),
            mesh_cache: None,
            noise: None,
            is_faithful: false,
            systems: Vec::new(),
            log_level: LogLevel::Info,
            realtime: None,
            view_port: None,
            heap: None,
            outside: Outside::default(),
        }
    }
}

/// What begins the name of a generated kitchen; its seed follows.
const GENERATED: &str = "generated:";

/// Whether a kitchen is one that is generated, rather than a file.
pub fn is_generated(world: &Path) -> bool {
    world
        .to_str()
        .is_some_and(|world| world.starts_with(GENERATED))
}

/// Whether a robot is one that comes with planwright, rather than a file.
pub fn is_shipped_robot(robot: &Path) -> bool {
    robot.to_str().and_then(robot_named).is_some()
}

/// Whether what an option names is no file: a generated kitchen, or a robot that comes with planwright.
pub fn is_built_in(name: &Path) -> bool {
    is_generated(name) || is_shipped_robot(name)
}

impl SessionOptions {
    /// Has the session begin with the robot of that name that comes with planwright.
    ///
    /// # Errors
    ///
    /// There is none of that name.
    pub fn set_shipped_robot(&mut self, name: &str) -> Result<(), SessionError> {
        let robot = robot_named(name).ok_or_else(|| {
            let names: Vec<&str> = ROBOTS.iter().map(|robot| robot.name).collect();
            let near = closest_name(name, names.iter().copied());
            SessionError::Models(match near {
                Some(near) => format!("there is no robot {name}; did you mean {near}?"),
                None => format!(
                    "there is no robot {name}: planwright has {}",
                    names.join(", ")
                ),
            })
        })?;
        let file = |ending: &str| format!("{}.{ending}", robot.name);
        self.robot = Some((file("urdf"), robot.urdf.to_owned()));
        if self.robot_description.is_none() {
            self.robot_description = Some((file("sexp"), robot.description.to_owned()));
        }
        Ok(())
    }

    /// Has the session begin in the kitchen of a layout of RoboCasa, of a name and a text.
    ///
    /// # Errors
    ///
    /// The layout is wrong; the error names the file and the line.
    pub fn set_layout(&mut self, name: &str, text: &str) -> Result<(), SessionError> {
        self.set_published(name, Published::of_layout(text))
    }

    /// Has the session begin in the kitchen of a house of ProcTHOR, of a name and a text. The database of assets has the
    /// sizes of what stands there.
    ///
    /// # Errors
    ///
    /// The house is wrong, or has no kitchen; the error names the file and the line.
    pub fn set_house(&mut self, name: &str, text: &str, assets: &str) -> Result<(), SessionError> {
        self.set_published(name, Published::of_house(text, assets))
    }

    fn set_published(
        &mut self,
        name: &str,
        kitchen: Result<Published, LayoutError>,
    ) -> Result<(), SessionError> {
        let kitchen = kitchen.map_err(|error| SessionError::Models(format!("{name}: {error}")))?;
        self.world = Some((name.to_owned(), kitchen.urdf));
        if self.world_description.is_none() {
            self.world_description = Some((name.to_owned(), kitchen.description));
        }
        let remarks = kitchen.remarks.iter();
        self.world_remarks = remarks.map(|remark| format!("{name}: {remark}")).collect();
        Ok(())
    }

    /// Has the session begin in the generated kitchen with a name such as `generated:7`, or
    /// `generated:7,table=nil,counter-height=0.9` for one with parameters that are set.
    ///
    /// # Errors
    ///
    /// The name has no seed, a parameter is wrong, or there is no such kitchen.
    pub fn set_generated_world(&mut self, name: &str) -> Result<(), SessionError> {
        let mut parts = name.strip_prefix(GENERATED).unwrap_or_default().split(',');
        let seed = parts.next().and_then(|seed| seed.parse().ok());
        let seed: u64 = seed.ok_or_else(|| {
            SessionError::Models(format!(
                "{name} names no generated kitchen: {GENERATED}SEED was expected, with a whole number from 0 to {}",
                u64::MAX
            ))
        })?;
        let mut settings = Settings::default();
        for part in parts {
            let Some((name, value)) = part.split_once('=') else {
                return Err(SessionError::Models(format!(
                    "{part:?} sets no parameter of a kitchen: NAME=VALUE was expected, as in {GENERATED}{seed},table=nil"
                )));
            };
            let set = settings.set_text(name, value);
            set.map_err(|error| SessionError::Models(error.to_string()))?;
        }
        let kitchen = Kitchen::with(seed, &settings)
            .map_err(|impossible| SessionError::Models(impossible.to_string()))?;
        self.world = Some((name.to_owned(), kitchen.urdf));
        if self.world_description.is_none() {
            self.world_description = Some((name.to_owned(), kitchen.description));
        }
        Ok(())
    }
}

/// Why a session cannot start.
#[derive(Debug, Error)]
pub enum SessionError {
    /// A description of the robot, the kitchen or the objects is wrong.
    #[error("{0}")]
    Models(String),
    /// A robot was given without a description, and the built-in one does not fit it.
    #[error(
        "{robot} lacks {missing}, which the built-in description of the PR2 names: say with \
         --robot-description FILE what its links and joints are for; planwright describe-robot \
         {robot} writes such a file"
    )]
    Undescribed {
        /// The robot's file.
        robot: String,
        /// What it lacks.
        missing: String,
    },
    /// The noise that was asked for cannot be.
    #[error("{0}")]
    Noise(String),
    /// A built-in plan is wrong.
    #[error("the built-in plan {name} cannot be loaded: {report}")]
    Plan {
        /// The file.
        name: String,
        /// What is wrong.
        report: String,
    },
}

impl SessionOptions {
    /// How large the robot's errors are.
    pub(super) fn noise_levels(&self) -> Result<Option<NoiseLevels>, SessionError> {
        let levels = self.noise.as_deref().map(NoiseLevels::from_text);
        levels
            .transpose()
            .map_err(|error| SessionError::Noise(error.to_string()))
    }

    /// Reads the descriptions of robot, kitchen and objects.
    pub(super) fn models(&self) -> Result<Models, SessionError> {
        let robot = self.tree(&self.robot, [PR2_URDF, "pr2.urdf"], UrdfUse::Robot)?;
        let kitchen = self.tree(&self.world, [KITCHEN_URDF, "kitchen.urdf"], UrdfUse::World)?;
        let remarks = [robot.remarks, kitchen.remarks].concat();
        let (robot, kitchen) = (robot.tree, kitchen.tree);
        let description = self.description(&robot)?;
        let furnishing = self.furnishing(&kitchen)?;
        let objects = ObjectLibrary::from_sexp(OBJECTS, "objects.sexp")
            .map_err(|e| SessionError::Models(e.to_string()))?;
        let mut models = Models::new(robot, description, kitchen, furnishing, objects);
        models.remarks = remarks;
        Ok(models)
    }

    /// A description of the robot's links and joints that follows from its URDF, with comments on what
    /// is assumed or missing.
    ///
    /// # Errors
    ///
    /// If the URDF cannot be read.
    pub fn derived_description(&self) -> Result<String, SessionError> {
        self.derived_with(&Srdf::default())
    }

    /// Like [`Self::derived_description`], with what an SRDF of a name and a text says: which links may touch, and
    /// postures.
    ///
    /// # Errors
    ///
    /// If the URDF or the SRDF cannot be read, or the SRDF says nothing of these.
    pub fn derived_description_with_srdf(
        &self,
        name: &str,
        text: &str,
    ) -> Result<String, SessionError> {
        let srdf = Srdf::read(text, name);
        let srdf = srdf.map_err(|error| SessionError::Models(error.to_string()))?;
        if srdf == Srdf::default() {
            return Err(SessionError::Models(format!(
                "{name}: nothing says which links may touch (<disable_collisions link1=… link2=…>), or how postures are \
                 (<group_state name=… group=…>): is it an SRDF?"
            )));
        }
        self.derived_with(&srdf)
    }

    fn derived_with(&self, srdf: &Srdf) -> Result<String, SessionError> {
        let tree = self
            .tree(&self.robot, [PR2_URDF, "pr2.urdf"], UrdfUse::Robot)?
            .tree;
        let touching = SelfTouching::new(&tree, PostureSample::default());
        Ok(DerivedRobot::of(&tree, &touching, srdf).text(&tree))
    }

    /// Reads the tree in a URDF that is given as its name and text, or in the one that is built in.
    fn tree(
        &self,
        given: &Option<(String, String)>,
        [text, name]: [&str; 2],
        usage: UrdfUse,
    ) -> Result<UrdfReading, SessionError> {
        let read = match given {
            Some((name, text)) => {
                let files = SessionMeshes {
                    files: Arc::clone(&self.outside.files),
                    kept_in: self.mesh_cache.clone(),
                };
                let path = name.replace('\\', "/");
                let meshes = MeshLibrary::new(&files, &path, &self.package_paths);
                KinematicTree::read_urdf(text, name, &meshes, usage)
            }
            None => KinematicTree::built_in(text, name).map(|tree| UrdfReading {
                tree,
                remarks: Vec::new(),
            }),
        };
        read.map_err(|error| SessionError::Models(error.to_string()))
    }

    /// Reads the description of the kitchen's furniture.
    fn furnishing(&self, kitchen: &KinematicTree) -> Result<KitchenDescription, SessionError> {
        let description = match &self.world_description {
            Some((name, text)) => KitchenDescription::from_sexp(text, name, kitchen),
            None => KitchenDescription::built_in(kitchen),
        };
        description.map_err(|error| SessionError::Models(error.to_string()))
    }

    /// The description of the robot's links and joints, at the speeds that were asked for.
    fn description(&self, robot: &KinematicTree) -> Result<RobotDescription, SessionError> {
        let description = self.read_description(robot)?;
        Ok(match self.is_faithful {
            true => description.as_fast_as_urdf(robot),
            false => description,
        })
    }

    /// Reads the description of the robot's links and joints.
    fn read_description(&self, robot: &KinematicTree) -> Result<RobotDescription, SessionError> {
        let wrong = |error: DataError| SessionError::Models(error.to_string());
        if let Some((name, text)) = &self.robot_description {
            return RobotDescription::from_sexp(text, name, robot).map_err(wrong);
        }
        let name = "pr2.sexp";
        if let Some((file, _)) = &self.robot {
            let missing = MissingNames::of(PR2_DESCRIPTION, name, robot).map_err(wrong)?;
            if !missing.is_empty() {
                return Err(SessionError::Undescribed {
                    robot: file.clone(),
                    missing: missing.to_string(),
                });
            }
        }
        RobotDescription::from_sexp(PR2_DESCRIPTION, name, robot).map_err(wrong)
    }
}

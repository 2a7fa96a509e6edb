//! Defining types of objects.

use std::sync::Arc;

use super::object_record::record;
use super::prompt::install_topics;
use crate::log_level::LogLevel;
use crate::mesh_files::SessionMeshes;
use crate::simulation::Simulation;
use crate::simulation::names::{type_keyword, type_text, type_text_of};
use cram::designator::vocabulary::{Domain, Vocabulary};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::mesh::MeshLibrary;
use robotics::motion::ShapeGrasps;
use robotics::sexp::DataError;
use robotics::world::object_definitions::{DefinedType, Grasping, ObjectDefinitions};

/// The tags of log lines about types of objects.
const TAGS: &str = "(PLANWRIGHT DEF-OBJECT-TYPE)";

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![
    define_object_type,
    load_object_types,
    ungraspable,
    mesh_files
];

/// Defines a type of objects; FILE is a file beside which meshes are, or NIL.
#[builtin("%DEFINE-OBJECT-TYPE", edit)]
fn define_object_type(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
    properties: &Value,
    file: &Value,
) -> Result<Value> {
    let name = type_text_of(image, name)?;
    let text = record(image, &name, properties)?;
    let path = match file {
        Value::Str(path) => path.text(),
        _ => simulation.meshes.source.clone(),
    };
    simulation.define_object(image, &name, &text, &path)?;
    Ok(type_keyword(image, &name))
}

impl Simulation {
    /// Defines the type that a record describes.
    pub(crate) fn define_object(
        &mut self,
        image: &mut Image,
        name: &str,
        record: &str,
        path: &str,
    ) -> Result<()> {
        let defined = self.define_objects(image, record, name, path);
        let wrong = |problem| {
            let name = name.to_uppercase();
            Raise::simple(format!("The type of objects {name} is wrong: {problem}."))
        };
        defined.map_err(|error| wrong(error.problem)).map(|_| ())
    }
}

/// The files of meshes in a folder of a package: types and paths.
#[builtin("%MESH-FILES")]
fn mesh_files(
    simulation: &mut Simulation,
    image: &mut Image,
    package: &Value,
    folder: &Value,
    extension: &Value,
) -> Vec<Value> {
    let text = |value: &Value| match value {
        Value::Str(text) => text.text(),
        other if other.is_true() => print::to_string(image, other, false).to_lowercase(),
        _ => String::new(),
    };
    let [package, folder, extension] = [package, folder, extension].map(text);
    let mut found = Vec::new();
    let folders = simulation.meshes.package_paths.iter().map(String::as_str);
    for place in folders.chain(["."]) {
        let place = place.trim_end_matches('/');
        let is_package = place.rsplit('/').next() == Some(package.as_str());
        let inner = (!is_package).then_some(package.as_str());
        let parts = [Some(place), inner, Some(folder.as_str())];
        let parts = parts.into_iter().flatten().filter(|part| !part.is_empty());
        let path = parts.collect::<Vec<_>>().join("/");
        let mut names = image.files.names(&path).unwrap_or_default();
        names.sort_unstable();
        found.extend(names.iter().filter_map(|file| {
            let (name, ending) = file.rsplit_once('.')?;
            let ending = ending.to_lowercase();
            let is_wanted = match extension.as_str() {
                "" => ["stl", "dae", "obj"].contains(&ending.as_str()),
                wanted => wanted == ending,
            };
            is_wanted.then(|| {
                [
                    name.to_lowercase().replace('_', "-"),
                    format!("{path}/{file}"),
                ]
            })
        }));
    }
    let found = found.into_iter();
    let found =
        found.map(|[name, path]| Value::list([type_keyword(image, &name), Value::string(path)]));
    found.collect()
}

/// Why no hand can grasp objects of a type, or NIL if that is not known.
#[builtin("%UNGRASPABLE", "type")]
fn ungraspable(simulation: &mut Simulation, image: &mut Image, kind: &Value) -> Option<Value> {
    let kind = type_text(image, kind).unwrap_or_default();
    simulation.grasp_library().refusal(&kind).map(Value::string)
}

/// Defines the types of objects in a file in the form of world/objects.sexp, in which shapes may be meshes,
/// too: (mesh "FILE" :scale 1). Returns the types.
#[builtin(edit)]
fn load_object_types(
    simulation: &mut Simulation,
    image: &mut Image,
    file: &Value,
) -> Result<Vec<Value>> {
    let file = match file {
        Value::Str(text) => text.text(),
        other => print::to_string(image, other, false),
    };
    let bytes = image.files.read_plan(&file);
    let text = bytes.map_err(|error| error.to_string()).and_then(|bytes| {
        String::from_utf8(bytes).map_err(|_| "it is no text in UTF-8".to_owned())
    });
    let text = text.map_err(|why| Raise::simple(format!("{file} cannot be read: {why}.")))?;
    let defined = simulation.define_objects(image, &text, &file, &file);
    let names = defined.map_err(|error| Raise::simple(format!("{error}.")))?;
    Ok(names.iter().map(|name| type_keyword(image, name)).collect())
}

impl Simulation {
    /// Reads types of objects in the form of `world/objects.sexp` and adds them to what is known; `path` is
    /// the file beside which meshes are, `name` its name in errors. Returns the names of the types.
    pub(crate) fn define_objects(
        &mut self,
        image: &mut Image,
        text: &str,
        name: &str,
        path: &str,
    ) -> std::result::Result<Vec<String>, DataError> {
        let files = SessionMeshes {
            files: Arc::clone(&image.files),
            kept_in: self.meshes.kept_in.clone(),
        };
        let path = path.replace('\\', "/");
        let meshes = MeshLibrary::new(&files, &path, &self.meshes.package_paths);
        let known = &self.models.objects;
        let definitions = ObjectDefinitions::read(text, name, &meshes, known, &self.grasps)?;
        let ObjectDefinitions {
            objects,
            grasps,
            defined,
        } = definitions;
        let are_new = |name: &&str| known.names().all(|known| known != *name);
        let names: Vec<String> = objects.names().filter(are_new).map(str::to_owned).collect();
        Vocabulary::of(image).add(Domain::ObjectType, names);
        self.know_objects(Arc::new(objects));
        self.grasps.change(|known| *known = grasps);
        install_topics(image, Arc::clone(&self.models));
        for one in &defined {
            self.find_grasps(image, one);
        }
        Ok(defined.into_iter().map(|one| one.name).collect())
    }

    /// Gives a type the grasps that its shape has, if it is to be grasped so.
    fn find_grasps(&mut self, image: &mut Image, defined: &DefinedType) {
        let wanted: &[String] = match &defined.grasping {
            Grasping::AsShaped => &[],
            Grasping::Among(names) => names,
            Grasping::AsDefined => return,
        };
        let models = Arc::clone(&self.models);
        let name = &defined.name;
        let Some(kind) = models.objects.get(name) else {
            return;
        };
        match ShapeGrasps::of(&models, kind, wanted) {
            Ok(found) => {
                let names = found.grasps.iter().map(|(_, name, _)| name.as_str());
                Vocabulary::of(image).add(Domain::Grasp, names);
                self.grasps.change(|library| {
                    if !library.has_grip(name) {
                        library.set_grip(name, found.grip);
                    }
                    for (side, grasp, definition) in found.grasps {
                        // Directions are at right angles, so none is refused.
                        let _ = library.define(name, side, &grasp, definition);
                    }
                });
            }
            Err(why) => {
                let text = format!("No hand can grasp a {name}: it is {why}.");
                self.grasps
                    .change(|library| library.refuse(name, why.to_string()));
                self.log(image, LogLevel::Warn, TAGS, &text);
            }
        }
    }
}

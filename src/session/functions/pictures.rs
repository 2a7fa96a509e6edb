//! Pictures at the prompt: of the world from anywhere, of what the robot's camera sees, and of
//! the floor as the base planner sees it.

use super::picture_request::PictureRequest;
use crate::audience::Audience;
use crate::host::SimulationHost;
use crate::simulation::properties::property;
use cram::designator::value::current;
use lisp::builtin::Builtin;
use lisp::files::Files;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use view::picture;
use view::picture::map_picture::add_legend;
use view::picture::{CameraPicture, FloorMap, View, camera_picture, map_scene, render};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Default files of pictures. Each picture replaces the previous one.
const PICTURE: &str = "planwright-picture.png";
const CAMERA_PICTURE: &str = "planwright-camera.png";
const MAP_PICTURE: &str = "planwright-map.png";

/// Default size of a picture in pixels.
const WIDTH: usize = 640;
const HEIGHT: usize = 480;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![picture, camera_picture, map_picture];

/// Writes the picture and queues it for display; the reply is the file's name.
fn publish(
    files: &dyn Files,
    audience: &mut Audience,
    picture: picture::Image,
    file: Option<&str>,
    usual: &str,
) -> Result<Value> {
    let png = picture.to_png();
    publish_as(png, files, audience, picture, file.unwrap_or(usual))
}

/// The same for a picture that has been encoded.
pub(super) fn publish_as(
    png: std::io::Result<Vec<u8>>,
    files: &dyn Files,
    audience: &mut Audience,
    picture: picture::Image,
    file: &str,
) -> Result<Value> {
    let written = png.and_then(|png| files.write(file, &png));
    written.map_err(|error| {
        let reason = match error.kind() {
            std::io::ErrorKind::NotFound => "there is no such directory".to_owned(),
            std::io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
            std::io::ErrorKind::IsADirectory => "it is a directory".to_owned(),
            _ => error.to_string(),
        };
        Raise::new(
            known::FILE_ERROR,
            format!("The picture cannot be written to \"{file}\": {reason}."),
        )
        .with(known::K_PATHNAME, Value::string(file))
    })?;
    audience.add_picture(picture);
    Ok(Value::string(file))
}

/// Draws the world into a PNG file and returns the file's name: `(picture ["file.png"] [view] :from place :at
/// place :fov degrees :width n :height n)`. Views are :kitchen, :top, :map, :robot, :table, :island and
/// :follow; a place is a point (x y z), a pose, or the name of an object or frame; :fov is how much is seen
/// from top to bottom. Terminals that can show it show it.
#[builtin]
fn picture(host: &mut SimulationHost, image: &mut Image, arguments: &[Value]) -> Result<Value> {
    let keys = ["VIEW", "FROM", "AT", "FOV", "WIDTH", "HEIGHT"];
    let simulation = &host.simulation;
    let request = PictureRequest::of(image, arguments, &keys)?;
    let view = request.view(simulation, image)?;
    let width = request.size(image, "WIDTH", WIDTH)?;
    let height = request.size(image, "HEIGHT", HEIGHT)?;
    let vertical_fov = request.field_of_view(image)?;
    let (picture, obstruction) = simulation
        .judged_picture(view, vertical_fov, width, height)
        .map_err(Raise::reporting)?;
    if let Some(obstruction) = obstruction {
        image.output.fresh_line();
        let warning = format!("Warning: {obstruction}; choose another :from.\n");
        image.output.write(&warning);
    }
    publish(
        &*image.files,
        &mut host.audience,
        picture,
        request.file.as_deref(),
        PICTURE,
    )
}

/// Draws what the robot's camera sees into a PNG file: colours, distances and segments; the object that was
/// looked for last is outlined even where it is hidden: `(camera-picture ["file.png"] :object name :width
/// n)`. Tells how much of the object is in sight, and returns the file's name.
#[builtin]
fn camera_picture(
    host: &mut SimulationHost,
    image: &mut Image,
    arguments: &[Value],
) -> Result<Value> {
    let simulation = &host.simulation;
    let request = PictureRequest::of(image, arguments, &["OBJECT", "WIDTH"])?;
    let width = request.size(image, "WIDTH", camera_picture::WIDTH)?;
    let sought = match request.get("OBJECT") {
        Some(object) => {
            let name = property(image, &current(object), "NAME");
            vec![simulation.object_named(image, name.as_ref().unwrap_or(object))?]
        }
        None => simulation.sought(),
    };
    let shown = CameraPicture::take(&simulation.world, simulation.looks(), &sought, width);
    image.output.fresh_line();
    for visibility in &shown.sought {
        image.output.write(&format!("{visibility}.\n"));
    }
    publish(
        &*image.files,
        &mut host.audience,
        shown.image,
        request.file.as_deref(),
        CAMERA_PICTURE,
    )
}

/// Draws the kitchen from above into a PNG file: the floor is green where the base may stand as the robot is
/// now, red where something is in the way: `(map-picture ["file.png"] :width n :height n)`. Returns the
/// file's name.
#[builtin]
fn map_picture(host: &mut SimulationHost, image: &mut Image, arguments: &[Value]) -> Result<Value> {
    let simulation = &host.simulation;
    let request = PictureRequest::of(image, arguments, &["WIDTH", "HEIGHT"])?;
    let width = request.size(image, "WIDTH", WIDTH)?;
    let height = request.size(image, "HEIGHT", HEIGHT)?;
    let [from, to] = View::map_area(width, height);
    let map = FloorMap::of(&simulation.world, from, to);
    let mut scene = map_scene(&simulation.world, simulation.looks(), &map);
    if let Some(axes) = simulation.axes() {
        scene.add_axes(&axes.pose, axes.size);
    }
    if let Some(map) = &simulation.location_map {
        scene.add_location_map(map);
    }
    let camera = View::Map.camera(&simulation.world, width, height);
    let camera = camera.map_err(Raise::reporting)?;
    let mut picture = render(&scene, &camera);
    add_legend(&mut picture);
    publish(
        &*image.files,
        &mut host.audience,
        picture,
        request.file.as_deref(),
        MAP_PICTURE,
    )
}

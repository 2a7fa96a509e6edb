//! The scene, and the objects that the robot looked for.

use super::Simulation;
use view::picture::{self, Obstruction, View, render};

impl Simulation {
    /// The present scene.
    pub fn scene(&self) -> picture::Scene {
        let mut scene = self.looks().scene(&self.world);
        if let Some(axes) = self.axes() {
            scene.add_axes(&axes.pose, axes.size);
        }
        if let Some(map) = &self.location_map {
            scene.add_location_map(map);
        }
        scene
    }

    /// The present picture of a view.
    pub fn picture(
        &self,
        view: View,
        width: usize,
        height: usize,
    ) -> Result<picture::Image, picture::ViewError> {
        let judged = self.judged_picture(view, None, width, height);
        judged.map(|(picture, _)| picture)
    }

    /// The same with another vertical field of view (rad), if one is given, and what keeps the
    /// picture from showing what it is meant to show.
    pub fn judged_picture(
        &self,
        view: View,
        vertical_fov: Option<f64>,
        width: usize,
        height: usize,
    ) -> Result<(picture::Image, Option<Obstruction>), picture::ViewError> {
        let mut camera = view.camera(&self.world, width, height)?;
        camera.vertical_fov = vertical_fov.unwrap_or(camera.vertical_fov);
        let obstruction = view.obstruction(&self.world, &camera);
        Ok((render(&self.scene(), &camera), obstruction))
    }

    /// The objects that the robot looked for last, or all objects if it has not looked for any.
    pub(crate) fn sought(&self) -> Vec<String> {
        let library = &self.models.objects;
        let is_sought = |object: &&robotics::world::Object| match &self.sought {
            None => true,
            Some(query) => match &query.name {
                Some(name) => name == object.name(),
                None => {
                    let of_type = |kind: &String| library.is_kind_of(object.type_name(), kind);
                    query.types.is_empty() || query.types.iter().any(of_type)
                }
            },
        };
        let sought = self.world.objects().filter(is_sought);
        sought.map(|object| object.name().to_owned()).collect()
    }
}

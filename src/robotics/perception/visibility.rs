//! How much of an object the camera sees, and what hides it.

use std::fmt;

use nalgebra::Point3;
use serde::Serialize;

use super::camera::Camera;
use super::mesh::Mesh;
use super::picture::Picture;
use super::silhouette::Silhouette;
use super::window::Window;
use crate::world::{BodyName, Object, PartKey, World, WorldError};
use spatial::{Pose, trig};

/// A side of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Border {
    /// The left border.
    Left,
    /// The right border.
    Right,
    /// The upper border.
    Above,
    /// The lower border.
    Below,
}

impl fmt::Display for Border {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Above => "upper",
            Self::Below => "lower",
        })
    }
}

/// The result of looking at an object.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Visibility {
    /// The object's name.
    pub object: String,
    /// Pixels that show the object.
    pub(crate) visible_pixels: usize,
    /// Pixels that would show the object if it were alone and the camera turned towards it.
    pub(crate) full_pixels: usize,
    /// Bodies in front of the object, each with the number of pixels that it hides, in
    /// decreasing order.
    pub(crate) occluders: Vec<(BodyName, usize)>,
    /// Share of the object (0..1) that must be in sight for the object to count as seen.
    pub needed_share: f64,
    /// The border that the object extends beyond the farthest, and by how much (rad).
    pub outside: Option<(Border, f64)>,
}

impl Visibility {
    /// Share of the object that is in sight (0..1).
    pub fn fraction(&self) -> f64 {
        share_of(self.visible_pixels, self.full_pixels)
    }

    /// The bodies in front of the object, those that hide most of it first.
    pub fn occluders(&self) -> impl Iterator<Item = &BodyName> {
        self.occluders.iter().map(|(body, _)| body)
    }

    /// Whether the object counts as seen.
    pub fn is_seen(&self) -> bool {
        self.fraction() >= self.needed_share
    }
}

impl fmt::Display for Visibility {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = (self.fraction() * 100.0).floor();
        write!(f, "{percent} % of {} is in sight", self.object)?;
        if let Some((border, angle)) = self.outside {
            let degrees = angle.to_degrees();
            write!(
                f,
                ", it reaches {degrees:.1} degrees beyond the {border} border of the image"
            )?;
        }
        for (i, (body, pixels)) in self.occluders.iter().enumerate() {
            let lead = if i == 0 { ", hidden by" } else { " and" };
            write!(f, "{lead} {body} ({pixels} pixels)")?;
        }
        Ok(())
    }
}

/// The surfaces of an object at a pose (map frame), each with its own.
fn surfaces(object: &Object, pose: &Pose) -> Vec<(Pose, Mesh)> {
    let shapes = object.shapes().iter();
    shapes
        .map(|placed| (pose * placed.pose, Mesh::of(&placed.shape)))
        .collect()
}

/// The pixels in which surfaces may be seen, each at its pose (map frame).
fn window_of(surfaces: &[(Pose, Mesh)], camera: &Camera) -> Window {
    let corners = surfaces
        .iter()
        .flat_map(|(pose, mesh)| mesh.corners.iter().map(move |corner| pose * corner));
    Window::around(camera, corners)
}

/// The pixels that would show surfaces, of an object at a pose (map frame), if there were nothing else and the
/// camera were turned towards the object.
fn full_pixels(camera: &Camera, pose: &Pose, surfaces: &[(Pose, Mesh)]) -> usize {
    let turned = camera.turned_to(&Point3::from(pose.translation.vector));
    Silhouette::of(&turned, window_of(surfaces, &turned), surfaces).count()
}

/// The share (0..1) of an object's pixels that show it.
fn share_of(visible: usize, full: usize) -> f64 {
    match full {
        0 => 0.0,
        full => (visible as f64 / full as f64).min(1.0),
    }
}

/// What is seen in one direction.
pub(crate) struct Glance {
    /// How far away it is (m along the camera's z); `None` if nothing is seen.
    pub depth: Option<f64>,
    /// How far away the point is at which the camera looks.
    pub wanted: f64,
    /// The body that is seen.
    pub key: Option<PartKey>,
}

/// One look at the world.
pub struct Sight<'w> {
    world: &'w World,
    picture: Picture,
    needed_share: f64,
}

impl<'w> Sight<'w> {
    /// Looks through the robot's own camera.
    pub fn of_robot(world: &'w World) -> Self {
        let camera = world.models().description.camera();
        Self::through(world, camera)
    }

    /// Looks through one of the robot's cameras. The robot's own body may be in the way.
    pub fn through(world: &'w World, camera: &crate::robot::description::Camera) -> Self {
        let pose = world.link_pose(camera.frame);
        Self::take(world, Camera::new(camera, pose), camera.visible_share)
    }

    /// Takes a picture of the world from anywhere. An object counts as seen if `needed_share`
    /// (0..1) of it is in sight.
    pub fn take(world: &'w World, camera: Camera, needed_share: f64) -> Self {
        Self::draw(world, Picture::new(camera), needed_share)
    }

    /// Looks through the robot's own camera at one object only; the picture holds nothing else.
    pub(crate) fn of_robot_at(world: &'w World, name: &str) -> Result<Self, WorldError> {
        let description = world.models().description.camera();
        let camera = Camera::new(description, world.link_pose(description.frame));
        Self::at(world, camera, name, description.visible_share)
    }

    /// Takes a picture from anywhere of where one object is, or would be if nothing hid it, and of nothing
    /// else. It counts as seen if `needed_share` (0..1) of it is in sight.
    pub fn at(
        world: &'w World,
        camera: Camera,
        name: &str,
        needed_share: f64,
    ) -> Result<Self, WorldError> {
        let pose = world.object_pose(name)?;
        let window = window_of(&surfaces(world.object(name)?, &pose), &camera);
        let picture = Picture::of_window(camera, window);
        Ok(Self::draw(world, picture, needed_share))
    }

    /// Whether the robot's own body is in front of a point (m, map frame) for its own camera. So it is in no
    /// case for a point that is not in the picture.
    pub fn is_behind_own_body(world: &'w World, point: &Point3<f64>) -> bool {
        Self::of_robot_towards(world, point).is_some_and(|glance| {
            let body = glance.key.and_then(|key| world.body_name(key));
            let is_nearer = glance.depth.is_some_and(|depth| depth < glance.wanted);
            is_nearer && matches!(body, Some(BodyName::Robot(_)))
        })
    }

    /// What the robot's own camera sees in the direction of a point (m, map frame): the depth of that
    /// (m along the camera's z) and the point's, and the body; `None` if the point is not in the
    /// picture.
    pub(crate) fn of_robot_towards(world: &'w World, point: &Point3<f64>) -> Option<Glance> {
        let description = world.models().description.camera();
        let camera = Camera::new(description, world.link_pose(description.frame));
        let pixel = camera.pixel_of(point)?;
        let window = Window::pixel(&camera, pixel)?;
        let picture = Picture::of_window(camera, window);
        let sight = Self::draw(world, picture, description.visible_share);
        // The pixel is within the picture, so that the casts are exact.
        let [column, row] = pixel.map(|i| i as usize);
        Some(Glance {
            depth: sight.picture.depth(column, row),
            wanted: camera.pose.inverse_transform_point(point).z,
            key: sight.picture.keys().first().copied().flatten(),
        })
    }

    fn draw(world: &'w World, mut picture: Picture, needed_share: f64) -> Self {
        for shape in world.shapes() {
            if picture.may_show(&shape.pose, shape.shape.bounding_radius()) {
                picture.draw(shape.key, &shape.pose, &Mesh::of(shape.shape));
            }
        }
        Self {
            world,
            picture,
            needed_share,
        }
    }

    /// The picture.
    pub fn picture(&self) -> &Picture {
        &self.picture
    }

    /// How much of the object is in sight.
    pub fn visibility(&self, name: &str) -> Result<Visibility, WorldError> {
        let object = self.world.object(name)?;
        let pose = self.world.object_pose(name)?;
        let surfaces = surfaces(object, &pose);
        let mut visibility = Visibility {
            object: name.to_owned(),
            visible_pixels: 0,
            full_pixels: full_pixels(self.picture.camera(), &pose, &surfaces),
            occluders: Vec::new(),
            needed_share: self.needed_share,
            outside: self.outside(&surfaces),
        };
        if self.may_show(object, &pose) {
            let window = self.window_of(&surfaces);
            visibility.visible_pixels = self.pixels_of(object, window);
            let alone = Silhouette::of(self.picture.camera(), window, &surfaces);
            visibility.occluders = self.occluders(object.key(), &alone);
        }
        Ok(visibility)
    }

    /// The share of the object (0..1) that is in sight: [`Visibility::fraction`], with less work.
    pub fn share(&self, name: &str) -> Result<f64, WorldError> {
        let object = self.world.object(name)?;
        let pose = self.world.object_pose(name)?;
        if !self.may_show(object, &pose) {
            return Ok(0.0);
        }
        let surfaces = surfaces(object, &pose);
        let visible = self.pixels_of(object, self.window_of(&surfaces));
        if visible == 0 {
            return Ok(0.0);
        }
        let full = full_pixels(self.picture.camera(), &pose, &surfaces);
        Ok(share_of(visible, full))
    }

    /// Whether the object, which is at the pose (map frame), may be in the picture.
    fn may_show(&self, object: &Object, pose: &Pose) -> bool {
        object.shapes().iter().any(|placed| {
            let radius = placed.shape.bounding_radius();
            self.picture.may_show(&(pose * placed.pose), radius)
        })
    }

    /// The pixels of the picture in which surfaces may be seen.
    fn window_of(&self, surfaces: &[(Pose, Mesh)]) -> Window {
        let window = window_of(surfaces, self.picture.camera());
        self.picture.window().common_with(&window)
    }

    /// How many pixels of a window show the object.
    fn pixels_of(&self, object: &Object, window: Window) -> usize {
        let there = self.picture.keys_in(window);
        there.filter(|there| *there == Some(object.key())).count()
    }

    /// The bodies at the pixels that would show the object if it were alone.
    fn occluders(&self, key: PartKey, alone: &Silhouette) -> Vec<(BodyName, usize)> {
        let mut counts: Vec<(PartKey, usize)> = Vec::new();
        let there = self.picture.keys_in(alone.window());
        for (there, wanted) in there.zip(alone.shows()) {
            let Some(there) = there.filter(|there| *wanted && *there != key) else {
                continue;
            };
            match counts.iter_mut().find(|(k, _)| *k == there) {
                Some((_, count)) => *count += 1,
                None => counts.push((there, 1)),
            }
        }
        counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        counts
            .into_iter()
            .filter_map(|(key, count)| Some((self.world.body_name(key)?, count)))
            .collect()
    }

    /// How far surfaces, each at its pose (map frame), extend beyond the borders of the picture.
    fn outside(&self, surfaces: &[(Pose, Mesh)]) -> Option<(Border, f64)> {
        let camera = self.picture.camera();
        let half_width = camera.horizontal_fov() / 2.0;
        let half_height = camera.vertical_fov / 2.0;
        let mut farthest: Option<(Border, f64)> = None;
        let mut keep = |border: Border, excess: f64| {
            if excess > 0.0 && farthest.is_none_or(|(_, most)| excess > most) {
                farthest = Some((border, excess));
            }
        };
        for (pose, mesh) in surfaces {
            let to_camera = camera.pose.inverse() * pose;
            for corner in &mesh.corners {
                let p = to_camera * corner;
                let across = trig::atan2(p.x, p.z);
                keep(Border::Right, across - half_width);
                keep(Border::Left, -across - half_width);
                if p.z > 0.0 {
                    let down = trig::atan2(p.y, p.z);
                    keep(Border::Below, down - half_height);
                    keep(Border::Above, -down - half_height);
                }
            }
        }
        farthest
    }
}

//! Movable objects.

use std::sync::{Arc, OnceLock};

use nalgebra::Vector3;
use parry3d_f64::bounding_volume::Aabb;

use super::cavity::Cavity;
use super::content::Content;
use super::holding::Hold;
use super::inside::Inside;
use super::part_key::PartKey;
use super::physics::{BodyHandle, WeldHandle};
use super::solid::Solid;
use crate::robot::LinkId;
use spatial::{PlacedShape, Pose, Shape};

/// The attachment of an object to a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// The link that carries the object.
    pub link: LinkId,
    /// Pose of the object in the link's frame when it was attached.
    pub at: Pose,
    pub(crate) weld: WeldHandle,
    /// How fingers hold the object; `None` if it is merely fixed to the link.
    pub hold: Option<Hold>,
}

/// An object of the world.
#[derive(Clone)]
pub struct Object {
    pub name: String,
    pub type_name: String,
    pub color: [f32; 4],
    pub mass: f64,
    pub friction: f64,
    pub shapes: Arc<[PlacedShape]>,
    pub(crate) solids: Arc<[Solid]>,
    /// What is shown of it, unless its type or its shapes say that.
    pub(crate) looks: Option<Arc<[PlacedShape]>>,
    /// The point (m, its frame) at which its weight acts.
    pub(crate) balance: [f64; 3],
    pub(crate) edition: u32,
    /// The room inside it, if its solids do not show that.
    pub(super) inside: Option<Inside>,
    /// Whether it holds others as it stands.
    pub(crate) is_hollow: bool,
    pub bounds: Aabb,
    pub number: u32,
    pub body: BodyHandle,
    pub attachment: Option<Attachment>,
    /// The attachment to a second hand, if two hold the object together.
    pub(crate) second: Option<Attachment>,
    pub(super) content: Content,
    /// How it was last shaken, while it is turned down: its turn (rad/s) at its fastest since it was turned back.
    pub(super) swing: Vector3<f64>,
    /// The room inside it, once somebody has asked.
    pub(super) cavity: OnceLock<Option<Arc<Cavity>>>,
}

impl Object {
    /// Name, unique in the world.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Name of its type in the object library.
    pub fn type_name(&self) -> &str {
        &self.type_name
    }

    /// Colour, red green blue alpha in 0..1.
    pub fn color(&self) -> [f32; 4] {
        self.color
    }

    /// Mass (kg).
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Extent (m) along its own x, y and z axes.
    pub fn size(&self) -> [f64; 3] {
        let extents = self.bounds.extents();
        [extents.x, extents.y, extents.z]
    }

    /// Shapes, in the object's own frame.
    pub fn shapes(&self) -> &[PlacedShape] {
        &self.shapes
    }

    /// What is shown of it, in its own frame, unless its type or its shapes say that.
    pub fn looks(&self) -> Option<&[PlacedShape]> {
        self.looks.as_deref()
    }

    /// Whether it has a hollow that is open at its top, as vessels, plates and trays have: what is in it or on
    /// it falls out if it is tilted.
    pub fn is_hollow(&self) -> bool {
        self.is_hollow
    }

    /// Whether what is in it could leave it if it were tilted: it is hollow, or it has an opening or holes and is not empty.
    pub(crate) fn may_lose_content(&self) -> bool {
        self.is_hollow || self.inside.is_some() && self.content.volume > 0.0
    }

    /// Which definition of its type it was made by; 0 for one that is built in.
    pub fn edition(&self) -> u32 {
        self.edition
    }

    /// The point (m) at which its weight acts, in the frame in which the object is at a pose.
    pub(crate) fn balance_at(&self, pose: &Pose) -> Vector3<f64> {
        // Exactly the place of the pose for what balances there.
        match self.balance {
            [0.0, 0.0, 0.0] => pose.translation.vector,
            balance => (pose * nalgebra::Point3::from(balance)).coords,
        }
    }

    /// Whether it can tip over. A ball rolls instead, which only its place tells.
    pub fn can_tip(&self) -> bool {
        let is_ball = |placed: &PlacedShape| matches!(placed.shape, Shape::Sphere { .. });
        !self.shapes.iter().all(is_ball)
    }

    /// The attachment, if a link carries the object.
    pub fn attachment(&self) -> Option<&Attachment> {
        self.attachment.as_ref()
    }

    /// All attachments: one, or two if two hands hold the object together.
    pub fn attachments(&self) -> impl Iterator<Item = &Attachment> {
        self.attachment.iter().chain(&self.second)
    }

    /// The attachment to a link, if that carries the object, alone or together with another one.
    pub fn attachment_to(&self, link: LinkId) -> Option<&Attachment> {
        self.attachments().find(|one| one.link == link)
    }

    /// Whether two hands hold the object together.
    pub fn is_held_by_two(&self) -> bool {
        self.second.is_some()
    }

    /// How fingers hold the object, if they do.
    pub fn hold(&self) -> Option<&Hold> {
        self.attachment.as_ref()?.hold.as_ref()
    }

    /// The key of its parts.
    pub fn key(&self) -> PartKey {
        PartKey::Object(self.number)
    }
}

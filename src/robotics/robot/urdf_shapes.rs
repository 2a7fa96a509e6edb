//! The shapes of all links of a URDF: primitives, and meshes, which are read all together.

use std::sync::Arc;

use super::urdf::{UrdfUse, Wrong};
use super::urdf_error::UrdfProblem;
use super::urdf_node::Node;
use super::urdf_remark::{Leniency, Remarks};
use crate::mesh::{MeshLibrary, MeshPart, MeshPurpose, MeshRequest};
use spatial::pose::from_xyz_rpy;
use spatial::{PlacedShape, Pose, Shape};

/// A mesh with a longer side (m) is said to be in another unit than metres.
const LONGEST: f64 = 50.0;

/// The shapes of a link.
#[derive(Default)]
struct LinkShapes {
    collisions: Vec<PlacedShape>,
    visuals: Vec<PlacedShape>,
}

/// The shapes of links, by their places.
pub(super) struct Shapes {
    links: Vec<LinkShapes>,
}

/// A shape as a file gives it.
struct Given<'a> {
    link: usize,
    is_solid: bool,
    node: Node<'a>,
    pose: Pose,
    color: Option<[f32; 4]>,
}

impl Shapes {
    /// Reads the shapes of the links.
    pub(super) fn read<'a>(
        robot: Node<'a>,
        links: &[Node<'a>],
        meshes: &MeshLibrary<'_>,
        usage: UrdfUse,
        remarks: &mut Remarks,
    ) -> Result<Self, Wrong> {
        let materials: Vec<_> = robot.children("material").collect();
        let mut given = Vec::new();
        for (link, node) in links.iter().enumerate() {
            for (kind, is_solid) in [("collision", true), ("visual", false)] {
                given.extend(node.children(kind).filter_map(|shape| {
                    let material = shape.child("material").filter(|_| !is_solid);
                    Some(Given {
                        link,
                        is_solid,
                        node: shape_in(shape.child("geometry")?)?,
                        pose: shape.origin(),
                        color: material.and_then(|material| color(material, &materials)),
                    })
                }));
            }
        }
        if usage == UrdfUse::World && !given.iter().any(|shape| shape.is_solid) {
            let solid: Vec<_> = given
                .iter()
                .map(|shape| Given {
                    is_solid: true,
                    color: None,
                    ..*shape
                })
                .collect();
            if let Some(first) = solid.first() {
                remarks.add(first.node.offset(), Leniency::NoCollisions);
            }
            given.splice(0..0, solid);
        }
        let wanted: Vec<MeshRequest> = given.iter().filter_map(Given::mesh).collect();
        let mut found = meshes.load(&wanted).into_iter().zip(&wanted);
        let mut shapes = Self {
            links: links.iter().map(|_| LinkShapes::default()).collect(),
        };
        let mut without_looks = Vec::new();
        for shape in &given {
            // Every shape has a link.
            let link = &mut shapes.links[shape.link];
            if shape.node.name() != "mesh" {
                let places = match shape.is_solid {
                    true => &mut link.collisions,
                    false => &mut link.visuals,
                };
                places.extend(shape.primitives());
                continue;
            }
            let offset = shape.node.offset();
            match found.next() {
                Some((Ok(parts), request)) => {
                    if shape.is_solid {
                        remark_on_unit(&parts, request, offset, remarks);
                    }
                    shape.add(parts, link);
                }
                Some((Err(error), _)) if shape.is_solid => {
                    return Err((offset, UrdfProblem::Mesh(error)));
                }
                Some((Err(error), _)) => {
                    remarks.add(offset, Leniency::NoLooks(error.to_string()));
                    without_looks.push(shape.link);
                }
                None => {}
            }
        }
        without_looks.dedup();
        for link in without_looks {
            let link = &mut shapes.links[link];
            let solid = link.collisions.iter().cloned();
            link.visuals.extend(solid);
        }
        Ok(shapes)
    }

    /// Takes the solid and the visible shapes of a link.
    pub(super) fn take(&mut self, link: usize) -> (Vec<PlacedShape>, Vec<PlacedShape>) {
        let shapes = self
            .links
            .get_mut(link)
            .map(std::mem::take)
            .unwrap_or_default();
        (shapes.collisions, shapes.visuals)
    }
}

/// The shape in a geometry.
fn shape_in(geometry: Node<'_>) -> Option<Node<'_>> {
    let shapes = ["box", "cylinder", "sphere", "capsule", "mesh"];
    geometry
        .contents()
        .filter(|node| shapes.contains(&node.name()))
        .last()
}

/// Says that a mesh is in another unit, if it has no scale and is as large as a house.
fn remark_on_unit(parts: &[MeshPart], request: &MeshRequest, offset: usize, remarks: &mut Remarks) {
    let all = parts.iter().filter_map(|part| part.surface.bounds());
    let bounds = all.reduce(|[a, b], [c, d]| {
        [0, 1].map(|end| {
            [0, 1, 2].map(|axis| match end {
                0 => f64::min(a[axis], c[axis]),
                _ => f64::max(b[axis], d[axis]),
            })
        })
    });
    let Some([low, high]) = bounds else {
        return;
    };
    let length = (0..3)
        .map(|axis| high[axis] - low[axis])
        .fold(0.0, f64::max);
    if length > LONGEST && request.scale == [1.0; 3] {
        let file = request.file.clone();
        remarks.add(offset, Leniency::Unit { file, length });
    }
}

impl Given<'_> {
    /// The mesh that is wanted for the shape.
    fn mesh(&self) -> Option<MeshRequest> {
        if self.node.name() != "mesh" {
            return None;
        }
        let same = |scale: f64| [scale; 3];
        let one = || self.node.number("scale").map_or([1.0; 3], same);
        Some(MeshRequest {
            file: self.node.text("filename").trim().to_owned(),
            scale: self.node.numbers("scale").unwrap_or_else(one),
            purpose: match self.is_solid {
                true => MeshPurpose::Solid,
                false => MeshPurpose::Looks,
            },
        })
    }

    /// Adds the parts of a mesh to a link.
    fn add(&self, parts: Vec<MeshPart>, link: &mut LinkShapes) {
        for part in parts {
            let surface = Arc::new(part.surface);
            let (shape, places) = match self.is_solid {
                true => (Shape::Hull(surface), &mut link.collisions),
                false => (Shape::Mesh(surface), &mut link.visuals),
            };
            places.push(PlacedShape {
                shape,
                pose: self.pose,
                color: part.color.or(self.color),
            });
        }
    }

    /// The shapes that stand for a primitive; none for one without a size.
    fn primitives(&self) -> Vec<PlacedShape> {
        let node = self.node;
        let [radius, length] = ["radius", "length"].map(|name| node.number_or_zero(name));
        let placed = |shape, pose| PlacedShape {
            shape,
            pose,
            color: self.color,
        };
        let shape = match node.name() {
            "box" => {
                let size = node.vector("size");
                (!size.contains(&0.0)).then_some(Shape::Box { size })
            }
            "sphere" => (radius > 0.0).then_some(Shape::Sphere { radius }),
            _ => (radius > 0.0 && length > 0.0).then_some(Shape::Cylinder { radius, length }),
        };
        let shape = shape.map(|shape| placed(shape, self.pose));
        let mut shapes: Vec<_> = shape.into_iter().collect();
        if node.name() == "capsule" && radius > 0.0 {
            let ball = |z| {
                let at = self.pose * from_xyz_rpy([0.0, 0.0, z], [0.0; 3]);
                placed(Shape::Sphere { radius }, at)
            };
            shapes.extend([ball(-length / 2.0), ball(length / 2.0)]);
        }
        shapes
    }
}

/// The colour of the material itself, or of the robot's material with the same name.
fn color(material: Node<'_>, materials: &[Node<'_>]) -> Option<[f32; 4]> {
    let name = material.text("name").trim();
    let shared = || {
        let mut known = materials.iter().filter(|_| !name.is_empty());
        known
            .find(|known| known.text("name").trim() == name)?
            .child("color")
    };
    let color = material.child("color").or_else(shared)?;
    let shades = color.numbers("rgba").unwrap_or([0.0; 4]);
    Some(shades.map(|shade: f64| shade.clamp(0.0, 1.0) as f32))
}

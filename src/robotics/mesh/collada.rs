//! DAE files (COLLADA).
//!
//! The unit of length is applied. The upward axis is not turned: viewers and planners that people publish
//! for ignore it, so that published files are right only without.

use std::collections::HashMap;

use nalgebra::{Matrix4, Point3};
use roxmltree::{Document, Node, ParsingOptions};

use super::clean::{MAX_TRIANGLES, too_many};
use super::part::MeshPart;
use spatial::{Polyhedron, trig};

/// So deep may nodes lie in nodes.
const DEEPEST: usize = 64;

/// So many nodes may be shown, those that are used several times counted each time.
const MAX_NODES: usize = 20_000;

/// The geometries of a file where its scene places them, one part for each colour.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<MeshPart>, String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "the file is not UTF-8".to_owned())?;
    let options = ParsingOptions {
        nodes_limit: 2_000_000,
        ..ParsingOptions::default()
    };
    let text = text.trim_start_matches('\u{feff}');
    let document =
        Document::parse_with_options(text, options).map_err(|error| error.to_string())?;
    let root = document.root_element();
    if root.tag_name().name() != "COLLADA" {
        return Err(format!(
            "expected <COLLADA>, found <{}>",
            root.tag_name().name()
        ));
    }
    let ids = root.descendants();
    let mut reader = Reader {
        ids: ids
            .filter_map(|node| Some((node.attribute("id")?, node)))
            .collect(),
        parts: Vec::new(),
        triangles: 0,
        nodes: 0,
    };
    let unit = child(root, "asset").and_then(|asset| child(asset, "unit"));
    let unit = unit.and_then(|unit| unit.attribute("meter")?.trim().parse().ok());
    let unit = unit
        .filter(|unit: &f64| unit.is_finite() && *unit > 0.0)
        .unwrap_or(1.0);
    let start = Matrix4::new_scaling(unit);
    let scene = child(root, "scene").and_then(|scene| child(scene, "instance_visual_scene"));
    let scene = scene.and_then(|scene| reader.referred(scene, "url"));
    let scene = scene.or_else(|| child(child(root, "library_visual_scenes")?, "visual_scene"));
    match scene {
        Some(scene) => {
            for node in children(scene, "node") {
                reader.add_node(node, &start, 0)?;
            }
        }
        None => {
            let libraries = children(root, "library_geometries");
            for geometry in libraries.flat_map(|library| children(library, "geometry")) {
                reader.add_geometry(geometry, &start, &HashMap::new())?;
            }
        }
    }
    Ok(reader.parts)
}

fn children<'a, 'd>(node: Node<'a, 'd>, name: &'a str) -> impl Iterator<Item = Node<'a, 'd>> {
    node.children()
        .filter(move |child| child.tag_name().name() == name)
}

fn child<'a, 'd>(node: Node<'a, 'd>, name: &'a str) -> Option<Node<'a, 'd>> {
    children(node, name).next()
}

/// The numbers in an element's text.
fn numbers<T: std::str::FromStr>(node: Node<'_, '_>) -> impl Iterator<Item = Option<T>> {
    let words = node.text().unwrap_or_default().split_ascii_whitespace();
    words.map(|word| word.parse().ok())
}

fn place(node: Node<'_, '_>) -> String {
    let at = node.document().text_pos_at(node.range().start);
    format!("line {}", at.row)
}

struct Reader<'a, 'd> {
    ids: HashMap<&'a str, Node<'a, 'd>>,
    parts: Vec<MeshPart>,
    triangles: usize,
    nodes: usize,
}

/// A list of indices for each corner: where the position stands in it, and how long it is.
struct Layout {
    stride: usize,
    at: usize,
}

impl<'a, 'd> Reader<'a, 'd> {
    /// The element that an attribute refers to, as in `url="#id"`.
    fn referred(&self, node: Node<'a, 'd>, attribute: &str) -> Option<Node<'a, 'd>> {
        let id = node.attribute(attribute)?;
        self.ids.get(id.strip_prefix('#').unwrap_or(id)).copied()
    }

    fn add_node(
        &mut self,
        node: Node<'a, 'd>,
        outer: &Matrix4<f64>,
        depth: usize,
    ) -> Result<(), String> {
        self.nodes += 1;
        if depth > DEEPEST || self.nodes > MAX_NODES {
            return Err(format!(
                "{}: there are too many <node>, {MAX_NODES} or {DEEPEST} in each other are allowed",
                place(node)
            ));
        }
        let mut pose = *outer;
        for content in node.children().filter(Node::is_element) {
            match content.tag_name().name() {
                "matrix" | "translate" | "rotate" | "scale" => pose *= transform(content)?,
                "instance_geometry" => {
                    if let Some(geometry) = self.referred(content, "url") {
                        self.add_geometry(geometry, &pose, &self.colors(content))?;
                    }
                }
                "instance_controller" => {
                    let controller = self.referred(content, "url");
                    let skin = controller.and_then(|controller| child(controller, "skin"));
                    if let Some(geometry) = skin.and_then(|skin| self.referred(skin, "source")) {
                        self.add_geometry(geometry, &pose, &self.colors(content))?;
                    }
                }
                "node" => self.add_node(content, &pose, depth + 1)?,
                "instance_node" => {
                    if let Some(inner) = self.referred(content, "url") {
                        self.add_node(inner, &pose, depth + 1)?;
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// The colours that an instance gives to the names of materials in its geometry.
    fn colors(&self, instance: Node<'a, 'd>) -> HashMap<&'a str, [f32; 4]> {
        let bound = instance.descendants();
        let bound = bound.filter(|node| node.tag_name().name() == "instance_material");
        let colors = bound.filter_map(|node| {
            let material = self.referred(node, "target")?;
            Some((node.attribute("symbol")?, self.color(material)?))
        });
        colors.collect()
    }

    /// The diffuse colour of a material; a grey one if it has a texture.
    fn color(&self, material: Node<'a, 'd>) -> Option<[f32; 4]> {
        let effect = child(material, "instance_effect")?;
        let effect = self.referred(effect, "url")?;
        let mut inner = effect.descendants();
        let diffuse = inner.find(|node| node.tag_name().name() == "diffuse")?;
        let Some(color) = child(diffuse, "color") else {
            return Some([0.6, 0.6, 0.6, 1.0]);
        };
        let mut shades = numbers::<f32>(color).map_while(|shade| shade);
        let mut next = || Some(shades.next()?.clamp(0.0, 1.0));
        let color = [next()?, next()?, next()?, 1.0];
        color.iter().all(|shade| shade.is_finite()).then_some(color)
    }

    fn add_geometry(
        &mut self,
        geometry: Node<'a, 'd>,
        pose: &Matrix4<f64>,
        colors: &HashMap<&str, [f32; 4]>,
    ) -> Result<(), String> {
        let Some(mesh) = child(geometry, "mesh") else {
            return Ok(());
        };
        // Positions are read once for all groups of triangles that share them.
        let mut known: Option<(&str, Vec<[f64; 3]>)> = None;
        for group in mesh.children().filter(Node::is_element) {
            let kind = group.tag_name().name();
            if !["triangles", "polylist", "polygons", "trifans", "tristrips"].contains(&kind) {
                continue;
            }
            let Some((layout, source)) = self.layout(group)? else {
                continue;
            };
            if known.as_ref().is_none_or(|(id, _)| *id != source) {
                known = Some((source, self.positions(group, source, pose)?));
            }
            let Some((_, positions)) = &known else {
                continue;
            };
            let mut filler = Filler {
                positions,
                places: vec![None; positions.len()],
                surface: Polyhedron::default(),
                room: MAX_TRIANGLES.saturating_sub(self.triangles),
            };
            filler.fill(group, kind, &layout)?;
            self.triangles += filler.surface.triangles.len();
            let color = group
                .attribute("material")
                .and_then(|name| colors.get(name));
            self.parts.push(MeshPart {
                surface: filler.surface,
                color: color.copied(),
            });
        }
        Ok(())
    }

    /// Where positions are in the indices of a group, and the id of their source.
    fn layout(&self, group: Node<'a, 'd>) -> Result<Option<(Layout, &'a str)>, String> {
        let mut stride = 0;
        let mut found = None;
        for input in children(group, "input") {
            let offset = input
                .attribute("offset")
                .map_or(Some(0), |o| o.trim().parse().ok());
            let offset = offset
                .filter(|offset| *offset < 64)
                .ok_or_else(|| format!("{}: <input> has a wrong offset", place(input)))?;
            stride = stride.max(offset + 1);
            if input.attribute("semantic") == Some("VERTEX") {
                let vertices = self.referred(input, "source");
                let mut inputs = vertices
                    .into_iter()
                    .flat_map(|node| children(node, "input"));
                let position = inputs.find(|i| i.attribute("semantic") == Some("POSITION"));
                let source = position.and_then(|position| position.attribute("source"));
                found = source.map(|source| (offset, source));
            }
        }
        Ok(found.map(|(at, source)| {
            let id = source.strip_prefix('#').unwrap_or(source);
            (Layout { stride, at }, id)
        }))
    }

    /// The positions in a source, in the frame of the mesh.
    fn positions(
        &self,
        group: Node<'a, 'd>,
        source: &str,
        pose: &Matrix4<f64>,
    ) -> Result<Vec<[f64; 3]>, String> {
        let missing = || {
            format!(
                "{}: there is no source {source:?} of positions",
                place(group)
            )
        };
        let source = self.ids.get(source).copied().ok_or_else(missing)?;
        let array = child(source, "float_array").ok_or_else(missing)?;
        let accessor = source
            .descendants()
            .find(|n| n.tag_name().name() == "accessor");
        let count = |name: &str, usual: usize| {
            let given = accessor.and_then(|accessor| accessor.attribute(name)?.trim().parse().ok());
            given.unwrap_or(usual)
        };
        let (stride, offset) = (count("stride", 3).max(3), count("offset", 0));
        let text = array.text().unwrap_or_default();
        // What is no number is nowhere, and its triangles are left out.
        let words = text.split_ascii_whitespace();
        let numbers: Vec<f64> = words.map(|word| word.parse().unwrap_or(f64::NAN)).collect();
        let corners = numbers.get(offset..).unwrap_or_default().chunks(stride);
        let corners = corners.filter_map(|corner| match corner {
            [x, y, z, ..] => Some(pose.transform_point(&Point3::new(*x, *y, *z)).into()),
            _ => None,
        });
        Ok(corners.collect())
    }
}

fn transform(node: Node<'_, '_>) -> Result<Matrix4<f64>, String> {
    let kind = node.tag_name().name();
    let wanted = match kind {
        "matrix" => 16,
        "rotate" => 4,
        _ => 3,
    };
    let numbers: Vec<f64> = numbers(node).map_while(|number| number).collect();
    if numbers.len() != wanted || numbers.iter().any(|number| !number.is_finite()) {
        return Err(format!(
            "{}: expected {wanted} numbers in <{kind}>",
            place(node)
        ));
    }
    Ok(match numbers.as_slice() {
        [x, y, z, angle] => {
            let axis = nalgebra::Vector3::new(*x, *y, *z);
            match axis.try_normalize(1e-9) {
                Some(axis) => {
                    let (s, c) = trig::sin_cos(angle.to_radians() / 2.0);
                    let turn = nalgebra::Quaternion::new(c, s * axis.x, s * axis.y, s * axis.z);
                    nalgebra::UnitQuaternion::new_unchecked(turn).to_homogeneous()
                }
                None => Matrix4::identity(),
            }
        }
        [x, y, z] if kind == "scale" => Matrix4::new_nonuniform_scaling(&[*x, *y, *z].into()),
        [x, y, z] => Matrix4::new_translation(&[*x, *y, *z].into()),
        all => Matrix4::from_row_slice(all),
    })
}

/// Fills a surface with the triangles of a group.
struct Filler<'p> {
    positions: &'p [[f64; 3]],
    /// The place of each position in the surface.
    places: Vec<Option<u32>>,
    surface: Polyhedron,
    /// How many more triangles the mesh may have.
    room: usize,
}

impl Filler<'_> {
    fn fill(&mut self, group: Node<'_, '_>, kind: &str, layout: &Layout) -> Result<(), String> {
        let mut counts = child(group, "vcount").map(numbers::<usize>);
        for list in
            children(group, "p").chain(children(group, "ph").filter_map(|holed| child(holed, "p")))
        {
            let mut corners = Vec::new();
            for (i, index) in numbers::<usize>(list).enumerate() {
                if i % layout.stride == layout.at {
                    let corner = index.and_then(|index| self.place(index));
                    corners.push(corner.ok_or_else(|| {
                        format!(
                            "{}: corner {} of <p> is none of {} positions",
                            place(list),
                            i / layout.stride + 1,
                            self.positions.len()
                        )
                    })?);
                }
            }
            match (kind, &mut counts) {
                ("polylist", Some(counts)) => {
                    let mut rest = corners.as_slice();
                    for count in counts.by_ref() {
                        let split = count.and_then(|count| rest.split_at_checked(count));
                        let Some((polygon, after)) = split else {
                            return Err(format!(
                                "{}: <vcount> and <p> do not fit each other",
                                place(list)
                            ));
                        };
                        self.add_fan(polygon)?;
                        rest = after;
                    }
                }
                ("polygons" | "trifans", _) => self.add_fan(&corners)?,
                ("tristrips", _) => {
                    for (i, three) in corners.windows(3).enumerate() {
                        match i % 2 {
                            0 => self.add_fan(three)?,
                            _ => self.add_fan(&[three[1], three[0], three[2]])?,
                        }
                    }
                }
                _ => {
                    for three in corners.chunks_exact(3) {
                        self.add_fan(three)?;
                    }
                }
            }
        }
        Ok(())
    }

    fn place(&mut self, index: usize) -> Option<u32> {
        let position = self.positions.get(index)?;
        let place = self.places.get_mut(index)?;
        Some(*place.get_or_insert_with(|| {
            self.surface.corners.push(*position);
            self.surface.corners.len() as u32 - 1
        }))
    }

    fn add_fan(&mut self, polygon: &[u32]) -> Result<(), String> {
        for i in 2..polygon.len() {
            self.surface
                .triangles
                .push([polygon[0], polygon[i - 1], polygon[i]]);
        }
        match self.surface.triangles.len() > self.room {
            true => Err(too_many(MAX_TRIANGLES)),
            false => Ok(()),
        }
    }
}

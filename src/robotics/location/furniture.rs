//! The furniture by name: what things can be put on, and what can be opened.

use thiserror::Error;

use crate::robot::{JointId, JointKind, KinematicTree, LinkId};
use crate::world::{Extent, Ground, Models, StandingRoom, World};
use closest_name::closest_name;

/// Narrower furniture (m) is no surface.
const NARROWEST: f64 = 0.25;
/// Distance (m) of the points at which a surface is probed, and how far (m) its parts may be below
/// the top.
const PROBE: f64 = 0.08;
const SLACK: f64 = 0.02;
/// Room (m) that there must be above a surface.
const HEADROOM: f64 = 0.1;
/// Share of the points that must be solid, and free above.
const SOLID_SHARE: f64 = 0.3;

/// A name that no furniture has.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("the kitchen has no furniture named {name}{}", hint(.closest.as_deref()))]
pub struct UnknownFurniture {
    /// The name as it was read.
    pub name: String,
    /// The name that was probably meant.
    pub closest: Option<String>,
}

fn hint(closest: Option<&str>) -> String {
    match closest {
        Some(name) => format!("; did you mean {}?", name.replace('_', "-")),
        None => "; (list-surfaces) and (list-containers) tell the names".to_owned(),
    }
}

/// The link of the kitchen with that name, whatever its case; `-` counts as `_`. It has a shape.
pub fn link_named(models: &Models, name: &str) -> Result<LinkId, UnknownFurniture> {
    let wanted = name.to_lowercase().replace('-', "_");
    let kitchen = &models.kitchen;
    let links = || kitchen.links().filter(|(_, l)| !l.collisions.is_empty());
    let found = links().find(|(_, link)| link.name.to_lowercase() == wanted);
    let alias = || kitchen.link_named(&wanted);
    found
        .map(|(id, _)| id)
        .or_else(alias)
        .ok_or_else(|| UnknownFurniture {
            name: name.to_owned(),
            closest: closest_name(&wanted, links().map(|(_, l)| l.name.as_str()))
                .map(str::to_owned),
        })
}

/// The furniture on which things can be put, in the order of the kitchen, with the box around each.
pub fn surfaces(world: &World) -> Vec<(LinkId, Extent)> {
    let links = world.models().kitchen.links();
    let extents = links.filter_map(|(id, _)| Some((id, world.furniture_extent(id)?)));
    extents
        .filter(|(_, extent)| is_surface(world, extent))
        .collect()
}

fn is_surface(world: &World, extent: &Extent) -> bool {
    let [x, y, _] = extent.size();
    if x.min(y) < NARROWEST {
        return false;
    }
    let count = |length: f64| (length / PROBE).floor().max(1.0) as u32;
    let points = (0..count(x)).flat_map(|i| (0..count(y)).map(move |j| (i, j)));
    let points: Vec<[f64; 2]> = points
        .map(|(i, j)| {
            let local = nalgebra::Point3::new(
                extent.min[0] + (f64::from(i) + 0.5) * x / f64::from(count(x)),
                extent.min[1] + (f64::from(j) + 0.5) * y / f64::from(count(y)),
                0.0,
            );
            let point = extent.frame * local;
            [point.x, point.y]
        })
        .collect();
    let border = |pick: fn(f64, f64) -> f64, start: f64| {
        [0, 1].map(|i| points.iter().map(|p| p[i]).fold(start, pick))
    };
    let limits = [
        border(f64::min, f64::INFINITY),
        border(f64::max, f64::NEG_INFINITY),
    ];
    let room = StandingRoom::new(world, limits, None);
    let top = extent.top();
    let is_solid = |point: &&[f64; 2]| {
        let found = room.point(**point, top + HEADROOM, HEADROOM + SLACK, Ground::Furniture);
        found.is_ok_and(|height| height <= top + SLACK)
    };
    let solid = points.iter().filter(is_solid).count();
    solid as f64 >= SOLID_SHARE * points.len() as f64
}

/// A part of the furniture that can be opened by its handle.
#[derive(Clone, Debug, PartialEq)]
pub struct Container {
    /// The part that moves.
    pub link: LinkId,
    /// The joint that moves it.
    pub joint: JointId,
    /// Its handle.
    pub handle: LinkId,
}

/// Everything that can be opened by a handle, in the order of the kitchen.
pub fn containers(models: &Models) -> Vec<Container> {
    let kitchen = &models.kitchen;
    kitchen
        .joints()
        .filter(|(_, joint)| joint.kind != JointKind::Fixed)
        .filter_map(|(id, joint)| {
            Some(Container {
                link: joint.child,
                // What follows another joint is opened by that one.
                joint: joint.mimic.map_or(id, |mimic| mimic.joint),
                handle: handle_of(kitchen, joint.child)?,
            })
        })
        .collect()
}

/// What can be opened that the link is part of, or that is part of the link: the nearest below it,
/// in the order of the kitchen, or else the nearest above.
pub fn container_of(models: &Models, link: LinkId) -> Option<Container> {
    let kitchen = &models.kitchen;
    let all = containers(models);
    let depth = |container: &&Container| {
        let parent = kitchen.joint(container.joint).parent;
        kitchen
            .ancestors(parent)
            .take_while(|joint| kitchen.joint(*joint).child != link)
            .count()
    };
    let below = all
        .iter()
        .filter(|c| kitchen.carries(link, kitchen.joint(c.joint).parent));
    let below = below.min_by_key(depth);
    let above = || {
        let mut joints = kitchen.ancestors(link);
        joints.find_map(|joint| all.iter().find(|c| c.joint == joint))
    };
    below.or_else(above).cloned()
}

/// The handle that is fixed to the link.
fn handle_of(kitchen: &KinematicTree, link: LinkId) -> Option<LinkId> {
    let fixed = kitchen
        .joints()
        .filter(|(_, joint)| joint.kind == JointKind::Fixed && joint.parent == link);
    let mut children = fixed.map(|(_, joint)| joint.child);
    children.find(|child| kitchen.link(*child).name.contains("handle"))
}

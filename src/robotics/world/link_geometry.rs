//! The solids of a tree's links, prepared for physics and for collision queries.
//!
//! Built once per tree; nothing here depends on joint positions.

use std::sync::Arc;

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};

use super::body_name::LinkName;
use super::solid::{Solid, bounds_of, to_parry};
use crate::robot::{JointId, KinematicTree, LinkId};

/// A link that can touch something.
pub(crate) struct LinkSolids {
    /// The link.
    pub link: LinkId,
    /// Its solids in its own frame; not empty.
    pub(crate) solids: Vec<Solid>,
    /// Bounds (m) of the solids in the link's frame.
    pub bounds: Aabb,
}

/// Links that never move relative to each other, hence one body of the physics engine.
pub struct RigidGroup {
    /// The link whose frame is the body's frame.
    pub root: LinkId,
    /// All links of the group that have solids, as indices into
    /// [`TreeGeometry::solid_links`], with the pose of each in the root's frame.
    pub members: Vec<(usize, spatial::Pose)>,
    /// Bounds (m) of their solids in the root's frame; `None` if there are none.
    pub bounds: Option<Aabb>,
    /// Whether the body's frame can move relative to the root of the tree.
    pub moves: bool,
}

/// The solids of a tree.
pub struct TreeGeometry {
    /// Names of all links, at [`LinkId::index`].
    pub names: Vec<LinkName>,
    /// The links that have solids, in the order of the tree.
    pub(crate) solid_links: Vec<LinkSolids>,
    /// The group of each link, at [`LinkId::index`].
    pub(crate) group_of: Vec<usize>,
    /// The groups, including those without solids, so that things can be welded to them.
    pub groups: Vec<RigidGroup>,
}

impl TreeGeometry {
    /// Prepares the tree. `is_idle` selects joints that could move but never do, such as those
    /// of castors: they count as fixed.
    pub fn new(tree: &KinematicTree, is_idle: impl Fn(JointId) -> bool) -> Self {
        let zero = tree.zero_positions();
        let names: Vec<_> = tree
            .links()
            .map(|(id, link)| LinkName {
                id,
                name: Arc::from(link.name.as_str()),
            })
            .collect();
        let solid_links: Vec<_> = tree
            .links()
            .filter_map(|(link, l)| {
                let solids = Solid::all(&l.collisions);
                let bounds = bounds_of(&solids)?;
                Some(LinkSolids {
                    link,
                    solids,
                    bounds,
                })
            })
            .collect();

        let group_root = |mut link: LinkId| loop {
            let Some(id) = tree.link(link).parent_joint else {
                return link;
            };
            let joint = tree.joint(id);
            let moves = joint.kind != crate::robot::JointKind::Fixed && !is_idle(id);
            if moves {
                return link;
            }
            link = joint.parent;
        };
        let mut groups: Vec<RigidGroup> = Vec::new();
        let mut group_of = Vec::with_capacity(names.len());
        for (link, _) in tree.links() {
            let root = group_root(link);
            let place = groups.iter().position(|g| g.root == root);
            group_of.push(place.unwrap_or_else(|| {
                let moves = root != tree.root();
                groups.push(RigidGroup {
                    root,
                    members: Vec::new(),
                    bounds: None,
                    moves,
                });
                groups.len() - 1
            }));
        }
        for (place, solid_link) in solid_links.iter().enumerate() {
            // Every link has a group: the loop above ran over all of them.
            let group = &mut groups[group_of[solid_link.link.index()]];
            if let Some(pose) = tree.relative_pose(group.root, solid_link.link, &zero) {
                let bounds = solid_link.bounds.transform_by(&to_parry(&pose));
                group.bounds = Some(group.bounds.map_or(bounds, |all| all.merged(&bounds)));
                group.members.push((place, pose));
            }
        }
        Self {
            names,
            solid_links,
            group_of,
            groups,
        }
    }

    /// The name of the link with that index in the tree.
    pub fn name(&self, index: u32) -> Option<&LinkName> {
        self.names.get(usize::try_from(index).ok()?)
    }
}

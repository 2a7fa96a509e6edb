//! Which links of a robot touch by construction, and which never can: by trying many postures.
//!
//! Links that hang on each other, that never move against each other, or that slide in each other as the
//! pieces of a telescope do, are neighbours. Of all other
//! pairs, those that touch in every random posture do so by construction, and those that touch in none
//! never do. What touches almost always is reported, since it may hide real collisions.

use std::f64::consts::PI;

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::{JointId, JointKind, JointPositions, KinematicTree, LinkId};
use spatial::Pose;

/// Share of the postures from which on links count as touching by construction.
const ALMOST_ALWAYS: f64 = 0.95;
/// Postures after which pairs that touch in some and clearly not in almost all are settled.
const FIRST_LOOK: usize = 500;
const CLEARLY_SOMETIMES: f64 = 0.8;
/// Cosine from which on two axes are one direction.
const PARALLEL: f64 = 0.999;

/// Pairs of links, the one that comes first in the file first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TouchingPairs {
    /// Links that hang on each other, never move against each other, or are pieces of one telescope.
    pub neighbours: Vec<(LinkId, LinkId)>,
    /// Links that touch in every posture that was tried.
    pub always: Vec<(LinkId, LinkId)>,
    /// Links that touch in almost every posture, with the share of the postures.
    pub almost_always: Vec<(LinkId, LinkId, f64)>,
    /// Links that touch in no posture that was tried.
    pub never: Vec<(LinkId, LinkId)>,
}

/// How many postures are tried, and which.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PostureSample {
    /// Number of postures.
    pub count: usize,
    /// Which ones.
    pub seed: u64,
}

impl Default for PostureSample {
    fn default() -> Self {
        Self {
            count: 10_000,
            seed: 0,
        }
    }
}

impl TouchingPairs {
    /// Tries random postures. `stands` selects joints that could move but never do; they are at 0, or as
    /// near as their limits let them. `links` are those that have shapes, in the order of the tree;
    /// `touch` says whether two of them do, given their places in `links` and the poses of all links.
    pub fn sampled(
        tree: &KinematicTree,
        sample: PostureSample,
        stands: impl Fn(JointId) -> bool,
        links: &[LinkId],
        mut touch: impl FnMut([usize; 2], &[Pose]) -> bool,
    ) -> Self {
        let mut pairs = Self::default();
        let mut open: Vec<([usize; 2], usize)> = Vec::new();
        for (i, one) in links.iter().enumerate() {
            for (j, other) in links.iter().enumerate().skip(i + 1) {
                if are_neighbours(tree, &stands, *one, *other) {
                    pairs.neighbours.push((*one, *other));
                } else {
                    open.push(([i, j], 0));
                }
            }
        }
        let mut random = Pcg64::seed_from_u64(sample.seed);
        let mut q = tree.zero_positions();
        let mut poses = Vec::new();
        for tried in 0..sample.count {
            draw(tree, &stands, &mut random, &mut q);
            tree.forward_kinematics(&Pose::identity(), &q, &mut poses);
            for (pair, touching) in &mut open {
                *touching += usize::from(touch(*pair, &poses));
            }
            if tried + 1 == FIRST_LOOK {
                let most = (FIRST_LOOK as f64 * CLEARLY_SOMETIMES) as usize;
                open.retain(|(_, touching)| *touching == 0 || *touching > most);
            }
        }
        for ([i, j], touching) in open {
            let (Some(one), Some(other)) = (links.get(i), links.get(j)) else {
                continue;
            };
            let share = touching as f64 / sample.count.max(1) as f64;
            if touching == 0 {
                pairs.never.push((*one, *other));
            } else if touching == sample.count {
                pairs.always.push((*one, *other));
            } else if share >= ALMOST_ALWAYS {
                pairs.almost_always.push((*one, *other, share));
            }
        }
        pairs
    }

    /// The pairs that are not to be checked, because they touch by construction: neighbours, and those
    /// that touch always or almost always.
    pub fn by_construction(&self) -> impl Iterator<Item = (LinkId, LinkId)> {
        let almost = self
            .almost_always
            .iter()
            .map(|(one, other, _)| (*one, *other));
        let sure = self.neighbours.iter().chain(&self.always).copied();
        sure.chain(almost)
    }
}

/// A posture within the limits.
fn draw(
    tree: &KinematicTree,
    stands: &impl Fn(JointId) -> bool,
    random: &mut Pcg64,
    q: &mut JointPositions,
) {
    for (id, joint) in tree.joints().filter(|(_, joint)| joint.is_actuated()) {
        let position = if stands(id) {
            joint.limits.map_or(0.0, |limits| limits.clamp(0.0))
        } else {
            let share = f64::from(random.next_u32()) / f64::from(u32::MAX);
            match joint.limits {
                Some(limits) => limits.lower + share * (limits.upper - limits.lower),
                None => PI * (2.0 * share - 1.0),
            }
        };
        q.set(id, position);
    }
}

/// Whether at most one joint moves the one against the other, and no other solid link is between them; or
/// whether they are pieces of one telescope.
fn are_neighbours(
    tree: &KinematicTree,
    stands: &impl Fn(JointId) -> bool,
    one: LinkId,
    other: LinkId,
) -> bool {
    let moves = |joint: &JointId| {
        let limits = tree.joint(*joint).limits;
        let is_still = limits.is_some_and(|limits| limits.lower >= limits.upper);
        tree.joint(*joint).kind != JointKind::Fixed && !stands(*joint) && !is_still
    };
    let path = |link: LinkId| -> Vec<JointId> { tree.ancestors(link).collect() };
    let (mut a, mut b) = (path(one), path(other));
    while a.last().is_some() && a.last() == b.last() {
        a.pop();
        b.pop();
    }
    let moving: Vec<&JointId> = a.iter().chain(&b).filter(|joint| moves(joint)).collect();
    if (a.is_empty() || b.is_empty()) && is_telescope(tree, &moving) {
        return true;
    }
    let [joint] = moving[..] else {
        return moving.is_empty();
    };
    // Both at the joint itself, or with nothing but frames between.
    let (inner, outer) = (tree.joint(*joint).parent, tree.joint(*joint).child);
    let hangs =
        |lower: LinkId, upper: LinkId| lower == upper || hangs_bare(tree, &moves, lower, upper);
    let meet = |a: LinkId, b: LinkId| hangs(inner, a) && hangs(b, outer);
    meet(one, other) || meet(other, one)
}

/// Whether joints that follow each other, the outermost one first, slide along one line and belong to a
/// telescope, which has two of them at least: what they carry is then built to be in each other.
fn is_telescope(tree: &KinematicTree, joints: &[&JointId]) -> bool {
    let [outermost, ..] = joints else {
        return false;
    };
    let zero = tree.zero_positions();
    let axis = |joint: JointId| {
        let joint = tree.joint(joint);
        let slides = joint.kind == JointKind::Prismatic;
        let pose = tree.relative_pose(tree.root(), joint.child, &zero);
        let pose = pose.filter(|_| slides)?;
        Some(pose.rotation * joint.axis.into_inner())
    };
    let Some(line) = axis(**outermost) else {
        return false;
    };
    let is_along = |joint: JointId| axis(joint).is_some_and(|own| own.dot(&line) > PARALLEL);
    let moves = |joint: &JointId| tree.joint(*joint).kind != JointKind::Fixed;
    let before = |joint: JointId| tree.ancestors(tree.joint(joint).parent).find(moves);
    let follows = |joint: JointId| before(joint) == Some(**outermost) && is_along(joint);
    joints.iter().all(|joint| is_along(**joint))
        && (joints.len() > 1
            || before(**outermost).is_some_and(is_along)
            || tree.joints().any(|(joint, _)| follows(joint)))
}

/// Whether the one link hangs on the other, with nothing but frames between and no joint that moves.
fn hangs_bare(
    tree: &KinematicTree,
    moves: &impl Fn(&JointId) -> bool,
    lower: LinkId,
    upper: LinkId,
) -> bool {
    let mut at = lower;
    let is_bare = |link: LinkId| tree.link(link).collisions.is_empty();
    for joint in tree.ancestors(lower).take_while(|joint| !moves(joint)) {
        // A solid link between the two ends the row, as does one of the two that is no frame.
        let passes = is_bare(at) || at == lower;
        at = tree.joint(joint).parent;
        if !passes {
            return false;
        }
        if at == upper {
            return is_bare(lower) || is_bare(upper);
        }
    }
    false
}

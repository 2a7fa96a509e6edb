//! The search behind collision queries: which primitives are close to each other.
//!
//! Bounds are compared first, from all links together down to primitives, then the boxes about what
//! is left; the primitives of moving parts are placed only when they are needed.

use std::ops::ControlFlow;

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::{Pose as ParryPose, Vector};

use super::frame::Frame;
use super::models::{Footing, Models};
use super::moving_parts::{MovingParts, Pairs};
use super::obstacles::Obstacles;
use super::oriented_box::OrientedBox;
use super::part_key::{PartKey, index};
use super::placed_solid::PlacedSolid;
use super::separation::{Separation, below_floor, overlap, separation};
use super::solid::{Solid, to_parry};
use crate::robot::LinkId;
use crate::spatial::Pose;

/// Largest gap (m) required between parts of the robot, which are built to pass each other
/// closely.
const SELF_MARGIN: f64 = 0.005;

/// A free object at its pose.
pub(crate) struct ObjectAt<'w> {
    pub(crate) key: PartKey,
    pub(crate) name: &'w str,
    pub(crate) solids: &'w [Solid],
    pub(crate) pose: ParryPose,
    pub(crate) bounds: Aabb,
}

/// An object that moves with a link.
pub(crate) struct HeldObject<'w> {
    pub(crate) key: PartKey,
    pub(crate) name: &'w str,
    pub(crate) solids: &'w [Solid],
    /// Bounds in the object's frame (m).
    pub(crate) bounds: Aabb,
    /// The link that carries the object.
    pub(crate) link: LinkId,
    /// Pose of the object in the link's frame.
    pub(crate) at: Pose,
}

/// Everything that a robot may collide with.
pub(crate) struct Surroundings<'w> {
    pub(crate) models: &'w Models,
    pub(crate) furniture: &'w Obstacles,
    pub(crate) objects: Vec<ObjectAt<'w>>,
    pub(crate) held: Vec<HeldObject<'w>>,
}

/// A pair closer than the margin.
pub(crate) struct Near {
    pub(crate) moving: PartKey,
    pub(crate) other: PartKey,
    pub(crate) separation: Separation,
}

/// What a query wants to know about a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// Only that it is closer than the margin; distance and point are meaningless then.
    Whether,
    /// The distance, and where.
    HowMuch,
    /// As [`Wanted::HowMuch`], without pairs of the robot's own links.
    HowMuchToOthers,
}

/// Which pairs a query looks at, and what it wants to know about them.
#[derive(Clone, Copy)]
pub(crate) struct Question<'q> {
    /// Pairs that do not matter.
    pub(crate) allowed: &'q [(PartKey, PartKey)],
    /// The pairs that matter, if not all.
    pub(crate) only: Option<&'q [(PartKey, PartKey)]>,
    /// What moves.
    pub(crate) moving: Option<&'q MovingParts>,
    /// Which pairs matter, by what moves.
    pub(crate) pairs: Pairs,
    /// Those of the robot's solid links that may matter, as indices.
    pub(crate) self_pairs: &'q [(usize, usize)],
    pub(crate) wanted: Wanted,
}

/// What is kept between queries of the same surroundings: memory, and the places of links.
#[derive(Default)]
pub(crate) struct Scratch {
    movers: Vec<Mover>,
    solids: Vec<PlacedSolid>,
    /// The furniture near the robot, as places in the list of all.
    furniture: Vec<usize>,
    /// The pairs of links with bounds that are near each other.
    near: Vec<(usize, usize)>,
}

/// A link or a held object, placed for one query.
struct Mover {
    key: PartKey,
    /// The link, or the one that carries the object.
    link: LinkId,
    pose: ParryPose,
    frame: Frame,
    /// Bounds in the map frame (m).
    bounds: Aabb,
    /// Index of its first solid in the scratch memory.
    first: usize,
    /// Whether its solids have been placed.
    is_placed: bool,
}

/// One running query.
struct Search<'s, 'w, V> {
    around: &'s Surroundings<'w>,
    link_poses: &'s [Pose],
    question: Question<'s>,
    margin: f64,
    scratch: &'s mut Scratch,
    visit: V,
}

impl<'w> Surroundings<'w> {
    /// Visits the pairs that are closer than the margin (m) and not allowed, in a fixed order,
    /// until the visitor stops. The visitor may lower the margin. `moved` tells which links have
    /// moved since the last query with the same memory; all may have if it is not given.
    pub(crate) fn search(
        &self,
        link_poses: &[Pose],
        moved: Option<&[bool]>,
        question: Question<'_>,
        margin: f64,
        scratch: &mut Scratch,
        visit: impl FnMut(Near, &mut f64) -> ControlFlow<()>,
    ) {
        scratch.furniture.clear();
        let mut search = Search {
            around: self,
            link_poses,
            question,
            margin,
            scratch,
            visit,
        };
        match moved {
            Some(moved) if !search.scratch.movers.is_empty() => search.place_moved(moved),
            _ => search.place_all(),
        }
        // Whether the visitor stopped the search is of no interest to the caller.
        let _stopped = search.run();
    }

    /// The solids of the mover with that index: links come first, then held objects.
    fn solids(&self, mover: usize) -> &[Solid] {
        let links = &self.models.robot_geometry.solid_links;
        match links.get(mover) {
            Some(link) => &link.solids,
            None => self.held.get(mover - links.len()).map_or(&[], |h| h.solids),
        }
    }

    /// The box about the mover with that index, in its frame.
    fn containing_box(&self, mover: usize) -> OrientedBox {
        let links = &self.models.robot_geometry.solid_links;
        let bounds = match links.get(mover) {
            Some(link) => link.bounds,
            None => {
                let held = self.held.get(mover - links.len());
                held.map_or_else(Aabb::new_invalid, |held| held.bounds)
            }
        };
        OrientedBox::new(&bounds)
    }
}

impl<V: FnMut(Near, &mut f64) -> ControlFlow<()>> Search<'_, '_, V> {
    fn run(&mut self) -> ControlFlow<()> {
        let around = self.around;
        let links = &around.models.robot_geometry.solid_links;
        self.find_furniture();
        for place in 0..self.scratch.movers.len() {
            if self.may_matter(place) {
                self.against_world(place)?;
            }
        }
        if self.question.wanted == Wanted::HowMuchToOthers {
            return ControlFlow::Continue(());
        }
        match self.question.only {
            None => {
                let mut near = std::mem::take(&mut self.scratch.near);
                self.find_near_pairs(&mut near);
                for &(a, b) in &near {
                    self.against_each_other(a, b)?;
                }
                self.scratch.near = near;
            }
            Some(only) => {
                let all = self.question.self_pairs;
                let mut pairs: Vec<_> = only.iter().filter_map(|p| self.self_pair(*p)).collect();
                pairs.retain(|pair| all.binary_search(pair).is_ok());
                pairs.sort_unstable();
                pairs.dedup();
                for (a, b) in pairs {
                    self.against_each_other(a, b)?;
                }
            }
        }
        for (i, held) in around.held.iter().enumerate() {
            let place = links.len() + i;
            for (other, link) in links.iter().enumerate() {
                if !around.models.belong_to_same_hand(held.link, link.link) {
                    self.against_each_other(place, other)?;
                }
            }
            for other in (place + 1)..(links.len() + around.held.len()) {
                self.against_each_other(place, other)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Whether the question is about any pair with the mover of that index.
    fn may_matter(&self, place: usize) -> bool {
        let (Some(only), Some(mover)) = (self.question.only, self.scratch.movers.get(place)) else {
            return true;
        };
        only.iter().any(|&(a, b)| a == mover.key || b == mover.key)
    }

    /// The indices of two links of the robot, the smaller one first; `None` if the pair is another.
    fn self_pair(&self, (a, b): (PartKey, PartKey)) -> Option<(usize, usize)> {
        let movers = &self.scratch.movers;
        let place = |key| movers.iter().position(|mover| mover.key == key);
        let (a, b) = (place(a)?, place(b)?);
        Some((a.min(b), a.max(b)))
    }

    /// Finds the pairs of links with bounds that are near each other; most are far apart.
    fn find_near_pairs(&self, near: &mut Vec<(usize, usize)>) {
        let margin = self.margin.min(SELF_MARGIN);
        near.clear();
        let moves_as_a_whole = |moving: &&MovingParts| !moving.any_part();
        let whole = self.question.moving.filter(moves_as_a_whole);
        if self.question.pairs == Pairs::Changing && whole.is_some() {
            return;
        }
        let pairs = self.question.self_pairs.iter().copied();
        near.extend(pairs.filter(|&(a, b)| self.are_near(a, b, margin)));
    }

    /// Whether the bounds of two movers are closer than the margin (m).
    #[inline]
    fn are_near(&self, a: usize, b: usize, margin: f64) -> bool {
        let movers = &self.scratch.movers;
        let (Some(one), Some(two)) = (movers.get(a), movers.get(b)) else {
            return false;
        };
        let (one, two, slack) = (&one.bounds, &two.bounds, margin.max(0.0));
        // One branch for all: which of the comparisons fails cannot be foreseen.
        (one.mins.x - slack <= two.maxs.x)
            & (one.maxs.x + slack >= two.mins.x)
            & (one.mins.y - slack <= two.maxs.y)
            & (one.maxs.y + slack >= two.mins.y)
            & (one.mins.z - slack <= two.maxs.z)
            & (one.maxs.z + slack >= two.mins.z)
    }

    /// The pose of a link. The caller must pass one for every link; a link without one is taken to
    /// be at the origin.
    fn link_pose(&self, link: LinkId) -> Pose {
        let pose = self.link_poses.get(link.index());
        pose.copied().unwrap_or_default()
    }

    /// The pose, the frame and the bounds of the mover with that index.
    fn place(&self, mover: usize) -> (ParryPose, Frame, Aabb) {
        let links = &self.around.models.robot_geometry.solid_links;
        let pose = match links.get(mover) {
            Some(link) => self.link_pose(link.link),
            None => {
                let held = self.around.held.get(mover - links.len());
                held.map_or_else(Pose::identity, |held| self.link_pose(held.link) * held.at)
            }
        };
        let pose = to_parry(&pose);
        let frame = Frame::new(&pose);
        let bounds = frame.bounds_of(&self.around.containing_box(mover));
        (pose, frame, bounds)
    }

    fn place_all(&mut self) {
        let around = self.around;
        let links = around.models.robot_geometry.solid_links.iter();
        let links = links.map(|link| (PartKey::Robot(index(link.link)), link.link));
        let held = around.held.iter().map(|held| (held.key, held.link));
        let mut first = 0;
        self.scratch.movers.clear();
        for (place, (key, link)) in links.chain(held).enumerate() {
            let (pose, frame, bounds) = self.place(place);
            self.scratch.movers.push(Mover {
                key,
                link,
                pose,
                frame,
                bounds,
                first,
                is_placed: false,
            });
            first += around.solids(place).len();
        }
        // They are placed when they are needed.
        let point = OrientedBox::new(&Aabb::new(Vector::ZERO, Vector::ZERO));
        let anywhere = PlacedSolid::at(&ParryPose::IDENTITY, &point);
        self.scratch.solids.resize(first, anywhere);
    }

    fn place_moved(&mut self, moved: &[bool]) {
        for place in 0..self.scratch.movers.len() {
            // The index is one of this list.
            let link = self.scratch.movers[place].link;
            if moved.get(link.index()) == Some(&false) {
                continue;
            }
            let (pose, frame, bounds) = self.place(place);
            let mover = &mut self.scratch.movers[place];
            (mover.pose, mover.frame, mover.bounds) = (pose, frame, bounds);
            mover.is_placed = false;
        }
    }

    /// Whether the question is about the link and what does not belong to the robot.
    fn asks_of_world(&self, link: LinkId) -> bool {
        match (self.question.pairs, self.question.moving) {
            (Pairs::Changing, Some(moving)) => moving.moves(link),
            (Pairs::Constant, Some(moving)) => !moving.moves(link),
            (Pairs::All, _) | (_, None) => true,
        }
    }

    /// Whether the question is about two links of the robot.
    fn asks_of_links(&self, one: LinkId, other: LinkId) -> bool {
        match (self.question.pairs, self.question.moving) {
            (Pairs::Changing, Some(moving)) => moving.part(one, other),
            (Pairs::Constant, Some(moving)) => !moving.part(one, other),
            (Pairs::All, _) | (_, None) => true,
        }
    }

    /// Finds the furniture near any of the movers.
    fn find_furniture(&mut self) {
        let movers = self.scratch.movers.iter();
        let asked = movers.filter(|mover| self.asks_of_world(mover.link));
        let Some(bounds) = asked.map(|m| m.bounds).reduce(|a, b| a.merged(&b)) else {
            return;
        };
        let bounds = with_slack(&bounds, self.margin);
        let near = self.around.furniture.places_near(&bounds);
        self.scratch.furniture.extend(near);
    }

    /// Checks one mover against furniture, objects and floor.
    fn against_world(&mut self, place: usize) -> ControlFlow<()> {
        let around = self.around;
        let Some(mover) = self.scratch.movers.get(place) else {
            return ControlFlow::Continue(());
        };
        if !self.asks_of_world(mover.link) {
            return ControlFlow::Continue(());
        }
        let (key, lowest) = (mover.key, mover.bounds.mins.z);
        let (bounds, margin) = (with_slack(&mover.bounds, self.margin), self.margin);
        for i in 0..self.scratch.furniture.len() {
            // These are places in this list.
            let obstacle = &around.furniture.all()[self.scratch.furniture[i]];
            if !obstacle.placed.bounds.intersects(&bounds) || self.is_allowed(key, obstacle.key) {
                continue;
            }
            let (solid, placed) = (&obstacle.solid, &obstacle.placed);
            self.solids_against(place, obstacle.key, solid, placed, margin)?;
        }
        for object in &around.objects {
            if !object.bounds.intersects(&bounds) || self.is_allowed(key, object.key) {
                continue;
            }
            for solid in object.solids {
                let placed = PlacedSolid::new(solid, &object.pose);
                self.solids_against(place, object.key, solid, &placed, margin)?;
            }
        }
        let margin = match around.models.footing(key) {
            Footing::Rolls => return ControlFlow::Continue(()),
            Footing::Rides => self.margin.min(0.0),
            Footing::Reaches => self.margin,
        };
        if lowest < margin && !self.is_allowed(key, PartKey::Floor) {
            let first = self.place_solids(place);
            for (i, solid) in around.solids(place).iter().enumerate() {
                // The solids were placed from `first` on by the line above.
                let pose = self.scratch.solids[first + i].pose;
                if let Some(separation) = below_floor(&pose, solid, margin.min(self.margin)) {
                    self.report(Near {
                        moving: key,
                        other: PartKey::Floor,
                        separation,
                    })?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Checks two movers against each other.
    fn against_each_other(&mut self, a: usize, b: usize) -> ControlFlow<()> {
        let margin = self.margin.min(SELF_MARGIN);
        // Most pairs are far from each other.
        if !self.are_near(a, b, margin) {
            return ControlFlow::Continue(());
        }
        let around = self.around;
        let movers = &self.scratch.movers;
        let (Some(one), Some(two)) = (movers.get(a), movers.get(b)) else {
            return ControlFlow::Continue(());
        };
        if !self.asks_of_links(one.link, two.link) || self.is_allowed(one.key, two.key) {
            return ControlFlow::Continue(());
        }
        let (box1, box2) = (around.containing_box(a), around.containing_box(b));
        if box1.is_apart(&one.frame, &box2, &two.frame, margin.max(0.0)) {
            return ControlFlow::Continue(());
        }
        let bounds = with_slack(&one.bounds, margin);
        let other = two.key;
        let first = self.place_solids(b);
        for (i, solid) in around.solids(b).iter().enumerate() {
            // The solids were placed from `first` on by the line above.
            let placed = &self.scratch.solids[first + i];
            if placed.bounds.intersects(&bounds) {
                let placed = *placed;
                self.solids_against(a, other, solid, &placed, margin)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Checks the solids of a mover against one solid.
    fn solids_against(
        &mut self,
        place: usize,
        other: PartKey,
        other_solid: &Solid,
        other_placed: &PlacedSolid,
        margin: f64,
    ) -> ControlFlow<()> {
        let around = self.around;
        let first = self.place_solids(place);
        for (i, solid) in around.solids(place).iter().enumerate() {
            // The solids were placed from `first` on by the line above.
            // The visitor may have lowered the margin since.
            let margin = margin.min(self.margin);
            let placed = &self.scratch.solids[first + i];
            let (box1, box2) = (&solid.containing_box, &other_solid.containing_box);
            if !with_slack(&placed.bounds, margin).intersects(&other_placed.bounds)
                || box1.is_apart(&placed.frame, box2, &other_placed.frame, margin.max(0.0))
            {
                continue;
            }
            let near = if self.question.wanted == Wanted::Whether && margin == 0.0 {
                overlap(&placed.pose, solid, &other_placed.pose, other_solid)
            } else {
                separation(&placed.pose, solid, &other_placed.pose, other_solid, margin)
            };
            if let Some(separation) = near {
                // The mover exists: its solids were placed.
                let moving = self.scratch.movers[place].key;
                self.report(Near {
                    moving,
                    other,
                    separation,
                })?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Places the solids of the mover if needed, and returns the index of the first.
    fn place_solids(&mut self, place: usize) -> usize {
        let Scratch { movers, solids, .. } = &mut *self.scratch;
        // Callers pass the index of an existing mover.
        let mover = &mut movers[place];
        if !mover.is_placed {
            mover.is_placed = true;
            let own = solids.iter_mut().skip(mover.first);
            for (placed, solid) in own.zip(self.around.solids(place)) {
                *placed = PlacedSolid::new(solid, &mover.pose);
            }
        }
        mover.first
    }

    /// Whether the pair does not matter.
    fn is_allowed(&self, a: PartKey, b: PartKey) -> bool {
        let has = |pairs: &[(PartKey, PartKey)]| {
            let mut pairs = pairs.iter();
            pairs.any(|&(x, y)| (x == a && y == b) || (x == b && y == a))
        };
        has(self.question.allowed) || self.question.only.is_some_and(|only| !has(only))
    }

    fn report(&mut self, near: Near) -> ControlFlow<()> {
        (self.visit)(near, &mut self.margin)
    }
}

/// The bounds, grown by the margin (m) unless it is negative.
fn with_slack(bounds: &Aabb, margin: f64) -> Aabb {
    if margin > 0.0 {
        bounds.loosened(margin)
    } else {
        *bounds
    }
}

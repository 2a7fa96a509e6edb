//! The search behind collision queries: which primitives are close to each other.
//!
//! Bounds are compared first, from all links together down to primitives, then the boxes about what
//! is left; the primitives of moving parts are placed only when they are needed.

mod again;

use std::ops::ControlFlow;

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::{Pose as ParryPose, Vector};

use self::again::At;
pub(super) use self::again::Looked;
use super::frame::Frame;
use super::link_pairs::{BLOCK, LinkPairs, blocks_of, meet};
use super::models::Footing;
use super::moving_parts::{MovingParts, Pairs};
use super::near_solids::{visit_near, with_slack};
use super::oriented_box::OrientedBox;
use super::part_key::{PartKey, index};
use super::placed_solid::PlacedSolid;
use super::separation::{Separation, below_floor};
use super::solid::{Solid, to_parry};
use super::surroundings::Surroundings;
use crate::robot::LinkId;
use spatial::Pose;

/// Largest gap (m) required between parts of the robot, which are built to pass each other
/// closely.
const SELF_MARGIN: f64 = 0.005;

/// A pair closer than the margin.
pub struct Near {
    pub moving: PartKey,
    pub other: PartKey,
    pub(crate) separation: Separation,
}

/// What a query wants to know about a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Only that it is closer than the margin; distance and point are meaningless then.
    Whether,
    /// The distance, and where.
    HowMuch,
    /// As [`Wanted::HowMuch`], without pairs of the robot's own links.
    HowMuchToOthers,
    /// As [`Wanted::Whether`], without pairs of the robot's own links.
    WhetherToOthers,
}

impl Wanted {
    /// Whether distances do not matter.
    fn is_whether(self) -> bool {
        matches!(self, Self::Whether | Self::WhetherToOthers)
    }

    /// Whether pairs of the robot's own links do not matter.
    fn is_to_others(self) -> bool {
        matches!(self, Self::HowMuchToOthers | Self::WhetherToOthers)
    }
}

/// Which pairs a query looks at, and what it wants to know about them.
#[derive(Clone, Copy)]
pub struct Question<'q> {
    /// Pairs that do not matter, each [`in_order`], sorted.
    pub allowed: &'q [(PartKey, PartKey)],
    /// The pairs that matter, likewise, if not all.
    pub only: Option<&'q [(PartKey, PartKey)]>,
    /// The links that matter, and only with what is no part of the robot, if not all.
    pub links: Option<&'q [PartKey]>,
    /// What moves.
    pub moving: Option<&'q MovingParts>,
    /// Which pairs matter, by what moves.
    pub pairs: Pairs,
    /// Those of the robot's solid links that may matter.
    pub(crate) self_pairs: &'q LinkPairs,
    pub wanted: Wanted,
}

/// What is kept between queries of the same surroundings: memory, and the places of links.
#[derive(Default)]
pub struct Scratch {
    movers: Vec<Mover>,
    /// The bounds of each mover in the map frame (m). Most comparisons need nothing else, so they
    /// lie close together.
    bounds: Vec<Aabb>,
    /// The bounds (m) of each block of movers.
    blocks: Vec<Aabb>,
    solids: Vec<PlacedSolid>,
    /// The furniture near the robot: its bounds (m), and its places in the list of all.
    furniture: Vec<(Aabb, usize)>,
    /// The part of it that is near the block of movers being looked at.
    near_block: Vec<(Aabb, usize)>,
    /// The pairs of links with bounds that are near each other.
    near: Vec<(usize, usize)>,
    /// What has been looked at last: after a search that was stopped, the pair that stopped it.
    pub(super) last: Option<Looked>,
}

/// A link or a held object, placed for one query.
struct Mover {
    key: PartKey,
    /// The link, or the one that carries the object.
    link: LinkId,
    pose: ParryPose,
    frame: Frame,
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
    pub fn search(
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
        let Scratch { bounds, blocks, .. } = &mut *search.scratch;
        blocks.clear();
        blocks.extend(blocks_of(bounds));
        // Whether the visitor stopped the search is of no interest to the caller.
        if search.run().is_continue() {
            scratch.last = None;
        }
    }
}

impl<V: FnMut(Near, &mut f64) -> ControlFlow<()>> Search<'_, '_, V> {
    fn run(&mut self) -> ControlFlow<()> {
        let around = self.around;
        let links = &around.models.robot_geometry.solid_links;
        self.again()?;
        self.find_furniture();
        for block in 0..self.scratch.blocks.len() {
            let movers = self.scratch.movers.len();
            let block_places = block * BLOCK..((block + 1) * BLOCK).min(movers);
            let mut asked = block_places.clone();
            if asked.any(|place| self.asks_of_mover(&self.scratch.movers[place])) {
                self.find_furniture_near(block);
                for place in block_places {
                    if self.may_matter(place) {
                        self.against_world(place)?;
                    }
                }
            }
        }
        if self.question.wanted.is_to_others() || self.question.links.is_some() {
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
                pairs.retain(|pair| all.contains(*pair));
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
                let holds = |palm: &LinkId| around.models.belong_to_same_hand(*palm, link.link);
                if !held.hands.iter().flatten().any(holds) {
                    self.against_each_other(place, other)?;
                }
            }
            for (further, other) in around.held.iter().enumerate().skip(i + 1) {
                if other.load != held.load {
                    self.against_each_other(place, links.len() + further)?;
                }
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
        let Scratch { bounds, blocks, .. } = &*self.scratch;
        let pairs = self.question.self_pairs;
        pairs.near(bounds, blocks, margin.max(0.0), near);
    }

    /// Whether the bounds of two movers are closer than the margin (m).
    fn are_near(&self, a: usize, b: usize, margin: f64) -> bool {
        let bounds = &self.scratch.bounds;
        let (Some(one), Some(two)) = (bounds.get(a), bounds.get(b)) else {
            return false;
        };
        meet(&with_slack(one, margin), two)
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
        self.scratch.bounds.clear();
        for (place, (key, link)) in links.chain(held).enumerate() {
            let (pose, frame, bounds) = self.place(place);
            self.scratch.bounds.push(bounds);
            self.scratch.movers.push(Mover {
                key,
                link,
                pose,
                frame,
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
            self.place_again(place);
        }
    }

    /// Places the mover with that index where it is now.
    fn place_again(&mut self, place: usize) {
        let (pose, frame, bounds) = self.place(place);
        self.scratch.bounds[place] = bounds;
        let mover = &mut self.scratch.movers[place];
        (mover.pose, mover.frame) = (pose, frame);
        mover.is_placed = false;
    }

    /// Whether the question is about a link or a held object and what does not belong to the robot.
    fn asks_of_mover(&self, mover: &Mover) -> bool {
        let links = self.question.links;
        links.is_none_or(|links| links.contains(&mover.key)) && self.asks_of_world(mover.link)
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
        let movers = self.scratch.movers.iter().zip(&self.scratch.bounds);
        let asked = movers.filter(|(mover, _)| self.asks_of_mover(mover));
        let bounds = asked.map(|(_, bounds)| *bounds);
        let Some(bounds) = bounds.reduce(|a, b| a.merged(&b)) else {
            return;
        };
        let bounds = with_slack(&bounds, self.margin);
        let furniture = self.around.furniture;
        let near = furniture.places_near(&bounds);
        // These are places in the list.
        let near = near.map(|place| (furniture.all()[place].placed.bounds, place));
        self.scratch.furniture.extend(near);
    }

    /// Finds the furniture near a block of movers, out of that near any of them.
    fn find_furniture_near(&mut self, block: usize) {
        let Scratch {
            blocks,
            furniture,
            near_block,
            ..
        } = &mut *self.scratch;
        // Callers pass the number of a block.
        let bounds = with_slack(&blocks[block], self.margin);
        near_block.clear();
        near_block.extend(furniture.iter().filter(|(near, _)| meet(near, &bounds)));
    }

    /// Checks one mover against furniture, that near its block, objects and floor.
    fn against_world(&mut self, place: usize) -> ControlFlow<()> {
        let around = self.around;
        let scratch = &self.scratch;
        let (Some(mover), Some(own)) = (scratch.movers.get(place), scratch.bounds.get(place))
        else {
            return ControlFlow::Continue(());
        };
        if !self.asks_of_mover(mover) {
            return ControlFlow::Continue(());
        }
        let (key, lowest) = (mover.key, own.mins.z);
        let bounds = with_slack(own, self.margin);
        for i in 0..self.scratch.near_block.len() {
            let (near, obstacle) = &self.scratch.near_block[i];
            if meet(near, &bounds) {
                self.against_furniture(place, &bounds, *obstacle)?;
            }
        }
        for object in 0..around.objects.len() {
            self.against_object(place, &bounds, object)?;
        }
        let margin = match around.models.footing(key) {
            Footing::Rolls => return ControlFlow::Continue(()),
            Footing::Rides => self.margin.min(0.0),
            Footing::Reaches => self.margin,
        };
        if lowest < margin && !self.is_allowed(key, PartKey::Floor) {
            self.scratch.last = Some(Looked {
                mover: place,
                at: At::Floor,
            });
            let first = self.place_solids(place);
            for (i, solid) in around.solids(place).iter().enumerate() {
                // The solids were placed from `first` on by the line above.
                let pose = self.scratch.solids[first + i].pose;
                if let Some(separation) = below_floor(&pose, solid, margin.min(self.margin)) {
                    let near = Near {
                        moving: key,
                        other: PartKey::Floor,
                        separation,
                    };
                    (self.visit)(near, &mut self.margin)?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Checks a mover, whose bounds with the margin are given, against a piece of furniture.
    fn against_furniture(&mut self, mover: usize, bounds: &Aabb, place: usize) -> ControlFlow<()> {
        let around = self.around;
        // Both places are in their lists.
        let obstacle = &around.furniture.all()[place];
        let key = self.scratch.movers[mover].key;
        if !meet(&obstacle.placed.bounds, bounds) || self.is_allowed(key, obstacle.key) {
            return ControlFlow::Continue(());
        }
        self.scratch.last = Some(Looked {
            mover,
            at: At::Furniture(place),
        });
        let other = (&obstacle.solid, &obstacle.placed);
        self.against_solid(mover, obstacle.key, other)
    }

    /// Checks a mover, whose bounds with the margin are given, against an object.
    fn against_object(&mut self, mover: usize, bounds: &Aabb, place: usize) -> ControlFlow<()> {
        let around = self.around;
        // Both places are in their lists.
        let object = &around.objects[place];
        let key = self.scratch.movers[mover].key;
        if !object.bounds.intersects(bounds) || self.is_allowed(key, object.key) {
            return ControlFlow::Continue(());
        }
        self.scratch.last = Some(Looked {
            mover,
            at: At::Object(place),
        });
        for solid in object.solids {
            let placed = PlacedSolid::new(solid, &object.pose);
            self.against_solid(mover, object.key, (solid, &placed))?;
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
        let keys = (one.key, two.key);
        self.scratch.last = Some(Looked {
            mover: a,
            at: At::Mover(b),
        });
        let (first1, first2) = (self.place_solids(a), self.place_solids(b));
        let (solids1, solids2) = (around.solids(a), around.solids(b));
        let bounds = with_slack(&self.scratch.bounds[a], margin);
        // The solids were placed from these places on.
        let all = &self.scratch.solids;
        let (placed1, placed2) = (&all[first1..first1 + solids1.len()], &all[first2..]);
        let is_quick = self.question.wanted.is_whether();
        for other in solids2.iter().zip(placed2) {
            if other.1.bounds.intersects(&bounds) {
                let own = solids1.iter().zip(placed1);
                let mut visit = |separation, margin: &mut f64| {
                    let (moving, other) = keys;
                    let near = Near {
                        moving,
                        other,
                        separation,
                    };
                    (self.visit)(near, margin)
                };
                visit_near(own, other, is_quick, margin, &mut self.margin, &mut visit)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Checks the solids of a mover against one solid at its place.
    fn against_solid(
        &mut self,
        place: usize,
        other: PartKey,
        solid: (&Solid, &PlacedSolid),
    ) -> ControlFlow<()> {
        let (first, margin) = (self.place_solids(place), self.margin);
        // The mover exists: its solids were placed from `first` on.
        let moving = self.scratch.movers[place].key;
        let own = self.around.solids(place).iter();
        let own = own.zip(&self.scratch.solids[first..]);
        let is_quick = self.question.wanted.is_whether();
        let mut visit = |separation, margin: &mut f64| {
            let near = Near {
                moving,
                other,
                separation,
            };
            (self.visit)(near, margin)
        };
        visit_near(own, solid, is_quick, margin, &mut self.margin, &mut visit)
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
        let pair = in_order(a, b);
        let has = |pairs: &[(PartKey, PartKey)]| pairs.binary_search(&pair).is_ok();
        has(self.question.allowed) || self.question.only.is_some_and(|only| !has(only))
    }
}

/// The pair as lists of pairs have it.
pub(super) fn in_order(a: PartKey, b: PartKey) -> (PartKey, PartKey) {
    (a.min(b), a.max(b))
}

//! Looking again at the pair that was looked at last: searches for a free configuration go through many that are like
//! each other.

use std::ops::ControlFlow;

use super::{Near, Question, Scratch, Search, with_slack};
use crate::robot::LinkId;
use crate::world::surroundings::Surroundings;
use spatial::Pose;

/// A pair that has been looked at: the place of a mover, and what it may touch.
#[derive(Clone, Copy)]
pub(in crate::world) struct Looked {
    pub(super) mover: usize,
    pub(super) at: At,
}

impl Looked {
    /// The places of the movers.
    fn movers(self) -> impl Iterator<Item = usize> {
        let other = match self.at {
            At::Mover(other) => Some(other),
            At::Floor | At::Furniture(_) | At::Object(_) => None,
        };
        std::iter::once(self.mover).chain(other)
    }
}

/// What a mover may touch.
#[derive(Clone, Copy)]
pub(super) enum At {
    Floor,
    /// By its place in the list of all furniture.
    Furniture(usize),
    /// By its place in the list of objects.
    Object(usize),
    /// Another mover, by its place.
    Mover(usize),
}

impl Scratch {
    /// The links of what has been looked at last.
    pub(in crate::world) fn last_links(&self) -> impl Iterator<Item = LinkId> {
        let movers = self.last.into_iter().flat_map(Looked::movers);
        movers.filter_map(|place| Some(self.movers.get(place)?.link))
    }
}

impl Surroundings<'_> {
    /// The pair that another search has looked at, if it is still closer than the margin (m) and matters; of the poses,
    /// those of [its links](Scratch::last_links) are enough. `scratch` is for such searches only.
    pub(in crate::world) fn near_again(
        &self,
        looked: Looked,
        link_poses: &[Pose],
        question: Question<'_>,
        margin: f64,
        scratch: &mut Scratch,
    ) -> Option<Near> {
        let mut found = None;
        let visit = |near, _: &mut f64| {
            found = Some(near);
            ControlFlow::Break(())
        };
        let mut search = Search {
            around: self,
            link_poses,
            question,
            margin,
            scratch,
            visit,
        };
        match search.scratch.movers.is_empty() {
            true => search.place_all(),
            false => looked.movers().for_each(|place| search.place_again(place)),
        }
        search.scratch.last = Some(looked);
        // What has been found says as much.
        let _ = search.again();
        found
    }
}

impl<V: FnMut(Near, &mut f64) -> ControlFlow<()>> Search<'_, '_, V> {
    /// Looks first at the pair that has stopped the last search, where any pair is as good as another one: searches for
    /// a free configuration ask about many that are like each other.
    pub(super) fn again(&mut self) -> ControlFlow<()> {
        let last = self.scratch.last.take();
        if !self.question.wanted.is_whether() || self.question.only.is_some() {
            return ControlFlow::Continue(());
        }
        match last {
            Some(Looked {
                mover,
                at: At::Mover(other),
            }) if self.question.links.is_none() => match self.question.wanted.is_to_others() {
                true => ControlFlow::Continue(()),
                false => self.against_each_other(mover, other),
            },
            Some(Looked { mover, at }) => {
                let scratch = &self.scratch;
                let (Some(bounds), true) = (
                    scratch.bounds.get(mover),
                    (scratch.movers.get(mover)).is_some_and(|mover| self.asks_of_mover(mover)),
                ) else {
                    return ControlFlow::Continue(());
                };
                let bounds = with_slack(bounds, self.margin);
                match at {
                    At::Furniture(place) => self.against_furniture(mover, &bounds, place),
                    At::Object(place) => self.against_object(mover, &bounds, place),
                    At::Floor | At::Mover(_) => ControlFlow::Continue(()),
                }
            }
            None => ControlFlow::Continue(()),
        }
    }
}

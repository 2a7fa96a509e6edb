//! Ends tasks prematurely.

use super::Scheduler;
use super::live::{Answer, Ending, Live, Slot, Told, Wait};
use crate::host::Host;
use lisp::image::Image;

impl<C: 'static> Scheduler<C> {
    /// Evaporates a task and all below it: each unwinds when all below it have ended. Tasks that
    /// are ending already or must not be disturbed are left alone.
    pub(super) fn evaporate(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        slot: Slot,
    ) {
        let mut doomed = Vec::new();
        let mut pending = vec![slot];
        while let Some(slot) = pending.pop() {
            let Some(live) = self.live_mut(slot) else {
                continue;
            };
            if live.ending.is_some() {
                continue;
            }
            if live.scheduling < 0 {
                live.told = Told::Evaporate;
                continue;
            }
            live.ending = Some(Ending::Evaporated);
            live.is_suspended = false;
            live.hooks.clear();
            doomed.push(slot);
            pending.extend(live.children.iter().rev().copied());
        }
        for slot in doomed {
            self.give_up_wait(image, host, slot);
            let Some(live) = self.live_mut(slot) else {
                continue;
            };
            if matches!(live.answer, Some(Answer::Start(..))) {
                live.answer = None;
                self.end(image, slot);
                continue;
            }
            live.answer = None;
            if live.children.is_empty() {
                self.make_ready(slot, Answer::Unwind);
            } else {
                self.block(slot, Wait::LastChildren, None);
            }
        }
    }

    /// Evaporates all children of an entry.
    pub(super) fn evaporate_children(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        slot: Slot,
    ) {
        let children = self.live(slot).map(|l| l.children.clone());
        for child in children.unwrap_or_default() {
            self.evaporate(image, host, child);
        }
    }

    /// Ends dying tasks that would never end by themselves, without running their cleanup code; if
    /// that code waits for tasks of its own, evaporates these first. Returns whether there were
    /// any.
    pub(super) fn bury(&mut self, image: &mut Image, host: &mut dyn Host<Call = C>) -> bool {
        let stuck: Vec<Slot> = self
            .dying()
            .filter(|l| l.children.is_empty())
            .filter_map(|l| l.task.as_ref().and_then(|t| t.get().slot.get()))
            .collect();
        for slot in &stuck {
            self.give_up_wait(image, host, *slot);
            self.end(image, *slot);
        }
        if !stuck.is_empty() {
            return true;
        }
        let begun_late: Vec<Slot> = self
            .dying()
            .flat_map(|l| l.children.iter().copied())
            .filter(|child| self.live(*child).is_some_and(|l| l.ending.is_none()))
            .collect();
        for slot in &begun_late {
            if let Some(live) = self.live_mut(*slot) {
                live.scheduling = 0;
            }
            self.evaporate(image, host, *slot);
        }
        !begun_late.is_empty()
    }

    fn dying(&self) -> impl Iterator<Item = &Live> {
        let alive = self.entries.iter().flatten().map(|live| &**live);
        alive.filter(|live| live.ending.is_some())
    }
}

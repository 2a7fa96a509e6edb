//! The physical state as a frame of the tape, and what snapshots need of it while it is stale.

use std::rc::Rc;
use std::sync::Arc;

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use super::explain::Remembered;
use super::held::Held;
use super::{Axes, Simulation};
use crate::tape::{Data, Entry, Frame};
use lisp::image::Image;
use lisp::value::Value;
use robotics::motion::{DetectQuery, MotionFailure};
use robotics::world::Snapshot;
use view::picture::LocationMap;

/// The physical state while no motion is active.
#[derive(Serialize, Deserialize)]
struct State {
    world: Vec<u8>,
    names: Vec<(String, Data)>,
    held: IndexMap<String, Held>,
    axes: Option<Axes>,
    location_map: Option<Arc<LocationMap>>,
    noises: u64,
    searches: u64,
    sought: Option<DetectQuery>,
    last_account: Option<String>,
    /// The number of the frame with the last failure.
    last_failure: Option<u64>,
    begun: u64,
}

/// The last failure of a motion.
#[derive(Serialize, Deserialize)]
struct Failed {
    failure: MotionFailure,
    /// Simulated time (s).
    time: f64,
    world: Vec<u8>,
}

/// What a snapshot restores.
pub(crate) struct Restored {
    pub world: Snapshot,
    pub names: IndexMap<String, Value>,
    pub held: IndexMap<String, Held>,
    pub axes: Option<Axes>,
    /// How many searches for locations have begun.
    pub(crate) searches: u64,
}

impl Simulation {
    /// The hash of the world, also while it is stale.
    pub(crate) fn state_hash(&mut self) -> u64 {
        if self.tape.is_playing() {
            return match self.tape.next() {
                Some(Entry::Hash(hash)) => hash,
                _ => {
                    self.tape.fail();
                    0
                }
            };
        }
        let hash = match self.tape.present() {
            Some(frame) => frame.hash,
            None => self.physical.world.hash(),
        };
        self.tape.put(&Entry::Hash(hash));
        hash
    }

    /// Whether no motion is active or waiting, also while the world is stale.
    pub(crate) fn is_idle(&mut self) -> bool {
        if self.tape.is_playing() {
            return match self.tape.next() {
                Some(Entry::Rest(rests)) => rests,
                _ => {
                    self.tape.fail();
                    true
                }
            };
        }
        let rests = self.physical.jobs.is_idle();
        self.tape.put(&Entry::Rest(rests));
        rests
    }

    /// A frame of the present state, if it is recorded and can be written.
    pub(crate) fn frame(&mut self, image: &Image) -> Option<Rc<Frame>> {
        if !self.tape.is_recording() {
            return None;
        }
        if let Some(frame) = self.tape.present() {
            return Some(frame);
        }
        let last_failure = match &self.physical.last_failure {
            Some(_) => Some(self.failure_frame()?),
            None => None,
        };
        let Self { tape, physical, .. } = self;
        let names = physical.names.iter();
        let names = names.map(|(name, value)| {
            let data = Data::of(image, value, &[])?;
            Some((name.clone(), data))
        });
        let state = State {
            world: physical.world.snapshot().to_bytes()?,
            names: names.collect::<Option<_>>()?,
            held: physical.held.clone(),
            axes: physical.axes.clone(),
            location_map: physical.location_map.clone(),
            noises: physical.noises,
            searches: physical.searches,
            sought: physical.sought.clone(),
            last_account: physical.last_account.clone(),
            last_failure,
            begun: physical.jobs.begun,
        };
        let frame = tape.take(physical.world.hash(), &state)?;
        if physical.jobs.is_idle() {
            tape.is_at(&frame);
        }
        Some(frame)
    }

    /// The number of the frame with the last failure.
    fn failure_frame(&mut self) -> Option<u64> {
        let Self { tape, physical, .. } = self;
        let last = physical.last_failure.as_mut()?;
        if last.frame.is_none() {
            let state = Failed {
                failure: last.failure.clone(),
                time: last.time,
                world: last.world.snapshot().to_bytes()?,
            };
            last.frame = tape.take(last.world.hash(), &state);
        }
        last.frame.as_ref().map(|frame| frame.number)
    }

    /// The frame with the last failure, if it has one.
    pub(crate) fn last_failure_frame(&self) -> Option<u64> {
        let last = self.physical.last_failure.as_ref()?;
        last.frame.as_ref().map(|frame| frame.number)
    }

    /// What a snapshot with that frame restores.
    pub(crate) fn restored(&self, image: &mut Image, frame: &Frame) -> Option<Restored> {
        self.restored_of(image, frame.state()?)
    }

    fn restored_of(&self, image: &mut Image, state: State) -> Option<Restored> {
        let mut names = IndexMap::new();
        for (name, data) in state.names {
            names.insert(name, data.value(image, &[])?);
        }
        Some(Restored {
            world: Snapshot::from_bytes(&self.physical.world, &state.world)?,
            names,
            held: state.held,
            axes: state.axes,
            searches: state.searches,
        })
    }

    /// Takes the world back to a snapshot; ongoing motions end. This is the same for the tape as a
    /// change that it answers for.
    pub(crate) fn restore(&mut self, restored: &Restored) {
        self.tape.note_change_apart();
        let physical = &mut self.physical;
        physical.world.restore(&restored.world);
        physical.names.clone_from(&restored.names);
        physical.held.clone_from(&restored.held);
        physical.axes.clone_from(&restored.axes);
        physical.searches = restored.searches;
        physical.jobs.clear();
    }

    /// Puts the world into the state of a frame. Returns false if the frame is damaged; the state is
    /// of no use then.
    pub(crate) fn load(&mut self, image: &mut Image, frame: &Rc<Frame>) -> bool {
        self.try_load(image, frame).is_some()
    }

    fn try_load(&mut self, image: &mut Image, frame: &Rc<Frame>) -> Option<()> {
        let mut state: State = frame.state()?;
        let (sought, begun, noises) = (state.sought.take(), state.begun, state.noises);
        let (location_map, last_account) = (state.location_map.take(), state.last_account.take());
        let last_failure = match state.last_failure {
            None => None,
            Some(number) => {
                let frame = self.tape.frame(number)?;
                let failed: Failed = frame.state()?;
                let mut world = self.physical.world.clone();
                world.restore(&Snapshot::from_bytes(&world, &failed.world)?);
                Some(Box::new(Remembered {
                    failure: failed.failure,
                    time: failed.time,
                    world,
                    frame: Some(frame),
                }))
            }
        };
        let restored = self.restored_of(image, state)?;
        let physical = &mut self.physical;
        physical.world.restore(&restored.world);
        if physical.world.hash() != frame.hash {
            return None;
        }
        physical.names = restored.names;
        physical.held = restored.held;
        physical.axes = restored.axes;
        physical.noises = noises;
        physical.searches = restored.searches;
        physical.location_map = location_map;
        physical.resolved_map = None;
        physical.last_account = last_account;
        physical.jobs.clear();
        physical.jobs.begun = begun;
        physical.sought = sought;
        physical.last_failure = last_failure;
        self.tape.has_loaded(Rc::clone(frame));
        Some(())
    }
}

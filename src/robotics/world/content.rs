//! What is in vessels, by the level model: a vessel holds what is below the lowest point of its rim. What
//! is above leaves over the lip as soon as the vessel is tilted, whatever tilts it, and falls on a parabola
//! into the vessel below or beside it. There is no viscosity, no splashing, and no weight of a content.

use std::sync::Arc;

use super::cavity::Cavity;
use super::error::WorldError;
use super::hash::Hasher;
use super::object::Object;
use super::scene::World;
use spatial::{Pose, trig};

/// How fast (m/s) a stream leaves a lip, level.
const STREAM_SPEED: f64 = 0.2;
/// How fast (m/s²) what falls gets faster.
const GRAVITY: f64 = 9.81;
/// As much (ml) stays above the level, by the surface that holds it.
const CLINGS: f64 = 0.05;
/// A vessel that is tilted more than this (rad) catches nothing.
const CATCHES: f64 = 0.5;

/// What a content of several parts is called.
pub const MIXTURE: &str = "mixture";

/// What is in a vessel, or has been.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Content {
    /// What it is, such as `water`; empty for a vessel that has had no content.
    pub what: String,
    /// How much (ml) is in it.
    pub volume: f64,
    /// How much (ml) has left it and has fallen beside every vessel.
    pub spilled: f64,
}

impl Content {
    pub(super) fn hash_into(&self, hasher: &mut Hasher) {
        hasher.text(&self.what);
        hasher.number(self.volume);
        hasher.number(self.spilled);
    }
}

/// How far (rad) a vessel at a pose is from upright.
pub fn tilt_of(at: &Pose) -> f64 {
    let up = at.rotation * nalgebra::Vector3::z();
    trig::atan2(up.xy().norm(), up.z)
}

impl Object {
    /// The room inside it; `None` if it is no open vessel.
    pub fn cavity(&self) -> Option<&Cavity> {
        let cavity = self.cavity.get_or_init(|| {
            let found = match &self.inside {
                Some(inside) => Cavity::behind(&self.solids, inside),
                None => Cavity::of(&self.solids),
            };
            found.map(Arc::new)
        });
        cavity.as_deref()
    }

    /// What is in it.
    pub fn content(&self) -> &Content {
        &self.content
    }
}

impl World {
    /// Fills a vessel with so much (ml) of something, in place of what was in it, grains, too; nothing is
    /// spilled any more. What is too much for it is lost at the next step.
    pub fn set_content(&mut self, name: &str, what: &str, volume: f64) -> Result<(), WorldError> {
        let number = self.object(name)?.number;
        self.remove_grains_of(number);
        if let Some(object) = self.state.objects.get_mut(name) {
            object.content = Content {
                what: what.to_owned(),
                volume,
                spilled: 0.0,
            };
        }
        Ok(())
    }

    /// Lets what is above the level of each vessel leave it.
    pub(super) fn pour(&mut self) {
        for place in 0..self.state.objects.len() {
            let Some((_, object)) = self.state.objects.get_index(place) else {
                continue;
            };
            if object.content.volume <= CLINGS {
                // A drop in a vessel upside down falls, too, with the next that leaves it.
                continue;
            }
            let Some(cavity) = object.cavity() else {
                continue;
            };
            if cavity.portion.is_some() {
                // It leaves holes only when it is shaken: `super::shaking`.
                continue;
            }
            let at = self.physics.pose(object.body);
            let level = cavity.volume_at(tilt_of(&at));
            let excess = object.content.volume - level;
            if excess <= CLINGS {
                continue;
            }
            let (lip, out) = cavity.lip(&at);
            self.let_fall(place, excess, &lip, &out);
        }
    }

    /// So much (ml) leaves the vessel with a number at a point, with the speed of a stream in a level direction, or
    /// straight down if that is none, and falls into the vessel below or beside it.
    pub(super) fn let_fall(
        &mut self,
        place: usize,
        amount: f64,
        from: &nalgebra::Point3<f64>,
        out: &nalgebra::Vector3<f64>,
    ) {
        let caught = self.catcher(place, from, out);
        let Some((_, source)) = self.state.objects.get_index_mut(place) else {
            return;
        };
        source.content.volume -= amount;
        let what = source.content.what.clone();
        let spilled = match caught {
            None => amount,
            Some((into, room)) => {
                let fits = amount.min(room);
                if let Some((_, target)) = self.state.objects.get_index_mut(into) {
                    target.content.volume += fits;
                    if target.content.what.is_empty() || target.content.volume <= fits {
                        target.content.what = what;
                    } else if target.content.what != what {
                        MIXTURE.clone_into(&mut target.content.what);
                    }
                }
                amount - fits
            }
        };
        if let Some((_, source)) = self.state.objects.get_index_mut(place) {
            source.content.spilled += spilled;
        }
    }

    /// The vessel into which a stream from a lip falls first, and how much (ml) still fits into it.
    fn catcher(
        &self,
        source: usize,
        lip: &nalgebra::Point3<f64>,
        out: &nalgebra::Vector3<f64>,
    ) -> Option<(usize, f64)> {
        let mut best: Option<(usize, f64, f64)> = None;
        for (place, object) in self.state.objects.values().enumerate() {
            if place == source {
                continue;
            }
            let at = self.physics.pose(object.body);
            let far = (at.translation.vector - lip.coords).xy().norm();
            if far > 1.0 || tilt_of(&at) > CATCHES {
                continue;
            }
            let Some(cavity) = object.cavity().filter(|cavity| cavity.portion.is_none()) else {
                continue;
            };
            let mouth = cavity.mouth_at(&at);
            let fall = lip.z - mouth.z;
            if fall < 0.0 || best.is_some_and(|(_, _, rim)| rim >= mouth.z) {
                continue;
            }
            let way = STREAM_SPEED * (2.0 * fall / GRAVITY).sqrt();
            let lands = lip.coords + out * way;
            if (lands - mouth.coords).xy().norm() < cavity.narrowest {
                let room = cavity.volume_at(tilt_of(&at)) - object.content.volume;
                best = Some((place, room.max(0.0), mouth.z));
            }
        }
        best.map(|(place, room, _)| (place, room))
    }
}

//! What falls out of shakers. A shaker loses a portion each time it is shaken: when it is turned down and its turn
//! changes to the opposite direction, both times faster than a hand moves that carries it. The portion falls straight
//! down from the middle of the holes, into the vessel below or beside it. A portion is a figure of the description, not
//! a result: how fine a powder is, and how it clots, is not modelled.

use super::content::tilt_of;
use super::scene::World;

/// A shaker that is tilted more than this (rad) is turned down.
const TURNED_DOWN: f64 = 2.0;
/// How fast (rad/s) a shaker turns at least when it is shaken.
const SHAKEN: f64 = 0.5;

impl World {
    /// Lets shakers that are shaken lose their portions.
    pub(super) fn shake(&mut self) {
        for place in 0..self.state.objects.len() {
            let Some((_, object)) = self.state.objects.get_index(place) else {
                continue;
            };
            let holes = object.inside.and_then(|inside| inside.portion);
            let Some(portion) = holes.filter(|_| object.content.volume > 0.0) else {
                continue;
            };
            let at = self.physics.pose(object.body);
            let swing = object.swing;
            if tilt_of(&at) < TURNED_DOWN {
                self.note_swing(place, nalgebra::Vector3::zeros());
                continue;
            }
            let (_, turn) = self.physics.velocity(object.body);
            if turn.norm() < SHAKEN {
                continue;
            }
            let is_back = turn.dot(&swing) < 0.0;
            if !is_back && turn.norm() <= swing.norm() {
                continue;
            }
            let mouth = object.cavity().map(|cavity| cavity.mouth_at(&at));
            let amount = portion.min(object.content.volume);
            self.note_swing(place, turn);
            if let Some(mouth) = mouth.filter(|_| is_back) {
                self.let_fall(place, amount, &mouth, &nalgebra::Vector3::zeros());
            }
        }
    }

    fn note_swing(&mut self, place: usize, swing: nalgebra::Vector3<f64>) {
        if let Some((_, object)) = self.state.objects.get_index_mut(place) {
            object.swing = swing;
        }
    }
}

//! Keeping what is seen every now and then, for moving pictures.

use super::Audience;
use crate::picture::animation::Shot;
use crate::picture::{View, ViewError};
use crate::session::simulation::Simulation;

/// Shots of a session as time passes.
pub(crate) struct Film {
    wanted: Filming,
    /// When (simulated s) the next shot is due.
    next: f64,
    shots: Vec<Shot>,
}

/// What is to be filmed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Filming {
    /// From where.
    pub(crate) view: View,
    /// Pixels per row.
    pub(crate) width: usize,
    /// Rows.
    pub(crate) height: usize,
    /// Simulated time from one shot to the next (s).
    pub(crate) every: f64,
}

impl Audience {
    /// Keeps a shot every now and then from here on.
    pub(crate) fn start_film(
        &mut self,
        simulation: &Simulation,
        wanted: Filming,
    ) -> Result<(), ViewError> {
        // A view that there is not is told at once.
        wanted
            .view
            .camera(&simulation.world, wanted.width, wanted.height)?;
        self.film = Some(Film {
            wanted,
            next: simulation.now,
            shots: Vec::new(),
        });
        Ok(())
    }

    /// The shots since the film was started, the last of them as everything is now.
    pub(crate) fn end_film(&mut self, simulation: &Simulation) -> Vec<Shot> {
        self.shoot(simulation);
        self.film.take().map_or_else(Vec::new, |film| film.shots)
    }

    /// Keeps a shot if one is due.
    pub(crate) fn film(&mut self, simulation: &Simulation) {
        let now = simulation.now;
        let Some(film) = &mut self.film else { return };
        if now + 1e-9 < film.next {
            return;
        }
        film.next = now.max(film.next + film.wanted.every);
        self.shoot(simulation);
    }

    fn shoot(&mut self, simulation: &Simulation) {
        let Some(film) = &self.film else { return };
        let Filming {
            view,
            width,
            height,
            ..
        } = film.wanted;
        // The view was there when the film was started, and furniture stays.
        let Ok(camera) = view.camera(&simulation.world, width, height) else {
            return;
        };
        let scene = simulation.scene();
        if let Some(film) = &mut self.film {
            film.shots.push(Shot { scene, camera });
        }
    }
}

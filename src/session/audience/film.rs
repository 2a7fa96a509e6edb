//! Taking shots of the world at regular intervals, for animations.

use super::Audience;
use crate::simulation::Simulation;
use view::picture::animation::Shot;
use view::picture::{View, ViewError};

/// Shots of a session over time.
pub(crate) struct Film {
    wanted: Filming,
    /// Simulated time (s) at which the next shot is due.
    next: f64,
    shots: Vec<Shot>,
}

/// How to film.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Filming {
    /// The viewpoint.
    pub view: View,
    /// Width of a shot in pixels.
    pub width: usize,
    /// Height of a shot in pixels.
    pub height: usize,
    /// Simulated time (s) from one shot to the next.
    pub every: f64,
}

impl Audience {
    /// Starts to film.
    pub fn start_film(
        &mut self,
        simulation: &Simulation,
        wanted: Filming,
    ) -> Result<(), ViewError> {
        // Report a view that does not exist at once.
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

    /// Ends the film and returns its shots; the last one shows the present state.
    pub fn end_film(&mut self, simulation: &Simulation) -> Vec<Shot> {
        self.shoot(simulation);
        self.film.take().map_or_else(Vec::new, |film| film.shots)
    }

    /// Takes a shot if one is due.
    pub fn film(&mut self, simulation: &Simulation) {
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
        // The view existed when the film was started, and furniture does not disappear.
        let Ok(camera) = view.camera(&simulation.world, width, height) else {
            return;
        };
        let scene = simulation.scene();
        if let Some(film) = &mut self.film {
            film.shots.push(Shot { scene, camera });
        }
    }
}

//! What of the furniture opens: drawers and doors, with their handles.

use crate::fittings::{Door, Drawer, Fittings};
use crate::furniture::Maker;
use crate::modules::Module;
use crate::plan::{ASIDE, Row};

impl Maker<'_> {
    fn fittings(&self) -> Fittings {
        let style = self.plan.style;
        Fittings {
            front: style.front,
            bar: style.bar,
            ahead: style.ahead,
        }
    }

    pub(super) fn drawers(
        &mut self,
        unit: &str,
        width: f64,
        [low, high]: [f64; 2],
        shares: &[f64],
    ) {
        let style = self.plan.style;
        let length = (style.depth - 0.08).min(style.travel + 0.04);
        let mut from = low;
        let count = shares.len();
        for (number, share) in shares.iter().enumerate() {
            let tall = (high - low) * share;
            let middle = from + tall / 2.0;
            let bar = (width - 0.09).min(self.numbers.between("handle.length", 0.16, 0.6));
            let above = match self.numbers.flag("handle.middle", 0.4) {
                true => 0.0,
                false => (tall / 2.0 - 0.045).max(0.0),
            };
            let drawer = Drawer {
                unit,
                name: &format!("{unit}_drawer_{}", count - number),
                width,
                tall,
                length,
                at: [0.0, middle],
                travel: style.travel.min(length),
                handle: [bar, above],
            };
            let main = self.fittings().drawer(&mut self.urdf, &drawer);
            self.inventory.drawers.push((main, middle, tall));
            from += tall;
        }
    }

    /// A door with an upright handle.
    pub(super) fn door(&mut self, door: &Door<'_>) {
        self.fittings().door(&mut self.urdf, door);
    }

    /// Whether the door of a cabinet on the wall has room to open.
    pub(super) fn opens(&self, row: &Row, module: &Module, is_left: bool) -> bool {
        let style = self.plan.style;
        let depth = style.hanging[2];
        let (from, to) = (module.at, module.at + module.width);
        let aside = match is_left {
            true => [from - ASIDE, to],
            false => [from, to + ASIDE],
        };
        let ahead = depth + module.width + style.front + style.ahead + style.bar;
        let needed = row.rectangle([depth + 0.03, aside[0]], [ahead, aside[1]]);
        let mut others = self.plan.rows.iter().flat_map(|other| {
            let modules = other.modules.iter();
            modules.filter_map(move |one| {
                let depth = match one.unit.is_tall() {
                    true => style.depth + 0.08,
                    false if other.name != row.name && other.has_wall => depth + 0.08,
                    false => return None,
                };
                Some(other.rectangle([0.0, one.at], [depth, one.at + one.width]))
            })
        });
        needed.is_inside(&self.plan.room) && !others.any(|other| other.overlaps(&needed))
    }
}

//! Which solids are close to one: boxes first, then shapes.

use std::ops::ControlFlow;

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};

use super::placed_solid::PlacedSolid;
use super::separation::{Separation, overlap, separation};
use super::solid::Solid;

/// Visits the solids that are closer to another one than the margin (m) and than `most` (m), which
/// the visitor may lower, until the visitor stops. With `is_quick` the distances are meaningless:
/// how deep solids overlap costs much more than that they do.
pub(super) fn visit_near<'a>(
    solids: impl Iterator<Item = (&'a Solid, &'a PlacedSolid)>,
    (other, at): (&Solid, &PlacedSolid),
    is_quick: bool,
    margin: f64,
    most: &mut f64,
    visit: &mut impl FnMut(Separation, &mut f64) -> ControlFlow<()>,
) -> ControlFlow<()> {
    for (solid, placed) in solids {
        let margin = margin.min(*most);
        let (box1, box2) = (&solid.containing_box, &other.containing_box);
        if !with_slack(&placed.bounds, margin).intersects(&at.bounds)
            || box1.is_apart(&placed.frame, box2, &at.frame, margin.max(0.0))
        {
            continue;
        }
        let (one, two) = (&placed.pose, &at.pose);
        let overlapping = match is_quick && margin >= 0.0 {
            true => overlap(one, solid, two, other),
            false => None,
        };
        let near = match overlapping {
            // Without a margin, nothing else counts.
            None if !is_quick || margin != 0.0 => separation(one, solid, two, other, margin),
            known => known,
        };
        if let Some(separation) = near {
            visit(separation, most)?;
        }
    }
    ControlFlow::Continue(())
}

/// The bounds, grown by the margin (m) unless it is negative.
pub(super) fn with_slack(bounds: &Aabb, margin: f64) -> Aabb {
    if margin > 0.0 {
        bounds.loosened(margin)
    } else {
        *bounds
    }
}

//! Drawers and doors behind others: what has to be open before they can move.

use std::collections::BTreeMap;

use super::furniture::{Container, containers};
use crate::robot::JointId;
use crate::world::{Models, ShutKitchen};

/// Positions on the way of a drawer or door that are looked at.
const STEPS: u32 = 24;

/// What has to be open before a drawer or door can move, if there is something: another one, which is in its
/// way while it is shut, and is not once it is open.
pub fn container_before(models: &Models, container: &Container) -> Option<Container> {
    let before = models.kept_orders().get_or_init(|| orders(models));
    let joint = before.get(&container.joint)?;
    containers(models).into_iter().find(|c| c.joint == *joint)
}

/// For each joint behind another one, that one.
fn orders(models: &Models) -> BTreeMap<JointId, JointId> {
    let all = containers(models);
    let ends = |container: &Container| {
        let limits = models.kitchen.joint(container.joint).limits?;
        Some([limits.lower, limits.upper])
    };
    let shut = ShutKitchen::new(models);
    let mut found = BTreeMap::new();
    for inner in &all {
        let Some([lower, upper]) = ends(inner) else {
            continue;
        };
        let at = |i: u32| lower + (upper - lower) * f64::from(i) / f64::from(STEPS);
        let positions: Vec<f64> = (1..=STEPS).map(at).collect();
        let blocks = |outer: &&Container| {
            let open = ends(outer).map(|[_, upper]| upper);
            let pair = [inner.joint, outer.joint];
            inner.joint != outer.joint
                && !models.kitchen.carries(outer.link, inner.link)
                && !models.kitchen.carries(inner.link, outer.link)
                && shut.meet(pair, &positions, None)
                && open.is_some_and(|open| !shut.meet(pair, &positions, Some(open)))
        };
        if let Some(outer) = all.iter().find(blocks) {
            found.insert(inner.joint, outer.joint);
        }
    }
    found
}

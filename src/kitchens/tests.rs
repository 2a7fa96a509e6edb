//! What holds for every kitchen.

use std::collections::{BTreeMap, BTreeSet};

use super::*;

/// The kitchens of some seeds.
fn kitchens(count: u64) -> Vec<Kitchen> {
    (0..count).filter_map(Kitchen::of_seed).collect()
}

#[test]
fn a_thousand_seeds_give_a_thousand_different_kitchens() {
    let all = kitchens(1000);
    assert_eq!(all.len(), 1000);
    let different: BTreeSet<&str> = all.iter().map(|kitchen| kitchen.urdf.as_str()).collect();
    assert_eq!(different.len(), 1000);
}

#[test]
fn the_same_seed_gives_the_same_kitchen() {
    for seed in [0, 1, 17, u64::MAX] {
        assert_eq!(Kitchen::of_seed(seed), Kitchen::of_seed(seed));
    }
}

#[test]
fn every_arrangement_occurs_and_rejections_are_rare() {
    let all = kitchens(500);
    let mut arrangements: BTreeMap<Arrangement, usize> = BTreeMap::new();
    let mut rejected: BTreeMap<Rejection, usize> = BTreeMap::new();
    for kitchen in &all {
        *arrangements.entry(kitchen.facts.arrangement).or_default() += 1;
        for rejection in &kitchen.facts.rejections {
            *rejected.entry(*rejection).or_default() += 1;
        }
    }
    assert_eq!(arrangements.len(), 7, "{arrangements:?}");
    assert!(
        arrangements.values().all(|count| *count >= 10),
        "{arrangements:?}"
    );
    let count: usize = rejected.values().sum();
    assert!(count * 2 <= all.len(), "{rejected:?}");
}

#[test]
fn every_kitchen_has_drawers_a_sink_and_a_fridge() {
    for kitchen in kitchens(300) {
        assert!(kitchen.facts.drawers >= 3, "{:?}", kitchen.facts);
        for link in ["\"sink\"", "\"fridge_door_handle\"", "\"wall_back\""] {
            assert!(kitchen.urdf.contains(link), "{:?}", kitchen.facts);
        }
        for place in ["table", "sink", "fridge", "cutlery-drawer", "bowl-drawer"] {
            assert!(
                kitchen.description.contains(&format!("(place {place} ")),
                "{place}: {}",
                kitchen.description
            );
        }
        assert!(kitchen.facts.aisle >= 1.0, "{:?}", kitchen.facts);
        assert!((0.85..=0.95).contains(&kitchen.facts.counter_height));
    }
}

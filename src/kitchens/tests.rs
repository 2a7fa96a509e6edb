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

/// Hashes of the first kitchens and of some others: sweeps rely on them.
#[test]
fn the_kitchens_of_seeds_stay_as_they_are() {
    let hash = |seeds: std::ops::Range<u64>| {
        let texts = seeds.filter_map(Kitchen::of_seed);
        let texts = texts.map(|kitchen| kitchen.urdf + &kitchen.description);
        texts.fold(0_u64, |all, text| {
            all.rotate_left(5) ^ sweep::draw::fnv1a(&text)
        })
    };
    assert_eq!(hash(0..300), 0x76ea_d669_508b_d362);
    assert_eq!(hash(500_000..500_100), 0xf69e_8961_3366_cdfc);
}

/// The text of parameters that are set.
fn set(texts: &[(&str, &str)]) -> Settings {
    let mut settings = Settings::default();
    for (name, text) in texts {
        settings.set_text(name, text).unwrap();
    }
    settings
}

#[test]
fn a_parameter_that_is_set_changes_no_other() {
    for (name, text) in [
        ("counter-height", "0.9"),
        ("table", "nil"),
        ("wall-cabinets", "nil"),
        ("island", "nil"),
        ("handle-length", "0.3"),
    ] {
        let mut same = 0;
        for seed in 0..50 {
            let plain = Kitchen::of_seed(seed).unwrap();
            let Ok(other) = Kitchen::with(seed, &set(&[(name, text)])) else {
                continue;
            };
            if other.facts.is_redrawn {
                continue;
            }
            same += 1;
            let (before, after) = (&plain.facts, &other.facts);
            if name != "island" {
                assert_eq!(before.arrangement, after.arrangement, "{seed} {name}");
                assert_eq!(before.drawers, after.drawers, "{seed} {name}");
                assert_eq!(before.aisle, after.aisle, "{seed} {name}");
            }
            assert_eq!(before.room, after.room, "{seed} {name}");
            match name {
                "counter-height" => assert_eq!(after.counter_height, 0.9),
                "table" => assert!(!after.has_table),
                "island" => assert!(!other.urdf.contains("island_counter")),
                "wall-cabinets" => assert!(!other.urdf.contains("_hanging\"")),
                _ => {}
            }
            if name != "counter-height" {
                assert_eq!(before.counter_height, after.counter_height);
            }
            // Whoever sets the drawn value has the drawn kitchen.
            let height = before.counter_height.to_string();
            let again = Kitchen::with(seed, &set(&[("counter-height", &height)])).unwrap();
            assert_eq!(again.urdf, plain.urdf);
        }
        assert!(same >= 40, "{name}: {same}");
    }
}

#[test]
fn what_is_simpler_can_be_set_and_is_then_so() {
    let (mut tried, mut same) = (0, 0);
    for seed in 0..16 {
        let plain = Kitchen::of_seed(seed).unwrap();
        for (name, simplest) in &plain.simpler {
            let mut settings = Settings::default();
            settings.set(name, simplest.clone()).unwrap();
            let Ok(kitchen) = Kitchen::with(seed, &settings) else {
                continue;
            };
            tried += 1;
            // Of what is not there, the size changes nothing.
            same += usize::from(kitchen.urdf == plain.urdf);
            if !kitchen.facts.is_redrawn {
                let left = kitchen
                    .simpler
                    .iter()
                    .find(|one| &one.0 == name && one.1 == *simplest);
                assert_eq!(left, None, "{seed}: {name} {simplest}");
            }
            assert!(Kitchen::with(seed, &settings).unwrap() == kitchen);
        }
    }
    assert!(tried > 300 && same * 10 < tried, "{same} of {tried}");
}

#[test]
fn kitchens_can_be_simplified_step_by_step() {
    let mut settings_of_all = 0;
    for seed in 0..12 {
        let mut kitchen = Kitchen::of_seed(seed).unwrap();
        let mut settings = Settings::default();
        let all = kitchen.simpler.len();
        for (name, simplest) in kitchen.simpler.clone() {
            let mut more = settings.clone();
            more.set(&name, simplest).unwrap();
            if let Ok(simpler) = Kitchen::with(seed, &more)
                && !simpler.facts.is_redrawn
            {
                (kitchen, settings) = (simpler, more);
            }
        }
        settings_of_all += settings.iter().count();
        assert!(kitchen.simpler.len() < all, "{seed}");
        assert!(kitchen.facts.drawers >= 3);
    }
    assert!(settings_of_all > 120, "{settings_of_all}");
}

#[test]
fn what_cannot_be_set_is_told_with_what_can() {
    let error = |name: &str, text: &str| {
        let error = Settings::default().set_text(name, text);
        error.unwrap_err().to_string()
    };
    let unknown = error("islnd", "nil");
    assert!(unknown.contains("did you mean island?"), "{unknown}");
    assert!(unknown.contains("counter-height"), "{unknown}");
    assert_eq!(
        error("counter-height", "9"),
        "The counter-height of a kitchen cannot be 9: a length from 0.7 to 1.1 m was expected."
    );
    assert_eq!(
        error("table", "0.7"),
        "The table of a kitchen cannot be 0.7: t or nil was expected."
    );
    assert_eq!(
        error("arrangement", "round"),
        "The arrangement of a kitchen cannot be round: one of one-wall, galley, l, u, island, \
         l-with-island, peninsula was expected."
    );
    for (name, text) in [
        ("stools", "1.5"),
        ("stools", "-1"),
        ("aisle", "NaN"),
        ("back-0", "nil"),
        ("back-21", "nil"),
    ] {
        error(name, text);
    }
    let impossible = Kitchen::with(3, &set(&[("arrangement", "galley"), ("island", "t")]));
    let impossible = impossible.unwrap_err().to_string();
    assert!(
        impossible.contains("no place for the island"),
        "{impossible}"
    );
    let narrow = Kitchen::with(
        3,
        &set(&[("room-width", "2.4"), ("room-depth", "2.4"), ("table", "t")]),
    );
    assert!(narrow.is_err());
}

#[test]
fn settings_that_change_nothing_are_not_needed() {
    for seed in 0..20 {
        let kitchen = Kitchen::of_seed(seed).unwrap();
        let height = kitchen.facts.counter_height.to_string();
        let all = [
            ("table", "nil"),
            ("table-length", "1.2"),
            ("counter-height", &height),
            ("front-thickness", "0.03"),
        ];
        let needed = Kitchen::needed(seed, &set(&all));
        let wanted = match kitchen.facts.has_table {
            true => vec![("front-thickness", "0.03"), ("table", "nil")],
            false => vec![("front-thickness", "0.03")],
        };
        assert_eq!(needed, set(&wanted), "{seed}");
    }
}

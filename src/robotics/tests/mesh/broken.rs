//! Files that are broken, or made to do harm: they are read or refused, soon, and nothing panics.

use std::time::Instant;

use proptest::prelude::*;

use super::memory_files::{cuboid, only, stl};
use crate::mesh::MeshPurpose;

const BOTH: [MeshPurpose; 2] = [MeshPurpose::Solid, MeshPurpose::Looks];

fn refusal(name: &str, bytes: impl Into<Vec<u8>>) -> String {
    only(name, bytes, MeshPurpose::Solid).map_or_else(|error| error, |_| "none".to_owned())
}

#[test]
fn what_is_wrong_is_said() {
    let mut short = stl(&cuboid([0.0; 3], [1.0; 3]));
    short.truncate(300);
    let mut many = stl(&[]);
    many[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let nowhere = stl(&[[[f32::NAN; 3], [0.0; 3], [1.0; 3]], [[1.0; 3]; 3]]);
    let far = stl(&[[[0.0; 3], [1e9, 0.0, 0.0], [0.0, 1.0, 0.0]]]);
    for (name, bytes, wanted) in [
        (
            "a.stl",
            b"solid x\nfacet".to_vec(),
            "the file ends before endsolid",
        ),
        ("a.stl", short, "the file ends after 4 of 12 triangles"),
        (
            "a.stl",
            b"GIF89a".to_vec(),
            "the file ends before the number of its triangles",
        ),
        ("a.stl", nowhere, "the mesh has no triangle with an area"),
        (
            "a.stl",
            far,
            "a corner is farther than 10000 m from the origin; expected metres, or a scale",
        ),
        (
            "a.obj",
            b"v 0 0\n".to_vec(),
            "line 1: expected v and three numbers",
        ),
        (
            "a.obj",
            b"v 0 0 0\nf 1 2 9999999999999999999\n".to_vec(),
            "line 2: \"2\" is no corner; there are 1 so far",
        ),
        (
            "a.obj",
            b"PK\x03\x04".to_vec(),
            "the mesh has no triangle with an area",
        ),
        (
            "a.dae",
            b"<html></html>".to_vec(),
            "expected <COLLADA>, found <html>",
        ),
        ("a.dae", b"\xff\xfe<".to_vec(), "the file is not UTF-8"),
    ] {
        assert_eq!(refusal(name, bytes), format!("/k/{name}: {wanted}"));
    }
    assert!(refusal("a.stl", many).contains("the file ends after 0 of 4294967295"));
    assert_eq!(
        refusal("a.ply", "ply\n"),
        "/k/a.ply is no mesh that can be read; give an STL, OBJ or DAE (COLLADA) file"
    );
}

#[test]
fn nothing_grows_beyond_measure() {
    // Nodes that show each other, and nodes in nodes.
    let circle = "<COLLADA><library_visual_scenes><visual_scene><node id=\"n\">\
                  <instance_node url=\"#n\"/><instance_node url=\"#n\"/></node></visual_scene>\
                  </library_visual_scenes></COLLADA>";
    assert!(refusal("a.dae", circle).contains("there are too many <node>"));
    let deep = "<node>".repeat(100_000);
    let deep = format!("<COLLADA><library_visual_scenes><visual_scene>{deep}");
    assert!(refusal("a.dae", deep).starts_with("/k/a.dae: "));
    // Entities of entities.
    let entities =
        "<!DOCTYPE a [<!ENTITY a \"aaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]><COLLADA>&b;</COLLADA>";
    assert!(refusal("a.dae", entities).starts_with("/k/a.dae: "));
    // Nearly all of four billion triangles.
    let polygon = "1 ".repeat(600_001);
    let polygon = format!("v 0 0 0\nf {polygon}\n");
    assert!(refusal("a.obj", polygon).contains("simplify it to 500000 at most"));
}

/// A ball of many triangles, bumpy, with corners (m) from a sequence.
fn ball(rings: usize, bump: f32) -> Vec<[[f32; 3]; 3]> {
    let point = |i: usize, j: usize| {
        let (a, b) = (
            i as f32 / rings as f32 * std::f32::consts::PI,
            j as f32 / rings as f32 * std::f32::consts::TAU,
        );
        let radius = 0.2 + bump * ((i * 7919 + j * 104_729) % 97) as f32 / 97.0;
        let (s, c) = (libm::sinf(a), libm::cosf(a));
        [
            radius * s * libm::cosf(b),
            radius * s * libm::sinf(b),
            radius * c,
        ]
    };
    let cells = (0..rings).flat_map(|i| (0..rings).map(move |j| (i, j)));
    let halves = cells.flat_map(|(i, j)| {
        let [a, b] = [point(i, j), point(i + 1, j)];
        let [c, d] = [point(i + 1, (j + 1) % rings), point(i, (j + 1) % rings)];
        [[a, b, c], [a, c, d]]
    });
    halves.collect()
}

#[test]
fn many_triangles_are_read_or_refused_soon() {
    for (rings, bump) in [(100, 0.0), (300, 0.0), (100, 0.02), (708, 0.0)] {
        let bytes = stl(&ball(rings, bump));
        let begin = Instant::now();
        let solid = only("a.stl", bytes.clone(), MeshPurpose::Solid);
        let took = begin.elapsed();
        // 708 × 708 × 2 are a million.
        assert_eq!(solid.is_err(), rings == 708, "{rings}: {:?}", solid.err());
        println!("{} triangles: {took:?}", 2 * rings * rings);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4))]

    #[test]
    fn triangles_at_random_are_read_or_refused(
        corners in prop::collection::vec(prop::array::uniform3(-0.3f32..0.3), 3..40),
        triangles in prop::collection::vec(prop::array::uniform3(0usize..40), 1..60),
        snap in prop::sample::select(vec![1e-6f32, 0.01, 0.1, 0.3]),
    ) {
        let corner = |i: usize| {
            corners[i % corners.len()].map(|x| (x / snap).round() * snap)
        };
        let triangles: Vec<_> = triangles.iter().map(|t| t.map(corner)).collect();
        for purpose in BOTH {
            let _ = only("a.stl", stl(&triangles), purpose);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn bytes_at_random_are_read_or_refused(
        bytes in prop::collection::vec(any::<u8>(), 0..400),
        name in prop::sample::select(vec!["a.stl", "a.obj", "a.dae", "a"]),
    ) {
        for purpose in BOTH {
            let _ = only(name, bytes.clone(), purpose);
        }
    }

    #[test]
    fn garbled_files_are_read_or_refused(
        place in any::<prop::sample::Index>(),
        patch in "[-0-9.e /#<>\"nvf\n]{0,6}",
        length in 0usize..9,
        name in prop::sample::select(vec!["a.obj", "a.dae"]),
    ) {
        let text = match name {
            "a.obj" => "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no a\nf 1 2 3\nf -1 -2 -3\n",
            _ => "<COLLADA><library_geometries><geometry id=\"g\"><mesh><source id=\"s\">\
                  <float_array>0 0 0 1 0 0 0 1 0</float_array></source><vertices id=\"v\">\
                  <input semantic=\"POSITION\" source=\"#s\"/></vertices><triangles>\
                  <input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles>\
                  </mesh></geometry></library_geometries></COLLADA>",
        };
        let from = place.index(text.len());
        let to = (from + length).min(text.len());
        let text = format!("{}{patch}{}", &text[..from], &text[to..]);
        for purpose in BOTH {
            let _ = only(name, text.clone(), purpose);
        }
    }
}

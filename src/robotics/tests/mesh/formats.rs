//! The formats of meshes.

use super::memory_files::{MemoryFiles, cuboid, load, only, stl};
use crate::mesh::{MeshPart, MeshPurpose};

const TRIANGLE: [[f32; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]];

fn looks(name: &str, bytes: impl Into<Vec<u8>>) -> Vec<MeshPart> {
    only(name, bytes, MeshPurpose::Looks).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_binary_stl_may_begin_like_one_of_text() {
    let parts = looks("a.stl", stl(&[TRIANGLE]));
    assert_eq!(
        parts[0].surface.corners,
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]
    );
    assert_eq!(parts[0].surface.triangles, [[0, 1, 2]]);
}

#[test]
fn an_stl_of_text_is_read() {
    let text = "solid s\n facet normal 0 0 0\n  outer loop\n   vertex 0 0 0\n   vertex 1e0 0 0\n   \
                vertex 0 2 0\n  endloop\n endfacet\nendsolid s\n";
    assert_eq!(looks("a.STL", text), looks("a.stl", stl(&[TRIANGLE])));
}

#[test]
fn an_obj_has_parts_polygons_and_colours() {
    let text = "mtllib a.mtl\nv 0 0 0\nv 1 0 0 1 1 1\nv 1 1 0\nv 0 1 0\no one\nusemtl red\n\
                f 1/1/1 2//2 3 -1\no two\nusemtl blue\nf 1 2 3\n";
    let colors = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nd 0.5\n";
    let files = MemoryFiles::of("/k/a.obj", text).with("/k/a.mtl", colors);
    let parts = load(&files, "a.obj", [1.0; 3], MeshPurpose::Looks).expect("it is right");
    let found: Vec<_> = parts
        .iter()
        .map(|part| (part.surface.triangles.len(), part.color))
        .collect();
    assert_eq!(
        found,
        [
            (2, Some([1.0, 0.0, 0.0, 1.0])),
            (1, Some([0.0, 0.0, 1.0, 0.5]))
        ]
    );
}

/// A file with a triangle of 100 units, a turned node in another one, and a colour.
const DAE: &str = r##"<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="centimetre" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
  <library_effects><effect id="paint"><profile_COMMON><technique sid="t"><lambert>
    <diffuse><color>0.5 0.25 0 1</color></diffuse></lambert></technique></profile_COMMON></effect>
  </library_effects>
  <library_materials><material id="m"><instance_effect url="#paint"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array count="9">0 0 0 100 0 0 0 100 0</float_array>
      <technique_common><accessor source="#a" count="3" stride="3"/></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <polylist material="face" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="NORMAL" source="#n" offset="1"/><vcount>3</vcount><p>0 0 1 0 2 0</p></polylist>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s">
    <node><translate>0 0 100</translate>
      <node><rotate>0 0 1 90</rotate><scale>1 2 1</scale>
        <instance_geometry url="#g"><bind_material><technique_common>
          <instance_material symbol="face" target="#m"/></technique_common></bind_material>
        </instance_geometry></node></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"##;

#[test]
fn a_dae_has_its_unit_and_its_nodes_but_is_not_turned() {
    let parts = looks("a.dae", DAE);
    assert_eq!(parts[0].color, Some([0.5, 0.25, 0.0, 1.0]));
    let wanted = [[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [-2.0, 0.0, 1.0]];
    for (corner, wanted) in parts[0].surface.corners.iter().zip(wanted) {
        for (number, wanted) in corner.iter().zip(wanted) {
            assert!((number - wanted).abs() < 1e-12, "{corner:?}");
        }
    }
}

#[test]
fn a_scale_is_for_each_axis_and_may_mirror() {
    let files = MemoryFiles::of("/k/a.stl", stl(&cuboid([0.0; 3], [1.0; 3])));
    let volume = |scale: [f64; 3]| {
        let parts = load(&files, "a.stl", scale, MeshPurpose::Looks).expect("it is right");
        let surface = &parts[0].surface;
        let six: f64 = surface
            .triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = surface.triangle(*triangle);
                a[0] * (b[1] * c[2] - b[2] * c[1])
                    + a[1] * (b[2] * c[0] - b[0] * c[2])
                    + a[2] * (b[0] * c[1] - b[1] * c[0])
            })
            .sum();
        six / 6.0
    };
    assert!((volume([1.0, 2.0, 0.5]) - 1.0).abs() < 1e-12);
    // The triangles go on facing outwards.
    assert!((volume([-1.0, 1.0, 1.0]) - 1.0).abs() < 1e-12);
    assert!((volume([-0.5, -1.0, -1.0]) - 0.5).abs() < 1e-12);
}

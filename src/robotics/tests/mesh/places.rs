//! Where the files of meshes are found.

use super::memory_files::{MemoryFiles, cuboid, stl};
use crate::mesh::{MeshLibrary, MeshPurpose, MeshRequest};
use crate::robot::{KinematicTree, UrdfUse};

fn found(stored: &str, named: &str, packages: &[&str]) -> Result<usize, String> {
    let files = MemoryFiles::of(stored, stl(&cuboid([0.0; 3], [1.0; 3])));
    let packages: Vec<String> = packages.iter().map(|path| (*path).to_owned()).collect();
    let request = MeshRequest {
        file: named.to_owned(),
        scale: [1.0; 3],
        purpose: MeshPurpose::Looks,
    };
    let library = MeshLibrary::new(&files, "/ws/kitchen/urdf/k.urdf", &packages);
    let parts = library.load(&[request]).remove(0);
    parts
        .map(|parts| parts.len())
        .map_err(|error| error.to_string())
}

#[test]
fn packages_are_found_below_given_folders_and_around_the_urdf() {
    let named = "package://kitchen/meshes/a.stl";
    for (stored, packages) in [
        ("/ws/kitchen/meshes/a.stl", &[][..]),
        ("/ws/kitchen/urdf/kitchen/meshes/a.stl", &[]),
        ("/p/kitchen/meshes/a.stl", &["/p"]),
        ("/p/kitchen/meshes/a.stl", &["/p/kitchen/"]),
        ("/p/repository/kitchen/meshes/a.stl", &["/q", "/p"]),
    ] {
        assert_eq!(found(stored, named, packages), Ok(1), "{stored}");
    }
    let beside = found("/ws/kitchen/urdf/../meshes/a.stl", "../meshes/a.stl", &[]);
    assert_eq!(beside, Ok(1));
    assert_eq!(found("/a.stl", "file:///a.stl", &[]), Ok(1));
}

#[test]
fn what_is_not_found_is_said_with_the_paths() {
    assert_eq!(
        found("/a.stl", "package://kitchen/a.stl", &["/p"]),
        Err(
            "there is no file for the mesh package://kitchen/a.stl; tried /p/kitchen/a.stl, \
             /ws/kitchen/urdf/kitchen/a.stl, /ws/kitchen/a.stl, /ws/kitchen/kitchen/a.stl; \
             say where the package is with --package-path FOLDER"
                .to_owned()
        )
    );
    for (named, reason) in [
        (
            "package://kitchen/../../a.stl",
            "the path leads out of the package",
        ),
        ("package://../a.stl", "the path leads out of the package"),
        ("package://kitchen", "expected package://NAME/PATH"),
        (
            "http://a.org/a.stl",
            "only package:// and file:// lead to files",
        ),
        ("a\0.stl", "a path has no such character"),
    ] {
        let wanted = format!("the mesh {named} cannot be had: {reason}");
        assert_eq!(found("/a.stl", named, &["/"]), Err(wanted));
    }
}

#[test]
fn a_missing_mesh_is_an_error_for_solids_and_a_remark_for_looks() {
    let files = MemoryFiles::of("/k/a.stl", stl(&cuboid([0.0; 3], [1.0; 3])));
    let library = MeshLibrary::new(&files, "/k/k.urdf", &[]);
    let read = |looks: &str, solid: &str| {
        let text = format!(
            "<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh filename=\"{looks}\"/></geometry>\
             </visual>\n<collision><geometry><mesh filename=\"{solid}\"/></geometry></collision></link></robot>"
        );
        KinematicTree::read_urdf(&text, "k.urdf", &library, UrdfUse::World)
    };
    let reading = read("b.stl", "a.stl").expect("the solid is there");
    let (_, link) = reading.tree.links().next().expect("there is a link");
    assert_eq!(link.visuals, link.collisions);
    let remarks: Vec<String> = reading.remarks.iter().map(ToString::to_string).collect();
    assert_eq!(
        remarks,
        [
            "k.urdf:1:50: there is no file for the mesh b.stl; tried /k/b.stl; what is solid there is \
          shown instead"
        ]
    );
    let error = read("a.stl", "b.stl").expect_err("the solid is missing");
    assert_eq!(
        error.to_string(),
        "k.urdf:2:22: there is no file for the mesh b.stl; tried /k/b.stl"
    );
}

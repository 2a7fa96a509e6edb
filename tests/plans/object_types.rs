//! Types of objects that users define.

use std::fs;
use std::path::PathBuf;

use super::cook::Cook;
use session::{Session, SessionOptions};

/// A carton, of which nothing is said about how to grasp it.
const CARTON: &str = "(def-object-type juice :shapes '((box :size (0.06 0.09 0.2))) :mass 0.8
                        :kind :drink :color '(0.9 0.5 0.1))";

/// A text of a mesh: a prism over a rectangle (m).
fn prism([x, y, z]: [f64; 3]) -> String {
    let corner = |i: usize| {
        let at = |bit: usize, half: f64| if i & bit > 0 { half } else { -half };
        [at(1, x / 2.0), at(2, y / 2.0), at(4, z / 2.0)]
    };
    let faces = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    let mut text = String::new();
    for i in 0..8 {
        let [x, y, z] = corner(i);
        text.push_str(&format!("v {x} {y} {z}\n"));
    }
    for [a, b, c] in faces {
        text.push_str(&format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    }
    text
}

/// A folder for a test.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("planwright-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn a_new_object_is_transported_without_a_number() {
    let mut cook = Cook::watched();
    assert_eq!(cook.done(CARTON).trim(), ":JUICE");
    let listed = cook.done("(last (list-available-objects))");
    assert_eq!(listed.trim(), "(:JUICE)");
    let grasps = cook.done("(list-defined-grasps :juice)");
    for grasp in [":TOP", ":LEFT-SIDE", ":RIGHT-SIDE"] {
        assert!(grasps.contains(grasp), "{grasps}");
    }
    cook.done(
        "(btr-utils:spawn-object 'juice-1 :juice :pose '((-1.5 -0.9 0.85) (0 0 0 1)))
         (with-simulated-robot
           (perform (an action (type transporting) (object (an object (type juice)))
             (location (a location (on (an object (urdf-name table-area-main) (part-of kitchen)))))
             (target (a location (on (an object (urdf-name kitchen-island-surface)
                                                (part-of kitchen))))))))",
    );
    let at = cook.pose("JUICE-1").translation;
    assert!(at.x > -1.4 && at.x < -0.4 && at.y > 0.0, "{at}");
    assert!(cook.lean("JUICE-1") < 3.0);
    cook.assert_no_overlap();
}

#[test]
fn what_no_hand_can_grasp_is_refused_with_the_reason() {
    let mut cook = Cook::new();
    let said =
        cook.done("(def-object-type crate :shapes '((box :size (0.12 0.2 0.2))) :kind :bottle)");
    let why =
        "it is too wide by 36 mm: its narrowest part is 120 mm wide, and fingers go around 84 mm.";
    assert!(
        said.contains(&format!("No hand can grasp a crate: {why}")),
        "{said}"
    );
    cook.done("(btr-utils:spawn-object 'crate-1 :crate :pose '((-1.5 -0.9 0.85) (0 0 0 1)))");
    // Its kind has grasps, but those are of another shape.
    let report = cook.fails(
        "FETCHING-FAILED",
        "(perform (an action (type transporting) (object (an object (type crate)))
           (location (a location (on (an object (urdf-name table-area-main) (part-of kitchen)))))
           (target (a location (on (an object (urdf-name kitchen-island-surface)
                                              (part-of kitchen)))))))",
    );
    assert!(report.contains(why.trim_end_matches('.')), "{report}");
    // A grasp that somebody says is tried.
    cook.done(
        "(man-int:def-object-type-to-gripper-transforms :crate :right :by-string
           :grasp-translation '(0 0 0.1) :grasp-rot-matrix '((0 1 0) (1 0 0) (0 0 -1)))",
    );
    assert_eq!(
        cook.done("(list-defined-grasps :crate)").trim(),
        "(:BY-STRING)"
    );
}

#[test]
fn a_type_belongs_to_its_session_and_survives_undo() {
    let mut cook = Cook::new();
    cook.done("(init-projection)");
    cook.done("(spawn-object '((-1.5 -0.9 0.85) (0 0 0 1)) :bottle 'bottle-1)");
    cook.done(CARTON);
    cook.done("(btr-utils:spawn-object 'juice-1 :juice :pose '((-1.2 -0.9 0.85) (0 0 0 1)))");
    cook.done("(rewind 2)");
    assert_eq!(
        cook.done("(btr-utils:object-exists 'juice-1)").trim(),
        "NIL"
    );
    cook.done("(btr-utils:spawn-object 'juice-2 :juice :pose '((-1.2 -0.9 0.85) (0 0 0 1)))");
    // A fresh world keeps it, too.
    cook.done("(init-projection)");
    cook.done("(btr-utils:spawn-object 'juice-3 :juice :pose '((-1.2 -0.9 0.85) (0 0 0 1)))");
    let other = Session::new(&SessionOptions::default()).unwrap();
    assert!(other.simulation().object_types().get("juice").is_none());
}

#[test]
fn copies_of_a_session_know_its_types_and_not_each_others() {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    session.run("file", CARTON).unwrap();
    let mut copy = session.copied().unwrap();
    copy.run(
        "file",
        "(def-object-type soup :shapes '((cylinder :radius 0.03 :length 0.1)))",
    )
    .unwrap();
    let types = |session: &Session| {
        ["juice", "soup"].map(|name| session.simulation().object_types().get(name).is_some())
    };
    assert_eq!(types(&copy), [true, true]);
    assert_eq!(types(&session), [true, false]);
    assert!(!copy.simulation().grasp_library().grasps("juice").is_empty());
    assert!(
        session
            .simulation()
            .grasp_library()
            .grasps("soup")
            .is_empty()
    );
}

#[test]
fn a_redefined_type_changes_what_is_spawned_from_now_on() {
    let mut cook = Cook::new();
    cook.done(
        "(init-projection) (def-object-type tin :shapes '((cylinder :radius 0.03 :length 0.1)))",
    );
    cook.done("(btr-utils:spawn-object 'tin-1 :tin :pose '((-1.5 -0.9 0.85) (0 0 0 1)))");
    cook.done("(def-object-type tin :shapes '((box :size (0.05 0.05 0.2))))");
    cook.done("(btr-utils:spawn-object 'tin-2 :tin :pose '((-1.2 -0.9 0.85) (0 0 0 1)))");
    let world = cook.session.simulation().world();
    let height = |name: &str| world.object(name).unwrap().size()[2];
    assert!((height("TIN-1") - 0.1).abs() < 1e-9);
    assert!((height("TIN-2") - 0.2).abs() < 1e-9);
}

#[test]
fn meshes_lie_beside_the_file_that_defines_their_type() {
    let folder = folder("mesh-types");
    fs::create_dir_all(folder.join("pack/resource")).unwrap();
    fs::write(folder.join("brick.obj"), prism([0.06, 0.08, 0.1])).unwrap();
    fs::write(
        folder.join("pack/resource/big_brick.obj"),
        prism([0.07, 0.08, 0.2]),
    )
    .unwrap();
    fs::write(
        folder.join("types.sexp"),
        "(object brick :shapes ((mesh \"brick.obj\")) :mass 0.4)",
    )
    .unwrap();
    let plan = folder.join("types.plan");
    fs::write(
        &plan,
        "(in-package :pp-tut) (def-object-type block :mesh \"brick.obj\" :scale 0.5)",
    )
    .unwrap();
    let options = SessionOptions {
        objects: Some((
            folder.join("types.sexp").display().to_string(),
            fs::read_to_string(folder.join("types.sexp")).unwrap(),
        )),
        package_paths: vec![folder.display().to_string()],
        ..SessionOptions::default()
    };
    let mut session = Session::new(&options).unwrap();
    session.run_file(&plan).unwrap();
    session
        .run(
            "more",
            &format!(
                "(btr:add-objects-to-mesh-list \"pack\")
                 (load {plan:?})
                 (btr-utils:spawn-object 'b-1 :slab :mesh \"{}\" :pose '((1.4 0.6 0.9) (0 0 0 1)))",
                folder.join("brick.obj").display()
            ),
        )
        .unwrap();
    let types = session.simulation().object_types();
    for (name, size) in [
        ("brick", [0.06, 0.08, 0.1]),
        ("block", [0.03, 0.04, 0.05]),
        ("big-brick", [0.07, 0.08, 0.2]),
        ("slab", [0.06, 0.08, 0.1]),
    ] {
        let found = types.get(name).unwrap_or_else(|| panic!("{name}")).size();
        for (found, wanted) in found.iter().zip(size) {
            assert!((found - wanted).abs() < 1e-3, "{name}: {found}");
        }
    }
    assert_eq!(types.get("brick").unwrap().mass, 0.4);
    let missing = session
        .run("more", "(def-object-type ghost :mesh \"ghost.stl\")")
        .unwrap_err()
        .to_string();
    assert!(missing.contains("ghost.stl"), "{missing}");
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn mistakes_are_one_clear_error() {
    let mut cook = Cook::new();
    let mut report = |text: &str| match cook.say(text) {
        Err((report, _)) => report,
        Ok(said) => panic!("{text}: {said}"),
    };
    assert_eq!(
        report("(def-object-type a :shapes '((bax :size (1 1 1))))"),
        "The type of objects A is wrong: there is no shape named bax; did you mean box?."
    );
    assert_eq!(
        report("(def-object-type a :mass 1)"),
        "The type of objects A is wrong: (object …) has no :shapes; add it."
    );
    assert_eq!(
        report("(def-object-type a :shapes '((sphere :radius 0.1)) :mass -1)"),
        "The type of objects A is wrong: expected a number above 0, found -1."
    );
    assert_eq!(
        report("(def-object-type a :shapes (list (make-hash-table)))")
            .split(" is no part")
            .nth(1),
        Some(" of a type of objects: a name, a number, a text or a list of these was expected.")
    );
    assert!(report("(def-object-type a 3)").contains("3 is no key with a value"));
    let circle = "(let ((l (list 1))) (setf (cdr l) l) (def-object-type a :shapes l))";
    assert!(report(circle).contains("The type of objects A is wrong"));
}

//! Kitchens that lack what the built-in one has, and descriptions of kitchens.

use super::cook::Cook;
use session::{Session, SessionOptions};

/// A room with a desk on the floor, which every kitchen has.
const ROOM: &str = r#"
<robot name="room">
  <link name="map"/>
  <link name="desk">
    <collision><geometry><box size="0.8 1.4 0.7"/></geometry></collision>
  </link>
  <joint name="desk_joint" type="fixed">
    <parent link="map"/><child link="desk"/><origin xyz="1.2 0 0.35"/>
  </joint>
</robot>"#;

/// What such a room is for.
const DESCRIPTION: &str = "
(kitchen office)
(alias table desk)
(place table :on desk)
(place desk-corner :on desk :side (back left))
(usually table :contexts (table-setting table-cleaning) :types (milk))
(belongs desk-corner :contexts (table-setting) :types (milk))
(view table :link desk :at (0 0 0.3) :eye (-1.5 -1.5 1.7))";

fn room(description: Option<&str>) -> SessionOptions {
    SessionOptions {
        world: Some(("room.urdf".to_owned(), ROOM.to_owned())),
        world_description: description.map(|text| ("room.sexp".to_owned(), text.to_owned())),
        ..SessionOptions::default()
    }
}

fn cook(description: Option<&str>) -> Cook {
    let mut cook = Cook::with(&room(description));
    cook.done("(init-projection) (spawn-object '((1.1 0.2 0.85) (0 0 0 1)) :milk 'milk-1)");
    cook
}

const LACKS_TABLE: &str = "the milk belongs beside the bowl on the table, but it is not known where \
    the table is: the description of this kitchen has no (place table …). Give one with \
    --world-description, or give a (target …).";

#[test]
fn a_kitchen_with_one_desk_says_what_it_lacks() {
    let mut cook = cook(None);
    let bring = "(perform (an action (type transporting) (object (an object (type milk)))";
    assert_eq!(
        cook.fails(
            "OBJECT-UNDELIVERABLE",
            &format!("{bring} (context table-setting)))")
        ),
        LACKS_TABLE
    );
    assert_eq!(
        cook.fails(
            "OBJECT-UNDELIVERABLE",
            &format!("{bring} (context table-cleaning)))")
        ),
        "It is not known where the milk belongs: the description of this kitchen has no (belongs …). \
         Give one with --world-description, or give a (target …)."
    );
    let report = cook.fails("DESIGNATOR-REFERENCE-FAILURE", &format!("{bring}))"));
    assert!(
        report.ends_with("The action TRANSPORTING needs one of target, context."),
        "{report}"
    );
    // Without knowing where such things are, the robot looks on all surfaces.
    cook.done(
        "(with-simulated-robot
           (perform (an action (type searching) (object (an object (type milk)))
                        (context table-setting))))",
    );
}

#[test]
fn a_kitchen_without_surfaces_says_so() {
    let empty = "<robot name=\"empty\"><link name=\"map\"/></robot>";
    let mut cook = Cook::with(&SessionOptions {
        world: Some(("empty.urdf".to_owned(), empty.to_owned())),
        ..SessionOptions::default()
    });
    let search = "(perform (an action (type searching) (object (an object (type milk)))))";
    assert_eq!(
        cook.fails("SEARCHING-FAILED", search),
        "This kitchen has no surface on which the milk could be: give a (location …)."
    );
}

#[test]
fn the_household_demo_says_what_the_kitchen_lacks() {
    let mut cook = cook(None);
    cook.done("(asdf:load-system \"cram_projection_demos\")");
    let end = cook.say("(demos::household-demo)").unwrap_err();
    assert_eq!(
        end.0,
        "This kitchen has no places for the things of the demo: its description has no (store …). \
         Give one with --world-description."
    );
    assert!(end.1.contains("ENVIRONMENT-UNREACHABLE"), "{}", end.1);
    // The tutorial's and CRAM's own functions fail alike.
    let moved = cook.say("(move-kitchen-joint)").unwrap_err().0;
    assert_eq!(
        moved,
        "This kitchen has no usual joint: give a :joint-name, or say in its description, (kitchen \
         NAME :usual-joint JOINT), which one is meant."
    );
}

#[test]
fn a_described_room_is_set_out() {
    let mut cook = cook(Some(DESCRIPTION));
    cook.done(
        "(with-simulated-robot
           (perform (an action (type transporting) (object (an object (type milk)))
                        (context table-setting))))",
    );
    // The back of the desk is at the greater x, its left at the greater y.
    let at = cook.pose("MILK-1").translation;
    assert!(at.x > 1.2 && at.y > 0.0 && at.z > 0.7, "{at}");
    assert_eq!(
        cook.done("(prolog:prolog '(rob-int:environment-name ?name))"),
        "(((?NAME . :OFFICE)))\n"
    );
    let known = "It is not known where the bowl belongs: give a (target …), or a (context …), one of \
                 table-setting.";
    let bring = "(perform (an action (type transporting) (object (an object (type bowl)))
                              (context breakfast)))";
    assert_eq!(cook.fails("OBJECT-UNDELIVERABLE", bring), known);
    // An alias is a name for plans, too.
    cook.done("(reference (a location (on (an object (urdf-name table)))))");
}

#[test]
fn a_wrong_description_is_told_where() {
    let refusal = |text: &str| match Session::new(&room(Some(text))) {
        Ok(_) => panic!("{text} was accepted"),
        Err(error) => error.to_string(),
    };
    let kitchen = "(kitchen office)";
    assert_eq!(
        refusal(""),
        "room.sexp:1:1: the file has no (kitchen …); add one"
    );
    for (text, expected) in [
        (
            "(place table :on dek)",
            "34: there is no link named dek; did you mean desk?",
        ),
        (
            "(plaec table :on desk)",
            "17: there is no record named plaec; did you mean place?",
        ),
        (
            "(place table :side left :onn desk)",
            "41: (place …) has no key :onn; it knows :on :in :above :side :level :level-invert \
             :orientation :range :range-invert :context :object-count; did you mean :on?",
        ),
        (
            "(place table)",
            "17: (place table) says nothing; add :on, :in or :above",
        ),
        (
            "(place table :on desk)(place table :on desk)",
            "46: (place table …) is given twice; keep one",
        ),
        (
            "(place table :on desk)(usually tabel :contexts (a) :types (milk))",
            "48: there is no place named tabel; did you mean table?",
        ),
        (
            "(place table :on desk)(belongs table :types (milk))",
            "39: (belongs …) has no :contexts; add it",
        ),
        (
            "(view iland :link desk :at (0 0 0) :eye (1 1 1))",
            "23: there is no view named iland; did you mean island?",
        ),
        (
            "(alias table desc)",
            "30: there is no link or joint named desc; did you mean desk?",
        ),
        (
            "(store milk :in desk :position (0 0) :heading 0)",
            "48: expected a list of 3 numbers, found (0 0)",
        ),
    ] {
        assert_eq!(
            refusal(&format!("{kitchen}{text}")),
            format!("room.sexp:1:{expected}"),
            "{text}"
        );
    }
}

/// A box of triangles, 1 m wide, as a file of text.
fn cube_stl() -> String {
    let corner = |i: usize| [i & 1, i >> 1 & 1, i >> 2 & 1];
    let sides = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let mut text = "solid cube\n".to_owned();
    for [a, b, c, d] in sides {
        for triangle in [[a, b, c], [a, c, d]] {
            text += "outer loop\n";
            for [x, y, z] in triangle.map(corner) {
                text += &format!("vertex {x} {y} {z}\n");
            }
            text += "endloop\n";
        }
    }
    text + "endsolid\n"
}

#[test]
fn a_kitchen_of_meshes_says_what_is_wrong_with_it() {
    let folder = std::env::temp_dir().join(format!("planwright-meshes-{}", std::process::id()));
    let meshes = folder.join("room").join("meshes");
    std::fs::create_dir_all(&meshes).unwrap();
    std::fs::write(meshes.join("desk.stl"), cube_stl()).unwrap();
    let urdf = folder.join("room").join("room.urdf");
    let mesh = "package://room/meshes/desk.stl";
    let text = format!(
        "<robot name=\"room\"><link name=\"desk\">\n\
         <visual><geometry><mesh filename=\"package://room/desk.dae\"/></geometry></visual>\n\
         <collision><geometry><mesh filename=\"{mesh}\" scale=\"1 1 0.7\"/></geometry></collision>\n\
         </link></robot>"
    );
    let options = SessionOptions {
        world: Some((urdf.to_str().unwrap().replace('\\', "/"), text)),
        mesh_cache: Some(folder.join("cache").to_str().unwrap().replace('\\', "/")),
        ..SessionOptions::default()
    };
    let hash = |session: &Session| session.simulation().world().hash();
    let session = Session::new(&options).unwrap();
    let remarks = session.remarks();
    assert_eq!(remarks.len(), 2, "{remarks:?}");
    assert!(remarks[0].contains("there is no file for the mesh package://room/desk.dae"));
    assert!(
        remarks[0].ends_with("what is solid there is shown instead"),
        "{}",
        remarks[0]
    );
    assert!(
        remarks[1].starts_with("the robot starts inside desk, "),
        "{}",
        remarks[1]
    );
    assert!(
        remarks[1].contains(" is free: (btr-utils:move-robot "),
        "{}",
        remarks[1]
    );
    // What was kept gives the same world.
    assert_eq!(std::fs::read_dir(folder.join("cache")).unwrap().count(), 1);
    assert_eq!(hash(&Session::new(&options).unwrap()), hash(&session));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_search_passes_over_places_where_nothing_has_room() {
    // A shelf with something on all of it, and a desk.
    let shelf = ROOM.replace(
        "</robot>",
        r#"<link name="shelf">
             <collision><geometry><box size="0.4 1.0 0.7"/></geometry></collision>
           </link>
           <link name="chest">
             <collision><geometry><box size="0.4 1.0 2.0"/></geometry></collision>
           </link>
           <joint name="shelf_joint" type="fixed">
             <parent link="map"/><child link="shelf"/><origin xyz="-1.5 0 0.35"/>
           </joint>
           <joint name="chest_joint" type="fixed">
             <parent link="map"/><child link="chest"/><origin xyz="-1.5 0 1.71"/>
           </joint></robot>"#,
    );
    let options = SessionOptions {
        world: Some(("room.urdf".to_owned(), shelf)),
        world_description: Some((
            "room.sexp".to_owned(),
            "(kitchen office)
             (place shelf :on shelf)
             (place table :on desk)
             (usually shelf :contexts (table-setting) :types (milk cup))
             (usually table :contexts (table-setting) :types (milk cup))"
                .to_owned(),
        )),
        ..SessionOptions::default()
    };
    let mut cook = Cook::with(&options);
    cook.done("(init-projection) (spawn-object '((1.1 0.2 0.85) (0 0 0 1)) :milk 'milk-1)");
    let search = |kind: &str| {
        format!(
            "(perform (an action (type searching) (object (an object (type {kind})))
                          (context table-setting)))"
        )
    };
    let said = cook.done(&format!("(with-simulated-robot {})", search("milk")));
    assert!(said.contains("touching chest"), "{said}");
    let report = cook.fails("SEARCHING-FAILED", &search("cup"));
    assert!(
        report.starts_with("the cup was not found; tried: "),
        "{report}"
    );
    // Where somebody says that it is, it is an error that nothing can be there.
    cook.fails(
        "DESIGNATOR-ERROR",
        "(perform (an action (type searching) (object (an object (type milk)))
                      (location (a location (on (an object (urdf-name shelf) (part-of kitchen)))))))",
    );
}

//! Layouts as RoboCasa writes them, and as nobody should.

use super::*;

/// A row along the wall with a stack below its counter, a sink, a fridge, cabinets above, and an island.
const LAYOUT: &str = r#"
room:
  walls:
    - name: wall
      type: wall
      size: [2.0, 1.5, 0.02]
      pos: [2.0, 0.0, 1.5]
    - name: wall_backing
      type: wall
      backing: true
      size: [2.0, 1.5, 0.1]
      pos: [2.0, 0.0, 1.5]
    - name: wall_left
      type: wall
      wall_side: left
      size: [2.0, 1.5, 0.02]
      pos: [0.0, -2.0, 1.5]
  floor:
    - name: floor
      type: floor
      size: [2.0, 2.0, 0.02]
      pos: [2.0, -2.0, 0.0]
  wall_accessories:
    - name: light
      type: wall_accessory
      attach_to: wall
      pos: [1.0, null, 1.1]
main_group:
  group_origin: [0, 0]
  group_pos: [0.0, 0.0]
  group_z_rot: 0.0
  bottom_row:
    - {name: sink, type: sink}
    - name: counter
      type: counter
      interior_obj: sink
      obj_x_percent: 0.6
      size: [2.0, 0.65, 0.92]
      pos: [1.0, -0.325, 0.46]
    - name: dishwasher
      type: dishwasher
      align_to: counter
      side: right
      alignment: bottom_back
    - name: fridge
      type: fridge_bottom_freezer
      align_to: dishwasher
      side: right
      alignment: bottom_back
      offset: [0.01, 0, 0]
  bottom_row_cabinets:
    - name: stack_1
      type: stack
      pos: [0.4, -0.3, 0.47]
      size: [0.8, 0.6, 0.84]
      levels: [single_cabinet, [drawer, drawer]]
      percentages: [0.7, 0.3]
    - name: stack_2
      type: stack
      size: [0.6, 0.6, 0.84]
      levels: [drawer, drawer, drawer]
      percentages: [0.4, 0.4, 0.2]
      align_to: stack_1
      slignment: top_back
      side: right
  top_row:
    - name: cab_1
      type: hinge_cabinet
      pos: [0.5, -0.2, 1.84]
      size: [1.0, 0.4, 0.92]
    - name: cab_2
      type: single_cabinet
      orientation: left
      size: [cab_1, null, 0.5]
      align_to: cab_1
      side: right
      alignment: top_back
  counter_accessories:
    - name: toaster
      type: toaster
      placement:
        fixture: counter_main_group
        sample_region_kwargs: {ref: stack_2}
        size: [1.0, 0.4]
        pos: [null, 1.0]
        rotation: [0, 0]
    - name: mixer
      type: stand_mixer
      enable: false
island_group:
  group_origin: [0, 0]
  group_pos: [2.0, -2.3]
  group_z_rot: 3.1416
  bottom_row:
    - name: island
      type: counter
      base_opening: [false, true]
      size: [1.4, 0.8, 0.92]
      pos: [0, 0, 0.46]
"#;

/// The place (m) of a link in the room.
fn joint_of(kitchen: &Published, link: &str) -> Vec<f64> {
    let urdf = &kitchen.urdf;
    let at = urdf.find(&format!("<child link=\"{link}\"/>")).unwrap();
    let origin = urdf[at..].split("xyz=\"").nth(1).unwrap();
    let numbers = origin.split('"').next().unwrap().split(' ');
    numbers.map(|number| number.parse().unwrap()).collect()
}

fn is_near(a: &[f64], b: [f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-3)
}

#[test]
fn fixtures_stand_where_the_layout_says() {
    let kitchen = Published::of_layout(LAYOUT).unwrap();
    for (link, at) in [
        // The middle of the top of a counter; what has fronts is placed by the front of its carcass.
        ("counter_main_group", [1.0, -0.325, 0.92]),
        ("dishwasher_main_group", [2.3, -0.58, 0.445]),
        ("fridge_main_group", [3.0, -0.78, 0.875]),
        // To the right of the first stack, in the middle of its depth and height.
        ("stack_2_main_group_1", [1.1, -0.58, 0.05 + 0.168]),
        // The halves of a level.
        ("stack_1_main_group_2", [0.2, -0.58, 0.89 - 0.126]),
        ("stack_1_main_group_3", [0.6, -0.58, 0.89 - 0.126]),
        // As wide as its neighbour, and aligned at the top.
        ("cab_2_main_group", [1.5, -0.38, 2.05]),
        // 0.6 of the width, in the middle of what the fronts leave.
        ("sink_main_group", [1.2, -0.2925, 0.92]),
        // Turned with its group.
        ("island_island_group", [2.0, -2.3, 0.92]),
        // Beside the sink, against the wall.
        ("toaster_main_group", [0.7, -0.17, 1.015]),
        ("wall_room", [2.0, 0.02, 1.5]),
        ("wall_left_room", [-0.02, -2.0, 1.5]),
    ] {
        let found = joint_of(&kitchen, link);
        assert!(is_near(&found, at), "{link}: {found:?}, not {at:?}");
    }
    assert!(!kitchen.urdf.contains("mixer") && !kitchen.urdf.contains("backing"));
    // Doors and drawers, each with a handle.
    for handle in [
        "stack_1_main_group_1_door_handle",
        "stack_2_main_group_3_handle",
        "cab_1_main_group_left_door_handle",
        "cab_1_main_group_right_door_handle",
        "dishwasher_main_group_door_handle",
        "fridge_main_group_main_door_handle",
        "fridge_main_group_freezer_handle",
    ] {
        assert!(
            kitchen.urdf.contains(&format!("<link name=\"{handle}\">")),
            "{handle}"
        );
    }
    for line in [
        "(place table :on island_island_group)",
        "(place sink :on sink_main_group)",
        "(place fridge :in fridge_main_group_main :side front)",
        "(place counter :on counter_main_group)",
    ] {
        assert!(
            kitchen.description.contains(line),
            "{line}: {}",
            kitchen.description
        );
    }
    assert_eq!(
        kitchen.remarks,
        [
            "unknown keys mean nothing: slignment (line 64)",
            "what hangs on walls is left out: accessories (1)",
            "as published, furniture overlaps: sink_main_group and stack_2_main_group_2 by 8 mm, \
             sink_main_group and stack_2_main_group_3 by 8 mm",
        ]
    );
}

#[test]
fn what_is_wrong_is_told_with_its_line() {
    let change = |from: &str, to: &str| {
        assert!(LAYOUT.contains(from), "{from}");
        Published::of_layout(&LAYOUT.replacen(from, to, 1))
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        change("align_to: counter\n", "align_to: counetr\n"),
        "line 42: there is no counetr before this in main_group; did you mean counter?"
    );
    assert_eq!(
        change("type: fridge_bottom_freezer", "type: fridge_bottom_freezr"),
        "line 45: there is no type of fixtures fridge_bottom_freezr; did you mean fridge_bottom_freezer?"
    );
    assert_eq!(
        change("percentages: [0.7, 0.3]", "percentages: [0.7]"),
        "line 52: a stack has as many percentages (1) as levels (2)"
    );
    assert_eq!(
        change("[drawer, drawer, drawer]", "[drawer, drawr, drawer]"),
        "line 61: drawr is no level of a stack; did you mean drawer?"
    );
    assert_eq!(
        change("alignment: top_back", "alignment: top_right"),
        "line 71: what is at the right of another fixture cannot be aligned with its right, too"
    );
    assert_eq!(
        change("size: [2.0, 0.65, 0.92]", "size: [2.0, 0.65, 920]"),
        "line 38: a fixture is between 0.001 and 30 m large, this one is [2.0, 0.65, 920.0]"
    );
    assert_eq!(
        change("size: [2.0, 0.65, 0.92]", "size: [2.0, wide, .nan]"),
        "line 38: there is no wide before this in main_group"
    );
    assert_eq!(
        change("obj_x_percent: 0.6", "obj_x_percent: .inf"),
        "line 37: obj_x_percent is a number (m, or rad)"
    );
    assert_eq!(
        change("  bottom_row:\n", "  bottom_row: 5\n  other:\n"),
        "line 32: bottom_row of main_group is a list"
    );
    assert_eq!(
        change(
            "    - {name: sink, type: sink}",
            "    - &a {name: sink, type: sink}\n    - *a"
        ),
        "line 34: a layout does not refer to other parts of itself (*name)"
    );
}

#[test]
fn furniture_of_any_size_and_name_is_a_kitchen_or_refused() {
    let change = |from: &str, to: &str| {
        assert!(LAYOUT.contains(from), "{from}");
        Published::of_layout(&LAYOUT.replacen(from, to, 1))
    };
    // Nothing thinner than its boards has negative ones, and no handle is longer than its door.
    for size in [
        "[1.0, 0.4, 0.005]",
        "[0.001, 0.001, 0.001]",
        "[0.2, 0.03, 0.11]",
    ] {
        let kitchen = change("size: [1.0, 0.4, 0.92]", &format!("size: {size}")).unwrap();
        let sizes = kitchen.urdf.split("<box size=\"").skip(1);
        let sizes = sizes.filter_map(|rest| rest.split('"').next());
        for edge in sizes.flat_map(|size| size.split(' ')) {
            assert!(edge.parse::<f64>().unwrap() > 0.0, "{size}: {edge}");
        }
    }
    // Names of whatever characters.
    let kitchen = change("name: fridge", "name: 'the <fridge> (\"big\")'").unwrap();
    assert!(
        kitchen
            .urdf
            .contains("<link name=\"the__fridge____big___main_group\">")
    );
    let kitchen = change("name: stack_2", "name: 1e").unwrap();
    assert!(
        kitchen
            .description
            .contains("(place cutlery-drawer :in _1e_main_group_3_main :side back)"),
        "{}",
        kitchen.description
    );
    // A fridge without room for a door has none.
    let kitchen = change("offset: [0.01, 0, 0]", "size: [0.1, 0.1, 0.2]").unwrap();
    assert!(
        !kitchen.description.contains(":usual-joint"),
        "{}",
        kitchen.description
    );
    // The same name twice, also of what stands on a counter.
    let mixer = "name: mixer\n      type: stand_mixer\n      enable: false";
    let toaster =
        "name: toaster\n      type: toaster\n      placement: {fixture: counter_main_group}";
    let kitchen = change(mixer, toaster).unwrap();
    assert!(
        kitchen
            .urdf
            .contains("<link name=\"toaster_main_group_2\">")
    );
    let remark = "there are two of the name toaster_main_group, one is toaster_main_group_2";
    assert!(
        kitchen.remarks.iter().any(|one| one == remark),
        "{:?}",
        kitchen.remarks
    );
    // A part of one thing called like another thing.
    let other = format!(
        "{toaster}\nmain_group_main:\n  row:\n    - {{name: fridge, type: box, pos: [9, 9, 9]}}"
    );
    assert_eq!(
        change(mixer, &other).unwrap_err().to_string(),
        "two parts would have the name fridge_main_group_main: rename one"
    );
}

#[test]
fn the_robot_starts_where_it_gets_to_most() {
    // Behind a wall there is another room, with one counter, which comes last.
    let behind = "
other_group:
  wall:
    - {name: middle, type: wall, size: [2, 1.5, 0.02], pos: [2, -4, 1.5]}
  floor:
    - {name: other, type: floor, size: [2, 1.5, 0.02], pos: [2, -5.5, 0]}
  row:
    - {name: counter, type: counter, size: [1.4, 0.6, 0.92], pos: [2, -6.5, 0.46]}
";
    let kitchen = Published::of_layout(&format!("{LAYOUT}{behind}")).unwrap();
    let start = joint_of(&kitchen, "room");
    assert!((0.0..4.0).contains(&start[1]), "{start:?}");
    let remark = "the robot does not get to counter_other_group";
    assert!(
        kitchen.remarks.iter().any(|one| one == remark),
        "{:?}",
        kitchen.remarks
    );
}

#[test]
fn a_thousand_fixtures_in_one_place_take_no_time_to_speak_of() {
    let mut text = LAYOUT.to_owned();
    text += "heap_group:\n  row:\n";
    for number in 0..900 {
        text += &format!(
            "    - {{name: cab_{number}, type: hinge_cabinet, pos: [2, -2.8, 0.5], size: [0.8, 0.6, 0.9]}}\n"
        );
    }
    let text = text.replace("size: [2.0, 2.0, 0.02]", "size: [9, 9, 0.02]");
    let begin = std::time::Instant::now();
    let kitchen = Published::of_layout(&text).unwrap();
    assert!(begin.elapsed().as_secs() < 20, "{:?}", begin.elapsed());
    assert!(
        kitchen
            .remarks
            .iter()
            .any(|remark| remark.contains("other pairs")),
        "{:?}",
        kitchen.remarks
    );
    let more = format!(
        "{text}{}",
        text.split_once("heap_group")
            .unwrap()
            .1
            .replace(":\n  row", "more_group:\n  row")
    );
    let error = Published::of_layout(&more).unwrap_err();
    assert_eq!(error.text, "a layout has at most 1000 fixtures");
}

#[test]
fn what_is_no_layout_is_refused() {
    let error = |text: &str| Published::of_layout(text).unwrap_err().to_string();
    assert_eq!(error(""), "the file is empty");
    assert_eq!(error("# nothing\n"), "the file is empty");
    assert_eq!(
        error("hello"),
        "line 1: a layout is a map of names and values"
    );
    assert_eq!(
        error("a: b"),
        "line 1: the group a is a map of names and values"
    );
    assert!(
        error("a: [b").starts_with("line 2: this is no YAML: "),
        "{}",
        error("a: [b")
    );
    assert_eq!(error("{}"), "there is no place where a robot could stand");
    let deep = format!("a: {}", "[".repeat(100_000));
    assert!(
        error(&deep).starts_with("line 1: this is "),
        "{}",
        error(&deep)
    );
    let long = format!("a:\n  b: [{}]", "1,".repeat(300_000));
    assert_eq!(
        error(&long),
        "line 2: a layout has fewer values than this file"
    );
}

/// `LAYOUTS=FOLDER cargo test -p planwright-kitchens --release -- --ignored --nocapture every_layout_of_a_folder`
#[test]
#[ignore = "wants the layouts of RoboCasa, which the package praxis-robocasa has"]
fn every_layout_of_a_folder_is_read() {
    let folder = std::env::var("LAYOUTS").expect("LAYOUTS is a folder of layouts");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|file| file.unwrap().path())
        .collect();
    files.sort();
    let (mut read, mut count, mut table) = (0, 0, String::new());
    for file in files.iter().filter(|file| Simulator::of(file).is_some()) {
        count += 1;
        let name = file.file_stem().unwrap().display();
        match Published::of_layout(&std::fs::read_to_string(file).unwrap()) {
            Ok(kitchen) => {
                read += 1;
                let links = kitchen.urdf.matches("<link ").count();
                let drawers = kitchen.urdf.matches("\"prismatic\"").count();
                let doors = kitchen.urdf.matches("\"revolute\"").count();
                table += &format!("{name}: {links} links, {drawers} drawers, {doors} doors\n");
                for remark in &kitchen.remarks {
                    table += &format!("    {remark}\n");
                }
            }
            Err(error) => table += &format!("{name}: {error}\n"),
        }
    }
    table += &format!("{read} of {count} are read\n");
    std::io::Write::write_all(&mut std::io::stdout(), table.as_bytes()).unwrap();
    assert_eq!(read, count);
}

/// A kitchen beside another room, with a doorway between them. The walls are there for both rooms, and for the outside.
const HOUSE: &str = r#"{
  "rooms": [
    {"id": "room|2", "roomType": "Kitchen", "floorPolygon": [
      {"x": 0, "y": 0, "z": 0}, {"x": 0, "y": 0, "z": 4}, {"x": 5, "y": 0, "z": 4}, {"x": 5, "y": 0, "z": 0}]},
    {"id": "room|3", "roomType": "Bedroom", "floorPolygon": [
      {"x": 5, "y": 0, "z": 0}, {"x": 5, "y": 0, "z": 4}, {"x": 8, "y": 0, "z": 4}, {"x": 8, "y": 0, "z": 0}]}
  ],
  "walls": [
    {"id": "wall|2|0|0|0|4", "polygon": [
      {"x": 0, "y": 0, "z": 0}, {"x": 0, "y": 2.6, "z": 0}, {"x": 0, "y": 2.6, "z": 4}, {"x": 0, "y": 0, "z": 4}]},
    {"id": "wall|2|0|4|5|4", "polygon": [
      {"x": 0, "y": 0, "z": 4}, {"x": 0, "y": 2.6, "z": 4}, {"x": 5, "y": 2.6, "z": 4}, {"x": 5, "y": 0, "z": 4}]},
    {"id": "wall|2|5|0|5|4", "polygon": [
      {"x": 5, "y": 0, "z": 4}, {"x": 5, "y": 2.6, "z": 4}, {"x": 5, "y": 2.6, "z": 0}, {"x": 5, "y": 0, "z": 0}]},
    {"id": "wall|3|5|0|5|4", "polygon": [
      {"x": 5, "y": 0, "z": 0}, {"x": 5, "y": 2.6, "z": 0}, {"x": 5, "y": 2.6, "z": 4}, {"x": 5, "y": 0, "z": 4}]},
    {"id": "wall|2|0|0|5|0", "polygon": [], "empty": true}
  ],
  "doors": [
    {"id": "door|2|3", "wall0": "wall|3|5|0|5|4", "wall1": "wall|2|5|0|5|4",
     "holePolygon": [{"x": 0.5, "y": 0, "z": 0}, {"x": 1.5, "y": 2.1, "z": 0}]}
  ],
  "objects": [
    {"assetId": "Countertop_L_8x6", "id": "2|0|0", "kinematic": true,
     "position": {"x": 1.22, "y": 0.47, "z": 3.085}, "rotation": {"x": 0, "y": 180, "z": 0},
     "children": [
       {"assetId": "Mug_2", "id": "small|2|5", "position": {"x": 1.2, "y": 0.98, "z": 3.7}},
       {"assetId": "Toaster_1", "id": "2|0|1", "position": {"x": 1.2, "y": 1.04, "z": 3.7},
        "rotation": {"x": 0, "y": 90, "z": 0}}]},
    {"assetId": "Fridge_1", "id": "2|1", "position": {"x": 4.0, "y": 0, "z": 3.6}, "rotation": {"x": 0, "y": 180, "z": 0}},
    {"assetId": "Dining_Table_16_1", "id": "2|2|0", "position": {"x": 2.5, "y": 0.4124, "z": 1.0}},
    {"assetId": "Wall_Decor_Photo_9", "id": "2|7", "position": {"x": 0.02, "y": 1.5, "z": 1.0}},
    {"assetId": "Nobody_Knows_1", "id": "2|8", "position": {"x": 1, "y": 0, "z": 1}},
    {"assetId": "Bed_1", "id": "3|0", "position": {"x": 6.5, "y": 0.4, "z": 2}}
  ]
}"#;

const ASSET_DATABASE: &str = r#"{
  "CounterTop": [{"assetId": "Countertop_L_8x6", "boundingBox": {"x": 2.44, "y": 0.94, "z": 1.83},
    "objectType": "CounterTop", "primaryProperty": "Static", "split": "train"}],
  "Mug": [{"assetId": "Mug_2", "boundingBox": {"x": 0.1, "y": 0.1, "z": 0.1}, "objectType": "Mug",
    "primaryProperty": "CanPickup"}],
  "Toaster": [{"assetId": "Toaster_1", "boundingBox": {"x": 0.2, "y": 0.2, "z": 0.34}, "objectType": "Toaster",
    "primaryProperty": "Static"}],
  "Fridge": [{"assetId": "Fridge_1", "boundingBox": {"x": 1.0, "y": 1.96, "z": 0.72}, "objectType": "Fridge",
    "primaryProperty": "Static"}],
  "DiningTable": [{"assetId": "Dining_Table_16_1", "boundingBox": {"x": 1.4, "y": 0.8248, "z": 0.9},
    "objectType": "DiningTable", "primaryProperty": "Moveable"}],
  "Painting": [{"assetId": "Wall_Decor_Photo_9", "boundingBox": {"x": 0.4, "y": 0.4, "z": 0.02},
    "objectType": "Painting"}]
}"#;

#[test]
fn what_stands_in_the_kitchen_of_a_house_stands_there() {
    let kitchen = Published::of_house(HOUSE, ASSET_DATABASE).unwrap();
    for (link, at) in [
        // The row along the far wall, and the wing along the one at its left.
        ("counter_top_2_0_0", [1.22, 3.695, 0.94]),
        ("counter_top_2_0_0_left", [0.305, 2.78, 0.94]),
        // What is said to be in the floor stands on it; it looks at the room.
        ("fridge_2_1", [4.0, 3.6 - 0.34, 0.98]),
        ("dining_table_2_2_0", [2.5, 1.0, 0.4124]),
        // Turned clockwise by a quarter: it looks along x.
        ("toaster_2_0_1", [1.2 + 0.15, 3.7, 1.04]),
        // Beyond its plane, two parts beside the doorway, and one above it.
        ("wall_3_1", [5.03, 2.75, 1.3]),
        ("wall_3_2", [5.03, 1.0, 2.35]),
        ("wall_3_3", [5.03, 0.25, 1.3]),
    ] {
        let found = joint_of(&kitchen, link);
        assert!(is_near(&found, at), "{link}: {found:?}, not {at:?}");
    }
    for left_out in ["bed", "mug", "painting", "wall_4", "_right"] {
        assert!(!kitchen.urdf.contains(left_out), "{left_out}");
    }
    assert!(
        kitchen
            .description
            .contains("(place table :on dining_table_2_2_0)")
    );
    assert!(
        kitchen
            .description
            .contains("(place fridge :in fridge_2_1_main :side front)")
    );
    assert_eq!(
        kitchen.remarks,
        [
            "what can be picked up is left out, and may be spawned: Mug",
            "what hangs on walls is left out: Painting",
            "what the database of assets does not know is left out: Nobody_Knows_1",
            "counters around a corner are taken to stand along the walls",
            "the house says nothing of drawers and handles: only fridges and microwaves open",
        ]
    );
}

#[test]
fn what_is_no_house_is_refused() {
    let error = |house: &str| {
        Published::of_house(house, ASSET_DATABASE)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        error(&HOUSE.replace("\"Kitchen\"", "\"LivingRoom\"")),
        "this house has no room of the type Kitchen, only Bedroom, LivingRoom"
    );
    assert!(
        error("[1").starts_with("line 1: this is no house: "),
        "{}",
        error("[1")
    );
    assert!(
        error(&HOUSE.replacen("\"assetId\"", "\"asset\"", 1)).contains("missing field `assetId`"),
        "{}",
        error(&HOUSE.replacen("\"assetId\"", "\"asset\"", 1))
    );
    assert_eq!(
        error(&HOUSE.replace("\"x\": 1.22", "\"x\": 1e9")),
        "a house is within 200 m, this point is at 1000000000 0.47 3.085"
    );
    let error = Published::of_house(HOUSE, "[]").unwrap_err().to_string();
    assert!(
        error.starts_with("the database of assets is none: "),
        "{error}"
    );
}

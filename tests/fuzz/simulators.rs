//! Targets that are kitchens of other simulators: layouts and houses. What is made of them must be a kitchen.

use super::target::{Taken, Target};
use kitchens::Published;
use robotics::robot::KinematicTree;
use robotics::world::KitchenDescription;

pub(super) fn targets() -> Vec<Target> {
    vec![
        Target {
            name: "layout",
            share: 20,
            least_read: 95,
            words: &[
                "\n",
                "  - ",
                ": ",
                "null",
                "[1, 0.6, 0.9]",
                "1e300",
                "-0",
                "true",
                "&a ",
                "*a",
                "size: ",
                "align_to: counter\n",
                "side: right\n",
                "type: ",
                "drawer",
                "hinge_cabinet",
                "oven",
                "fridge_french_door",
                "z_rot: 1.5708\n",
            ],
            corpus: || vec![LAYOUT.into()],
            open: || {
                Box::new(|input| taken(Published::of_layout(&String::from_utf8_lossy(input)).ok()))
            },
        },
        Target {
            name: "house",
            share: 20,
            least_read: 95,
            words: &[
                "{",
                "}",
                "[",
                "]",
                ",",
                "\"x\": 1",
                "1e300",
                "-0.0",
                "null",
                "\"children\": [",
                "\"Kitchen\"",
                "\"Countertop_L_8x6\"",
                "\"rotation\": {\"y\": 90}",
            ],
            corpus: || vec![HOUSE.into()],
            open: || {
                Box::new(|input| {
                    taken(Published::of_house(&String::from_utf8_lossy(input), ASSETS).ok())
                })
            },
        },
    ]
}

/// Whether there is a kitchen; then it must be one.
fn taken(kitchen: Option<Published>) -> Result<Taken, String> {
    let Some(kitchen) = kitchen else {
        return Ok(Taken::Refused);
    };
    let tree = KinematicTree::from_urdf(&kitchen.urdf, "kitchen.urdf")
        .map_err(|error| format!("the URDF that is made of it is wrong: {error}"))?;
    KitchenDescription::from_sexp(&kitchen.description, "kitchen.sexp", &tree)
        .map_err(|error| format!("the description that is made of it is wrong: {error}"))?;
    Ok(Taken::Read)
}

const LAYOUT: &str = "
room:
  walls:
    - {name: wall, type: wall, size: [2, 1.5, 0.02], pos: [2, 0, 1.5]}
  floor:
    - {name: floor, type: floor, size: [2, 2, 0.02], pos: [2, -2, 0]}
  floor_accessories:
    - {name: stool, type: stool, pos: [1, -3, null], z_rot: 1.57}
main_group:
  group_origin: [0, 0]
  group_pos: [0, 0]
  group_z_rot: 0
  row:
    - {name: sink, type: sink}
    - {name: counter, type: counter, interior_obj: sink, size: [2, 0.65, 0.92], pos: [1, -0.325, 0.46]}
    - {name: oven, type: oven, size: [0.7, 0.6, 0.6]}
    - name: housing
      type: housing_cabinet
      interior_obj: oven
      size: [0.8, 0.65, 0.7]
      padding: [null, [-0.01, null], null]
      align_to: counter
      side: right
      alignment: bottom_back
    - {name: fridge, type: fridge_french_door, align_to: housing, side: right, alignment: bottom_back}
    - name: stack
      type: stack
      pos: [0.4, -0.3, 0.47]
      size: [0.8, 0.6, 0.84]
      levels: [single_cabinet, [drawer, drawer]]
      percentages: [0.7, 0.3]
      configs: {single_cabinet: {orientation: left}}
    - {name: cab, type: hinge_cabinet, pos: [1, -0.2, 1.84], size: [1, 0.4, 0.92]}
    - {name: small, type: hinge_cabinet, size: [cab, 0.4, null], align_to: cab, side: top, stack_height: 1.5, stack_fixtures: [cab]}
    - {name: toaster, type: toaster, placement: {fixture: counter_main_group, size: [1, 0.4], pos: [null, 1], rotation: [0, 0]}}
";

const HOUSE: &str = r#"{"rooms": [{"id": "room|2", "roomType": "Kitchen", "floorPolygon": [{"x": 0, "z": 0}, {"x": 0, "z": 4},
    {"x": 5, "z": 4}, {"x": 5, "z": 0}]}],
  "walls": [{"id": "wall|1", "polygon": [{"x": 0, "y": 0, "z": 0}, {"x": 0, "y": 2.6, "z": 0}, {"x": 0, "y": 2.6, "z": 4}]},
    {"id": "wall|2", "polygon": [], "empty": true}],
  "doors": [{"wall0": "wall|1", "holePolygon": [{"x": 0.5, "y": 0}, {"x": 1.5, "y": 2.1}]}],
  "objects": [{"assetId": "Countertop_L_8x6", "id": "2|0|0", "position": {"x": 1.22, "y": 0.47, "z": 3.085},
    "rotation": {"y": 180}, "children": [{"assetId": "Mug_2", "id": "small|2|5", "position": {"x": 1, "y": 1, "z": 3.7}}]},
    {"assetId": "Fridge_1", "id": "2|1", "position": {"x": 4, "y": 0, "z": 3.6}, "rotation": {"y": 180}}]}"#;

const ASSETS: &str = r#"{
  "CounterTop": [{"assetId": "Countertop_L_8x6", "boundingBox": {"x": 2.44, "y": 0.94, "z": 1.83}, "objectType": "CounterTop"}],
  "Mug": [{"assetId": "Mug_2", "boundingBox": {"x": 0.1, "y": 0.1, "z": 0.1}, "objectType": "Mug", "primaryProperty": "CanPickup"}],
  "Fridge": [{"assetId": "Fridge_1", "boundingBox": {"x": 1.0, "y": 1.96, "z": 0.72}, "objectType": "Fridge"}]}"#;

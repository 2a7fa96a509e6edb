//! The messages that a session sends.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

use crate::cdr::{ByteOrder, decode, encode};
use crate::message;
use crate::{Distribution, FieldType, Layouts, SceneModel, SceneState, Value};
use robotics::world::{Models, RobotConfiguration, World};
use spatial::Pose;

fn scene() -> (SceneModel, SceneState) {
    let models = Arc::new(Models::pr2_in_kitchen().expect("the models are right"));
    let configuration = RobotConfiguration {
        base: Pose::translation(0.5, -0.25, 0.0),
        joints: models.robot.zero_positions(),
    };
    let model = SceneModel::new(&models);
    let world = World::new(models, configuration);
    let state = model.state(1.5, &world, &SceneState::default());
    (model, state)
}

const STAMP: Duration = Duration::new(7, 500);

/// Whether a distribution has a field for all that a value says.
fn fits(layouts: &Layouts, message: &str, value: &Value) {
    let Value::Record(fields) = value else {
        return;
    };
    let known = layouts.fields(message).expect("the message is known");
    for (name, value) in fields {
        let field = known.iter().find(|field| *field.name == **name);
        let field = field.unwrap_or_else(|| panic!("{message} has no field {name}"));
        if let FieldType::Message(inner) = &field.kind {
            match value {
                Value::List(items) => items.iter().for_each(|item| fits(layouts, inner, item)),
                value => fits(layouts, inner, value),
            }
        }
    }
}

#[test]
fn every_message_of_a_session_fits_the_layouts() {
    let (model, state) = scene();
    let messages = [
        ("std_msgs/msg/String", message::text("<robot/>")),
        ("rosgraph_msgs/msg/Clock", message::clock(STAMP)),
        (
            "tf2_msgs/msg/TFMessage",
            message::moving_frames(STAMP, &model, &state),
        ),
        (
            "tf2_msgs/msg/TFMessage",
            message::still_frames(STAMP, &model),
        ),
        (
            "sensor_msgs/msg/JointState",
            message::joint_states(STAMP, &model.joints, &state.positions, None),
        ),
        (
            "visualization_msgs/msg/MarkerArray",
            message::object_markers(STAMP, &model, &state),
        ),
        (
            "visualization_msgs/msg/MarkerArray",
            message::furniture_markers(STAMP, &model, &state),
        ),
    ];
    for distribution in Distribution::ALL {
        let layouts = Layouts::of(distribution).expect("the table is right");
        for (name, value) in &messages {
            fits(&layouts, name, value);
            let bytes = encode(&layouts, name, value).expect("the message fits");
            let read = decode(&layouts, name, &bytes, ByteOrder::Little);
            assert_eq!(
                encode(&layouts, name, &read.expect("it is whole")),
                Ok(bytes)
            );
        }
    }
}

#[test]
fn every_joint_that_moves_is_in_the_joint_states() {
    let (model, state) = scene();
    let value = message::joint_states(STAMP, &model.joints, &state.positions, None);
    let count = |field: &str| value.get(field).and_then(Value::as_list).map(<[_]>::len);
    assert_eq!(count("name"), Some(model.joints.len()));
    assert_eq!(count("position"), Some(model.joints.len()));
    assert_eq!(count("velocity"), Some(model.joints.len()));
    assert!(model.joints.iter().any(|name| name == "torso_lift_joint"));
    // A finger that follows the other one is a joint, too, as robot_state_publisher has it.
    assert!(model.joints.len() > 40, "{}", model.joints.len());
}

#[test]
fn joints_without_velocities_stand_still() {
    let names = ["a".to_owned(), "b".to_owned()];
    let states = |velocities| message::joint_states(STAMP, &names, &[1.0, 0.0], velocities);
    let velocity = |velocities| states(velocities).get("velocity").cloned();
    assert_eq!(velocity(Some(&[2.0, 0.0])), Some(Value::floats([2.0, 0.0])));
    // Lists of other lengths would be read as those of other joints.
    for wrong in [Some(&[0.5][..]), None] {
        assert_eq!(velocity(wrong), Some(Value::floats([0.0, 0.0])));
    }
}

/// The frames of a message: child and parent.
fn edges(value: &Value) -> Vec<(String, String)> {
    let frames = value.get("transforms").and_then(Value::as_list);
    let text = |value: Option<&Value>| value.and_then(Value::as_text).map(str::to_owned);
    let edges = frames.into_iter().flatten().map(|frame| {
        let parent = text(frame.at(&["header", "frame_id"]));
        (text(frame.get("child_frame_id")), parent)
    });
    edges
        .map(|(child, parent)| (child.expect("a child"), parent.expect("a parent")))
        .collect()
}

#[test]
fn the_frames_are_one_tree_below_the_map() {
    let (model, state) = scene();
    let still = edges(&message::still_frames(STAMP, &model));
    let moving = edges(&message::moving_frames(STAMP, &model, &state));
    let all: Vec<_> = still.iter().chain(&moving).collect();
    let children: BTreeSet<&String> = all.iter().map(|(child, _)| child).collect();
    assert_eq!(children.len(), all.len(), "a frame has two parents");
    for (child, _) in &all {
        let mut frame = child;
        let mut steps = 0;
        while frame != "map" {
            let parent = all.iter().find(|(known, _)| known == frame);
            let (_, parent) = parent.unwrap_or_else(|| panic!("{frame} has no parent"));
            frame = parent;
            steps += 1;
            assert!(steps < 100, "{child} is in a circle");
        }
        assert!(!child.starts_with('/'), "{child}");
    }
    assert_eq!(
        moving[0],
        ("base_footprint".to_owned(), "odom_combined".to_owned())
    );
}

#[test]
fn the_base_is_where_the_world_has_it() {
    let (model, state) = scene();
    let value = message::moving_frames(STAMP, &model, &state);
    let frames = value.get("transforms").and_then(Value::as_list);
    let base = &frames.expect("frames are a list")[0];
    let at = |axis: &str| {
        base.at(&["transform", "translation", axis])
            .and_then(Value::as_float)
    };
    assert_eq!(
        [at("x"), at("y"), at("z")],
        [Some(0.5), Some(-0.25), Some(0.0)]
    );
    let stamp = base.at(&["header", "stamp", "nanosec"]);
    assert_eq!(stamp.and_then(Value::as_integer), Some(500));
}

#[test]
fn markers_begin_with_forgetting_all_earlier_ones() {
    let (model, state) = scene();
    let value = message::furniture_markers(STAMP, &model, &state);
    let markers = value.get("markers").and_then(Value::as_list);
    let markers = markers.expect("markers are a list");
    let action = |i: usize| markers[i].get("action").and_then(Value::as_integer);
    assert_eq!((action(0), action(1)), (Some(3), Some(0)));
    assert!(markers.len() > 20, "{}", markers.len());
}

#[test]
fn a_camera_is_told_by_its_focus_in_pixels() {
    let camera = robotics::perception::Camera {
        pose: Pose::identity(),
        width: 320,
        height: 200,
        vertical_fov: std::f64::consts::FRAC_PI_2,
        near: 0.1,
        far: 10.0,
    };
    let info = message::camera_info(Duration::ZERO, "eye", &camera);
    let matrix = info.get("k").and_then(Value::as_list).unwrap();
    let matrix: Vec<f64> = matrix.iter().filter_map(Value::as_float).collect();
    let wanted = [100.0, 0.0, 160.0, 0.0, 100.0, 100.0, 0.0, 0.0, 1.0];
    let farthest = matrix.iter().zip(wanted).map(|(a, b)| (a - b).abs());
    assert!(farthest.fold(0.0, f64::max) < 1e-9, "{matrix:?}");
    let mut picture = view::picture::Image::filled(2, 1, [1, 2, 3]);
    picture.set(1, 0, [4, 5, 6]);
    let image = message::image(Duration::ZERO, "eye", &picture);
    let data = image.get("data").and_then(Value::as_bytes);
    assert_eq!(data, Some(&[1, 2, 3, 4, 5, 6][..]));
    assert_eq!(image.get("step").and_then(Value::as_integer), Some(6));
}

//! The bytes of messages.

use crate::cdr::{ByteOrder, CdrError, decode, encode};
use crate::{Distribution, Layouts, Value};

fn layouts() -> Layouts {
    Layouts::of(Distribution::Jazzy).expect("the table is right")
}

fn bytes(message: &str, value: &Value) -> Result<Vec<u8>, CdrError> {
    encode(&layouts(), message, value)
}

#[test]
fn a_joint_state_has_the_bytes_that_cdr_prescribes() {
    let stamp = Value::record([("sec", 1i64.into()), ("nanosec", 2i64.into())]);
    let header = Value::record([("stamp", stamp), ("frame_id", "ab".into())]);
    let value = Value::record([
        ("header", header),
        ("name", Value::texts(["x"])),
        ("position", Value::floats([1.0])),
    ]);
    let wanted: Vec<u8> = [
        &[1, 0, 0, 0, 2, 0, 0, 0][..],
        &[3, 0, 0, 0, b'a', b'b', 0, 0],
        &[1, 0, 0, 0, 2, 0, 0, 0, b'x', 0, 0, 0],
        // The number of positions, then padding: a double stands at a multiple of eight.
        &[1, 0, 0, 0],
        &[0, 0, 0, 0, 0, 0, 0xf0, 0x3f],
        &[0, 0, 0, 0, 0, 0, 0, 0],
    ]
    .concat();
    assert_eq!(bytes("sensor_msgs/msg/JointState", &value), Ok(wanted));
}

#[test]
fn what_is_encoded_is_decoded_in_both_orders_of_bytes() {
    let point = |x: f64| Value::record([("x", x.into()), ("y", 2.5.into()), ("z", (-3.0).into())]);
    let value = Value::record([
        ("ns", "cup \u{fc}".into()),
        ("id", (-7i64).into()),
        ("frame_locked", true.into()),
        ("points", Value::list([point(1.0), point(f64::MIN)])),
        (
            "mesh_file",
            Value::record([("data", Value::Bytes(vec![0, 255, 7]))]),
        ),
    ]);
    let message = "visualization_msgs/msg/Marker";
    let little = bytes(message, &value).expect("the message fits");
    let read = decode(&layouts(), message, &little, ByteOrder::Little).expect("it is whole");
    assert_eq!(read.get("ns").and_then(Value::as_text), Some("cup \u{fc}"));
    assert_eq!(read.get("id").and_then(Value::as_integer), Some(-7));
    assert_eq!(read.get("frame_locked"), Some(&Value::Bool(true)));
    let points = read.get("points").and_then(Value::as_list);
    let points = points.expect("points are a list");
    assert_eq!(points[1].get("x").and_then(Value::as_float), Some(f64::MIN));
    let data = read.at(&["mesh_file", "data"]).and_then(Value::as_bytes);
    assert_eq!(data, Some(&[0, 255, 7][..]));
    // What was decoded is encoded to the same bytes.
    assert_eq!(bytes(message, &read), Ok(little));
    let big = [0, 0, 0, 5, 0xff, 0xff, 0xff, 0xfe];
    let time = decode(
        &layouts(),
        "builtin_interfaces/msg/Time",
        &big,
        ByteOrder::Big,
    );
    let time = time.expect("it is whole");
    assert_eq!(time.get("sec").and_then(Value::as_integer), Some(5));
    let nanoseconds = time.get("nanosec").and_then(Value::as_integer);
    assert_eq!(nanoseconds, Some(0xffff_fffe));
}

#[test]
fn a_message_that_is_cut_anywhere_is_refused() {
    let goal = "control_msgs/action/FollowJointTrajectory_SendGoal_Request";
    let point = Value::record([("positions", Value::floats([0.1, 0.2]))]);
    let trajectory = Value::record([
        ("joint_names", Value::texts(["a", "b"])),
        ("points", Value::list([point])),
    ]);
    let value = Value::record([("goal", Value::record([("trajectory", trajectory)]))]);
    let whole = bytes(goal, &value).expect("the message fits");
    let read = |bytes: &[u8]| decode(&layouts(), goal, bytes, ByteOrder::Little);
    assert!(read(&whole).is_ok());
    for end in 0..whole.len() {
        let cut = read(&whole[..end]);
        assert!(matches!(cut, Err(CdrError::Short(_))), "{end}: {cut:?}");
    }
}

#[test]
fn a_length_that_is_a_lie_is_refused_without_room_for_it() {
    for message in ["std_msgs/msg/String", "tf2_msgs/msg/TFMessage"] {
        let read = decode(&layouts(), message, &[0xff; 8], ByteOrder::Little);
        assert!(matches!(read, Err(CdrError::Short(_))), "{message}");
    }
}

#[test]
fn a_text_that_is_no_utf8_is_read_as_far_as_it_is() {
    let read = |bytes: &[u8]| {
        let read = decode(&layouts(), "std_msgs/msg/String", bytes, ByteOrder::Little);
        let text = read.expect("it is whole");
        text.get("data").and_then(Value::as_text).map(str::to_owned)
    };
    let bad = [4, 0, 0, 0, b'a', 0xff, b'b', 0];
    assert_eq!(read(&bad).as_deref(), Some("a\u{fffd}b"));
    // Some write texts without the byte at their end, or nothing at all.
    assert_eq!(read(&[1, 0, 0, 0, b'a']).as_deref(), Some("a"));
    assert_eq!(read(&[0, 0, 0, 0]).as_deref(), Some(""));
}

#[test]
fn a_text_never_has_its_end_within() {
    let text = bytes(
        "std_msgs/msg/String",
        &Value::record([("data", "a\0b".into())]),
    );
    assert_eq!(text, Ok(vec![3, 0, 0, 0, b'a', b'b', 0]));
}

#[test]
fn what_does_not_fit_is_refused_by_name() {
    let wrong = |message: &str, value: Value| {
        let error = bytes(message, &value).expect_err("it does not fit");
        error.to_string()
    };
    let time = "builtin_interfaces/msg/Time";
    let uuid = "unique_identifier_msgs/msg/UUID";
    for (message, field, value, text) in [
        (
            time,
            "nanosec",
            Value::Integer(-1),
            "nanosec should be a whole number from 0 to 4294967295",
        ),
        (
            time,
            "sec",
            Value::Integer(1 << 31),
            "sec should be a whole number from -2147483648 to 2147483647",
        ),
        (
            time,
            "sec",
            Value::Float(1.0),
            "sec should be a whole number",
        ),
        (
            uuid,
            "uuid",
            Value::Bytes(vec![0; 15]),
            "uuid should be 16 of its kind",
        ),
        (uuid, "uuid", Value::Bool(true), "uuid should be a list"),
        (
            "std_msgs/msg/String",
            "data",
            Value::Bool(true),
            "data should be a text",
        ),
        (
            "std_msgs/msg/Strin",
            "data",
            Value::Bool(true),
            "there is no message std_msgs/msg/Strin",
        ),
        (
            "geometry_msgs/msg/Pose",
            "position",
            Value::Bool(true),
            "geometry_msgs/msg/Point should be a geometry_msgs/msg/Point",
        ),
    ] {
        assert_eq!(wrong(message, Value::record([(field, value)])), text);
    }
}

//! Which fields the messages of each distribution have, told by what is on the wire.

use crate::cdr::encode;
use crate::{Distribution, LayoutError, Layouts, Value};

fn layouts(distribution: Distribution) -> Layouts {
    Layouts::of(distribution).expect("the table is right")
}

/// The size of a message in which all is zero or empty, for each distribution.
fn sizes(message: &str) -> [usize; 5] {
    Distribution::ALL.map(|distribution| {
        let bytes = encode(&layouts(distribution), message, &Value::record([]));
        bytes.expect("the message is known").len()
    })
}

#[test]
fn messages_that_are_the_same_in_all_distributions_have_their_size() {
    for (message, size) in [
        ("builtin_interfaces/msg/Time", 8),
        // A text without letters: its length and the byte that ends it.
        ("std_msgs/msg/String", 5),
        ("std_msgs/msg/Empty", 1),
        ("geometry_msgs/msg/Pose", 56),
        // Stamp, empty text, padding to eight, pose.
        ("geometry_msgs/msg/PoseStamped", 8 + 5 + 3 + 56),
        ("geometry_msgs/msg/TransformStamped", 8 + 5 + 3 + 5 + 3 + 56),
        ("tf2_msgs/msg/TFMessage", 4),
        ("sensor_msgs/msg/JointState", 8 + 5 + 3 + 4 * 4),
        // Header to 16, size, model to 29, no distortion to 36; then doubles from 40 on.
        (
            "sensor_msgs/msg/CameraInfo",
            40 + (9 + 9 + 12) * 8 + 2 * 4 + 4 * 4 + 1,
        ),
        ("action_msgs/msg/GoalInfo", 16 + 8),
        ("action_msgs/srv/CancelGoal_Response", 1 + 3 + 4),
        ("control_msgs/action/PointHead_Result", 1),
        ("control_msgs/action/GripperCommand_Result", 18),
        (
            "nav2_msgs/action/NavigateToPose_SendGoal_Request",
            16 + 72 + 5,
        ),
        (
            "nav2_msgs/action/NavigateToPose_SendGoal_Response",
            1 + 3 + 8,
        ),
        ("nav2_msgs/action/NavigateToPose_GetResult_Request", 16),
    ] {
        assert_eq!(sizes(message), [size; 5], "{message}");
    }
}

#[test]
fn messages_that_have_changed_have_the_size_of_their_distribution() {
    let result = "nav2_msgs/action/NavigateToPose_GetResult_Response";
    // A status; then an empty message, a code, or a code and a text.
    assert_eq!(sizes(result), [2, 4, 4 + 5, 4 + 5, 4 + 5]);
    let feedback = "nav2_msgs/action/NavigateToPose_FeedbackMessage";
    let before = 16 + 72 + 8 + 8 + 2 + 2 + 4;
    assert_eq!(
        sizes(feedback),
        [before, before, before, before, before + 8]
    );
    let [humble, iron, jazzy, kilted, lyrical] =
        sizes("control_msgs/action/FollowJointTrajectory_Feedback");
    assert_eq!((humble, jazzy, kilted), (iron, iron, lyrical));
    assert_eq!(kilted, jazzy + 2 * 4);
    assert_eq!(sizes("rmw_dds_common/msg/Gid"), [24, 16, 16, 16, 16]);
}

#[test]
fn every_message_of_every_distribution_can_be_encoded() {
    for distribution in Distribution::ALL {
        let layouts = layouts(distribution);
        let count = layouts.messages().count();
        assert!(count > 50, "{count}");
        for message in layouts.messages() {
            let bytes = encode(&layouts, message, &Value::record([]));
            assert!(bytes.is_ok_and(|bytes| !bytes.is_empty()), "{message}");
        }
    }
}

#[test]
fn mistakes_in_a_table_are_named_with_their_line() {
    let read = |table: &str| Layouts::read(table, Distribution::Jazzy).err();
    for (table, wrong) in [
        (
            "int32 a",
            "line 1 of the table of messages: int32 a belongs to no message",
        ),
        (
            "[a/msg/A]\nint33 a",
            "line 2 of the table of messages: int33 a: there is no type int33",
        ),
        (
            "[a/msg/A]\nint32",
            "line 2 of the table of messages: int32 is no field: a type and a name were expected",
        ),
        (
            "[a/msg/A]\nint32[0] a",
            "line 2 of the table of messages: int32[0] a: between [ and ] may be a number from 1, or nothing",
        ),
        (
            "[a/msg/A]\nint32 a\nint8 a",
            "line 3 of the table of messages: a/msg/A has two fields a",
        ),
        (
            "[a/msg/A\nint32 a",
            "line 1 of the table of messages: [a/msg/A lacks a ] at its end",
        ),
        (
            "[a/msg/A]\n[a/msg/A]",
            "line 2 of the table of messages: a/msg/A stands there twice, or an older layout stands behind a newer one",
        ),
        (
            "[a/msg/A since kilted]\n[a/msg/A since iron]",
            "line 2 of the table of messages: a/msg/A stands there twice, or an older layout stands behind a newer one",
        ),
        (
            "[a/msg/A]\nb/msg/B b",
            "the table of messages: a/msg/A has a field of type b/msg/B, which is not in it",
        ),
        (
            "[a/msg/A]\nb/msg/B b\n[b/msg/B]\na/msg/A[] a",
            "the table of messages: a/msg/A contains itself",
        ),
    ] {
        assert_eq!(
            read(table).as_ref().map(LayoutError::to_string).as_deref(),
            Some(wrong)
        );
    }
}

#[test]
fn distributions_are_known_by_their_names() {
    for distribution in Distribution::ALL {
        assert_eq!(Distribution::named(distribution.name()), Ok(distribution));
    }
    let wrong = Distribution::named("jazy").map_err(|error| error.to_string());
    let wanted = "no distribution of ROS 2 is called \"jazy\" (did you mean jazzy?): known are \
                  humble, iron, jazzy, kilted, lyrical";
    assert_eq!(wrong, Err(wanted.to_owned()));
}

"""Actions of ROS 2 as Cyclone DDS reads them: what is on the wire of a goal, for a distribution, which is the second argument of
the program."""

import sys
import types
from dataclasses import dataclass

from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import array, float32, float64, int8, int16, int32, sequence, uint8, uint16, uint32

import messages as ros
import trajectories

DISTRIBUTION = sys.argv[2]


# What Cyclone's middleware puts before requests and replies: whose it is, and a number of 64 bits.
@dataclass
class RequestHeader(IdlStruct, typename="RequestHeader"):
    guid: array[uint8, 8]
    low: uint32
    high: int32


@dataclass
class PoseStamped(IdlStruct, typename="geometry_msgs::msg::dds_::PoseStamped_"):
    header: ros.Header
    pose: ros.Pose


@dataclass
class PointStamped(IdlStruct, typename="geometry_msgs::msg::dds_::PointStamped_"):
    header: ros.Header
    point: ros.Point


@dataclass
class GoalInfo(IdlStruct, typename="action_msgs::msg::dds_::GoalInfo_"):
    goal_id: array[uint8, 16]
    stamp: ros.Time


@dataclass
class GoalStatus(IdlStruct, typename="action_msgs::msg::dds_::GoalStatus_"):
    goal_info: GoalInfo
    status: int8


@dataclass
class GoalStatusArray(IdlStruct, typename="action_msgs::msg::dds_::GoalStatusArray_"):
    status_list: sequence[GoalStatus]


@dataclass
class CancelRequest(IdlStruct, typename="action_msgs::srv::dds_::CancelGoal_Request_"):
    request: RequestHeader
    goal_info: GoalInfo


@dataclass
class CancelResponse(IdlStruct, typename="action_msgs::srv::dds_::CancelGoal_Response_"):
    request: RequestHeader
    return_code: int8
    goals_canceling: sequence[GoalInfo]


def action(package, name, goal, result, feedback):
    """The messages of an action, of the fields of its parts."""
    prefix = f"{package}::action::dds_::{name}_"

    def message(part, fields):
        keywords = {"typename": f"{prefix}{part}_"}
        body = {"__annotations__": fields}
        kind = types.new_class(name + part, (IdlStruct,), keywords, lambda all: all.update(body))
        return dataclass(kind)

    header = {"request": RequestHeader}
    identity = {"goal_id": array[uint8, 16]}
    return {
        "send_goal": message("SendGoal_Request", {**header, **identity, **goal}),
        "accepted": message("SendGoal_Response", {**header, "accepted": bool, "stamp": ros.Time}),
        "get_result": message("GetResult_Request", {**header, **identity}),
        "result": message("GetResult_Response", {**header, "status": int8, **result}),
        "feedback": message("FeedbackMessage", {**identity, **feedback}),
    }


navigation_result = {
    "humble": {"nothing": uint8},
    "iron": {"error_code": uint16},
}.get(DISTRIBUTION, {"error_code": uint16, "error_msg": str})
tracking = {"position_tracking_error": float32, "heading_tracking_error": float32}
NAVIGATE = action(
    "nav2_msgs",
    "NavigateToPose",
    {"pose": PoseStamped, "behavior_tree": str},
    navigation_result,
    {
        "current_pose": PoseStamped,
        "navigation_time": ros.Duration,
        "estimated_time_remaining": ros.Duration,
        "number_of_recoveries": int16,
        "distance_remaining": float32,
        **(tracking if DISTRIBUTION == "lyrical" else {}),
    },
)
hand = {"position": float64, "effort": float64, "stalled": bool, "reached_goal": bool}
GRIPPER = action(
    "control_msgs", "GripperCommand", {"position": float64, "max_effort": float64}, hand, hand
)
POINT = action(
    "control_msgs",
    "PointHead",
    {
        "target": PointStamped,
        "pointing_axis": ros.Vector3,
        "pointing_frame": str,
        "min_duration": ros.Duration,
        "max_velocity": float64,
    },
    {"nothing": uint8},
    {"pointing_angle_error": float64},
)


FOLLOW = action("control_msgs", "FollowJointTrajectory", *trajectories.parts(DISTRIBUTION))

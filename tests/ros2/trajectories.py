"""Messages of trajectories of joints, and what comes of them."""

import time
from dataclasses import dataclass

from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import float64, int32, sequence, uint16

import messages as ros
from checks import check


@dataclass
class TrajectoryPoint(IdlStruct, typename="trajectory_msgs::msg::dds_::JointTrajectoryPoint_"):
    positions: sequence[float64]
    velocities: sequence[float64]
    accelerations: sequence[float64]
    effort: sequence[float64]
    time_from_start: ros.Duration


@dataclass
class Trajectory(IdlStruct, typename="trajectory_msgs::msg::dds_::JointTrajectory_"):
    header: ros.Header
    joint_names: sequence[str]
    points: sequence[TrajectoryPoint]


@dataclass
class Twist(IdlStruct, typename="geometry_msgs::msg::dds_::Twist_"):
    linear: ros.Vector3
    angular: ros.Vector3


@dataclass
class MultiPoint(IdlStruct, typename="trajectory_msgs::msg::dds_::MultiDOFJointTrajectoryPoint_"):
    transforms: sequence[ros.Transform]
    velocities: sequence[Twist]
    accelerations: sequence[Twist]
    time_from_start: ros.Duration


@dataclass
class MultiTrajectory(IdlStruct, typename="trajectory_msgs::msg::dds_::MultiDOFJointTrajectory_"):
    header: ros.Header
    joint_names: sequence[str]
    points: sequence[MultiPoint]


@dataclass
class Tolerance(IdlStruct, typename="control_msgs::msg::dds_::JointTolerance_"):
    name: str
    position: float64
    velocity: float64
    acceleration: float64


@dataclass
class ComponentTolerance(IdlStruct, typename="control_msgs::msg::dds_::JointComponentTolerance_"):
    joint_name: str
    component: uint16
    position: float64
    velocity: float64
    acceleration: float64


def parts(distribution):
    """The fields of goal, result and feedback of FollowJointTrajectory."""
    indices = distribution in ("kilted", "lyrical")
    return (
        {
            "trajectory": Trajectory,
            "multi_dof_trajectory": MultiTrajectory,
            "path_tolerance": sequence[Tolerance],
            "component_path_tolerance": sequence[ComponentTolerance],
            "goal_tolerance": sequence[Tolerance],
            "component_goal_tolerance": sequence[ComponentTolerance],
            "goal_time_tolerance": ros.Duration,
        },
        {"error_code": int32, "error_string": str},
        {
            "header": ros.Header,
            "joint_names": sequence[str],
            "desired": TrajectoryPoint,
            "actual": TrajectoryPoint,
            "error": TrajectoryPoint,
            **({"index": int32} if indices else {}),
            "multi_dof_joint_names": sequence[str],
            "multi_dof_desired": MultiPoint,
            "multi_dof_actual": MultiPoint,
            "multi_dof_error": MultiPoint,
            **({"multi_dof_index": int32} if indices else {}),
        },
    )


def duration(seconds):
    return ros.Duration(int(seconds), int(round(seconds % 1 * 1e9)))


def goal(names, points, stamp=ros.Time(0, 0)):
    """A goal of points: time (s), positions, and velocities or none."""
    all = [TrajectoryPoint(list(p), list(v or []), [], [], duration(t)) for t, p, v in points]
    header = ros.Header(stamp, "")
    several = MultiTrajectory(ros.Header(ros.Time(0, 0), ""), [], [])
    return Trajectory(header, list(names), all), several, [], [], [], [], ros.Duration(0, 0)


SUCCEEDED, CANCELED, ABORTED = 4, 5, 6


def try_arm(client, torso, joints):
    """Moves an arm by trajectories, right and wrong ones; `joints` tells where joints are."""
    arm = [
        name
        for name in joints()
        if name.startswith("r_") and any(part in name for part in ("shoulder", "upper_arm", "elbow", "forearm", "wrist"))
    ]
    here = joints()
    elbow = "r_elbow_flex_joint"
    start = {name: here[name] for name in arm}

    def at(**moved):
        return [start[name] + moved.get(name, 0.0) for name in arm]

    # One that is reached in time, with what is told meanwhile.
    points = [(1.0, at(**{elbow: 0.2}), None), (2.0, at(**{elbow: 0.3}), None)]
    identity, accepted = client.send(*goal(arm, points))
    begun = time.monotonic()
    result = client.result(identity)
    check(accepted and result.status == SUCCEEDED and result.error_code == 0, f"a trajectory: {result}")
    check(time.monotonic() - begun > 1.9, "a trajectory ends early")
    check(abs(joints()[elbow] - start[elbow] - 0.3) < 0.01, f"the elbow is at {joints()[elbow]}")
    told = [m for m in client.feedback.take(1000) if list(m.goal_id) == identity]
    check(len(told) >= 3 and told[-1].joint_names == list(told[0].joint_names), "feedback of a trajectory")
    check(max(abs(e) for e in told[-1].error.positions) < 0.1, f"it lags: {told[-1].error}")

    # One joint alone, in a stamp that begins soon, with velocities.
    soon = time.time() + 0.5
    stamp = ros.Time(int(soon), int(soon % 1 * 1e9))
    identity, _ = client.send(*goal([elbow], [(1.0, [start[elbow]], [0.0])], stamp))
    begun = time.monotonic()
    result = client.result(identity)
    check(result.status == SUCCEEDED, f"one joint: {result}")
    check(time.monotonic() - begun > 1.3, "it does not wait for its stamp")
    check(abs(joints()[elbow] - start[elbow]) < 0.01, "the elbow is not back")
    told = [m for m in client.feedback.take(1000) if list(m.goal_id) == identity]
    at_elbow = list(told[0].joint_names).index(elbow)
    desired = [m.desired.positions[at_elbow] - start[elbow] for m in told]
    check(any(0.02 < d < 0.28 for d in desired), f"feedback does not follow the stamp: {desired}")
    check(max(abs(m.error.positions[at_elbow]) for m in told) < 0.1, "it lags behind its stamp")

    # Wrong ones: the reason is told, and nothing moves.
    late = ros.Time(1000, 0)
    for code, wrong in (
        (-2, goal(["no_such_joint"], [(1.0, [0.0], None)])),
        (-2, goal([elbow, elbow], [(1.0, [0.0, 0.0], None)])),
        (-2, goal([], [])),
        (-1, goal([elbow], [])),
        (-1, goal([elbow], [(1.0, [0.0, 0.0], None)])),
        (-1, goal([elbow], [(1.0, [float("nan")], None)])),
        (-1, goal([elbow], [(1.0, [start[elbow]], None), (0.5, [start[elbow]], None)])),
        (-1, goal([elbow], [(5.0, [5.0], None)])),
        (-1, goal([elbow], [(0.05, [start[elbow] + 0.5], None)])),
        (-1, goal([elbow], [(0.0, [start[elbow] + 0.5], None)])),
        (-3, goal([elbow], [(1.0, [start[elbow]], None)], late)),
    ):
        identity, accepted = client.send(*wrong)
        result = client.result(identity)
        check(accepted and result.status == ABORTED and result.error_code == code, f"{wrong[0]}: {result}")
        check(result.error_string, f"no reason: {result}")
    check(abs(joints()[elbow] - start[elbow]) < 0.01, "a wrong trajectory moves the arm")

    # One that is cancelled on the way.
    identity, _ = client.send(*goal([elbow], [(4.0, [start[elbow] + 0.8], None)]))
    time.sleep(1.0)
    check(client.cancel(identity).return_code == 0, "a trajectory cannot be cancelled")
    check(client.result(identity).status == CANCELED, "a trajectory is not cancelled")
    rest = joints()[elbow]
    time.sleep(0.3)
    check(abs(joints()[elbow] - rest) < 1e-4, "it moves after it was cancelled")
    check(0.05 < rest - start[elbow] < 0.6, f"it stopped at {rest}")

    lift = "torso_lift_joint"
    height = here[lift] + (0.02 if here[lift] < 0.1 else -0.02)
    identity, _ = torso.send(*goal([lift], [(3.0, [height], None)]))
    result = torso.result(identity)
    check(result.status == SUCCEEDED, f"the torso: {result}")
    check(abs(joints()[lift] - height) < 0.002, "the torso is elsewhere")

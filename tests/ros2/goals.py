"""Drives the robot that `planwright robot --ros2` is, as clients of ROS 2's actions do, and judges what comes of it."""

import random
import signal
import subprocess
import sys
import time
import types
import uuid
from dataclasses import dataclass

from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import array, uint8
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

import messages as ros
import trajectories
from actions import (
    FOLLOW,
    GRIPPER,
    NAVIGATE,
    POINT,
    CancelRequest,
    CancelResponse,
    GoalInfo,
    GoalStatusArray,
    PointStamped,
    PoseStamped,
    RequestHeader,
    navigation_result,
)
from checks import check, timely

PROGRAM, DISTRIBUTION, REPETITIONS = sys.argv[1], sys.argv[2], int(sys.argv[3])


def message_of_bytes(name, length):
    """A message of a name that is nothing but bytes."""
    body = {"__annotations__": {"bytes": array[uint8, length]}}
    kind = types.new_class("Garbage", (IdlStruct,), {"typename": name}, lambda all: all.update(body))
    return dataclass(kind)


class Client:
    """A client of an action."""

    def __init__(self, participant, name, kinds):
        self.kinds = kinds
        self.number = 2**32  # In both halves, which implementations order differently.
        inner = f"{name}/_action/"

        def write(part, kind):
            topic = Topic(participant, f"rq/{inner}{part}Request", kind)
            return DataWriter(participant, topic, qos=ros.reliable(100))

        def read(topic, kind, qos=ros.reliable(100)):
            return DataReader(participant, Topic(participant, topic, kind), qos=qos)

        self.send_goal = write("send_goal", kinds["send_goal"])
        self.accepted = read(f"rr/{inner}send_goalReply", kinds["accepted"])
        self.get_result = write("get_result", kinds["get_result"])
        self.results = read(f"rr/{inner}get_resultReply", kinds["result"])
        self.cancel_goal = write("cancel_goal", CancelRequest)
        self.canceled = read(f"rr/{inner}cancel_goalReply", CancelResponse)
        self.feedback = read(f"rt/{inner}feedback", kinds["feedback"])
        self.status = read(f"rt/{inner}status", GoalStatusArray, ros.latched())
        self.guid = list(uuid.uuid4().bytes[:8])
        end = time.monotonic() + 20
        while time.monotonic() < end and not self.is_matched():
            time.sleep(0.02)
        check(self.is_matched(), f"nobody serves {name}: {self.unmatched()}")

    def unmatched(self):
        ends = {
            "send_goal": self.send_goal.get_matched_subscriptions(),
            "get_result": self.get_result.get_matched_subscriptions(),
            "cancel_goal": self.cancel_goal.get_matched_subscriptions(),
            "accepted": self.accepted.get_matched_publications(),
            "results": self.results.get_matched_publications(),
            "canceled": self.canceled.get_matched_publications(),
            "feedback": self.feedback.get_matched_publications(),
            "status": self.status.get_matched_publications(),
        }
        return [end for end, matched in ends.items() if not matched]

    def is_matched(self):
        return not self.unmatched()

    def ask(self, writer, reader, kind, *fields, seconds=10):
        """The reply to a request; those to others are passed over."""
        header = self.request(writer, kind, *fields)
        return self.reply(reader, header, seconds)

    def request(self, writer, kind, *fields):
        self.number += 1
        header = RequestHeader(self.guid, self.number % 2**32, self.number // 2**32)
        writer.write(kind(header, *fields))
        return header

    def reply(self, reader, header, seconds=10):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for message in reader.take(100):
                mine = list(message.request.guid) == list(header.guid)
                if mine and (message.request.low, message.request.high) == (header.low, header.high):
                    return message
            time.sleep(0.001)
        return None

    def send(self, *goal, identity=None):
        """The identity of a goal, and whether it is accepted."""
        identity = identity or list(uuid.uuid4().bytes)
        reply = self.ask(self.send_goal, self.accepted, self.kinds["send_goal"], identity, *goal)
        check(reply is not None, "a goal is not answered")
        return identity, reply.accepted

    def result(self, identity, seconds=60):
        kind = self.kinds["get_result"]
        reply = self.ask(self.get_result, self.results, kind, identity, seconds=seconds)
        check(reply is not None, "no result comes")
        return reply

    def cancel(self, identity, stamp=ros.Time(0, 0)):
        reply = self.ask(self.cancel_goal, self.canceled, CancelRequest, GoalInfo(identity, stamp))
        check(reply is not None, "a request to cancel is not answered")
        return reply


def pose(x, y, z=0.0, w=1.0, frame="map"):
    place = ros.Pose(ros.Point(float(x), float(y), 0.0), ros.Quaternion(0.0, 0.0, float(z), float(w)))
    return PoseStamped(ros.Header(ros.Time(0, 0), frame), place), ""


ACCEPTED, EXECUTING, CANCELING, SUCCEEDED, CANCELED, ABORTED = range(1, 7)

robot = subprocess.Popen(
    [PROGRAM, "robot", f"--ros2={DISTRIBUTION}"], stdout=subprocess.PIPE, text=True
)
try:
    participant = DomainParticipant(77)
    joints = DataReader(
        participant,
        Topic(participant, "rt/joint_states", ros.JointState),
        qos=ros.reliable(1000),
    )
    tf = DataReader(participant, Topic(participant, "rt/tf", ros.TFMessage), qos=ros.reliable(1000))
    drive = Client(participant, "navigate_to_pose", NAVIGATE)
    right = Client(participant, "right_gripper_controller/gripper_cmd", GRIPPER)
    head = Client(participant, "head_controller/point_head_action", POINT)
    arm = Client(participant, "right_arm_controller/follow_joint_trajectory", FOLLOW)
    torso = Client(participant, "torso_controller/follow_joint_trajectory", FOLLOW)

    def track(seconds):
        """Where the base is heard for some time: time (s), x, y."""
        places = []
        end = time.monotonic() + seconds
        while time.monotonic() < end or not places:
            for message in tf.take(1000):
                frame = message.transforms[0]
                check(frame.child_frame_id == "base_footprint", "the base is not the first frame")
                at = frame.transform.translation
                places.append((frame.header.stamp.nanoseconds() / 1e9, at.x, at.y))
            time.sleep(0.002)
        return places

    def base():
        """Where the base was last heard."""
        return track(0.05)[-1][1:]

    stops = []
    for repetition in range(REPETITIONS):
        # A goal that is reached, with what is told meanwhile.
        x_wanted = -0.3 + 0.01 * (repetition % 20)
        goal, accepted = drive.send(*pose(x_wanted, 0.6))
        check(accepted, "a goal is rejected")
        drive.feedback.take(1000)
        result = drive.result(goal)
        check(result.status == SUCCEEDED, f"the goal is not reached: {result}")
        told = [m for m in drive.feedback.take(1000) if list(m.goal_id) == goal]
        remaining = [message.distance_remaining for message in told]
        timely(len(told) >= 3 and remaining[-1] < remaining[0], f"feedback: {remaining}")
        x, y = base()
        check(abs(x - x_wanted) < 0.01 and abs(y - 0.6) < 0.01, f"the base is at {x}, {y}")
        # Asked again, the result is the same; so is that of a goal that nobody had, which is unknown.
        check(drive.result(goal).status == SUCCEEDED, "the result is not kept")
        check(drive.result(list(uuid.uuid4().bytes)).status == 0, "an unknown goal has a state")

        # A goal that cannot be reached, with the explanation where the distribution has room for it.
        goal, accepted = drive.send(*pose(-1.0, 1.5))
        result = drive.result(goal)
        check(accepted and result.status == ABORTED, f"a goal in the furniture: {result}")
        if "error_msg" in navigation_result:
            check("island" in result.error_msg, f"no explanation: {result.error_msg}")
        if "error_code" in navigation_result:
            check(result.error_code != 0, "no error code")

        # A goal that is cancelled on the way.
        goal, accepted = drive.send(*pose(0.5, -1.0, 1.0, 0.0))
        pending = drive.request(drive.get_result, NAVIGATE["get_result"], goal)
        # Until it is under way: where it has to turn first, that takes a while.
        begin, *_, last = track(0.1)
        deadline = time.monotonic() + 20
        while abs(last[1] - begin[1]) + abs(last[2] - begin[2]) < 0.2:
            check(time.monotonic() < deadline, "the robot does not move")
            last = track(0.05)[-1]
        asked = time.time()
        canceling = drive.cancel(goal)
        check(canceling.return_code == 0 and len(canceling.goals_canceling) == 1, f"{canceling}")
        result = drive.reply(drive.results, pending)
        ended = time.time()
        check(result is not None and result.status == CANCELED, f"the goal is not cancelled: {result}")
        places = track(0.8)
        rest = places[-1]
        moving = [at for at, x, y in places if abs(x - rest[1]) + abs(y - rest[2]) > 1e-4]
        still = max(moving, default=asked)
        check(abs(rest[1] - begin[1]) + abs(rest[2] - begin[2]) < 1.0, "the robot does not stop")
        stops.append((still - asked, ended - asked))
        timely(still <= ended + 0.05, "the robot moves after the goal has ended")
        check(drive.cancel(goal).return_code == 3, "a goal that has ended is cancelled")
        check(drive.cancel(list(uuid.uuid4().bytes)).return_code == 2, "an unknown goal is cancelled")

    for what, times in zip(("the robot stands", "the end is told"), zip(*stops)):
        print(f"cancelled: {what} after {1e3 * max(times):.0f} ms at most ({len(times)} goals)")

    # What is no goal is rejected; what names a strange frame has the reason in its result.
    for wrong in (pose(float("nan"), 0), pose(float("inf"), 0), pose(0, 0, 0, 0)):
        check(not drive.send(*wrong)[1], f"{wrong} is accepted")
    goal, accepted = drive.send(*pose(0, 0, frame="odometry"))
    check(accepted and drive.result(goal).status == ABORTED, "a strange frame is understood")
    again, accepted = drive.send(*pose(0, 0), identity=goal)
    check(not accepted, "two goals have one identity")

    # A new goal takes the place of the old one.
    first, accepted = drive.send(*pose(0.5, -1.0, 1.0, 0.0))
    time.sleep(0.5)
    second, accepted = drive.send(*pose(-0.3, 0.6))
    check(accepted, "a second goal is rejected")
    check(drive.result(first).status == ABORTED, "the first goal is not given up")
    check(drive.result(second).status == SUCCEEDED, "the second goal is not reached")

    # A goal that waits for another action is cancelled before it begins.
    first, _ = drive.send(*pose(0.2, 0.6))
    waiting, accepted = right.send(0.05, 0.0)
    check(accepted and right.cancel(waiting).return_code == 0, "a goal that waits")
    check(right.result(waiting).status == CANCELED, "a goal that waits is not cancelled")
    check(drive.result(first).status == SUCCEEDED, "the other goal is hit, too")

    for gap in (0.08, 0.03):
        goal, accepted = right.send(gap, 50.0)
        result = right.result(goal)
        check(accepted and result.status == SUCCEEDED, f"the hand: {result}")
        check(result.reached_goal and abs(result.position - gap) < 0.003, f"the hand: {result}")
    check(not right.send(float("nan"), 0.0)[1] and not right.send(-1.0, 0.0)[1], "a gap that cannot be")

    target = PointStamped(ros.Header(ros.Time(0, 0), "base_footprint"), ros.Point(1.0, 0.5, 0.8))
    look = (target, ros.Vector3(1.0, 0.0, 0.0), "", ros.Duration(0, 0), 0.0)
    goal, accepted = head.send(*look)
    check(accepted and head.result(goal).status == SUCCEEDED, "the head does not turn")
    pan = joints.take(1000)[-1]
    pan = pan.position[list(pan.name).index("head_pan_joint")]
    check(0.3 < pan < 0.6, f"the head looks elsewhere: {pan}")

    def heard():
        """Where the joints were last heard."""
        joints.take(1000)
        end = time.monotonic() + 5
        while time.monotonic() < end:
            time.sleep(0.03)
            for message in joints.take(1000)[-1:]:
                return dict(zip(message.name, message.position))
        check(False, "no joints are heard")

    trajectories.try_arm(arm, torso, heard)

    # What is no request hurts nobody: too short, without sense, with lengths that are lies.
    strange = DomainParticipant(77)
    random.seed(5)
    for service, kind in (
        ("send_goal", NAVIGATE["send_goal"]),
        ("get_result", NAVIGATE["get_result"]),
        ("cancel_goal", CancelRequest),
    ):
        for length in (1, 8, 15, 16, 17, 40, 200, 60000):
            garbage = message_of_bytes(kind.__idl_typename__.replace(".", "::"), length)
            topic = Topic(strange, f"rq/navigate_to_pose/_action/{service}Request", garbage)
            writer = DataWriter(strange, topic, qos=ros.reliable(10))
            deadline = time.monotonic() + 10
            while not writer.get_matched_subscriptions() and time.monotonic() < deadline:
                time.sleep(0.005)
            check(writer.get_matched_subscriptions(), f"garbage of {length} bytes finds nobody")
            for bytes in (random.randbytes(length), b"\xff" * length, b"\0" * length):
                writer.write(garbage(list(bytes)))
    time.sleep(0.5)
    goal, accepted = drive.send(*pose(-0.2, 0.6))
    check(accepted and drive.result(goal).status == SUCCEEDED, "after garbage, a goal is not reached")

    # The states are told, and of all goals the last one's is the last.
    statuses = drive.status.take(1000)[-1].status_list
    check({status.status for status in statuses} <= {SUCCEEDED, CANCELED, ABORTED}, "states")

    check(robot.poll() is None, "the robot has died")
finally:
    robot.send_signal(signal.SIGINT)
    robot.wait(timeout=20)
check(robot.returncode == 0, f"Ctrl-C ends it with {robot.returncode}")
print(f"ROS 2 ({DISTRIBUTION}): all goals end as they should")

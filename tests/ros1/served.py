"""Sends goals of ROS 2 to a base of ROS 1 through the bridge, as a client that knows all of the protocol: results that are asked for again, ways to
cancel, identities twice, goals that are none. Plans do not ask for all of that. The messages are those of the bridge's own table."""

import os
import signal
import sys
import time
import uuid

from programs import DOMAIN, LOOPBACK, Program, bridge, wait_for_master

os.environ["CYCLONEDDS_URI"] = LOOPBACK
sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../src/ros/ros1"))

from checks import check
from dds import Node, Reader, Writer, latched, reliable
from layouts import Layouts

SUCCEEDED, CANCELED, ABORTED = 4, 5, 6
LAYOUTS = Layouts("jazzy")
ACTION = "nav2_msgs/action/NavigateToPose"
KINDS = LAYOUTS.action(ACTION)
CANCEL, CANCELS = LAYOUTS.service("action_msgs/srv/CancelGoal")
UUID, TIME = LAYOUTS.message("unique_identifier_msgs/msg/UUID"), LAYOUTS.message("builtin_interfaces/msg/Time")
ALL, ALWAYS = [0] * 16, TIME(0, 0)

wait_for_master()
carrying = bridge("--robot", "ros1")
base = Program([sys.executable, "tests/ros1/base.py"])
carrying.expect("is served in ROS 2")
node = Node(DOMAIN, True)
identity, number = list(uuid.uuid4().bytes[:8]), 2**32


def spin(seconds):
    end = time.monotonic() + seconds
    node.run(lambda: time.monotonic() < end)


def hear(topic, kind, quality=reliable(100)):
    heard = []
    Reader(node, topic, kind, quality, lambda message, _: heard.append(message))
    return heard


def service(part, request, reply):
    inner = f"navigate_to_pose/_action/{part}"
    return Writer(node, f"rq/{inner}Request", request, reliable(100)), request, hear(f"rr/{inner}Reply", reply)


GOALS = service("send_goal", KINDS["SendGoal_Request"], KINDS["SendGoal_Response"])
RESULTS = service("get_result", KINDS["GetResult_Request"], KINDS["GetResult_Response"])
CANCELLING = service("cancel_goal", CANCEL, CANCELS)
feedback = hear("rt/navigate_to_pose/_action/feedback", KINDS["FeedbackMessage"])
states = hear("rt/navigate_to_pose/_action/status", LAYOUTS.message("action_msgs/msg/GoalStatusArray"), latched())


def ask(asked, *fields):
    """The reply to a request."""
    global number
    number += 1
    writer, kind, replies = asked
    writer.write(kind(LAYOUTS.message("RequestHeader")(identity, number % 2**32, number // 2**32), *fields))
    end = time.monotonic() + 20
    while time.monotonic() < end:
        spin(0.01)
        for reply in replies:
            if list(reply.request.identity) == identity and reply.request.low + reply.request.high * 2**32 == number:
                return reply
    check(False, f"a request {kind.__name__} is not answered")


def send(x, w=1.0, goal=None):
    """The identity of a goal, and whether it is accepted."""
    goal = goal or list(uuid.uuid4().bytes)
    message = LAYOUTS.message
    turn = message("geometry_msgs/msg/Quaternion")(0.0, 0.0, 0.0, w)
    pose = message("geometry_msgs/msg/Pose")(message("geometry_msgs/msg/Point")(x, 0.6, 0.0), turn)
    stamped = message("geometry_msgs/msg/PoseStamped")(message("std_msgs/msg/Header")(TIME(0, 0), "map"), pose)
    return goal, ask(GOALS, UUID(goal), message(f"{ACTION}_Goal")(stamped, "")).accepted


def result(goal):
    reply = ask(RESULTS, UUID(goal))
    return reply.status, reply.result.error_msg


def cancel(goal, stamp=ALWAYS):
    reply = ask(CANCELLING, LAYOUTS.message("action_msgs/msg/GoalInfo")(UUID(goal), stamp))
    return reply.return_code, len(reply.goals_canceling)


def stranger():
    return list(uuid.uuid4().bytes)


spin(2)
goal, accepted = send(-0.3)
check(accepted and result(goal) == (SUCCEEDED, "there"), "a goal is not reached")
rest = [message.feedback.distance_remaining for message in feedback]
check(len(rest) > 5 and rest[0] > 0.2 and rest[-1] < 0.05, f"feedback: {rest}")
check(result(goal)[0] == SUCCEEDED and result(stranger())[0] == 0, "a result is not kept, or one that nobody had is")
check(not send(0.0, goal=goal)[1], "two goals have one identity")
check(not send(float("nan"))[1] and not send(0.0, w=0.0)[1], "what is no goal is accepted")

goal, _ = send(0.3)
spin(0.4)
asked = time.monotonic()
check(cancel(goal) == (0, 1) and result(goal)[0] == CANCELED, "a goal is not cancelled")
print(f"cancelled: the end is told after {1e3 * (time.monotonic() - asked):.0f} ms")
check(cancel(goal) == (3, 0) and cancel(stranger()) == (2, 0), "what has ended or never was is cancelled")
first, _ = send(0.3)
spin(0.3)
second, _ = send(-0.3)
check(result(first)[0] == ABORTED and result(second)[0] == SUCCEEDED, "a new goal does not take the place of the old one")
goal, _ = send(0.3)
check(cancel(ALL) == (0, 1) and result(goal)[0] == CANCELED, "all goals are not cancelled")
goal, _ = send(0.3)
now = int(time.time())
check(cancel(ALL, TIME(now - 60, 0)) == (0, 0), "goals after a time are cancelled")
check(cancel(ALL, TIME(now + 1, 0)) == (0, 1) and result(goal)[0] == CANCELED, "goals before a time are not cancelled")
told = [status.status for status in states[-1].status_list]
check(told == [SUCCEEDED, CANCELED, ABORTED, SUCCEEDED, CANCELED, CANCELED], f"states: {told}")

# Of a server that is gone, nothing is left in ROS 2.
send(0.3)
base.end(signal.SIGKILL)
end = time.monotonic() + 10
while GOALS[0].readers():
    check(time.monotonic() < end, "the action is still served")
    spin(0.02)
print("ROS 1: goals of ROS 2 end as they should")

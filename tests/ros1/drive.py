"""Drives the robot that `planwright robot --ros2` is by actionlib of ROS 1, as programs for `move_base` do, and judges what comes of it."""

import random
import signal
import sys
import time

from programs import Program, bridge, eventually, wait_for_master

import actionlib
import rospy
import tf2_ros
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped
from move_base_msgs.msg import MoveBaseAction, MoveBaseActionResult, MoveBaseGoal
from tf2_msgs.msg import TFMessage

from checks import check, timely

PROGRAM = sys.argv[1]
NAMES = {getattr(GoalStatus, name): name for name in dir(GoalStatus) if name.isupper()}
FAR = (0.5, -1.0, 1.0, 0.0)

wait_for_master()
rospy.init_node("drive")
carrying = bridge()
places = []


def hear(message):
    for transform in message.transforms:
        if transform.child_frame_id == "base_footprint":
            places.append((time.monotonic(), transform.transform.translation.x, transform.transform.translation.y))


rospy.Subscriber("/tf", TFMessage, hear, queue_size=1000)
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
simple = actionlib.SimpleActionClient("move_base", MoveBaseAction)
# A client that can have several goals at once.
client = actionlib.ActionClient("move_base", MoveBaseAction)
check(simple.wait_for_server(rospy.Duration(20)) and client.wait_for_server(rospy.Duration(20)), "nobody serves move_base in ROS 1")


def goal(x, y, z=0.0, w=1.0, frame="map"):
    wanted = MoveBaseGoal()
    wanted.target_pose.header.frame_id = frame
    pose = wanted.target_pose.pose
    pose.position.x, pose.position.y, pose.orientation.z, pose.orientation.w = x, y, z, w
    return wanted


def drive(wanted, seconds=40):
    """The state in which a goal has ended, its text, and after what time, by the simple client."""
    begin = time.monotonic()
    state = simple.send_goal_and_wait(wanted, rospy.Duration(seconds))
    return NAMES[state], simple.get_goal_status_text(), time.monotonic() - begin


def ended(handle, seconds=40):
    """The state in which a goal of the other client has ended, and its text."""
    done = lambda: handle.get_comm_state() == actionlib.CommState.DONE
    end = time.monotonic() + seconds
    while not done():
        state = actionlib.CommState.to_string(handle.get_comm_state())
        check(time.monotonic() < end, f"a goal does not end, and is {state}, last {NAMES[handle.get_goal_status()]}")
        time.sleep(0.01)
    return NAMES[handle.get_terminal_state()], handle.get_goal_status_text()


def base():
    at = buffer.lookup_transform("map", "base_footprint", rospy.Time(0)).transform.translation
    return at.x, at.y


def is_under_way(begin):
    return abs(places[-1][1] - begin[0]) + abs(places[-1][2] - begin[1]) > 0.2


def moves(begin, seconds=20):
    """Waits until the robot is under way."""
    eventually(lambda: is_under_way(begin), "the robot does not move", seconds)


def send_off(wanted):
    """Sends a goal until the robot is under way: as long as one that was killed is not known to be gone, there are two of them, and the
    bridge refuses."""
    since = time.monotonic()
    while True:
        begin = base()
        simple.send_goal(wanted)
        while not simple.wait_for_result(rospy.Duration(0.05)):
            if is_under_way(begin):
                return
        text = simple.get_goal_status_text()
        check("2 nodes serve" in text, f"a goal does not begin: {NAMES[simple.get_state()]}, {text}")
        check(time.monotonic() - since < 100, f"when the robot has returned, goals do not begin: {text}")


def last_motion(since):
    """When the robot has moved last, by a clock that never jumps."""
    time.sleep(0.8)
    heard = [place for place in places if place[0] >= since]
    rest = heard[-1]
    return max((at for at, x, y in heard if abs(x - rest[1]) + abs(y - rest[2]) > 1e-4), default=since)


# Without a robot, a goal ends soon, and says why; while it waits, it can be cancelled.
state, text, took = drive(goal(0, 0))
check(state == "ABORTED" and "nobody serves /navigate_to_pose" in text, f"without a robot: {state}, {text}")
check(took < 8, f"without a robot, a goal takes {took:.1f} s")
print(f"no robot: {state} after {took:.1f} s: {text}")
handle = client.send_goal(goal(0, 0))
time.sleep(0.5)
handle.cancel()
state, text = ended(handle, 2)
check(state == "RECALLED", f"cancelled while it waits for a robot: {state}, {text}")

robot = Program([PROGRAM, "robot", "--ros2"])
robot.expect("/navigate_to_pose")
eventually(lambda: places, "the base is not heard")

# A goal that is reached, with what is told meanwhile.
told = []
simple.send_goal(goal(-0.3, 0.6), feedback_cb=lambda feedback: told.append(feedback.base_position.pose.position.x))
check(simple.wait_for_result(rospy.Duration(40)), "the goal does not end")
check(NAMES[simple.get_state()] == "SUCCEEDED", f"the goal is not reached: {simple.get_goal_status_text()}")
x, y = base()
print(f"SUCCEEDED {100 * ((x + 0.3) ** 2 + (y - 0.6) ** 2) ** 0.5:.2f} cm from the goal by tf; {len(told)} times feedback")
check(abs(x + 0.3) < 0.05 and abs(y - 0.6) < 0.05, f"the base is at {x}, {y}")
timely(len(told) >= 3 and told[-1] < told[0], f"feedback: {told}")

# A slash before a frame, as old nodes have it, and a goal in the robot's own frame.
check(drive(goal(-0.2, 0.6, frame="/map"))[0] == "SUCCEEDED", "a frame with a slash is not understood")
state, text, _ = drive(goal(0.2, 0.0, frame="base_footprint"))
check(state == "SUCCEEDED" and abs(base()[0]) < 0.05, f"a goal in the robot's frame: {state}, {text}, at {base()}")

# Goals that cannot be reached, with planwright's explanation; what is no goal.
state, text, _ = drive(goal(-1.0, 1.5))
check(state == "ABORTED" and "island" in text, f"a goal in the furniture: {state}, {text}")
print(f"ABORTED: {' '.join(text.split())}")
state, text, _ = drive(goal(0, 0, frame="odometry"))
check(state == "ABORTED" and "odometry" in text, f"a strange frame: {state}, {text}")
nan, infinite = float("nan"), float("inf")
for wrong in (goal(nan, 0), goal(0, infinite), goal(0, 0, 0, 0), goal(0, 0, nan, 1)):
    state, text, _ = drive(wrong)
    check(state == "REJECTED" and ("expected" in text or "quaternion" in text), f"{wrong}: {state}, {text}")
late = goal(0, 0)
late.target_pose.header.stamp = rospy.Time(2**32 - 1, 0)
state, text, _ = drive(late)
check(state == "REJECTED" and "no time" in text, f"a stamp that ROS 2 has not: {state}, {text}")

# A goal that is cancelled on the way: the robot stands when the end is told.
stops = []
for _ in range(3):
    begin = base()
    simple.send_goal(goal(*FAR))
    moves(begin)
    asked = time.monotonic()
    simple.cancel_goal()
    check(simple.wait_for_result(rospy.Duration(10)), "a goal that was cancelled does not end")
    end = time.monotonic()
    check(NAMES[simple.get_state()] == "PREEMPTED", f"cancelled: {NAMES[simple.get_state()]}")
    still = last_motion(asked)
    stops.append((end - asked, still - asked))
    timely(still <= end + 0.05, f"the robot moves {still - end:.2f} s after its goal has ended")
    check(drive(goal(-0.3, 0.6))[0] == "SUCCEEDED", "after a cancelled goal, another one is not reached")
print("cancelled: the end is told after {:.0f} ms, the robot stands after {:.0f} ms at most".format(*(1e3 * max(times) for times in zip(*stops))))

# All goals of before a time are cancelled.
begin = base()
handle = client.send_goal(goal(*FAR))
moves(begin)
client.cancel_goals_at_and_before_time(rospy.Time.now())
check(ended(handle)[0] == "PREEMPTED", "goals of before a time are not cancelled")

# A new goal takes the place of the old one, which ends first; of those that wait, only the newest begins.
first = client.send_goal(goal(*FAR))
time.sleep(0.7)
second, third, fourth = (client.send_goal(goal(x, 0.6)) for x in (0.4, 0.2, -0.2))
states = [ended(handle)[0] for handle in (first, second, third, fourth)]
check(states == ["PREEMPTED", "RECALLED", "RECALLED", "SUCCEEDED"], f"four goals: {states}")
check(abs(base()[0] + 0.2) < 0.05, f"the last of four goals is not where the base is: {base()}")
print(f"four goals: {', '.join(states)}")

# Goals that come and are cancelled at random moments all end, each once. That is judged by the topic of results: Debian's client waits
# for ever for a goal that is cancelled just after its end.
dice = random.Random(3)
results = {}
rospy.Subscriber("/move_base/result", MoveBaseActionResult, lambda m: results.setdefault(m.status.goal_id.id, []).append(m.status))
time.sleep(0.5)
handles = []
for _ in range(40):
    handles.append(client.send_goal(goal(dice.uniform(-0.3, 0.4), dice.uniform(0.5, 0.7))))
    time.sleep(dice.choice((0, 0.002, 0.02, 0.2)))
    if dice.random() < 0.5:
        dice.choice(handles[-2:]).cancel()
        time.sleep(dice.choice((0, 0.05)))
eventually(lambda: len(results) == len(handles), "not all goals at random moments end", 40)
time.sleep(0.5)
check(all(len(ends) == 1 for ends in results.values()), "a goal ends twice")
states = [NAMES[ends[0].status] for ends in results.values()]
aborted = [ends[0].text for ends in results.values() if NAMES[ends[0].status] == "ABORTED"]
check(set(states) <= {"SUCCEEDED", "PREEMPTED", "RECALLED"}, f"goals at random moments: {states}, {aborted}")
print("40 goals at random moments: " + ", ".join(f"{states.count(state)} {state}" for state in sorted(set(states))))
check(drive(goal(-0.3, 0.6))[0] == "SUCCEEDED", "after all these, a goal is not reached")

# A goal of rviz, which has no action.
rviz = rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=1)
eventually(lambda: rviz.get_num_connections(), "nobody hears goals of rviz")
rviz.publish(goal(0.2, 0.6).target_pose)
eventually(lambda: abs(base()[0] - 0.2) < 0.01, "a goal of rviz is not reached", 40)

# A robot that dies on the way, and comes back.
for how in (signal.SIGKILL, signal.SIGINT):
    send_off(goal(*FAR))
    died = time.monotonic()
    robot.end(how)
    check(simple.wait_for_result(rospy.Duration(40)), "when the robot dies, a goal does not end")
    took = time.monotonic() - died
    state, text = NAMES[simple.get_state()], simple.get_goal_status_text()
    print(f"the robot ends by {how.name}: {state} after {took:.1f} s: {text}")
    check(state in ("ABORTED", "PREEMPTED") and text, f"when the robot dies: {state}, {text}")
    robot = Program([PROGRAM, "robot", "--ros2"])
    robot.expect("/navigate_to_pose")
    returned = time.monotonic()
    while drive(goal(-0.3, 0.6))[0] != "SUCCEEDED":
        check(time.monotonic() - returned < 100, "when the robot has returned, goals are not reached")
    check(abs(base()[0] + 0.3) < 0.05, f"the robot that has returned is at {base()}")
    print(f"a robot that has returned reaches a goal within {time.monotonic() - returned:.1f} s")

# Two robots by one name: nobody knows which of them would drive.
other = Program([PROGRAM, "robot", "--ros2"])
other.expect("/navigate_to_pose")
time.sleep(2)
state, text, _ = drive(goal(0, 0.6))
check(state == "ABORTED" and "2 nodes serve" in text, f"two robots: {state}, {text}")
other.end()
eventually(lambda: drive(goal(-0.2, 0.6))[0] == "SUCCEEDED", "after a second robot has gone, goals are not reached", 40)

# A bridge that ends lets the robot stand first, and says so to its clients.
begin = base()
simple.send_goal(goal(*FAR))
moves(begin)
asked = time.monotonic()
carrying.process.send_signal(signal.SIGTERM)
check(simple.wait_for_result(rospy.Duration(5)), "when the bridge ends, a goal does not")
check(NAMES[simple.get_state()] == "PREEMPTED", f"the bridge ends: {NAMES[simple.get_state()]}")
check(carrying.process.wait(10) == 0, "the bridge ends with another status")
watching = bridge()
time.sleep(1.5)
track = [place for place in places if place[0] > time.monotonic() - 0.5]
check(track and all(abs(x - track[0][1]) < 1e-4 for _, x, _ in track), "the robot drives on without the bridge")

# A bridge that has been killed is no hang either: actionlib's client learns nothing, and the next bridge serves the next goal.
watching.end(signal.SIGKILL)
carrying = bridge()
# A goal that is sent before the client has found the new bridge is lost: that is how actionlib is.
eventually(lambda: drive(goal(-0.3, 0.6), 8)[0] == "SUCCEEDED", "after a bridge was killed, goals are not reached", 40)
check(robot.end() == 0, "the robot ends badly")

# Other distributions have other results and other feedback.
for distribution in ("humble", "lyrical"):
    check(carrying.end() == 0, "the bridge ends badly")
    carrying = bridge("--distribution", distribution)
    robot = Program([PROGRAM, "robot", f"--ros2={distribution}"])
    robot.expect("/navigate_to_pose")
    told.clear()
    simple.wait_for_server(rospy.Duration(20))
    simple.send_goal(goal(-0.3, 0.6), feedback_cb=lambda feedback: told.append(feedback.base_position.pose.position.x))
    check(simple.wait_for_result(rospy.Duration(40)), f"{distribution}: the goal does not end")
    check(NAMES[simple.get_state()] == "SUCCEEDED" and told and abs(told[-1]) < 0.4, f"{distribution}: {simple.get_goal_status_text()}")
    state, text, _ = drive(goal(-1.0, 1.5))
    expected = "error code unknown" if distribution == "humble" else "island"
    check(state == "ABORTED" and expected in text, f"{distribution}: {state}, {text}")
    check(robot.end() == 0, f"{distribution}: the robot ends badly")
print("ROS 1: all goals end as they should")

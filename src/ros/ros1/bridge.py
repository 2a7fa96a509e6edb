#!/usr/bin/env python3
"""A bridge between planwright's ROS 2 and ROS 1: topics of a session, and the action that drives the base.

    python3 src/ros/ros1/bridge.py [--robot ros2|ros1] [--domain N] [--distribution NAME] [--clock]
                                   [--move-base NAME] [--navigate-to-pose NAME]

With --robot ros2, the default, planwright is on the side of ROS 2: what a session shows (`planwright --ros2`) is shown to ROS 1, and
clients of `move_base` in ROS 1 drive `planwright robot --ros2`. With --robot ros1, the robot is on the side of ROS 1: plans (`planwright
run FILE --real-robot`) hear it and drive its base. Needs rospy, actionlib and the messages of ROS 1 (Debian's packages), a master,
and `cyclonedds` of PyPI. It runs until Ctrl-C. docs/ros.md says more.

Ends with status 0 after Ctrl-C or SIGTERM, 1 if there is no master or the master has changed, 2 for wrong options."""

import argparse
import http.client
import os
import signal
import sys
import threading
import time
import xmlrpc.client

# The folder of the sources stays as it is.
sys.dont_write_bytecode = True
try:
    import actionlib  # noqa: F401
    import rosgraph
    import rospy
except ImportError as error:
    sys.exit(f"bridge: {error}: Debian has rospy in python3-rospy and actionlib in python3-actionlib, for /usr/bin/python3")
try:
    import cyclonedds  # noqa: F401
except ImportError:
    sys.exit(f"bridge: {sys.executable} has no package cyclonedds: install it where rospy is, such as in a venv with --system-site-packages")

from conversion import MissingMessage
from dds import Node, tell
from layouts import DISTRIBUTIONS, Layouts, TableError
from move_base_server import MoveBaseServer
from navigation_server import NavigationServer
from to_ros1 import ToRos1Topics
from to_ros2 import ToRos2Topics

# The domain where none is asked for, as planwright has it, and the greatest one.
DOMAIN, MAX_DOMAIN = 77, 232
# For how long goals may take to end when the bridge ends, and how often the master is looked for; in seconds.
ENDING, MASTER = 2.5, 2.0


def domain(text):
    if text.strip().isdigit() and int(text) <= MAX_DOMAIN:
        return int(text)
    raise argparse.ArgumentTypeError(f"{text!r} is no domain: a number from 0 to {MAX_DOMAIN} was expected")


def options(arguments):
    """What was asked for, by options and by the variables of ROS 2."""
    parser = argparse.ArgumentParser(description="Carries topics and goals between planwright's ROS 2 and ROS 1.")
    parser.add_argument("--robot", choices=("ros2", "ros1"), default="ros2", help="the side where the robot is [default: ros2]")
    parser.add_argument("--domain", type=domain, help=f"the domain of ROS 2 [default: ROS_DOMAIN_ID, or {DOMAIN}]")
    parser.add_argument(
        "--distribution", choices=DISTRIBUTIONS, default="jazzy", help="whose messages ROS 2 has [default: jazzy; ROS_DISTRO is that of ROS 1]"
    )
    parser.add_argument("--clock", action="store_true", help="carry /clock to ROS 1, too")
    parser.add_argument("--move-base", default="move_base", metavar="NAME", help="the action of ROS 1 [default: move_base]")
    parser.add_argument("--navigate-to-pose", default="navigate_to_pose", metavar="NAME", help="the action of ROS 2 [default: navigate_to_pose]")
    asked = parser.parse_args(arguments)
    asked.navigate_to_pose = asked.navigate_to_pose.strip("/")
    for name in (asked.move_base.strip("/"), asked.navigate_to_pose):
        if not all(part.isidentifier() and part.isascii() for part in name.split("/")):
            parser.error(f"{name!r} is no name of an action")
    if asked.robot == "ros1" and asked.clock:
        parser.error("--clock carries the clock to ROS 1, and with --robot ros1 topics go the other way")
    if asked.domain is None:
        try:
            asked.domain = domain(os.environ.get("ROS_DOMAIN_ID", "").strip() or str(DOMAIN))
        except argparse.ArgumentTypeError as error:
            parser.error(f"ROS_DOMAIN_ID: {error}")
    reach = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").strip() or "LOCALHOST"
    if reach not in ("LOCALHOST", "SUBNET"):
        parser.error(f"ROS_AUTOMATIC_DISCOVERY_RANGE is {reach!r}: known are LOCALHOST and SUBNET")
    asked.only_this_machine = reach == "LOCALHOST" or os.environ.get("ROS_LOCALHOST_ONLY", "").strip() == "1"
    return asked


def run_of_master():
    """What tells a master from the one before it, or None if there is none."""
    master = rosgraph.Master("/planwright_bridge")
    try:
        # A master that roscore has not started has no number of its run.
        return master.getPid(), master.getParam("/run_id") if master.hasParam("/run_id") else None
    except (OSError, rosgraph.MasterException, xmlrpc.client.Error, http.client.HTTPException):
        return None


class MasterWatch(threading.Thread):
    """Looks whether the master is still the one with which the bridge is registered."""

    def __init__(self, run):
        super().__init__(daemon=True)
        self.run_id, self.has_changed, self.ends = run, False, threading.Event()

    def run(self):
        is_there = True
        while not self.ends.wait(MASTER):
            run = run_of_master()
            if (run is not None) != is_there:
                is_there = run is not None
                tell("the master is there" if is_there else "the master does not answer: nobody new can find the bridge in ROS 1")
            self.has_changed |= run is not None and run != self.run_id


def run_node(node, goes_on):
    """Lets the node do its work as long as something says so. Where ROS 1 has ended the bridge, nothing can be published any more."""
    while goes_on():
        try:
            node.run(goes_on)
        except rospy.ROSException:
            if not rospy.core.is_shutdown_requested():
                raise


def main():
    asked = options(rospy.myargv(sys.argv)[1:])
    run = run_of_master()
    if run is None:
        tell(f"no master of ROS 1 answers at {rosgraph.get_master_uri()}: start roscore, or set ROS_MASTER_URI")
        return 1
    wanted_end = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda *_: wanted_end.set())
    rospy.init_node("planwright_bridge", disable_signals=True)
    watch = MasterWatch(run)
    watch.start()
    try:
        layouts = Layouts(asked.distribution)
        node = Node(asked.domain, asked.only_this_machine)
        if asked.robot == "ros2":
            ToRos1Topics(node, layouts, asked.clock)
            server = MoveBaseServer(node, layouts, asked.move_base, asked.navigate_to_pose)
        else:
            ToRos2Topics(node, layouts)
            server = NavigationServer(node, layouts, asked.navigate_to_pose, asked.move_base)
    except (MissingMessage, TableError) as error:
        tell(str(error))
        return 1
    sides = {"ros1": "ROS 1", "ros2": "ROS 2"}
    tell(f"ROS 2 ({asked.distribution}, domain {asked.domain}), ROS 1 ({rosgraph.get_master_uri()}); the robot is in {sides[asked.robot]}")
    try:
        run_node(node, lambda: not (wanted_end.is_set() or watch.has_changed or rospy.core.is_shutdown_requested()))
    finally:
        server.stop()
        end = time.monotonic() + ENDING
        run_node(node, lambda: not server.is_idle() and time.monotonic() < end)
        if not server.is_idle():
            tell(f"a goal has not ended within {ENDING} s: THE ROBOT MAY STILL MOVE")
        watch.ends.set()
    if watch.has_changed:
        tell("another master has taken the place of the one before, and does not know the bridge: start it again")
    elif rospy.core.is_shutdown_requested() and not wanted_end.is_set():
        tell("ROS 1 has ended the bridge: another node of its name has come, or somebody has asked for that")
    time.sleep(0.2)  # What was told last is on its way.
    rospy.signal_shutdown("the bridge ends")
    return 0 if wanted_end.is_set() else 1


if __name__ == "__main__":
    sys.exit(main())

"""A robot of ROS 1 for the checks: a base that `move_base` drives, a simple action server of actionlib, with tf and joint states.

    base.py [honest|rejects|aborts|beside|preempts|dies|mute]

It prints each goal and how it ended. Its arms hang still. `rejects` tells so by its status before it tells the result; `beside` reports
success 0.2 m from the goal; `dies` ends by itself on the way; `mute` arrives, and says so only by its status."""

import math
import os
import sys
import threading
import time
import xml.etree.ElementTree as xml

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import TransformStamped
from move_base_msgs.msg import MoveBaseAction, MoveBaseFeedback
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

MANNER = sys.argv[1] if len(sys.argv) > 1 else "honest"
# How fast it drives, in metres a second, and how often it tells where it is, a second.
SPEED, RATE = 0.3, 50


class Base:
    """Where the base is, and what it does with goals."""

    def __init__(self):
        self.x, self.y = 0.0, 0.6
        described = xml.parse("world/pr2.urdf").getroot()
        joints = [joint for joint in described.iter("joint") if joint.get("type") not in (None, "fixed")]
        self.joints = {joint.get("name"): middle(joint) for joint in joints}
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self.states = rospy.Publisher("/joint_states", JointState, queue_size=10)
        self.still = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        # As old nodes write it: with a slash.
        self.still.publish(TFMessage([self.frame("/map", "/odom_combined", 0.0, 0.0)]))
        threading.Thread(target=self.tell, daemon=True).start()
        kind = actionlib.ActionServer if MANNER == "rejects" else actionlib.SimpleActionServer
        self.server = kind("move_base", MoveBaseAction, self.reject if MANNER == "rejects" else self.drive, auto_start=False)
        self.server.start()

    def frame(self, parent, child, x, y):
        transform = TransformStamped()
        transform.header.stamp, transform.header.frame_id, transform.child_frame_id = rospy.Time.now(), parent, child
        transform.transform.translation.x, transform.transform.translation.y = x, y
        transform.transform.rotation.w = 1.0
        return transform

    def tell(self):
        while not rospy.is_shutdown():
            self.tf.publish(TFMessage([self.frame("odom_combined", "base_footprint", self.x, self.y)]))
            states = JointState()
            states.header.stamp = rospy.Time.now()
            states.name, states.position = list(self.joints), list(self.joints.values())
            states.velocity = [0.0] * len(self.joints)
            self.states.publish(states)
            time.sleep(1 / RATE)

    def reject(self, handle):
        print("goal, rejected", flush=True)
        status = handle.status_tracker.status
        with self.server.lock:
            status.status, status.text = GoalStatus.REJECTED, "not today"
            self.server.publish_status()
            time.sleep(0.3)
            self.server.publish_result(status, handle.get_default_result())

    def drive(self, goal):
        print("goal", flush=True)
        wanted = goal.target_pose.pose.position
        x, y = wanted.x + (0.2 if MANNER == "beside" else 0.0), wanted.y
        begin = time.monotonic()
        while math.hypot(x - self.x, y - self.y) > 1e-6:
            rest = math.hypot(x - self.x, y - self.y)
            step = min(1.0, SPEED / RATE / rest)
            self.x, self.y = self.x + step * (x - self.x), self.y + step * (y - self.y)
            feedback = MoveBaseFeedback()
            feedback.base_position.header.frame_id = "map"
            feedback.base_position.pose.position.x, feedback.base_position.pose.position.y = self.x, self.y
            self.server.publish_feedback(feedback)
            time.sleep(1 / RATE)
            under_way = time.monotonic() - begin > 0.2
            if MANNER == "dies" and under_way:
                os._exit(1)
            if self.server.is_preempt_requested() or (MANNER == "preempts" and under_way):
                print(f"preempted after {time.monotonic() - begin:.2f} s", flush=True)
                self.server.set_preempted()
                return
            if MANNER == "aborts" and under_way:
                self.server.set_aborted(text="the wheels are stuck")
                return
        print("there", flush=True)
        if MANNER == "mute":
            self.server.action_server.result_pub.publish = lambda _: None
        self.server.set_succeeded(text="there")


def middle(joint):
    """A position within the limits of a joint."""
    limit = joint.find("limit")
    lower, upper = (float(limit.get(end, 0)) for end in ("lower", "upper")) if limit is not None else (0.0, 0.0)
    return min(max(0.0, lower), upper) if lower < upper else 0.0


rospy.init_node("base")
BASE = Base()
print("serves", flush=True)
rospy.spin()

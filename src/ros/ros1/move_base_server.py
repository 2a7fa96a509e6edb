"""The action `move_base` of ROS 1, before a robot that is driven by `navigate_to_pose` of ROS 2.

What a new goal does to the one before is what actionlib's simple server does: the one under way is cancelled and the new one
begins when that has ended; one that still waits is recalled. An end is told only when the robot's own action has ended."""

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus

from action_client import ActionClient
from conversion import GarbledMessage, ToRos1, ToRos2, ros1_class, wrong_pose
from dds import tell

ACTION = "nav2_msgs/action/NavigateToPose"


class Drive:
    """A goal of ROS 1 that the robot has, or that waits for its turn."""

    def __init__(self, server, handle):
        self.server, self.handle = server, handle
        self.fields = server.goal(handle.get_goal().target_pose)
        self.goal = None
        self.is_superseded = False

    def stamp(self):
        return self.handle.get_goal_id().stamp

    def state(self):
        return self.handle.get_goal_status().status

    def begin(self):
        self.goal = self.server.client.send(self.fields, self)

    def cancel(self):
        self.server.client.cancel(self.goal)

    def accepted(self):
        self.handle.set_accepted("the robot has accepted the goal")

    def feedback(self, feedback):
        message = self.server.feedback_kind()
        message.base_position = self.server.to_ros1(feedback.current_pose)
        self.handle.publish_feedback(message)

    def ended(self, end, result, text):
        try:
            self.report(end, result, text)
        finally:
            self.server.over(self)

    def report(self, end, result, text):
        if result is not None and end == "aborted":
            text = text or f"the robot has aborted the goal (error code {getattr(result, 'error_code', 'unknown')})"
        if end == "rejected":
            self.handle.set_rejected(text=text)
        elif end == "canceled":
            is_waiting = self.state() in (GoalStatus.PENDING, GoalStatus.RECALLING)
            if self.state() == GoalStatus.ACTIVE and not self.is_superseded:
                text = text or "the goal was cancelled in ROS 2, by someone else"
            by = "by a newer goal" if self.is_superseded else "on request"
            # From those that wait, it makes recalled goals; from others, preempted ones.
            self.handle.set_canceled(text=text or (f"cancelled {by}" if is_waiting else f"cancelled {by}; the robot stands"))
        else:
            if self.state() in (GoalStatus.PENDING, GoalStatus.RECALLING):
                self.handle.set_accepted()
            if end == "succeeded":
                self.handle.set_succeeded(text=text or "the robot is there")
            else:
                self.handle.set_aborted(text=text)


class MoveBaseServer:
    """Serves `move_base`, and the topic `move_base_simple/goal`, which rviz's tool *2D Nav Goal* publishes."""

    def __init__(self, node, layouts, name, navigation):
        self.node, self.layouts, self.name = node, layouts, name
        self.client = ActionClient(node, layouts, navigation, ACTION)
        self.goal_kind = layouts.message(f"{ACTION}_Goal")
        self.to_ros2 = ToRos2(layouts, "geometry_msgs/msg/PoseStamped")
        pose_stamped = ros1_class("geometry_msgs/PoseStamped")
        self.to_ros1 = ToRos1.of(pose_stamped)
        self.feedback_kind = ros1_class("move_base_msgs/MoveBaseFeedback")
        self.current = self.next = None
        later = lambda deed: lambda *arguments: node.call(deed, *arguments)
        kind = ros1_class("move_base_msgs/MoveBaseAction")
        self.server = actionlib.ActionServer(name, kind, later(self.come), later(self.cancel), auto_start=False)
        self.server.start()
        goal = ros1_class("move_base_msgs/MoveBaseActionGoal")
        self.simple = rospy.Publisher(f"{name}/goal", goal, queue_size=10)
        rospy.Subscriber(f"{name}_simple/goal", pose_stamped, self.come_simply, queue_size=10)

    def goal(self, pose):
        return self.goal_kind(self.to_ros2(pose), "")

    def come_simply(self, pose):
        message = self.simple.data_class()
        message.header.stamp = message.goal_id.stamp = rospy.Time.now()
        message.goal_id.id = f"{self.name}_simple-{message.goal_id.stamp}"
        message.goal.target_pose = pose
        self.simple.publish(message)

    def come(self, handle):
        """A client has sent a goal."""
        wrong = wrong_pose(handle.get_goal().target_pose.pose)
        if wrong is not None:
            handle.set_rejected(text=wrong)
            return
        try:
            drive = Drive(self, handle)
        except GarbledMessage as error:
            handle.set_rejected(text=str(error))
            return
        before = [known for known in (self.current, self.next) if known is not None]
        if any(known.stamp() > drive.stamp() for known in before):
            handle.set_canceled(text="a newer goal had come before this one")
            return
        if self.next is not None:
            self.next.handle.set_canceled(text="a newer goal has come before this one began")
            self.next = None
        if self.current is None:
            self.current = drive
            drive.begin()
        else:
            self.next = drive
            self.current.is_superseded = True
            self.current.cancel()

    def cancel(self, handle):
        """A client wants a goal to end."""
        if self.next is not None and self.next.handle == handle:
            self.next = None
            handle.set_canceled(text="cancelled before it began")
        elif self.current is not None and self.current.handle == handle:
            self.current.is_superseded = False
            self.current.cancel()

    def over(self, drive):
        """A goal has ended."""
        if drive is self.current:
            self.current, self.next = self.next, None
            if self.current is not None:
                self.current.begin()

    def stop(self):
        """Lets all goals end, since the bridge ends."""
        if self.next is not None:
            self.cancel(self.next.handle)
        if self.current is not None:
            tell(f"the goal of /{self.name} is cancelled")
            self.current.cancel()

    def is_idle(self):
        return self.current is None

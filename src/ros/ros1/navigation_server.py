"""The action `navigate_to_pose` of ROS 2, before a robot that is driven by `move_base` of ROS 1.

It is served only while somebody serves `move_base`, so that a plan learns by itself that nobody is there, or that the server is gone."""

import math
import time

import actionlib
from actionlib import CommState
from actionlib_msgs.msg import GoalID, GoalStatus

from action_server import ABORTED, ACCEPTED, CANCELED, EXECUTING, SUCCEEDED, ActionServer
from conversion import GarbledMessage, ToRos1, ToRos2, ros1_class, wrong_pose
from dds import tell

ACTION = "nav2_msgs/action/NavigateToPose"
# nav2's number for failures that have none of their own.
UNKNOWN_ERROR = 9000
# For how long a goal that waits in ROS 1 may still turn out to be rejected before it counts as accepted, in seconds.
PENDING = 0.5
# How long ROS 1 may take to notice a goal.
ACKNOWLEDGED = 3.0
# With these, a goal has ended.
OVER = {GoalStatus.SUCCEEDED, GoalStatus.PREEMPTED, GoalStatus.RECALLED, GoalStatus.ABORTED, GoalStatus.REJECTED}
ENDS = {GoalStatus.SUCCEEDED: SUCCEEDED, GoalStatus.PREEMPTED: CANCELED, GoalStatus.RECALLED: CANCELED}


class Errand:
    """A goal of ROS 2 on its way through ROS 1."""

    def __init__(self, goal):
        self.goal, self.handle = goal, None
        self.since = time.monotonic()
        self.is_cancelled = False


class NavigationServer:
    """Serves `navigate_to_pose`."""

    def __init__(self, node, layouts, name, move_base):
        self.node, self.layouts, self.name, self.move_base = node, layouts, name, move_base
        self.results = layouts.message(f"{ACTION}_Result")
        self.to_ros1 = ToRos1.of(ros1_class("geometry_msgs/PoseStamped"))
        self.to_ros2 = ToRos2(layouts, "geometry_msgs/msg/PoseStamped")
        self.goal_kind = ros1_class("move_base_msgs/MoveBaseGoal")
        self.client = actionlib.ActionClient(move_base, ros1_class("move_base_msgs/MoveBaseAction"))
        self.server, self.errands = None, []
        node.every_tick(self.tick)

    def is_there(self):
        """Whether somebody serves the action in ROS 1, with all that a goal needs."""
        client = self.client
        ends = (client.status_sub, client.result_sub, client.feedback_sub, client.pub_goal, client.pub_cancel)
        return all(end.get_num_connections() > 0 for end in ends)

    def result(self, text, code=0):
        """A result with as much as the distribution has room for."""
        known = {"error_code": code, "error_msg": text}
        fields = self.layouts.fields(f"{ACTION}_Result")
        empty = lambda kind: self.layouts.message(kind)(0)
        return self.results(*[known[field] if field in known else empty(kind) for field, kind in fields])

    def tick(self):
        is_there = self.is_there()
        if is_there and self.server is None:
            tell(f"/{self.name} is served in ROS 2: {self.move_base} is there")
            self.server = ActionServer(self.node, self.layouts, self.name, ACTION, self)
        elif not is_there and self.server is not None:
            tell(f"/{self.name} is not served in ROS 2 any more: nobody serves {self.move_base}")
            for errand in self.errands:
                # Should it be only out of sight, it is to stop.
                self.cancel_in_ros1(errand)
            self.errands.clear()
            self.server.close()
            self.server = None
        for errand in list(self.errands):
            self.follow(errand)

    def begin(self, goal):
        """A client of ROS 2 has sent a goal."""
        wrong = wrong_pose(goal.goal.pose.pose)
        try:
            pose = self.to_ros1(goal.goal.pose)
        except GarbledMessage as error:
            wrong = str(error)
        if wrong is not None:
            tell(f"a goal of /{self.name} is rejected: {wrong}")
            self.server.reject(goal)
            return
        errand = Errand(goal)
        self.errands.append(errand)
        soon = lambda *_: self.node.call(self.follow, errand)
        feedback = lambda _, message: self.node.call(self.feedback, errand, message)
        errand.handle = self.client.send_goal(self.goal_kind(pose), soon, feedback)

    def cancel(self, goal):
        """A client of ROS 2 wants a goal to end."""
        for errand in self.errands:
            if errand.goal is goal:
                errand.is_cancelled = True
                self.cancel_in_ros1(errand)

    def cancel_in_ros1(self, errand):
        """Not by the handle: that would wait for ever where the goal has just ended."""
        self.client.pub_cancel.publish(GoalID(id=errand.handle.comm_state_machine.action_goal.goal_id.id))

    def follow(self, errand):
        """Tells what has become of a goal."""
        if errand not in self.errands or errand.handle is None:
            return
        state, waited = errand.handle.get_comm_state(), time.monotonic() - errand.since
        # Asked after the state, and before anything is made of that: on the way to the end of a goal that was rejected, actionlib passes
        # through states in which it looks accepted. The result, which may come later or never, has nothing in it that is not known by now.
        if state == CommState.DONE or errand.handle.get_goal_status() in OVER:
            self.errands.remove(errand)
            self.end(errand)
        elif state == CommState.LOST:
            self.errands.remove(errand)
            text = f"{self.move_base} does not know the goal any more; nobody knows whether the robot stands"
            self.server.end(errand.goal, ABORTED, self.result(text, UNKNOWN_ERROR))
        elif state == CommState.WAITING_FOR_GOAL_ACK:
            if waited >= ACKNOWLEDGED:
                self.errands.remove(errand)
                self.cancel_in_ros1(errand)
                tell(f"{self.move_base} has not noticed a goal within {ACKNOWLEDGED:.0f} s; it is rejected")
                self.server.reject(errand.goal)
        elif state == CommState.PENDING:
            if waited >= PENDING:
                self.server.accept(errand.goal, ACCEPTED)
        elif state not in (CommState.RECALLING, CommState.WAITING_FOR_CANCEL_ACK):
            self.server.accept(errand.goal, EXECUTING)

    def end(self, errand):
        status, text = errand.handle.get_goal_status(), errand.handle.get_goal_status_text()
        if status == GoalStatus.REJECTED and errand.goal.state is None:
            tell(f"{self.move_base} has rejected a goal: {text or 'it does not say why'}")
            self.server.reject(errand.goal)
            return
        end = ENDS.get(status, ABORTED)
        if end == CANCELED and not errand.is_cancelled:
            end, text = ABORTED, text or "the goal was cancelled in ROS 1, or another took its place"
        if end == ABORTED:
            text = text or f"{self.move_base} has ended the goal with state {status} and does not say why"
        self.server.end(errand.goal, end, self.result(text, 0 if end == SUCCEEDED else UNKNOWN_ERROR))

    def feedback(self, errand, message):
        if errand not in self.errands or errand.goal.state is None:
            return
        try:
            pose, wanted = self.to_ros2(message.base_position), errand.goal.goal.pose
        except GarbledMessage:
            return
        at, to = pose.pose.position, wanted.pose.position
        # In different frames, nobody here knows how far it is.
        is_known = pose.header.frame_id == wanted.header.frame_id.lstrip("/")
        known = {
            "current_pose": pose,
            "navigation_time": self.duration(time.monotonic() - errand.since),
            "distance_remaining": math.hypot(to.x - at.x, to.y - at.y) if is_known else math.nan,
        }
        rest = lambda kind: self.duration(0.0) if kind.endswith("Duration") else 0
        fields = self.layouts.fields(f"{ACTION}_Feedback")
        self.server.feedback(errand.goal, *[known.get(field, rest(kind)) for field, kind in fields])

    def duration(self, seconds):
        return self.layouts.message("builtin_interfaces/msg/Duration")(int(seconds), int(seconds % 1 * 1e9))

    def stop(self):
        """Lets all goals end, since the bridge ends."""
        for errand in self.errands:
            tell(f"a goal of {self.move_base} is cancelled")
            errand.is_cancelled = True
            self.cancel_in_ros1(errand)

    def is_idle(self):
        return not self.errands

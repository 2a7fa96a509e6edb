"""A client of an action of ROS 2, for servers that may be slow, silent, doubled, dead and back again."""

import time
import uuid

from dds import Reader, Writer, latched, reliable, tell

# How long to wait for a server, and for its word on a goal; in seconds.
SERVER, ANSWER = 5.0, 5.0
# A server has to have been the only one of its name for so long: others may be found after it.
SETTLED = 1.0
# How long before something is asked again that is urgent, or is not.
AGAIN, RARELY = 0.5, 5.0
# For how long a goal that was given up is still cancelled.
REMEMBERED = 60.0
# A server that has told how far it is at least this often, and at least every so often, is gone once it is silent for so long: of one
# that was killed, DDS learns only after a minute.
TOLD, TELLS, SILENT = 3, 0.5, 2.0
# When it is told that a goal that was cancelled has not ended.
OVERDUE = 2.0

SUCCEEDED, CANCELED, ABORTED = 4, 5, 6
WAITING, SENT, ACCEPTED, OVER = range(4)


class Goal:
    """A goal, with who is told of it: `accepted()`, `feedback(feedback)`, and once `ended(end, result, text)`, where the end is
    `succeeded`, `aborted`, `canceled`, `rejected` or, if nobody knows, `lost`."""

    def __init__(self, fields, listener):
        self.id = list(uuid.uuid4().bytes)
        self.fields, self.listener = fields, listener
        self.stage, self.since = WAITING, time.monotonic()
        self.server = frozenset()
        self.asked_result = self.wanted_end = self.asked_end = None
        self.has_ended = self.is_given_up = self.is_overdue = False
        self.told, self.told_first, self.told_last = 0, 0.0, 0.0

    def tells(self):
        """The server has told how far it is."""
        self.told_last = time.monotonic()
        self.told += 1
        if self.told == 1:
            self.told_first = self.told_last

    def is_silent(self, now):
        """Whether a server that used to tell how far it is does not any more."""
        is_steady = self.told >= TOLD and self.told_last - self.told_first <= TELLS * (self.told - 1)
        return is_steady and now - self.told_last >= SILENT

    def move(self, stage):
        self.stage, self.since = stage, time.monotonic()


class ActionClient:
    """A client of an action, whose name has no slash before it here."""

    def __init__(self, node, layouts, name, action):
        self.name = name
        self.kinds = kinds = layouts.action(action)
        self.cancel_kind, canceled = layouts.service("action_msgs/srv/CancelGoal")
        self.info = layouts.message("action_msgs/msg/GoalInfo")
        self.uuid = layouts.message("unique_identifier_msgs/msg/UUID")
        self.time = layouts.message("builtin_interfaces/msg/Time")
        self.header = layouts.message("RequestHeader")
        self.identity, self.number = list(uuid.uuid4().bytes[:8]), 0
        self.requests, self.goals = {}, []
        self.counted = (0, time.monotonic())
        inner = f"{name}/_action/"

        def service(part, request, reply, hear):
            write = Writer(node, f"rq/{inner}{part}Request", request, reliable(100))
            return write, Reader(node, f"rr/{inner}{part}Reply", reply, reliable(100), hear)

        self.services = {
            "send_goal": service("send_goal", kinds["SendGoal_Request"], kinds["SendGoal_Response"], self.answered),
            "get_result": service("get_result", kinds["GetResult_Request"], kinds["GetResult_Response"], self.result),
            "cancel_goal": service("cancel_goal", self.cancel_kind, canceled, self.cancelling),
        }
        Reader(node, f"rt/{inner}feedback", kinds["FeedbackMessage"], reliable(10), self.feedback)
        status = layouts.message("action_msgs/msg/GoalStatusArray")
        Reader(node, f"rt/{inner}status", status, latched(), self.status)
        node.every_tick(self.tick)

    def send(self, fields, listener):
        """Sends a goal of these fields as soon as there is one server."""
        goal = Goal(fields, listener)
        self.goals.append(goal)
        return goal

    def cancel(self, goal):
        """Lets a goal end. It has ended when its listener is told so."""
        if goal.stage == WAITING:
            self.end(goal, "canceled", None, "the goal was cancelled before it was sent")
        elif goal.stage != OVER and goal.wanted_end is None:
            goal.wanted_end = time.monotonic()
            self.ask_end(goal)

    def is_idle(self):
        """Whether no goal is under way."""
        return all(goal.stage == OVER for goal in self.goals)

    def ends(self):
        """The handles of all ends of servers."""
        sides = [side for write, reader in self.services.values() for side in (write.readers(), reader.writers())]
        return sides, frozenset().union(*sides)

    def servers(self):
        """How many servers are there, with all that a goal needs."""
        sides, _ = self.ends()
        return max(map(len, sides)) if all(sides) else 0

    def ask(self, goal, part, kind, *fields):
        self.number += 1
        self.requests[self.number] = goal
        header = self.header(self.identity, self.number % 2**32, self.number // 2**32)
        self.services[part][0].write(kind(header, *fields))

    def ask_result(self, goal):
        goal.asked_result = time.monotonic()
        self.ask(goal, "get_result", self.kinds["GetResult_Request"], self.uuid(goal.id))

    def ask_end(self, goal):
        goal.asked_end = time.monotonic()
        self.ask(goal, "cancel_goal", self.cancel_kind, self.info(self.uuid(goal.id), self.time(0, 0)))

    def asked(self, reply):
        """The goal about which this client has asked what is answered."""
        if list(reply.request.identity) != self.identity:
            return None
        return self.requests.pop(reply.request.low + reply.request.high * 2**32, None)

    def goal_of(self, identity):
        identity = list(identity.uuid)
        return next((goal for goal in self.goals if goal.id == identity), None)

    def answered(self, reply, _):
        goal = self.asked(reply)
        if goal is None:
            return
        if goal.stage == SENT and reply.accepted:
            goal.move(ACCEPTED)
            goal.asked_end = None  # Before, the server may not have known the goal.
            goal.listener.accepted()
            self.ask_result(goal)
        elif goal.stage == SENT:
            self.end(goal, "rejected", None, f"/{self.name} has rejected the goal in ROS 2")
        elif goal.stage == OVER and reply.accepted:
            goal.is_given_up = True  # What was given up must not begin.

    def result(self, reply, _):
        goal = self.asked(reply)
        if goal is None or goal.stage != ACCEPTED:
            return
        ends = {SUCCEEDED: "succeeded", CANCELED: "canceled", ABORTED: "aborted"}
        if reply.status in ends:
            self.end(goal, ends[reply.status], reply.result, getattr(reply.result, "error_msg", ""))
        elif reply.status == 0:
            text = f"the server of /{self.name} does not know the goal any more: it may have begun anew"
            self.end(goal, "lost", None, text)

    def cancelling(self, reply, _):
        goal = self.asked(reply)
        if goal is not None and goal.stage == OVER:
            goal.is_given_up = False

    def feedback(self, message, _):
        goal = self.goal_of(message.goal_id)
        if goal is not None and goal.stage == ACCEPTED:
            goal.tells()
            goal.listener.feedback(message.feedback)

    def status(self, message, _):
        for status in message.status_list:
            goal = self.goal_of(status.goal_info.goal_id)
            if goal is not None and status.status in (SUCCEEDED, CANCELED, ABORTED) and not goal.has_ended:
                goal.has_ended = True
                goal.asked_result = None  # The answer may be lost.

    def tick(self):
        now = time.monotonic()
        if not self.goals:
            return
        sides, ends = self.ends()
        servers = max(map(len, sides)) if all(sides) else 0
        if servers != self.counted[0]:
            self.counted = servers, now
        for goal in self.goals:
            self.follow(goal, now, servers, ends)
        self.goals = [goal for goal in self.goals if goal.stage != OVER or now - goal.since < REMEMBERED]
        known = set(map(id, self.goals))
        self.requests = {number: goal for number, goal in self.requests.items() if id(goal) in known}

    def follow(self, goal, now, servers, ends):
        is_due = lambda asked, pause: asked is None or now - asked >= pause
        if goal.stage == WAITING:
            if servers == 1 and now - self.counted[1] >= SETTLED:
                goal.move(SENT)
                goal.server = ends
                self.ask(goal, "send_goal", self.kinds["SendGoal_Request"], self.uuid(goal.id), goal.fields)
            elif now - goal.since >= SERVER:
                who = "nobody serves" if servers == 0 else f"{servers} nodes serve" if servers > 1 else "a server has only just come for"
                self.end(goal, "aborted", None, f"{who} /{self.name} in ROS 2 (waited {SERVER:.0f} s): one server was expected")
        elif goal.stage == OVER:
            if goal.is_given_up and servers and is_due(goal.asked_end, AGAIN):
                self.ask_end(goal)
        elif not goal.server <= ends:
            self.give_up(goal, f"the server of /{self.name} in ROS 2 is gone; nobody knows whether the robot stands")
        elif goal.stage == SENT and now - goal.since >= ANSWER:
            self.give_up(goal, f"the server of /{self.name} has not said within {ANSWER:.0f} s whether it accepts the goal")
        elif goal.stage == ACCEPTED and goal.is_silent(now):
            text = f"the server of /{self.name} in ROS 2 has been silent for {SILENT:.0f} s; nobody knows whether the robot stands"
            self.give_up(goal, text)
        elif goal.stage == ACCEPTED:
            is_urgent = goal.has_ended or goal.wanted_end is not None
            if is_due(goal.asked_result, AGAIN if is_urgent else RARELY):
                self.ask_result(goal)
            if goal.wanted_end is not None:
                if is_due(goal.asked_end, AGAIN):
                    self.ask_end(goal)
                if now - goal.wanted_end >= OVERDUE and not goal.is_overdue:
                    goal.is_overdue = True
                    tell(f"a goal of /{self.name} was cancelled {OVERDUE:.0f} s ago and has not ended: the robot may move")

    def give_up(self, goal, text):
        """Ends a goal that the server may carry out nevertheless."""
        goal.is_given_up = True
        self.end(goal, "lost", None, text)

    def end(self, goal, end, result, text):
        goal.move(OVER)
        goal.listener.ended(end, result, text)

"""A server of an action of ROS 2 whose goals are carried out elsewhere."""

import time

from dds import Reader, Writer, latched, reliable

ACCEPTED, EXECUTING, CANCELING, SUCCEEDED, CANCELED, ABORTED = range(1, 7)
UNKNOWN = 0
# What is answered to a request to cancel.
CANCELS, NOT_KNOWN, HAS_ENDED = 0, 2, 3
# For how long a result is kept, in seconds.
KEPT = 900.0


class ServedGoal:
    """A goal of a client, with its state, and who waits for its result."""

    def __init__(self, request, stamp):
        self.id, self.goal, self.stamp = list(request.goal_id.uuid), request.goal, stamp
        self.request = request.request
        # None: the client does not know yet whether it is accepted.
        self.state = None
        self.waiting, self.result, self.ended = [], None, None

    def is_over(self):
        return self.ended is not None


class ActionServer:
    """Serves an action, whose name has no slash before it here. `carry` has `begin(goal)` and `cancel(goal)`; it tells this server by
    `accept`, `reject`, `end` and `feedback` what comes of them."""

    def __init__(self, node, layouts, name, action, carry):
        self.layouts, self.carry = layouts, carry
        self.kinds = kinds = layouts.action(action)
        self.result_kind = layouts.message(f"{action}_Result")
        self.feedback_fields = layouts.message(f"{action}_Feedback")
        cancel, self.cancel_reply = layouts.service("action_msgs/srv/CancelGoal")
        self.status_kind = layouts.message("action_msgs/msg/GoalStatusArray")
        self.goal_status = layouts.message("action_msgs/msg/GoalStatus")
        self.info = layouts.message("action_msgs/msg/GoalInfo")
        self.uuid = layouts.message("unique_identifier_msgs/msg/UUID")
        self.time = layouts.message("builtin_interfaces/msg/Time")
        self.node, self.goals = node, []
        inner = f"{name}/_action/"

        def serve(part, request, reply, hear):
            self.readers.append(Reader(node, f"rq/{inner}{part}Request", request, reliable(100), hear))
            return Writer(node, f"rr/{inner}{part}Reply", reply, reliable(100))

        self.readers = []
        self.accepting = serve("send_goal", kinds["SendGoal_Request"], kinds["SendGoal_Response"], self.come)
        self.results = serve("get_result", kinds["GetResult_Request"], kinds["GetResult_Response"], self.ask)
        self.cancelling = serve("cancel_goal", cancel, self.cancel_reply, self.cancel)
        self.feedbacks = Writer(node, f"rt/{inner}feedback", kinds["FeedbackMessage"], reliable(10))
        self.status = Writer(node, f"rt/{inner}status", self.status_kind, latched())

    def close(self):
        """Nobody serves the action any more."""
        for reader in self.readers:
            reader.close()
        for writer in (self.accepting, self.results, self.cancelling, self.feedbacks, self.status):
            writer.close()

    def now(self):
        nanoseconds = time.time_ns()
        return self.time(nanoseconds // 10**9, nanoseconds % 10**9)

    def find(self, identity):
        return next((goal for goal in self.goals if goal.id == list(identity)), None)

    def come(self, request, _):
        forgotten = lambda goal: goal.is_over() and time.monotonic() - goal.ended > KEPT
        self.goals = [goal for goal in self.goals if not forgotten(goal)]
        goal = ServedGoal(request, self.now())
        if self.find(goal.id) is not None:
            self.accepting.write(self.kinds["SendGoal_Response"](request.request, False, goal.stamp))
            return
        self.goals.append(goal)
        self.carry.begin(goal)

    def accept(self, goal, state=EXECUTING):
        """A goal is accepted, or begins after that."""
        if goal.state is None:
            self.accepting.write(self.kinds["SendGoal_Response"](goal.request, True, goal.stamp))
        if goal.state in (None, ACCEPTED):
            self.move(goal, state)

    def reject(self, goal):
        self.goals.remove(goal)
        self.accepting.write(self.kinds["SendGoal_Response"](goal.request, False, goal.stamp))

    def feedback(self, goal, *fields):
        message = self.kinds["FeedbackMessage"](self.uuid(goal.id), self.feedback_fields(*fields))
        self.feedbacks.write(message)

    def end(self, goal, state, result):
        """A goal has ended."""
        self.accept(goal)
        goal.ended, goal.result = time.monotonic(), result
        self.move(goal, state)
        for request in goal.waiting:
            self.answer(request, goal)
        goal.waiting.clear()

    def move(self, goal, state):
        goal.state = state
        known = [goal for goal in self.goals if goal.state is not None]
        self.status.write(self.status_kind([self.goal_status(self.info_of(goal), goal.state) for goal in known]))

    def info_of(self, goal):
        return self.info(self.uuid(goal.id), goal.stamp)

    def answer(self, request, goal):
        self.results.write(self.kinds["GetResult_Response"](request.request, goal.state, goal.result))

    def ask(self, request, _):
        goal = self.find(request.goal_id.uuid)
        if goal is None:
            empty = self.carry.result("")
            self.results.write(self.kinds["GetResult_Response"](request.request, UNKNOWN, empty))
        elif goal.is_over():
            self.answer(request, goal)
        else:
            goal.waiting.append(request)

    def cancel(self, request, _):
        """An identity of zeros is every goal; a time is every goal that was accepted by then, and the one of the identity."""
        identity, stamp = list(request.goal_info.goal_id.uuid), request.goal_info.stamp
        has_id, has_time = any(identity), bool(stamp.sec or stamp.nanosec)
        is_meant = lambda goal: (
            goal.id == identity
            or (not has_id and not has_time)
            or (has_time and (goal.stamp.sec, goal.stamp.nanosec) <= (stamp.sec, stamp.nanosec))
        )
        meant = [goal for goal in self.goals if is_meant(goal)]
        open_goals = [goal for goal in meant if not goal.is_over()]
        named = self.find(identity) if has_id else None
        if has_id and named is None and not open_goals:
            code = NOT_KNOWN
        elif named is not None and named.is_over() and not open_goals:
            code = HAS_ENDED
        else:
            code = CANCELS
        for goal in open_goals:
            self.carry.cancel(goal)
            if goal.state in (ACCEPTED, EXECUTING):
                self.move(goal, CANCELING)
        self.cancelling.write(self.cancel_reply(request.request, code, [self.info_of(goal) for goal in open_goals]))

"""A robot behind a network that loses, delays, doubles and reorders what is said, and whose servers lie, fall silent, die and return.
What goes wrong in a run is drawn from a seed."""

import bisect
import heapq
import math
import os
import random
import time

from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

import messages as ros
from actions import (
    FOLLOW,
    GRIPPER,
    NAVIGATE,
    POINT,
    CancelRequest,
    CancelResponse,
    GoalInfo,
    GoalStatus,
    GoalStatusArray,
    RequestHeader,
)

DOMAIN = int(os.environ.get("ROS_DOMAIN_ID", 77))
EXECUTING, SUCCEEDED, CANCELED, ABORTED = 2, 4, 5, 6
NOW = ros.Time(0, 0)
# How fast the base drives (m/s), and the fingers move (m/s).
DRIVE, FINGERS = 0.5, 0.1
PARTS = {
    "base": ("navigate_to_pose", NAVIGATE),
    "torso": ("torso_controller/follow_joint_trajectory", FOLLOW),
    "neck": ("head_controller/point_head_action", POINT),
    "arm": ("left_arm_controller/follow_joint_trajectory", FOLLOW),
    "hand": ("left_gripper_controller/gripper_cmd", GRIPPER),
}
GRIPPER_JOINT = "l_gripper_l_finger_joint"


class Faults:
    """What goes wrong in a run."""

    def __init__(self, seed):
        self.random = dice = random.Random(seed)
        some = lambda: dice.choice(list(PARTS))
        self.loss = dice.choice((0, 0, 0.01, 0.05, 0.2))
        self.late = dice.choice((0, 0, 0, 0.3, 2.0))
        self.double = dice.choice((0, 0, 0.5))
        self.foreign = dice.choice((0, 0, 0.5))
        special = dice.choice(
            ("none", "none", "none", "eager", "endless", "deaf", "idle", "beside", "rejects", "aborts", "cancelled")
            + ("dies", "dies", "dies", "jump", "stop", "silent")
        )
        self.special, self.part = special, some()
        self.state = dice.choice(("idle", "sent", "accepted", "executing", "canceling", "ended"))
        self.after = dice.uniform(0.1, 3.0)
        self.jump = dice.choice((-1, 1)) * dice.uniform(2, 100)

    def of(self, part, special):
        return self.special == special and self.part == part

    def __str__(self):
        parts = [f"{name} {getattr(self, name)}" for name in ("loss", "late", "double", "foreign") if getattr(self, name)]
        if self.special != "none":
            where = "" if self.special in ("jump", "stop", "silent") else f" {self.part}"
            state = f" {self.state}" if self.special == "dies" else ""
            parts.append(f"{self.special}{where}{state}")
        return ", ".join(parts) or "nothing"


class Goal:
    def __init__(self, request, now):
        self.request, self.id, self.since = request, bytes(request.goal_id), now
        self.ended = self.canceled = self.start = None
        self.asked = []


class Server:
    """An action of the robot."""

    def __init__(self, robot, part):
        self.robot, self.part = robot, part
        self.name, self.kind = PARTS[part]
        self.life = 0
        self.open()

    def open(self):
        self.participant = participant = DomainParticipant(DOMAIN)
        self.life += 1
        self.goals, self.returns = {}, None

        def read(part, kind):
            topic = Topic(participant, f"rq/{self.name}/_action/{part}Request", kind)
            return DataReader(participant, topic, qos=ros.reliable(100))

        def write(topic, kind, qos=ros.reliable(100)):
            return DataWriter(participant, Topic(participant, topic, kind), qos=qos)

        inner = f"{self.name}/_action/"
        self.readers = [
            (read("send_goal", self.kind["send_goal"]), self.begin),
            (read("get_result", self.kind["get_result"]), self.ask),
            (read("cancel_goal", CancelRequest), self.cancel),
        ]
        self.accepting = write(f"rr/{inner}send_goalReply", self.kind["accepted"])
        self.results = write(f"rr/{inner}get_resultReply", self.kind["result"])
        self.cancelling = write(f"rr/{inner}cancel_goalReply", CancelResponse)
        self.feedback = write(f"rt/{inner}feedback", self.kind["feedback"])
        self.status = write(f"rt/{inner}status", GoalStatusArray, ros.latched())

    def die(self):
        """It is gone, with all that it knew, for a while."""
        for name in ("participant", "readers", "accepting", "results", "cancelling", "feedback", "status"):
            delattr(self, name)
        self.life += 1
        self.goals, self.readers = {}, []
        self.returns = self.robot.now + self.robot.faults.random.uniform(0.5, 3.0)
        self.robot.deaths += 1

    def dies_at(self, state):
        faults = self.robot.faults
        if faults.of(self.part, "dies") and faults.state == state and not self.robot.deaths:
            self.die()
            return True
        return False

    def carry(self, deed):
        """Does something unless it is lost, or this server is another one by then."""
        life = self.life
        self.robot.carry(lambda: self.life == life and deed())

    def poll(self):
        if self.returns is not None:
            if self.robot.now >= self.returns:
                self.open()
            return
        if self.dies_at("idle"):
            return
        for reader, deed in self.readers:
            for request in reader.take(20):
                if self.returns is None:
                    self.carry(lambda deed=deed, request=request: deed(request))

    def answer(self, writer, *fields, foreign=True):
        """Writes an answer, and sometimes one that is for others."""
        kind, header, *rest = fields
        self.carry(lambda: writer.write(kind(header, *rest)))
        if foreign and self.robot.faults.random.random() < self.robot.faults.foreign:
            other = RequestHeader(header.guid, header.low + 7000, header.high)
            self.carry(lambda: writer.write(kind(other, *rest)))

    def begin(self, request):
        if self.dies_at("sent"):
            return
        identity = bytes(request.goal_id)
        if identity in self.goals:
            return
        faults = self.robot.faults
        is_accepted = not faults.of(self.part, "rejects")
        if is_accepted:
            for older in self.goals.values():
                self.end(older, ABORTED)
            goal = self.goals[identity] = Goal(request, self.robot.now)
            goal.start = self.robot.place(self.part)
            self.robot.begun.append((self.robot.now, self.part))
        if faults.of(self.part, "eager"):
            # It begins, and says so, before it says that it has accepted the goal.
            self.results.write(self.kind["result"](request.request, SUCCEEDED, *self.result(SUCCEEDED)))
            life = self.life
            reply = lambda: self.life == life and self.accepting.write(self.kind["accepted"](request.request, True, NOW))
            self.robot.later(1.5, reply)
        else:
            self.answer(self.accepting, self.kind["accepted"], request.request, is_accepted, NOW)
        if is_accepted and not self.dies_at("accepted"):
            self.tell(goal, EXECUTING)

    def tell(self, goal, status):
        stati = [GoalStatus(GoalInfo(list(goal.id), NOW), status)]
        if self.robot.faults.random.random() < self.robot.faults.foreign:
            stati.insert(0, GoalStatus(GoalInfo([9] * 16, NOW), SUCCEEDED))
        self.carry(lambda: self.status.write(GoalStatusArray(stati)))

    def ask(self, request):
        goal = self.goals.get(bytes(request.goal_id))
        if goal is None:
            self.answer(self.results, self.kind["result"], request.request, 0, *self.result(0))
        elif goal.ended is not None:
            self.answer(self.results, self.kind["result"], request.request, goal.ended, *self.result(goal.ended))
        else:
            goal.asked.append(request.request)

    def cancel(self, request):
        if self.dies_at("canceling"):
            return
        goal = self.goals.get(bytes(request.goal_info.goal_id))
        self.answer(self.cancelling, CancelResponse, request.request, 0 if goal else 2, [])
        if goal and goal.ended is None and not self.robot.faults.of(self.part, "deaf"):
            goal.canceled = goal.canceled or self.robot.now

    def end(self, goal, status):
        if goal.ended is None:
            goal.ended = status
            self.tell(goal, status)
            for request in goal.asked:
                self.answer(self.results, self.kind["result"], request, status, *self.result(status))

    def result(self, status):
        if self.kind is NAVIGATE:
            return (7, "the way is blocked") if status == ABORTED else (0, "")
        if self.kind is FOLLOW:
            return (-4, "the arm is stuck") if status == ABORTED else (0, "")
        if self.kind is GRIPPER:
            return (self.robot.gap, 0.0, False, status == SUCCEEDED)
        return (0,)

    def move(self):
        """Goes on with the goal that has not ended."""
        faults = self.robot.faults
        for goal in list(self.goals.values()):
            if goal.ended is not None:
                continue
            since = self.robot.now - goal.since
            if goal.canceled is not None:
                if self.robot.now - goal.canceled > 0.05:
                    self.end(goal, CANCELED)
                continue
            if since > 0.3 and self.dies_at("executing"):
                return
            if any(faults.of(self.part, what) for what in ("endless", "deaf")) and since > 0.1:
                continue
            if faults.of(self.part, "aborts") and since > 0.3:
                self.end(goal, ABORTED)
                continue
            if faults.of(self.part, "cancelled") and since > 0.3:
                self.end(goal, CANCELED)
                continue
            if faults.of(self.part, "idle") or self.robot.go(self, goal, since):
                self.end(goal, SUCCEEDED)
                if self.dies_at("ended"):
                    return


class Robot:
    """The robot, its servers, and the network between it and its clients. `joints` is where its joints are, and `gaps` are
    pairs of gap (m) and position (rad) of the fingers."""

    def __init__(self, frames, joints, gaps):
        self.frames, self.joints, self.gaps = frames, joints, sorted(gaps)
        self.pose = [0.0, 0.0, 0.0]
        self.faults = Faults(0)
        self.faults.special, self.faults.loss, self.faults.late, self.faults.double, self.faults.foreign = "none", 0, 0, 0, 0
        self.gap, self.now, self.queue, self.number = 0.0, time.monotonic(), [], 0
        self.begun, self.deaths, self.clock, self.since, self.next = [], 0, 0.0, self.now, 0.0
        self.stood = None
        # As it was left when the pairs were measured. A hand that is wide open touches its forearm where some goals are.
        self.set_gap(gaps[-1][0])
        self.participant = participant = DomainParticipant(DOMAIN)
        self.tf = DataWriter(participant, Topic(participant, "rt/tf", ros.TFMessage), qos=ros.reliable(100))
        self.states = DataWriter(participant, Topic(participant, "rt/joint_states", ros.JointState), qos=ros.reliable(10))
        self.servers = {part: Server(self, part) for part in PARTS}

    def set_gap(self, gap):
        self.gap = gap
        known = [gap for gap, _ in self.gaps]
        at = min(max(bisect.bisect(known, gap), 1), len(known) - 1)
        (a, p), (b, q) = self.gaps[at - 1], self.gaps[at]
        self.joints[GRIPPER_JOINT] = p + (q - p) * (gap - a) / (b - a)

    def place(self, part):
        return {"base": list(self.pose), "hand": self.gap}.get(part, dict(self.joints))

    def later(self, seconds, deed):
        self.number += 1
        heapq.heappush(self.queue, (self.now + seconds, self.number, deed))

    def carry(self, deed):
        dice, faults = self.faults.random, self.faults
        if dice.random() < faults.loss:
            return
        for _ in range(2 if dice.random() < faults.double else 1):
            is_late = faults.late and dice.random() < 0.5
            self.later(dice.uniform(0, faults.late) if is_late else 0, deed)

    def go(self, server, goal, since):
        """Moves on; whether the goal is reached."""
        wanted = goal.request
        beside = 1 if self.faults.of(server.part, "beside") else 0
        if server.part == "base":
            at, turn = wanted.pose.pose.position, wanted.pose.pose.orientation
            to = [at.x + 0.1 * beside, at.y, 2 * math.atan2(turn.z, turn.w)]
            way = math.dist(goal.start[:2], to[:2])
            share = min(since * DRIVE / max(way, 1e-9), 1)
            turned = math.remainder(to[2] - goal.start[2], math.tau)
            self.pose = [a + (b - a) * share for a, b in zip(goal.start[:2], to[:2])] + [goal.start[2] + turned * share]
            return share == 1
        if server.part == "hand":
            to = wanted.position + 0.005 * beside
            way = to - goal.start
            self.set_gap(goal.start + math.copysign(min(abs(way), FINGERS * since), way))
            return abs(self.gap - to) < 1e-9
        if server.part == "neck":
            return since > 0.2
        points = [(p.time_from_start.sec + 1e-9 * p.time_from_start.nanosec, p.positions) for p in wanted.trajectory.points]
        stamp = wanted.trajectory.header.stamp
        if stamp.nanoseconds():
            since = time.time() + self.clock - 1e-9 * stamp.nanoseconds()
        names, end = wanted.trajectory.joint_names, points[-1][0]
        points.insert(0, (0.0, [goal.start[name] for name in names]))
        since = max(since, 0)
        at = next((i for i, point in enumerate(points) if point[0] > since), None)
        for number, name in enumerate(names):
            if at is None:
                position = points[-1][1][number]
            else:
                (a, p), (b, q) = points[at - 1], points[at]
                position = p[number] + (q[number] - p[number]) * (since - a) / (b - a)
            self.joints[name] = position + (0.3 * beside * min(since / end, 1) if number == 0 else 0)
        return since >= end

    def new_run(self, faults):
        self.faults, self.deaths, self.since, self.begun = faults, 0, self.now, []
        self.stood = None

    def heal(self):
        """Nothing is wrong any more, and nobody has a goal."""
        self.faults = faults = Faults(0)
        faults.special, faults.loss, faults.late, faults.double, faults.foreign = "none", 0, 0, 0, 0
        self.queue.clear()
        for server in self.servers.values():
            if server.returns is not None:
                server.open()
            server.goals = {}

    def runs(self):
        """The parts with goals that have not ended."""
        return [s.part for s in self.servers.values() for goal in s.goals.values() if goal.ended is None]

    def step(self):
        self.now = time.monotonic()
        while self.queue and self.queue[0][0] <= self.now:
            heapq.heappop(self.queue)[2]()
        for server in self.servers.values():
            server.poll()
            server.move()
        if self.now >= self.next:
            self.next = self.now + 1 / 60
            self.tell()
        time.sleep(0.002)

    def tell(self):
        """Tells where it is."""
        is_due = self.now - self.since > self.faults.after
        if self.faults.special == "silent" and is_due and self.now - self.since < self.faults.after + 1.5:
            return
        if self.faults.special == "jump" and is_due:
            self.clock, self.since = self.clock + self.faults.jump, self.now + 1e9
        if self.faults.special == "stop" and is_due and self.now - self.since < self.faults.after + 1.5:
            self.stood = self.stood or time.time()
        else:
            self.stood = None
        clock = max((self.stood or time.time()) + self.clock, 0)
        stamp = ros.Time(int(clock), int(clock % 1 * 1e9))
        x, y, turn = self.pose
        pose = ros.Transform(ros.Vector3(x, y, 0.0), ros.Quaternion(0.0, 0.0, math.sin(turn / 2), math.cos(turn / 2)))
        self.tf.write(ros.TFMessage([ros.TransformStamped(ros.Header(stamp, "map"), self.frames, pose)]))
        names = list(self.joints)
        self.states.write(ros.JointState(ros.Header(stamp, ""), names, [self.joints[name] for name in names], [], []))

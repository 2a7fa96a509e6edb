"""A robot on one host, a plan on another, the wire between them, and a referee on the robot's host who knows where it truly is."""

import collections
import json
import math
import os
import random
import resource
import signal
import sys
import tempfile
import threading
import time

from checks import check, patient
from short_plan import ARM_JOINTS, PLAN, Goal, Plan, impatient
from wire_network import Network

# How much faster than real time robot and plan are.
PACE = 1
DOMAIN = 82
# How much memory a process may have (bytes).
MEMORY = 4 << 30
HAND = "l_gripper_l_finger_joint"
# Base (m, rad), torso (m), arm (rad), and the hand's joint (rad), within which a goal is reached: those of `world/pr2.sexp`.
NEAR = {"base": 0.05, "turn": 0.1, "torso": 0.005, "arm": 0.17, "hand": 0.01}
# What has moved by more than this (m or rad) has moved, and what goes on slower than this in a moment stands.
MOVED, STANDS = 0.02, 1e-3


class State:
    def __init__(self, line):
        self.time, (self.x, self.y, self.turn), self.joints = json.loads(line)

    def way(self, other):
        """By how much the robot has moved (m or rad) to another state: of its base and its joints, what has moved most."""
        base = max(math.dist((self.x, self.y), (other.x, other.y)), abs(math.remainder(self.turn - other.turn, math.tau)))
        return max(base, *(abs(at - other.joints.get(name, at)) for name, at in self.joints.items()))


class RobotGone(Exception):
    """The robot's program has ended, or does not tell its own host any more where it is."""


class Pair:
    def __init__(self, program):
        self.program, self.scratch = program, tempfile.TemporaryDirectory()
        self.environment = dict(os.environ, ROS_DOMAIN_ID=str(DOMAIN), ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET")
        self.description = os.path.join(self.scratch.name, "pr2.sexp")
        impatient(self.description, base=6, torso=4, neck=3, left_arm=4, left_gripper=4, server=4)
        if os.environ.get("PATIENT"):
            # On a machine that is busy with other things, what is heard may be older.
            patient(self.description, self.scratch.name)
        self.robot = self.plan = self.referee = None
        self.states, self.angles = collections.deque(maxlen=4000), []
        self.timers, self.settled = [], 0
        self.network = Network()

    def close(self):
        for process in (self.plan, self.robot, self.referee):
            if process is not None:
                process.process.kill()
                process.process.wait()
        self.network.remove()

    def on(self, host, *command):
        """A process on a host."""

        def alone():
            # What arrives garbled must not cost others their memory, and Ctrl-C is to end what it is sent to.
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            signal.signal(signal.SIGINT, signal.SIG_DFL)

        return Plan(["ip", "netns", "exec", host, *command], env=self.environment, preexec_fn=alone)

    def start_robot(self):
        for process in (self.robot, self.referee):
            if process is not None:
                process.process.kill()
                process.process.wait()
        self.robot = self.on(self.network.robot, self.program, f"--realtime={PACE}", "robot", "--ros2=jazzy")
        end = time.monotonic() + 30
        while not any(line.startswith("/detect_objects") for line in self.robot.said(self.robot.lines)):
            check(time.monotonic() < end, f"the robot does not begin: {self.robot.said(self.robot.errors)}")
            time.sleep(0.05)
        referee = os.path.join(os.path.dirname(__file__), "wire_referee.py")
        self.referee = self.on(self.network.robot, sys.executable, "-u", referee)
        self.states.clear()
        threading.Thread(target=self.listen, args=(self.referee,), daemon=True).start()
        while not self.states:
            check(time.monotonic() < end, f"the referee hears nothing: {self.referee.said(self.referee.errors)}")
            time.sleep(0.05)

    def listen(self, referee):
        while self.referee is referee:
            self.states.append(State(referee.lines.get()))

    def plan_command(self, *arguments):
        options = (f"--realtime={PACE}", "--robot-description", self.description, "--real-robot=jazzy")
        return self.on(self.network.plan, self.program, *arguments, *options)

    def start_plan(self):
        if self.plan is not None:
            self.plan.process.kill()
            self.plan.process.wait()
        self.plan = self.plan_command()
        self.plan.tell(PLAN)

    def panics(self):
        """What threads of the plan and the robot have said when they failed."""
        lines = [line for process in (self.plan, self.robot) if process for line in process.errors.queue]
        return [line for line in lines if "panicked" in line]

    def wait_for(self, name, seconds):
        """What a run has said at its end; `None` if it does not end in time, or its process has."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for line in self.plan.said(self.plan.lines):
                if line.startswith(f"RUN {name} "):
                    return line.split(" ", 2)[2]
            if self.plan.process.poll() is not None:
                return None
            time.sleep(0.005)
        return None

    def now(self):
        """Where the robot is, by what the referee hears from now on."""
        begin = time.monotonic()
        end = begin + 5
        while self.states[-1].time < begin:
            if time.monotonic() > end or self.robot.process.poll() is not None:
                raise RobotGone(" ".join(self.robot.said(self.robot.errors))[:200] or "it says nothing")
            time.sleep(0.01)
        return self.states[-1]

    def motion(self, since, begin):
        """By how much the robot has moved since a state, and when (s) after a time it has moved last."""
        moved, last, before = 0.0, 0.0, since
        for state in [state for state in list(self.states) if state.time > since.time]:
            moved = max(moved, since.way(state))
            if before.way(state) > STANDS:
                last = state.time - begin
            before = state
        return moved, last

    def watch(self, since, begin, seconds, most=15):
        """What the robot moves for so long, and for half a second in which it stands; at most for so long."""
        until, end = time.monotonic() + seconds, time.monotonic() + most
        while time.monotonic() < end:
            moved, last = self.motion(since, begin)
            if time.monotonic() > max(until, begin + last + 0.5):
                break
            time.sleep(0.05)
        return self.motion(since, begin)

    def later(self, seconds, deed):
        """Does something later, unless all is well again by then."""
        timer = threading.Timer(seconds, deed)
        timer.daemon = True
        timer.start()
        self.timers.append(timer)

    def heal(self):
        """Nothing is wrong any more."""
        for timer in self.timers:
            timer.cancel()
        self.timers = []
        self.network.heal()

    def settle(self, goal=None):
        """A run over a whole wire: how it ends."""
        self.settled += 1
        goal, name = goal or Goal(random.Random(self.settled)), 1_000_000 + self.settled
        self.plan.tell(goal.call(name))
        return self.wait_for(name, 60)

    def calibrate(self):
        """Measures where the hand's joint is for some openings, over a whole wire."""
        goal = Goal(random.Random(0))
        for goal.opening in (0.03, 0.045, 0.06, 0.08):
            said = self.settle(goal)
            check(said == "done", f"over a whole wire: {said} {self.plan.said(self.plan.errors)}")
            time.sleep(0.3)
            self.angles.append((goal.opening, self.now().joints[HAND]))

    def beside(self, goal):
        """What of a goal the robot has not reached; empty if it has."""
        state, (x, y, turn) = self.now(), goal.place
        off = {
            "base": math.dist((state.x, state.y), (x, y)),
            "turn": abs(math.remainder(state.turn - turn, math.tau)),
            "torso": abs(state.joints["torso_lift_joint"] - goal.height),
            "arm": max(abs(math.remainder(state.joints[name] - at, math.tau)) for name, at in zip(ARM_JOINTS, goal.arm)),
            "hand": abs(state.joints[HAND] - self.angle(goal.opening)),
        }
        return ", ".join(f"{name} {by:.3f} beside" for name, by in off.items() if by > NEAR[name])

    def angle(self, opening):
        """Where the hand's joint is for an opening, by what was measured over a whole wire."""
        known = sorted(self.angles)
        if len(known) < 2:
            return self.now().joints[HAND]
        at = next((i for i in range(1, len(known) - 1) if known[i][0] >= opening), len(known) - 1)
        (a, p), (b, q) = known[at - 1], known[at]
        return p + (q - p) * (opening - a) / (b - a)

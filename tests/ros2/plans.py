"""Runs plans in simulation and on a robot in another process, `planwright robot --ros2`: same course, same failures, same ends."""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time

from cyclonedds.domain import DomainParticipant
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

import messages as ros
from checks import check, patient, timely

PROGRAM = sys.argv[1]
# How much faster than real time robot and plan are.
PACE = 3
BOTTLE = "(pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))\n"
TUTORIAL = open("plans/tutorial/move-bottle.plan", encoding="utf-8").read()
# The tutorial's plan up to where it begins, without its bottle.
PLAN = TUTORIAL[: TUTORIAL.index("(defun move-bottle")]
ENDS = """
(defun show-place (word)
  (let ((at (cl-tf:origin (btr-utils:object-pose 'bottle-1))))
    (format t "~&~a ~{~,5f ~}~%" word (list (cl-tf:x at) (cl-tf:y at) (cl-tf:z at)))))
"""
FAILURES = """
(defmacro told (name &body body)
  `(format t "~&FAILURE ~a ~a~%" ,name
           (handler-case (progn (with-real-robot ,@body) "none")
             (cram-common-failures:low-level-failure (failure)
               (format nil "~a: ~a" (type-of failure) (substitute #\\Space #\\Newline (princ-to-string failure)))))))
(told "occupied" (let ((?pose (make-pose "map" '((-1.3 2.0 0) (0 0 0 1)))))
                   (perform (a motion (type going) (target (a location (pose ?pose)))))))
(told "nothing" (perform (a motion (type detecting) (object (an object (type bowl))))))
(told "torso" (perform (a motion (type moving-torso) (joint-angle 0.9))))
(told "empty" (perform (a motion (type gripping) (gripper left))))
(told "far" (let ((?pose (make-pose "map" '((5 5 5) (0 0 0 1)))))
              (perform (a motion (type moving-tcp) (right-pose ?pose)))))
(told "fine" (perform (a motion (type moving-torso) (joint-angle 0.16))))
"""


def simulated(text):
    """The same text for the simulated robot."""
    return text.replace("(with-real-robot", "(with-simulated-robot")


def real(text):
    return text.replace("(with-simulated-robot", "(with-real-robot")


class Run:
    """A run of a text, with what it was like."""

    def __init__(self, folder, name, text, *options):
        self.plan = os.path.join(folder, f"{name}.plan")
        self.episode = os.path.join(folder, name)
        with open(self.plan, "w", encoding="utf-8") as file:
            file.write(text)
        self.began = time.monotonic()
        if "--real-robot" in options:
            options = (*options, *patient("world/pr2.sexp", folder))
        self.process = subprocess.Popen(
            [PROGRAM, *options, "run", self.plan, "--episode", self.episode],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def end(self, seconds):
        try:
            self.output, _ = self.process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.output, _ = self.process.communicate()
            check(False, f"{self.plan} hangs:\n{self.output}")
        self.seconds = time.monotonic() - self.began
        return self

    def lines(self, word):
        return [line for line in self.output.splitlines() if line.startswith(word)]

    def course(self):
        """What was performed by which part of the plan, and how it ended; parts that go on at once, each for itself."""
        with open(os.path.join(self.episode, "task.jsonl"), encoding="utf-8") as file:
            tasks = [json.loads(line) for line in file]
        # Of what goes on at once, one or the other is first.
        return sorted((task["path"], task["kind"], task["status"]) for task in tasks)


class Robot:
    """`planwright robot` with a bottle, as others hear it."""

    def __init__(self, setup):
        self.participant = DomainParticipant(77)

        def reader(topic, kind, qos):
            return DataReader(self.participant, Topic(self.participant, topic, kind), qos=qos)

        self.tf = reader("rt/tf", ros.TFMessage, ros.reliable(1000))
        self.joints = reader("rt/joint_states", ros.JointState, ros.reliable(1000))
        self.objects = reader("rt/objects", ros.MarkerArray, ros.latched())
        self.process = subprocess.Popen(
            [PROGRAM, f"--realtime={PACE}", "--setup", setup, "robot", "--ros2"],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        for line in self.process.stdout:
            if line.startswith("/detect_objects"):
                break
        self.markers = None

    def base(self):
        """Where the base is now."""
        self.tf.take(1000)
        end = time.monotonic() + 5
        while time.monotonic() < end:
            for message in self.tf.take(1000)[-1:]:
                at = message.transforms[0].transform
                return (at.translation.x, at.translation.y, at.rotation.z, at.rotation.w)
            time.sleep(0.005)
        check(False, "the robot tells of no frames")

    def bottle(self):
        """Where the bottle is now."""
        time.sleep(0.3)
        for message in self.objects.take(1000):
            self.markers = message.markers
        bottle = [marker for marker in self.markers or [] if marker.ns.upper() == "BOTTLE-1"]
        check(bottle, "the robot tells of no bottle")
        # The middle of its first solid.
        at = bottle[0].pose.position
        return [at.x, at.y, at.z]

    def rests(self, seconds):
        """When (s) within that time the base and the joints have moved last."""
        begin = time.monotonic()
        self.tf.take(1000), self.joints.take(1000)
        last, moved = {}, 0.0
        while time.monotonic() - begin < seconds:
            now = time.monotonic() - begin
            for message in self.joints.take(1000):
                for name, position in zip(message.name, message.position):
                    if abs(last.setdefault(name, position) - position) > 1e-4:
                        moved = now
                    last[name] = position
            for message in self.tf.take(1000):
                at = message.transforms[0].transform.translation
                for axis, value in (("x", at.x), ("y", at.y)):
                    if abs(last.setdefault(axis, value) - value) > 1e-4:
                        moved = now
                    last[axis] = value
            time.sleep(0.005)
        return moved

    def end(self):
        self.process.send_signal(signal.SIGINT)
        self.process.wait(timeout=20)


scratch = tempfile.TemporaryDirectory()
setup = os.path.join(scratch.name, "setup.plan")
with open(setup, "w", encoding="utf-8") as file:
    file.write(BOTTLE)

# Without a robot, one sentence says what is needed.
bare = Run(scratch.name, "bare", "(in-package :pp-tut)\n(with-real-robot 1)\n").end(60)
check("There is no robot to drive: start planwright with --real-robot" in bare.output, bare.output)

# The plan does not know the bottle; the robot's camera sees it.
start = "\n(with-simulated-robot\n  (get-ready-at-table)\n  (let ((bottle (find-bottle)))\n    (show-place \"BEGIN\")\n    (pick-bottle bottle :right)\n    (put-bottle bottle :right)))\n(show-place \"END\")\n"
text = PLAN + ENDS + start
here = Run(scratch.name, "here", BOTTLE + text, "--faithful").end(120)
check(here.lines("END"), f"the plan fails in simulation:\n{here.output}")
robot = Robot(setup)
try:
    before = robot.bottle()
    there = Run(scratch.name, "there", real(text), f"--realtime={PACE}", "--real-robot").end(180)
    check(there.lines("END"), f"the plan fails on the robot:\n{there.output}")
    others = set(here.course()) ^ set(there.course())
    check(here.course() == there.course(), f"another course: {others}\n{there.output}")
    ends = [[float(number) for number in run.lines("END")[0].split()[1:]] for run in (here, there)]
    # What it was moved by there, from where both have had it.
    begin = here.lines("BEGIN")[0].split()[1:]
    moved = zip(begin, before, robot.bottle())
    ends.append([float(begin) + after - before for begin, before, after in moved])
    for what, other in zip(("as the plan believes", "as it is there"), ends[1:]):
        beside = max(abs(a - b) for a, b in zip(ends[0], other))
        print(f"the bottle ends {1e3 * beside:.1f} mm beside where it does in simulation, {what}")
        check(beside < 0.01, f"the bottle is elsewhere: {ends}")
    x, y, *_ = robot.base()
    beside = max(abs(x + 0.15), abs(y - 2.0))
    print(f"the base ends {1e3 * beside:.1f} mm beside where it does in simulation; the run took {there.seconds:.0f} s")
    check(beside < 0.01, f"the base is at {x}, {y}")

    # The same failures.
    failing = "(in-package :pp-tut)\n" + FAILURES
    here = Run(scratch.name, "failing-here", simulated(failing), "--faithful").end(60)
    there = Run(scratch.name, "failing-there", failing, f"--realtime={PACE}", "--real-robot").end(120)
    for one, other in zip(here.lines("FAILURE"), there.lines("FAILURE")):
        print(other[:110])
        check(one.split(":")[0] == other.split(":")[0], f"another failure: {one} | {other}")
    check(len(here.lines("FAILURE")) == len(there.lines("FAILURE")) == 6, f"{here.output} {there.output}")

    # Ctrl-C and `kill` let the robot stop; it does not move after that.
    away = """(in-package :pp-tut)
(let ((?pose (make-pose "map" '((-1.447 -0.15 0) (0 0 -0.7071 0.7071)))))
  (with-real-robot (perform (a motion (type going) (target (a location (pose ?pose)))))))
(format t "~&ARRIVED~%")
"""
    for number, ending in enumerate((signal.SIGINT, signal.SIGTERM, signal.SIGINT)):
        before = robot.base()
        run = Run(scratch.name, f"stopped-{number}", away, f"--realtime={PACE}", "--real-robot")
        deadline = time.monotonic() + 30
        while time.monotonic() < deadline:
            x, y, *_ = robot.base()
            if abs(x - before[0]) + abs(y - before[1]) > 0.05:
                break
        check(time.monotonic() < deadline, "the robot does not begin to move")
        run.process.send_signal(ending)
        moved = robot.rests(2.5)
        run.end(20)
        print(f"{ending.name}: the robot stands after {1e3 * moved:.0f} ms")
        timely(moved < 0.5, f"the robot moves on after {ending.name}")
        check(moved < 2.0, f"the robot moves on after {ending.name}")
        check("DOES NOT STAND STILL" not in run.output, run.output)
        check(not run.lines("ARRIVED"), "the plan goes on after Ctrl-C")
        status = run.process.returncode
        check(status == 143 if ending is signal.SIGTERM else status != 0, f"{ending.name} ends with status {status}")
finally:
    robot.end()
print("ROS 2: the plan on a robot in another process does what it does in simulation")

"""Lets plans drive the base of a robot of ROS 1 through the bridge: `planwright --real-robot`, and a robot that is a simple action server of
Debian's actionlib with tf and joint states of its own, which also lies, refuses, dies and returns."""

import os
import signal
import sys
import time

from programs import LOOPBACK, Program, bridge, wait_for_master

os.environ["CYCLONEDDS_URI"] = LOOPBACK

from checks import check, patient

PROGRAM = sys.argv[1]
PLAN = """
(in-package :pp-tut)
(defun drive (x y)
  (let ((?pose (make-pose "map" (list (list x y 0) '(0 0 0 1)))))
    (format t "~&END ~a~%"
            (handler-case (progn (with-real-robot (perform (a motion (type going) (target (a location (pose ?pose)))))) "reached")
              (cram-common-failures:low-level-failure (failure)
                (format nil "~a: ~a" (type-of failure) (substitute #\\Space #\\Newline (princ-to-string failure))))))))
(defun where ()
  (let ((at (cl-tf:origin (btr:link-pose (btr:get-robot-object) "base_footprint"))))
    (format t "~&AT ~,4f ~,4f~%" (cl-tf:x at) (cl-tf:y at))))
(format t "~&READY~%")
"""


def robot(manner="honest"):
    """The robot of ROS 1, once it serves `move_base`."""
    started = Program([sys.executable, "tests/ros1/base.py", manner])
    started.expect("serves")
    return started


wait_for_master()
carrying = bridge("--robot", "ros1")
folder = os.environ["ROS_HOME"]
plan = Program([PROGRAM, *patient("world/pr2.sexp", folder), "--real-robot"])
plan.tell(PLAN)
plan.expect("READY")


def drive(x, y, seconds=30):
    """What a plan makes of a drive, and after what time."""
    begin = time.monotonic()
    plan.tell(f"(drive {x} {y})\n")
    end = plan.expect("END ", seconds)[4:].strip()
    return end, time.monotonic() - begin


# Nobody is there: the bridge serves nothing in ROS 2 then.
end, took = drive(-0.3, 0.6)
print(f"no robot ({took:.1f} s): {end[:110]}")
check("NAVIGATION-LOW-LEVEL-FAILURE" in end, f"without a robot: {end}")

base = robot()
carrying.expect("is served in ROS 2")
end, took = drive(-0.3, 0.6)
check(end == "reached", f"a drive: {end}")
base.expect("there")
plan.tell("(where)\n")
x, y = map(float, plan.expect("AT ").split()[1:])
check(abs(x + 0.3) < 0.05 and abs(y - 0.6) < 0.05, f"the plan believes to be at {x}, {y}")
print(f"honest ({took:.1f} s): reached, and believed at {x}, {y}")

# What cannot be is refused by the trial, and the robot learns nothing of it.
goals = len([line for line in base.said if "goal" in line])
end, _ = drive(-1.0, 1.5)
check("NAVIGATION" in end and "island" in end, f"a goal in the furniture: {end}")
check(len([line for line in base.said if "goal" in line]) == goals, "the robot gets a goal that the trial has refused")

# Ctrl-C on the way: the robot stands, and the plan is not left hanging.
plan.tell("(drive 0.15 0.6)\n")
base.expect("goal")
time.sleep(0.4)
plan.process.send_signal(signal.SIGINT)
cancelled = base.expect("preempted", 5)
print(f"Ctrl-C: {cancelled.strip()}")
plan.tell("(format t \"~&AGAIN~%\")\n")
plan.expect("AGAIN", 10)

# Robots that are not honest.
for manner, kind, words in (
    ("rejects", "NAVIGATION-POSE-UNREACHABLE", ""),
    ("aborts", "NAVIGATION-GOAL-NOT-REACHED", "the wheels are stuck"),
    ("beside", "NAVIGATION-GOAL-NOT-REACHED", "reported success"),
    ("preempts", "NAVIGATION-GOAL-NOT-REACHED", ""),
    ("mute", "reached", ""),
    ("dies", "NAVIGATION-LOW-LEVEL-FAILURE", ""),
):
    base.end(signal.SIGKILL)
    carrying.expect("not served in ROS 2 any more")
    base = robot(manner)
    carrying.expect("is served in ROS 2")
    # Until its joints are heard: a plan does nothing without.
    time.sleep(2)
    end, took = drive(-0.2, 0.6)
    print(f"{manner} ({took:.1f} s): {end[:140]}")
    check(kind in end and words in end, f"{manner}: {end}")
    check(took < 20, f"{manner}: only after {took:.1f} s")

# A robot that has returned reaches goals again.
base.process.wait(10)
base = robot()
carrying.expect("is served in ROS 2")
time.sleep(2)
end, took = drive(-0.3, 0.6)
check(end == "reached", f"a robot that has returned: {end}")
print(f"returned ({took:.1f} s): reached")

# The bridge ends on the way: the robot stands.
plan.tell("(drive 0.15 0.6)\n")
base.expect("goal")
time.sleep(0.4)
check(carrying.end(signal.SIGTERM) == 0, "the bridge ends with another status")
base.expect("preempted", 5)
end = plan.expect("END ", 30)
print(f"the bridge ends: {end[4:140].strip()}")
check("NAVIGATION" in end, f"the bridge ends: {end}")
plan.process.stdin.close()
plan.process.wait(20)
print("ROS 1: plans drive as they should")

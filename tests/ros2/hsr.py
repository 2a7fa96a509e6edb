"""Lets the HSR, in another process, carry out a plan that brings a bottle from the table to the island, as its description's interface
has it: same end as in simulation."""

import os
import signal
import subprocess
import sys
import tempfile

from checks import check, patient

PROGRAM = sys.argv[1]
PACE = 4
BOTTLE = "(in-package :pp-tut)\n(btr-utils:spawn-object 'bottle-1 :bottle :pose '((-1.6 -0.9 0.82) (0 0 0 1)))\n"
PLAN = """(in-package :pp-tut)
(with-simulated-robot
  (let ((?spot (make-pose "map" '((-0.8 2 0.96) (0 0 0 1)))))
    (perform (an action (type transporting) (object (an object (type bottle)))
                        (target (a location (pose ?spot)))))
    (park-arms)))
(let ((at (cl-tf:origin (btr-utils:object-pose 'bottle-1))))
  (format t "~&END ~{~,5f ~}~%" (list (cl-tf:x at) (cl-tf:y at) (cl-tf:z at))))
"""

scratch = tempfile.TemporaryDirectory()


def write(name, text):
    path = os.path.join(scratch.name, name)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def run(path, *options):
    """Where the bottle is at the end."""
    command = [PROGRAM, "--robot", "hsr", *options, "run", path]
    ran = subprocess.run(command, capture_output=True, text=True, timeout=120)
    end = [line for line in ran.stdout.splitlines() if line.startswith("END")]
    check(end, f"{command} does not get to its end: {ran.stdout}{ran.stderr}")
    return [float(number) for number in end[0].split()[1:]]


here = run(write("here.plan", BOTTLE + PLAN), "--faithful")
command = [PROGRAM, "--robot", "hsr", f"--realtime={PACE}", "--setup", write("setup.plan", BOTTLE), "robot", "--ros2"]
robot = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
try:
    served = []
    for line in robot.stdout:
        served.append(line.split()[0])
        if line.startswith("/detect_objects"):
            break
    check("/hsrb/move_base" in served, f"the robot serves {served}")
    plan = write("there.plan", PLAN.replace("(with-simulated-robot", "(with-real-robot"))
    there = run(plan, f"--realtime={PACE}", "--real-robot", *patient("world/hsr.sexp", scratch.name))
finally:
    robot.send_signal(signal.SIGINT)
    robot.wait(timeout=20)
beside = max(abs(a - b) for a, b in zip(here, there))
print(f"HSR: the bottle ends {1e3 * beside:.1f} mm beside where it does in simulation")
check(beside < 0.01, f"the bottle is elsewhere: {here} {there}")

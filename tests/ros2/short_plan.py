"""A short plan that drives, lifts the torso, looks, reaches and opens a hand, and the process that carries it out."""

import math
import queue
import re
import subprocess
import threading

from checks import check

PLACES = [(0.0, 0.0, 0.0), (0.0, -0.4, 0.0), (0.15, -0.2, 0.3)]
ARMS = [(1.9, 0.2, 1.4, -1.8, 1.3, -0.6, 0.4), (1.8, 0.4, 1.5, -2.0, 1.2, -0.5, 0.2)]
# Of the left arm, as in `ARMS`.
ARM_JOINTS = [
    f"l_{name}_joint"
    for name in ("shoulder_pan", "shoulder_lift", "upper_arm_roll", "elbow_flex", "forearm_roll", "wrist_flex", "wrist_roll")
]
PLAN = """(in-package :pp-tut)
(defun run (number ?pose ?height ?point ?arm ?opening)
  (format t "~&RUN ~a ~a~%" number
          (handler-case
              (with-real-robot
                (perform (a motion (type going) (target (a location (pose ?pose)))))
                (perform (a motion (type moving-torso) (joint-angle ?height)))
                (perform (a motion (type looking) (target (a location (pose ?point)))))
                (perform (a motion (type moving-arm-joints) (left-configuration ?arm)))
                (perform (a motion (type moving-gripper-joint) (gripper left) (joint-angle ?opening)))
                "done")
            (cram-common-failures:low-level-failure (failure)
              (format nil "~a: ~a" (type-of failure) (substitute #\\Space #\\Newline (princ-to-string failure)))))))
"""


class Goal:
    """Where a run is to end: a place, a height of the torso (m), positions of the arm, and how far the hand is to be open (m)."""

    def __init__(self, dice):
        self.place, self.height, self.arm = dice.choice(PLACES), dice.uniform(0.05, 0.15), dice.choice(ARMS)
        self.opening = dice.uniform(0.03, 0.08)

    def call(self, number):
        x, y, turn = self.place
        pose = f"""(make-pose "map" '(({x} {y} 0) (0 0 {math.sin(turn / 2)} {math.cos(turn / 2)})))"""
        point = """(make-pose "map" '((2 0 1) (0 0 0 1)))"""
        return f"(run {number} {pose} {self.height} {point} '({' '.join(map(str, self.arm))}) {self.opening})\n"


def impatient(path, **seconds):
    """Writes the description of the PR2 with other time-outs (s) of its parts, and of its servers."""
    with open("world/pr2.sexp", encoding="utf-8") as file:
        text = file.read()
    for name, limit in seconds.items():
        name = name.replace("_", "-")
        text, count = re.subn(rf"(\(interface {name} [^)]*:time-out )\d+", rf"\g<1>{limit}", text)
        check(count == 1, f"the description has no time-out of {name}")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


class Plan:
    """The plan's process, and what it says."""

    def __init__(self, command, **options):
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, text=True, **options)
        self.lines, self.errors = queue.Queue(), queue.Queue()
        for stream, lines in ((self.process.stdout, self.lines), (self.process.stderr, self.errors)):
            threading.Thread(target=self.read, args=(stream, lines), daemon=True).start()

    def read(self, stream, lines):
        for line in stream:
            lines.put(line.rstrip())

    def tell(self, text):
        try:
            self.process.stdin.write(text)
            self.process.stdin.flush()
        except BrokenPipeError:
            # That it has ended is found by who waits for an answer.
            pass

    def said(self, lines):
        """What has been said since."""
        said = []
        while not lines.empty():
            said.append(lines.get())
        return said

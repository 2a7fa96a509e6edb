"""Runs a short plan again and again on a robot behind a network with faults, each run with faults of its own from a seed: none hangs,
each ends in a success that is true or in a failure that names what has happened, and nothing moves after a goal was cancelled.

    faults.py PLANWRIGHT DISTRIBUTION [RUNS [FIRST]]
"""

import math
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

import messages as ros
from actions import GRIPPER, RequestHeader
from checks import check
from faulty_robot import DOMAIN, GRIPPER_JOINT, PARTS, Faults, Robot
from short_plan import PLAN, Goal, Plan, impatient

PROGRAM = sys.argv[1]
RUNS = int(sys.argv[3]) if len(sys.argv) > 3 else 4
FIRST = int(sys.argv[4]) if len(sys.argv) > 4 else 0
# No run takes longer (s): five motions, each with the time that a server, its answer and its end may take.
LIMIT = 60
# Which faults explain a failure with these words.
CARRIED = ("loss", "late")
CAUSES = {
    r"nobody serves": ("dies",),
    r"has not answered": (*CARRIED, "dies", "eager"),
    r"no result of|not begun it": (*CARRIED, "dies", "endless", "deaf", "eager"),
    r"the server of .* is gone": ("dies", *CARRIED),
    r"does not know the goal": ("dies", *CARRIED),
    r"reported success": ("idle", "beside", "eager"),
    r"has rejected": ("rejects",),
    r"has given up": ("aborts", *CARRIED),
    r"cancelled by someone else": ("cancelled",),
    r"was cancelled, AND NOTHING": (*CARRIED, "deaf", "dies"),
    r"no joint states for|no transform of|no transform": ("jump", "stop", "silent"),
    r"did not stand still": ("deaf", "dies", "silent", "stop", "jump", *CARRIED),
}


def calibrated():
    """The frame of the base, the joints, and gaps of the left hand with the positions of its joint, as planwright has them."""
    robot = subprocess.Popen([PROGRAM, "robot", "--ros2"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    try:
        for line in robot.stdout:
            if line.startswith("/detect_objects"):
                break
        participant = DomainParticipant(DOMAIN)
        tf = DataReader(participant, Topic(participant, "rt/tf", ros.TFMessage), qos=ros.reliable(100))
        states = DataReader(participant, Topic(participant, "rt/joint_states", ros.JointState), qos=ros.reliable(100))
        inner = f"{PARTS['hand'][0]}/_action/"
        goals = Topic(participant, f"rq/{inner}send_goalRequest", GRIPPER["send_goal"])
        goals = DataWriter(participant, goals, qos=ros.reliable(10))
        asking = Topic(participant, f"rq/{inner}get_resultRequest", GRIPPER["get_result"])
        asking = DataWriter(participant, asking, qos=ros.reliable(10))
        results = Topic(participant, f"rr/{inner}get_resultReply", GRIPPER["result"])
        results = DataReader(participant, results, qos=ros.reliable(10))
        frame, joints, gaps = None, None, []

        def hear(seconds):
            nonlocal frame, joints
            gap, end = None, time.monotonic() + seconds
            while time.monotonic() < end and gap is None:
                for message in tf.take(100):
                    frame = message.transforms[0].child_frame_id
                for message in states.take(100):
                    joints = dict(zip(message.name, message.position))
                for message in results.take(100):
                    gap = message.position
                time.sleep(0.01)
            return gap

        hear(1.5)
        for number, gap in enumerate((0.085, 0.06, 0.04, 0.02)):
            identity = [number + 1] * 16
            goals.write(GRIPPER["send_goal"](RequestHeader([1] * 8, number + 1, 0), identity, gap, 50.0))
            hear(0.1)
            asking.write(GRIPPER["get_result"](RequestHeader([1] * 8, number + 1, 0), identity))
            heard = hear(10)
            # Where the joint is then.
            hear(0.2)
            check(heard is not None and abs(heard - gap) < 0.01, f"the fingers do not open to {gap}: {heard}")
            gaps.append((heard, joints[GRIPPER_JOINT]))
        return frame, joints, gaps
    finally:
        robot.send_signal(signal.SIGINT)
        robot.wait(timeout=20)


def is_explained(text, faults, part):
    """Whether the faults of a run can have led to a failure, which speaks of the part that is concerned."""
    for words, causes in CAUSES.items():
        if re.search(words, text):
            of_carrying = any(getattr(faults, name) for name in ("loss", "late") if name in causes)
            return of_carrying or faults.special in causes
    return False


def run(number, robot, plan):
    """A run: what has come of it, and whether that is as it must be."""
    faults = Faults(number)
    dice = random.Random(f"plan {number}")
    goal = Goal(dice)
    place, height, arm = goal.place, goal.height, goal.arm
    turn = place[2]
    plan.said(plan.lines), plan.said(plan.errors)
    robot.new_run(faults)
    plan.tell(goal.call(number))
    begin, end, said = robot.now, None, []
    while end is None:
        robot.step()
        check(robot.now - begin < LIMIT, f"run {number} hangs ({faults}): {said} {plan.said(plan.errors)}")
        said += plan.said(plan.lines)
        end = next((line for line in said if line.startswith(f"RUN {number} ")), None)
        check(plan.process.poll() is None, f"run {number}: the plan has ended: {plan.said(plan.errors)}")
    seconds = robot.now - begin
    text = end.split(" ", 2)[2]
    at = (list(robot.pose), dict(robot.joints))
    goals = len(robot.begun)
    if text == "done":
        beside = math.dist(robot.pose[:2], place[:2])
        check(beside < 0.05, f"run {number}: success {beside} m beside the goal ({faults})")
        turned = abs(math.remainder(robot.pose[2] - turn, math.tau))
        check(turned < 0.1, f"run {number}: success turned by {turned} rad ({faults})")
        torso = abs(robot.joints["torso_lift_joint"] - height)
        check(torso < 0.005, f"run {number}: success with the torso {torso} m beside ({faults})")
        names = [name for name in robot.joints if name.startswith("l_") and not "gripper" in name]
        pan = abs(robot.joints["l_shoulder_pan_joint"] - arm[0])
        check(pan < 0.17, f"run {number}: success with the arm {pan} rad beside ({faults}) {names}")
    else:
        check(is_explained(text, faults, None), f"run {number}: {text!r} does not name what happened: {faults}")
    # What was given up ends, and nothing else begins.
    is_shouted = lambda: any("STAND STILL" in line or "NOTHING SAYS" in line for line in plan.errors.queue)
    is_told = "NOTHING SAYS" in text or "is gone" in text
    until = robot.now + (0.3 if text == "done" else 2.5)
    while robot.now < until and (text == "done" or robot.runs() or robot.queue):
        robot.step()
    running = robot.runs()
    check(not running or is_told or is_shouted(), f"run {number}: {running} go on after {text!r} ({faults})")
    late = [part for when, part in robot.begun[goals:]]
    # What arrives late must be cancelled at once.
    moved = math.dist(at[0][:2], robot.pose[:2]) + max(abs(at[1][name] - robot.joints[name]) for name in at[1])
    is_quiet = moved < 0.02 or late or is_told or is_shouted()
    check(is_quiet, f"run {number}: it moves by {moved} after {text!r} ({faults})")
    robot.heal()
    print(f"{number}: {text[:110]} [{faults}] {seconds:.1f} s", flush=True)
    return text, seconds


frame, joints, gaps = calibrated()
robot = Robot(frame, joints, gaps)
scratch = tempfile.TemporaryDirectory()
description = os.path.join(scratch.name, "pr2.sexp")
impatient(description, base=4, torso=3, neck=2, left_arm=3, left_gripper=3, server=4)
plan = Plan([PROGRAM, "--robot-description", description, f"--real-robot={sys.argv[2]}"])
try:
    plan.tell(PLAN)
    results = [run(number, robot, plan) for number in range(FIRST, FIRST + RUNS)]
    plan.process.stdin.close()
    plan.process.wait(timeout=20)
finally:
    plan.process.kill()
done = sum(text == "done" for text, _ in results)
slowest = max(seconds for _, seconds in results)
print(f"ROS 2: {len(results)} runs with faults: {done} arrived, {len(results) - done} failed and said why; the slowest took {slowest:.0f} s")

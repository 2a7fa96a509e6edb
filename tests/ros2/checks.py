"""How the checks of ROS 2 fail."""

import os
import sys


def check(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def patient(description, folder):
    """Options for a plan that drives the robot of a description: on a machine that is busy with other things, what is known of the
    robot may be older than otherwise, if that is asked for."""
    if not os.environ.get("PATIENT"):
        return []
    with open(description, encoding="utf-8") as file:
        text = file.read()
    for usual, longer in ((":max-age 0.5)", ":max-age 3)"), ("(interface map :name map :max-age 1)", "(interface map :name map :max-age 3)")):
        check(text.count(usual) == 1, f"{description} has no {usual}")
        text = text.replace(usual, longer)
    path = os.path.join(folder, os.path.basename(description))
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return ["--robot-description", path]


def timely(condition, what):
    """What a machine that is busy with other things may miss is only told, if that is asked for."""
    if not condition and os.environ.get("PATIENT"):
        print(f"not in time: {what}")
    else:
        check(condition, what)

"""How the checks of ROS 2 fail."""

import os
import sys


def check(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def timely(condition, what):
    """What a machine that is busy with other things may miss is only told, if that is asked for."""
    if not condition and os.environ.get("PATIENT"):
        print(f"not in time: {what}")
    else:
        check(condition, what)

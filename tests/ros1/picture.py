"""Takes a picture of what rviz of ROS 1 shows of a session, on a screen that there is not: robot, kitchen, a bottle, frames."""

import os
import subprocess
import sys
import time

from programs import Program, bridge, eventually, wait_for_master

import rospy

from checks import check

PROGRAM, PICTURE = sys.argv[1], sys.argv[2]
BEGIN = """
(in-package :pp-tut)
(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)) :bottle 'bottle-1 '(1 0 0))
(let ((?pose (make-pose "map" '((-1.447 -0.15 0) (0 0 -0.7071 0.7071)))))
  (with-simulated-robot
    (perform (an action (type going) (target (a location (pose ?pose)))))
    (perform (a motion (type moving-torso) (joint-angle 0.3)))))
(format t "~&arrived~%")
"""


def is_drawn():
    """Whether the picture has something of a bottle, which is the only red thing, and of the kitchen, which is dark."""
    pixels = subprocess.run(["convert", PICTURE, "-depth", "8", "rgb:-"], check=True, capture_output=True).stdout
    colors = list(zip(pixels[::3], pixels[1::3], pixels[2::3]))
    red = sum(r > 150 and g < 60 and b < 60 for r, g, b in colors)
    dark = sum(max(color) < 60 for color in colors)
    return red > 200 and dark > 30_000


wait_for_master()
carrying = bridge()
session = Program([PROGRAM, "--ros2"])
session.tell(BEGIN)
session.expect("arrived", 60)
eventually(lambda: rospy.get_param("/robot_description", ""), "the parameter robot_description is not there")
# The number of a screen that is free.
reading, writing = os.pipe()
screen = subprocess.Popen(
    ["Xvfb", "-displayfd", str(writing), "-screen", "0", "960x720x24", "-nolisten", "tcp"],
    pass_fds=[writing],
    stderr=subprocess.DEVNULL,
)
begun = [screen]
try:
    os.close(writing)
    display = ":" + os.read(reading, 16).decode().strip()
    environment = {"DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1", "XDG_RUNTIME_DIR": os.environ["ROS_HOME"]}
    rviz = Program(["rviz", "-d", "tests/ros1/scene.rviz"], **environment)
    begun.insert(0, rviz.process)
    # rviz says nothing when it has drawn: it is looked at until two pictures are the same, and no longer empty.
    last, end = b"", time.monotonic() + 90
    while True:
        time.sleep(5)
        check(rviz.process.poll() is None, f"rviz has ended: {''.join(rviz.said[-5:])}")
        command = ["import", "-window", "root", "-depth", "8", f"png:{PICTURE}"]
        subprocess.run(command, check=True, env={**os.environ, **environment})
        with open(PICTURE, "rb") as file:
            now = file.read()
        # The number of pictures a second, which rviz shows, changes some bytes.
        if is_drawn() and abs(len(now) - len(last)) < 500:
            break
        check(time.monotonic() < end, "rviz does not show a bottle in a kitchen")
        last = now
    wrong = [line for line in rviz.said if "ERROR" in line]
    check(not wrong, f"rviz complains: {wrong}")
finally:
    for program in begun:
        program.terminate()
        program.wait(10)
print(f"{PICTURE}: {len(now)} bytes. Look at it: robot, kitchen, a red bottle on the table, frames at hands and head")

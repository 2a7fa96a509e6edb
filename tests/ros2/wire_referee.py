"""Hears on the robot's own host, over its loopback, where the robot truly is, and writes it down: a line of JSON for each message of
joint states, `[time, [x, y, turn], {joint: position}]` with the time (s) of a clock that never jumps.

    wire_referee.py
"""

import json
import math
import os
import sys
import time

from cyclonedds.domain import DomainParticipant
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

import messages as ros

participant = DomainParticipant(int(os.environ["ROS_DOMAIN_ID"]))
tf = DataReader(participant, Topic(participant, "rt/tf", ros.TFMessage), qos=ros.reliable(10))
states = DataReader(participant, Topic(participant, "rt/joint_states", ros.JointState), qos=ros.reliable(10))
base = None
while True:
    for message in tf.take(100)[-1:]:
        at = message.transforms[0].transform
        base = [at.translation.x, at.translation.y, 2 * math.atan2(at.rotation.z, at.rotation.w)]
    for message in states.take(100)[-1:]:
        if base:
            print(json.dumps([time.monotonic(), base, dict(zip(message.name, message.position))]), flush=True)
    time.sleep(0.03)
    if os.getppid() == 1:
        sys.exit()

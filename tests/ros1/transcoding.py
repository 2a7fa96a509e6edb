"""Holds the bridge's way with bytes against the two libraries that know them: Cyclone DDS for ROS 2, genpy for ROS 1. What is cut off
or changed is refused, or is another message; it is never anything else."""

import io
import math
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../src/ros/ros1"))

from checks import check
from conversion import GarbledMessage
from layouts import Layouts
from transcoding import Transcoder

LAYOUTS = Layouts("jazzy")
DICE = random.Random(7)
KINDS = {
    "tf2_msgs/msg/TFMessage": "tf2_msgs/TFMessage",
    "sensor_msgs/msg/JointState": "sensor_msgs/JointState",
    "visualization_msgs/msg/MarkerArray": "visualization_msgs/MarkerArray",
    "sensor_msgs/msg/Image": "sensor_msgs/Image",
    "sensor_msgs/msg/CameraInfo": "sensor_msgs/CameraInfo",
    "rosgraph_msgs/msg/Clock": "rosgraph_msgs/Clock",
}


def value(kind):
    """Any value of a type."""
    inner, bracket, length = kind.partition("[")
    if bracket:
        count = int(length[:-1]) if length != "]" else DICE.choice((0, 1, 2, 7))
        return [value(inner) for _ in range(count)]
    if inner == "string":
        return "".join(DICE.choice("abc_ü/1") for _ in range(DICE.randrange(9))).lstrip("/")
    if inner == "bool":
        return DICE.random() < 0.5
    if inner == "float64":
        return DICE.choice((0.0, -1.5, math.pi, 1e300, float("inf")))
    if inner == "float32":
        return DICE.choice((0.0, -1.5, 0.25))
    if "/" in inner:
        return message(inner)
    return DICE.randrange(100)


def message(name):
    return LAYOUTS.message(name)(*[value(kind) for _, kind in LAYOUTS.fields(name)])


def same(ros2, ros1):
    """Whether all that ROS 1 has is what ROS 2 has."""
    if isinstance(ros2, (list, tuple)):
        return len(ros2) == len(ros1) and all(map(same, ros2, ros1))
    if hasattr(ros1, "secs"):
        return (ros2.sec, ros2.nanosec) == (ros1.secs, ros1.nsecs)
    if hasattr(ros1, "__slots__"):
        return all(slot == "seq" or same(getattr(ros2, slot.lower()), getattr(ros1, slot)) for slot in ros1.__slots__)
    return ros2 == ros1


carried = garbled = 0
for ros2, ros1 in KINDS.items():
    transcoder = Transcoder(LAYOUTS, ros2, ros1)
    is_both_ways = not any(step[0] == "skip" for step in transcoder.steps) and "Marker" not in ros1
    for _ in range(100):
        original = message(ros2)
        bytes2 = original.serialize(use_version_2=False)
        bytes1 = transcoder.to_ros1(bytes2)
        arrived = transcoder.ros1()
        arrived.deserialize(bytes1)
        check(same(original, arrived), f"{ros1}: {arrived} is not {original}")
        written = io.BytesIO()
        arrived.serialize(written)
        check(written.getvalue() == bytes1, f"{ros1}: genpy writes other bytes")
        if is_both_ways:
            back = transcoder.to_ros2(bytes1)
            check(back.rstrip(b"\0") == bytes2.rstrip(b"\0"), f"{ros1}: it does not come back as it went")
            check(LAYOUTS.message(ros2).deserialize(back + bytes(-len(back) % 4)) == original, f"{ros1}: Cyclone reads another message")
        carried += 1
        # Cut off anywhere, or with a byte changed.
        for source, carry in ((bytes2, transcoder.to_ros1), *([(bytes1, transcoder.to_ros2)] if is_both_ways else [])):
            for _ in range(20):
                cut = source[: DICE.randrange(len(source) - 3)]
                changed = bytearray(source)
                changed[DICE.randrange(len(source))] = DICE.choice((0, 1, 127, 255))
                for wrong in (cut, bytes(changed), b"\xff" * len(source)):
                    try:
                        carry(wrong)
                    except GarbledMessage:
                        garbled += 1
print(f"bytes: {carried} messages carried; {garbled} that were cut off or changed are refused")
check(garbled > 1000, "what is cut off is carried")

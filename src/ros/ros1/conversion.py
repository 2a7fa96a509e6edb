"""Messages of ROS 1 out of those of ROS 2, and the other way, field by field.

A field that one of them lacks has the value that messages have by themselves: `seq` of headers in ROS 1, textures of
markers in ROS 2. Names of frames lose the slash that old nodes of ROS 1 put before them."""

import rospy
from roslib.message import get_message_class

FRAMES = ("frame_id", "child_frame_id")
NUMBERS = ("bool", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64")


class GarbledMessage(Exception):
    """What is not the message that it is to be, or what the other ROS has no words for."""


class MissingMessage(Exception):
    """A message of ROS 1 that is not installed."""


def ros1_class(name):
    """The class of a message of ROS 1 such as `std_msgs/String`."""
    found = get_message_class(name)
    if found is None:
        raise MissingMessage(f"ROS 1 has no message {name} here: its package is not installed, or not on PYTHONPATH")
    return found


def frame(name):
    """The name of a frame as tf2 has it."""
    return name.lstrip("/")


def checked_time(seconds, nanoseconds):
    """Seconds and nanoseconds of a time that both have: libraries of ROS 1 abort on others, also those of tf2."""
    if not (0 <= seconds < 2**31 and 0 <= nanoseconds < 10**9):
        raise GarbledMessage(f"{seconds} s and {nanoseconds} ns is no time that both ROS 1 and ROS 2 have")
    return seconds, nanoseconds


class ToRos1:
    """Makes messages of a class of ROS 1 out of those of ROS 2."""

    made = {}

    @classmethod
    def of(cls, kind):
        if kind not in cls.made:
            cls.made[kind] = cls(kind)
        return cls.made[kind]

    def __init__(self, kind):
        self.kind = kind
        slots = zip(kind.__slots__, kind._slot_types)
        self.fields = [(slot, field_to_ros1(slot, slot_type)) for slot, slot_type in slots]
        # ROS 2 has no capitals in names of fields: D of CameraInfo is d there.
        self.names = {slot: slot.lower() for slot in kind.__slots__}

    def __call__(self, message):
        result = self.kind()
        for slot, convert in self.fields:
            value = getattr(message, self.names[slot], None)
            if value is not None:
                setattr(result, slot, convert(value))
        return result


def field_to_ros1(name, kind):
    if kind == "time":
        return lambda value: rospy.Time(*checked_time(value.sec, value.nanosec))
    if kind == "duration":
        return lambda value: rospy.Duration(value.sec, value.nanosec)
    if name in FRAMES:
        return frame
    inner, bracket, _ = kind.partition("[")
    if inner in NUMBERS or inner == "string":
        if bracket and inner in ("uint8", "char"):
            return bytes
        return list if bracket else (lambda value: value)
    convert = ToRos1.of(ros1_class(inner))
    return (lambda values: [convert(value) for value in values]) if bracket else convert


class ToRos2:
    """Makes messages of ROS 2 out of those of ROS 1, by a table of layouts."""

    def __init__(self, layouts, name):
        self.kind = layouts.message(name)
        self.fields = [(field, field_to_ros2(layouts, field, kind)) for field, kind in layouts.fields(name)]

    def __call__(self, message):
        return self.kind(*[convert(getattr(message, field)) for field, convert in self.fields])


def field_to_ros2(layouts, name, kind):
    if kind == "builtin_interfaces/msg/Time":
        make = layouts.message(kind)
        return lambda value: make(*checked_time(value.secs, value.nsecs))
    if name in FRAMES:
        return frame
    inner, bracket, _ = kind.partition("[")
    if inner in NUMBERS or inner == "string":
        return list if bracket else (lambda value: value)
    convert = ToRos2(layouts, inner)
    return (lambda values: [convert(value) for value in values]) if bracket else convert


def is_finite(*numbers):
    """Whether all of them are numbers, and none is infinite."""
    return all(number - number == 0 for number in numbers)


def wrong_pose(pose):
    """What is wrong with the numbers of a pose of either ROS, or None."""
    at, turn = pose.position, pose.orientation
    if not is_finite(at.x, at.y, at.z):
        return f"the position ({at.x}, {at.y}, {at.z}) is no place: finite numbers of metres were expected"
    if not is_finite(turn.x, turn.y, turn.z, turn.w):
        return f"the orientation ({turn.x}, {turn.y}, {turn.z}, {turn.w}) is no rotation: finite numbers were expected"
    if turn.x**2 + turn.y**2 + turn.z**2 + turn.w**2 < 1e-6:
        return "the orientation is a quaternion of length 0, which is no rotation: without one, w is to be 1"
    return None

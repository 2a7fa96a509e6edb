"""What plans need to know of a robot of ROS 1, carried from there to ROS 2."""

import rospy

from conversion import GarbledMessage, ToRos2, ros1_class
from dds import Writer, latched, reliable, tell
from static_frames import StaticFrames
from transcoding import Transcoder

# The topic, and its message in ROS 1 and ROS 2.
MOVING = (
    ("tf", "tf2_msgs/TFMessage", "tf2_msgs/msg/TFMessage", 100),
    ("joint_states", "sensor_msgs/JointState", "sensor_msgs/msg/JointState", 10),
)


def publisher_of(message):
    """The name of the node that has published a message."""
    return message._connection_header.get("callerid", "?")


def keep(message, data):
    """A message stays the bytes that it is."""
    message.data = bytes(data)
    return message


class ToRos2Topics:
    """All topics that go this way."""

    def __init__(self, node, layouts):
        self.node, self.garbled = node, set()
        self.subscribers = [self.carry(layouts, *topic) for topic in MOVING]
        self.frames = StaticFrames()
        kind = "tf2_msgs/msg/TFMessage"
        self.static, self.to_static = Writer(node, "rt/tf_static", layouts.message(kind), latched()), ToRos2(layouts, kind)
        hear = lambda message: node.call(self.hear_static, publisher_of(message), message)
        # A publisher that is gone is not reported: what it has told of still frames stays true for tf of ROS 1.
        self.subscribers.append(rospy.Subscriber("/tf_static", ros1_class("tf2_msgs/TFMessage"), hear, queue_size=100))

    def carry(self, layouts, name, ros1, ros2, depth):
        kind = layouts.bytes_of(ros2)
        writer = Writer(self.node, f"rt/{name}", kind, reliable(depth))
        transcoder = Transcoder(layouts, ros2, ros1)
        heard = type(transcoder.ros1.__name__, (transcoder.ros1,), {"__slots__": ("data",), "deserialize": keep})

        def hear(message):
            # What the bridge itself has published must not come back.
            if publisher_of(message) != rospy.get_name():
                write = lambda: writer.write(kind.carry(transcoder.to_ros2(message.data)))
                self.node.call(self.guard, name, write)

        return rospy.Subscriber(f"/{name}", heard, hear, queue_size=depth)

    def guard(self, name, deed):
        """Leaves out what cannot be carried."""
        try:
            deed()
        except GarbledMessage as error:
            if name not in self.garbled:
                self.garbled.add(name)
                tell(f"a message of /{name} of ROS 1 cannot be read and is left out: {error}")

    def hear_static(self, publisher, message):
        if publisher != rospy.get_name():
            self.frames.hear(publisher, message.transforms)
            merged = type(message)(self.frames.merged())
            self.guard("tf_static", lambda: self.static.write(self.to_static(merged)))

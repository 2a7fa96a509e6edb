"""What plans need to know of a robot of ROS 1, carried from there to ROS 2."""

import rospy

from conversion import ToRos2, ros1_class
from dds import Writer, latched, reliable
from static_frames import StaticFrames

# The topic, and its message in ROS 1 and ROS 2.
MOVING = (
    ("tf", "tf2_msgs/TFMessage", "tf2_msgs/msg/TFMessage", 100),
    ("joint_states", "sensor_msgs/JointState", "sensor_msgs/msg/JointState", 10),
)


def publisher_of(message):
    """The name of the node that has published a message."""
    return message._connection_header.get("callerid", "?")


class ToRos2Topics:
    """All topics that go this way."""

    def __init__(self, node, layouts):
        self.node = node
        self.subscribers = [self.carry(layouts, *topic) for topic in MOVING]
        self.frames = StaticFrames()
        kind = "tf2_msgs/msg/TFMessage"
        self.static, self.to_static = Writer(node, "rt/tf_static", layouts.message(kind), latched()), ToRos2(layouts, kind)
        hear = lambda message: node.call(self.hear_static, publisher_of(message), message)
        # A publisher that is gone is not reported: what it has told of still frames stays true for tf of ROS 1.
        self.subscribers.append(rospy.Subscriber("/tf_static", ros1_class("tf2_msgs/TFMessage"), hear, queue_size=100))

    def carry(self, layouts, name, ros1, ros2, depth):
        writer = Writer(self.node, f"rt/{name}", layouts.message(ros2), reliable(depth))
        convert = ToRos2(layouts, ros2)

        def hear(message):
            # What the bridge itself has published must not come back.
            if publisher_of(message) != rospy.get_name():
                self.node.call(lambda: writer.write(convert(message)))

        return rospy.Subscriber(f"/{name}", ros1_class(ros1), hear, queue_size=depth)

    def hear_static(self, publisher, message):
        if publisher != rospy.get_name():
            self.frames.hear(publisher, message.transforms)
            merged = type(message)(self.frames.merged())
            self.static.write(self.to_static(merged))

"""Topics of a session of planwright, carried from ROS 2 to ROS 1."""

import time

import rospy

from conversion import MissingMessage, ToRos1, ros1_class
from dds import Reader, best_effort, latched, reliable, tell
from static_frames import StaticFrames
from transcoding import Transcoder

# The topic; the message of ROS 2 and of ROS 1; what is asked for in ROS 2; whether who comes later gets the last message.
TOPICS = (
    ("tf", "tf2_msgs/msg/TFMessage", "tf2_msgs/TFMessage", reliable(100), False),
    ("joint_states", "sensor_msgs/msg/JointState", "sensor_msgs/JointState", reliable(100), False),
    ("kitchen/joint_states", "sensor_msgs/msg/JointState", "sensor_msgs/JointState", reliable(100), False),
    ("robot_description", "std_msgs/msg/String", "std_msgs/String", latched(), True),
    ("objects", "visualization_msgs/msg/MarkerArray", "visualization_msgs/MarkerArray", latched(), True),
    ("kitchen/furniture", "visualization_msgs/msg/MarkerArray", "visualization_msgs/MarkerArray", latched(), True),
)
# Asked for only while somebody listens, since planwright draws only then.
CAMERA = (
    ("camera/image", "sensor_msgs/msg/Image", "sensor_msgs/Image", best_effort(5), False),
    ("camera/camera_info", "sensor_msgs/msg/CameraInfo", "sensor_msgs/CameraInfo", best_effort(5), False),
)
CLOCK = ("clock", "rosgraph_msgs/msg/Clock", "rosgraph_msgs/Clock", best_effort(1), False)
STATIC = ("tf_static", "tf2_msgs/msg/TFMessage", "tf2_msgs/TFMessage", latched(100), True)
# How many messages wait for a listener that is slow.
QUEUE = 100
# How often listeners and publishers are counted, in seconds.
COUNT = 0.5


def ready(kind):
    """Messages of a class of ROS 1 that are there as bytes already: `of(data)` makes one."""

    def serialize(message, buffer):
        buffer.write(message.data)

    @classmethod
    def of(cls, data):
        message = cls.__new__(cls)
        message.data = data
        return message

    # With a header, rospy would write a number into it.
    return type(kind.__name__, (kind,), {"__slots__": ("data",), "_has_header": False, "serialize": serialize, "of": of})


class Carried:
    """A topic that is carried."""

    def __init__(self, node, layouts, topic, wanted=lambda publisher: True):
        self.node, self.wanted = node, wanted
        self.name, ros2, ros1, self.quality, is_latched = topic
        self.kind, kind = self.prepare(layouts, ros2, ros1)
        self.publisher = rospy.Publisher(f"/{self.name}", kind, queue_size=QUEUE, latch=is_latched)
        self.reader = None
        self.look()

    def prepare(self, layouts, ros2, ros1):
        """The classes that the topic has in ROS 2 and in ROS 1."""
        self.transcoder = Transcoder(layouts, ros2, ros1)
        return layouts.bytes_of(ros2), ready(self.transcoder.ros1)

    def look(self):
        """Hears the topic as long as that is wanted."""
        is_wanted = self.wanted(self.publisher)
        if is_wanted and self.reader is None:
            self.reader = Reader(self.node, f"rt/{self.name}", self.kind, self.quality, self.hear)
        elif not is_wanted and self.reader is not None:
            self.reader.close()
            self.reader = None

    def hear(self, message, _):
        self.publisher.publish(self.publisher.data_class.of(self.transcoder.to_ros1(message.data)))


class Converted(Carried):
    """A topic whose messages the bridge itself has to understand."""

    def prepare(self, layouts, ros2, ros1):
        kind = ros1_class(ros1)
        self.convert = ToRos1.of(kind)
        return layouts.message(ros2), kind

    def hear(self, message, _):
        self.publisher.publish(self.convert(message))


class Description(Converted):
    """The description of the robot, which is also a parameter: RobotModel of rviz reads that, not the topic."""

    def hear(self, message, publisher):
        super().hear(message, publisher)
        try:
            rospy.set_param("/robot_description", message.data)
        except (OSError, rospy.ROSException) as error:
            tell(f"the parameter /robot_description cannot be set: {error}")


class Static(Converted):
    """Still frames."""

    def __init__(self, *arguments):
        self.frames = StaticFrames()
        super().__init__(*arguments)

    def look(self):
        super().look()
        if self.frames.keep(self.reader.writers()):
            self.publish()

    def hear(self, message, publisher):
        self.frames.hear(publisher, self.convert(message).transforms)
        self.publish()

    def publish(self):
        self.publisher.publish(self.publisher.data_class(self.frames.merged()))


class ToRos1Topics:
    """All topics that go this way."""

    def __init__(self, node, layouts, with_clock):
        kinds = {"robot_description": Description}
        has_listeners = lambda publisher: publisher.get_num_connections() > 0
        topics = [(kinds.get(topic[0], Carried), topic, ()) for topic in (*TOPICS, *([CLOCK] if with_clock else []))]
        topics += [(Carried, topic, (has_listeners,)) for topic in CAMERA]
        topics.append((Static, STATIC, ()))
        self.carried = []
        for kind, topic, more in topics:
            try:
                self.carried.append(kind(node, layouts, topic, *more))
            except MissingMessage as error:
                tell(f"/{topic[0]} is not carried: {error}")
        self.looked = 0.0
        node.every_tick(self.look)

    def look(self):
        now = time.monotonic()
        if now - self.looked >= COUNT:
            self.looked = now
            for carried in self.carried:
                carried.look()

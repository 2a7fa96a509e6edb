"""Comes late: says in one line of JSON what is there at once for a listener of ROS 1, and after what time."""

import json
import time

import rospy
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

rospy.init_node("late", anonymous=True)
TOPICS = {
    "/robot_description": String,
    "/tf_static": TFMessage,
    "/objects": MarkerArray,
    "/kitchen/furniture": MarkerArray,
}
begin = time.monotonic()
heard = {}
for topic, kind in TOPICS.items():
    rospy.Subscriber(topic, kind, lambda message, topic=topic: heard.__setitem__(topic, message))
while len(heard) < len(TOPICS) and time.monotonic() - begin < 10:
    time.sleep(0.01)
print(
    json.dumps(
        {
            "after": time.monotonic() - begin,
            "heard": sorted(heard),
            "description": heard["/robot_description"].data if "/robot_description" in heard else "",
            "parameter": rospy.get_param("/robot_description", ""),
            "still": [t.child_frame_id for t in heard["/tf_static"].transforms] if "/tf_static" in heard else [],
            "objects": [[m.ns, m.action] for m in heard["/objects"].markers] if "/objects" in heard else [],
            "furniture": len(heard["/kitchen/furniture"].markers) if "/kitchen/furniture" in heard else 0,
        }
    ),
    flush=True,
)

"""Hears a session of planwright as a node of ROS 2 would, and says what it lacks."""

import os
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml

from cyclonedds.domain import DomainParticipant
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

import messages as ros
from checks import check, timely

PROGRAM, SECONDS = sys.argv[1], float(sys.argv[2])
DOMAIN = 77
URDF = open("world/pr2.urdf", encoding="utf-8").read()

MOVING = """
(in-package :pp-tut)
(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)) :bottle 'bottle-1 '(1 0 0))
(format t "~&placed~%")
(let ((?pose (make-pose "map" '((-1.447 -0.15 0) (0 0 -0.7071 0.7071)))))
  (with-simulated-robot
    (perform (an action (type going) (target (a location (pose ?pose)))))
    (perform (a motion (type moving-torso) (joint-angle 0.3)))))
(format t "~&arrived ~s~%" (get-robot-transformation))
"""


def reader(participant, topic, kind, qos):
    return DataReader(participant, Topic(participant, topic, kind), qos=qos)


def wait(reader, seconds, enough=lambda sample: True):
    """The first sample that is enough, or None."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for sample in reader.take(100):
            if enough(sample):
                return sample
        time.sleep(0.005)
    return None


class Session:
    """planwright in a pipe."""

    def __init__(self, *options, **environment):
        self.process = subprocess.Popen(
            [PROGRAM, *options],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, **environment},
        )

    def tell(self, text):
        self.process.stdin.write(text)
        self.process.stdin.flush()

    def read_to(self, word):
        for line in self.process.stdout:
            if line.startswith(word):
                return line
        sys.exit(f"FAILED: {word} is not printed: {self.process.stderr.read()}")

    def end(self):
        self.process.stdin.close()
        self.process.stdout.read()
        return self.process.wait()


def refused(option, **environment):
    run = subprocess.run(
        [PROGRAM, "run", option, "--eval", "1"],
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
    )
    check(run.returncode == 2, f"{option} {environment} ends with {run.returncode}: {run.stderr}")
    return run.stderr


# What cannot be is refused before anything is sent.
check("(did you mean jazzy?)" in refused("--ros2=jazy"), "a distribution that is misspelt")
check("ROS_DOMAIN_ID" in refused("--ros2", ROS_DOMAIN_ID="500"), "a domain that there is not")
check("ROS_AUTOMATIC" in refused("--ros2", ROS_AUTOMATIC_DISCOVERY_RANGE="OFF"), "a wrong range")
check("klingon" in refused("--ros2", ROS_DISTRO="klingon"), "a distribution of the environment")

# Without anybody who asks, nothing is sent: the session ends as it does with a node.
scratch = tempfile.TemporaryDirectory()
journals = [os.path.join(scratch.name, name) for name in ("silent", "heard")]
silent = Session("--realtime=20", "--journal", journals[0])
silent.tell(MOVING)
where = silent.read_to("arrived")
silent.end()

participant = DomainParticipant(DOMAIN)
tf = reader(participant, "rt/tf", ros.TFMessage, ros.reliable(1000))
joints = reader(participant, "rt/joint_states", ros.JointState, ros.reliable(1000))
sensors = reader(participant, "rt/joint_states", ros.JointState, ros.best_effort(1000))
clock = reader(participant, "rt/clock", ros.Clock, ros.best_effort(1000))
images = reader(participant, "rt/camera/image", ros.Image, ros.best_effort(5))
infos = reader(participant, "rt/camera/camera_info", ros.CameraInfo, ros.best_effort(5))
elsewhere = reader(DomainParticipant(0), "rt/tf", ros.TFMessage, ros.reliable(10))
incompatible = reader(participant, "rt/tf", ros.TFMessage, ros.latched())

session = Session("--ros2", "--journal", journals[1])
check(wait(joints, 20) is not None, "no joint states are heard")
check(wait(tf, 20) is not None, "no frames are heard")
session.tell(MOVING)
session.read_to("placed")

# All joints that can move, in each message; each frame has one parent.
described = xml.fromstring(URDF)
kinds = {joint.get("name"): joint.get("type") for joint in described.iter("joint") if joint.get("type")}
movable = {name for name, kind in kinds.items() if kind != "fixed"}

heard = {"tf": [], "joints": [], "sensors": []}
clocks = 0
pictures, info = [], None
end = time.monotonic() + SECONDS
while time.monotonic() < end:
    for message in joints.take(1000):
        check(set(message.name) == movable, f"joints: {set(message.name) ^ movable}")
        lengths = {len(message.name), len(message.position), len(message.velocity)}
        check(lengths == {len(movable)} and len(message.effort) == 0, f"lengths: {lengths}")
        heard["joints"].append(message.header.stamp.nanoseconds())
        last_joints = message
    for message in sensors.take(1000):
        heard["sensors"].append(message.header.stamp.nanoseconds())
    for message in tf.take(1000):
        stamps = {frame.header.stamp.nanoseconds() for frame in message.transforms}
        check(len(stamps) == 1, "frames of one message have different stamps")
        heard["tf"].append(stamps.pop())
        last_tf = message
    clocks += len(clock.take(1000))
    pictures += images.take(10)
    info = (infos.take(10) or [info])[-1]
    time.sleep(0.005)

# What one topic has and another has not was lost; the first and the last messages may still be on their way.
stamps = set(heard["joints"]) | set(heard["tf"])
first, last = sorted(stamps)[3], sorted(stamps)[-4]
within = {stamp for stamp in stamps if first <= stamp <= last}
for topic in ("joints", "tf"):
    mine = [stamp for stamp in heard[topic] if first <= stamp <= last]
    check(mine == sorted(mine) and len(set(mine)) == len(mine), f"{topic}: doubled or out of order")
    lost = len(within) - len(mine)
    rate = len(mine) / (last - first) * 1e9
    print(f"{topic}: {len(mine)} in {(last - first) / 1e9:.1f} s ({rate:.1f}/s), {lost} lost")
    timely(lost <= 0.01 * len(within), f"{topic}: {lost} of {len(within)} lost")
    timely(50 <= rate <= 100, f"{topic}: {rate}/s")
timely(len(heard["sensors"]) > 0.9 * len(within), "a reader of best effort hears too little")
timely(clocks > 0.9 * len(within), f"the clock was heard {clocks} times")
rate = len(pictures) / SECONDS
print(f"pictures: {len(pictures)} in {SECONDS:.1f} s ({rate:.1f}/s)")
check(pictures and info, "the camera's pictures are not heard")
timely(2 <= rate <= 6, f"pictures: {rate}/s")
for picture in pictures:
    check(picture.encoding == "rgb8" and picture.step == 3 * picture.width, f"a picture in {picture.encoding}")
    check(len(picture.data) == picture.step * picture.height, f"a picture of {len(picture.data)} bytes")
    check(len(set(picture.data)) > 30, "a picture shows nothing")
check((info.width, info.height) == (picture.width, picture.height), "a camera of another size")
check(info.k[2] == info.width / 2 and info.k[0] == info.k[4] > 50, f"the camera is {info.k}")
check(len({bytes(picture.data) for picture in pictures}) > 2, "all pictures of a drive are the same")
now = time.time_ns()
timely(abs(now - max(stamps)) < 2e9, f"stamps are not of now: {now - max(stamps)} ns")

# Who comes later has the description, the still frames and the objects at once.
late = DomainParticipant(DOMAIN)
begin = time.monotonic()
latched = {
    "rt/robot_description": ros.String,
    "rt/tf_static": ros.TFMessage,
    "rt/objects": ros.MarkerArray,
    "rt/kitchen/furniture": ros.MarkerArray,
}
latched = {topic: reader(late, topic, kind, ros.latched()) for topic, kind in latched.items()}
late_values = {topic: wait(found, 10) for topic, found in latched.items()}
for topic, value in late_values.items():
    check(value is not None, f"who comes later does not get {topic}")
print(f"a late listener has all after {time.monotonic() - begin:.2f} s")
check(late_values["rt/robot_description"].data == URDF, "the description is not the URDF")
still = late_values["rt/tf_static"].transforms
frames = {frame.child_frame_id: frame.header.frame_id for frame in [*still, *last_tf.transforms]}
check(len(frames) == len(still) + len(last_tf.transforms), "a frame has two parents")
links = {link.get("name") for link in described.iter("link")}
check(links <= set(frames), f"links without frames: {links - set(frames)}")
check(picture.header.frame_id == info.header.frame_id in frames, f"pictures in {picture.header.frame_id}")
for frame in frames:
    steps = 0
    while frame != "map":
        frame, steps = frames[frame], steps + 1
        check(steps < 100, f"{frame} is in a circle")
objects = {marker.ns for marker in late_values["rt/objects"].markers}
check("BOTTLE-1" in {name.upper() for name in objects}, f"objects: {objects}")
check(len(late_values["rt/kitchen/furniture"].markers) > 20, "there is no furniture")
volatile = reader(late, "rt/robot_description", ros.String, ros.reliable(1))
check(wait(volatile, 0.5) is None, "who asks for nothing old gets something old")

# The node is in the graph of nodes, with its topics.
graph = reader(late, "ros_discovery_info", ros.ParticipantEntitiesInfo, ros.latched())
nodes = wait(graph, 5, lambda info: len(info.node_entities_info_seq[0].writer_gid_seq) >= 10)
check(nodes is not None, "the node is not announced with its topics")
node = nodes.node_entities_info_seq[0]
check((node.node_namespace, node.node_name) == ("/", "planwright"), f"the node is {node}")

# The robot arrives where it does without listeners, and is heard there.
there = session.read_to("arrived")
check("(-1.447" in there, f"the plan does not get there: {there}")
check(there == where, f"listeners change the result: {where} {there}")
base = wait(tf, 5, lambda message: abs(message.transforms[0].transform.translation.x + 1.447) < 0.03)
check(base is not None, "the base is not heard where it is")
torso = wait(joints, 5, lambda m: abs(m.position[list(m.name).index("torso_lift_joint")] - 0.3) < 0.01)
check(torso is not None, "the torso is not heard where it is")

check(len(elsewhere.take(10)) == 0, "another domain hears the session")
check(len(incompatible.take(10)) == 0, "a reader that cannot match hears the session")

# When the session ends, so does all that it sends.
check(session.end() == 0, "the session ends badly")
told = session.process.stderr.read()
check("listens to /tf in vain" in told and "(Durability)" in told, f"nothing is told of who cannot match: {told}")
check(told.count("in vain") == 1, f"others listen in vain: {told}")
deadline = time.monotonic() + 15
# A journal has the bits of the world after each input, as a number that they all enter into.
silent, loud = (open(journal, encoding="utf-8").read() for journal in journals)
check(silent == loud and silent.count("\nended ") >= 4, "listeners change the bits of the world")
while tf.get_matched_publications() and time.monotonic() < deadline:
    time.sleep(0.05)
check(not tf.get_matched_publications(), "the node is still there after its end")
print("ROS 2: all heard")

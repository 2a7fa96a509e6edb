"""Reads a recording of move-bottle with the Python packages `mcap` and `mcap-protobuf-support` and
checks that it shows what happened, in messages that conform to the schemas in the file, and that
these are Foxglove's, as the package `foxglove-sdk` has them.

    python3 tests/browser/check_recording.py RUN.mcap
"""

import math
import os
import sys
from collections import Counter
from xml.etree import ElementTree

import foxglove.messages
from google.protobuf import descriptor_pb2
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

SCHEMAS = {
    "/tf": "foxglove.FrameTransforms",
    "/tf_static": "foxglove.FrameTransforms",
    "/scene/robot_and_kitchen": "foxglove.SceneUpdate",
    "/scene/objects": "foxglove.SceneUpdate",
    "/scene/plans": "foxglove.SceneUpdate",
    "/scene/contacts": "foxglove.SceneUpdate",
    "/scene/tasks": "foxglove.SceneUpdate",
    "/joint_states": "foxglove.JointStates",
    "/camera/image": "foxglove.CompressedImage",
    "/camera/calibration": "foxglove.CameraCalibration",
    "/log": "foxglove.Log",
    "/tasks": "planwright.Task",
    "/shown": "planwright.Shown",
}
# Descriptions in URDF, as text, and their least numbers of links and shapes.
DESCRIPTIONS = {
    "/robot_description": ("robot", 40, 60),
    "/kitchen/robot_description": ("kitchen", 30, 60),
    "/objects/robot_description": ("objects", 1, 1),
}
LARGEST = 3_000_000


def types(data):
    """The messages in a set of descriptors, with their fields."""
    files = descriptor_pb2.FileDescriptorSet.FromString(data)
    found = {}
    for file in files.file:
        for message in file.message_type:
            found[f"{file.package}.{message.name}"] = {
                (f.name, f.number, f.type, f.label, f.type_name, f.proto3_optional) for f in message.field
            }
            for enum in message.enum_type:
                found[f"{file.package}.{message.name}.{enum.name}"] = {(v.name, v.number) for v in enum.value}
    return found


def check_description(name, links, shapes, data, frames):
    """A message with a description: a string of ROS 2 whose links are frames, or the map."""
    assert data[:4] == b"\0\1\0\0" and int.from_bytes(data[4:8], "little") == len(data) - 8 and data[-1] == 0
    robot = ElementTree.fromstring(data[8:-1].decode())
    names = [link.get("name") for link in robot.iter("link")]
    assert robot.get("name") == name and names[0] == "map", names
    assert len(names) > links and set(names[1:]) <= set(frames), set(names) - set(frames)
    assert len(robot.findall(".//visual/geometry/*")) >= shapes
    assert {joint.find("parent").get("link") for joint in robot.iter("joint")} == {"map"}


def main(path):
    size = os.path.getsize(path)
    assert size <= LARGEST, f"{size} bytes"
    counts, sizes, last_time = Counter(), Counter(), 0
    frames, joints, states, levels, base, entities, texts = {}, {}, {}, Counter(), [], {}, set()
    parameters, forces = {}, set()
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for schema, channel, message, value in reader.iter_decoded_messages(list(SCHEMAS), log_time_order=False):
            topic = channel.topic
            if not counts[topic]:
                assert schema.encoding == "protobuf" and channel.message_encoding == "protobuf"
                assert schema.name == SCHEMAS[topic], f"{topic}: {schema.name}"
                package, name = schema.name.split(".")
                if package == "foxglove":
                    theirs = types(getattr(foxglove.messages, name).get_schema().data)
                    ours = types(schema.data)
                    assert ours == theirs, f"{schema.name}: {[n for n in theirs if ours.get(n) != theirs[n]]}"
            counts[topic] += 1
            sizes[topic] += len(message.data)
            assert message.log_time >= last_time, "time runs backwards"
            last_time = message.log_time
            if topic in ("/tf", "/tf_static"):
                for one in value.transforms:
                    frames[one.child_frame_id] = one
                    q = one.rotation
                    assert abs(q.x**2 + q.y**2 + q.z**2 + q.w**2 - 1) < 1e-3, one
                if topic == "/tf":
                    base.append(frames["base_footprint"].translation)
            elif topic == "/scene/contacts":
                for entity in value.entities:
                    assert len(entity.arrows) == len(entity.texts)
                    forces.update(float(text.text.removesuffix(" N")) for text in entity.texts)
            elif topic.startswith("/scene/") and topic != "/scene/plans":
                for entity in value.entities:
                    texts.update(text.text for text in entity.texts)
                    if entity.triangles:
                        entities[entity.frame_id] = entity
                    for list_ in entity.triangles:
                        assert len(list_.indices) % 3 == 0
                        assert max(list_.indices) < len(list_.points)
            elif topic == "/joint_states":
                for joint in value.joints:
                    assert joint.HasField("position") and joint.HasField("velocity")
                    assert math.isfinite(joint.velocity) and abs(joint.velocity) < 20, joint
                    joints[joint.name] = joint.position
            elif topic == "/tasks":
                states[value.id] = value.state
                if value.parameters:
                    parameters[value.name] = {pair.key: pair.value for pair in value.parameters}
            elif topic == "/log":
                levels[value.level] += 1
            elif topic == "/camera/image":
                assert value.data.startswith(b"\x89PNG\r\n")
        assert set(counts) == set(SCHEMAS), sorted(counts)
        for schema, channel, message in reader.iter_messages(list(DESCRIPTIONS)):
            assert (schema.name, schema.encoding, channel.message_encoding) == ("std_msgs/msg/String", "ros2msg", "cdr")
            check_description(*DESCRIPTIONS[channel.topic], message.data, frames)
            counts[channel.topic] += 1
            sizes[channel.topic] += len(message.data)
        summary = reader.get_summary()
    assert set(counts) == set(SCHEMAS) | set(DESCRIPTIONS), sorted(counts)
    assert summary.statistics.message_count == sum(counts.values())
    assert summary.statistics.chunk_count == len(summary.chunk_indexes) > 3
    missing = [frame for frame in entities if frame not in frames]
    assert not missing, f"bodies without a transform: {missing}"
    depths = Counter()
    for frame in frames:
        chain = [frame]
        while (parent := frames[chain[-1]].parent_frame_id) != "map":
            chain.append(parent)
            assert len(chain) < 50, chain
        depths[len(chain)] += 1
    assert max(depths) > 8, f"the frames do not carry each other: {depths}"
    bottle = frames["object/BOTTLE-1"].translation
    assert math.dist((bottle.x, bottle.y), (-0.8, 2.0)) < 0.02 and bottle.z > 0.9, bottle
    way = sum(math.dist((a.x, a.y), (b.x, b.y)) for a, b in zip(base, base[1:]))
    assert 3 < way < 20, way
    assert "torso_lift_joint" in joints and any("drawer" in name for name in joints), sorted(joints)
    assert all(state == "succeeded" for state in states.values()), states
    assert parameters["picking-up"]["grasp"] == "LEFT-SIDE", parameters
    assert any(text.startswith("picking-up › ") for text in texts), texts
    assert levels[2] >= 8, levels
    assert any(abs(force - 2) < 0.1 for force in forces), f"nothing carries the bottle: {sorted(forces)}"
    seconds = last_time * 1e-9
    print(f"{path}: {size} bytes, {sum(counts.values())} messages in {seconds:.1f} simulated seconds, {len(entities)} bodies")
    for topic, count in sorted(counts.items()):
        print(f"  {topic:27} {SCHEMAS.get(topic, 'std_msgs/msg/String'):28} {count:5} {sizes[topic]:9} bytes")


main(sys.argv[1])

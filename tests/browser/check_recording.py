"""Reads a recording of move-bottle with the Python package `mcap` and checks that it shows
what happened, in messages that conform to the schemas in the file.

    python3 tests/browser/check_recording.py RUN.mcap
"""

import base64
import json
import math
import sys
from collections import Counter

from mcap.reader import make_reader

SCHEMAS = {
    "/tf": "foxglove.FrameTransforms",
    "/tf_static": "foxglove.FrameTransforms",
    "/scene/robot_and_kitchen": "foxglove.SceneUpdate",
    "/scene/objects": "foxglove.SceneUpdate",
    "/scene/plans": "foxglove.SceneUpdate",
    "/joint_states": "foxglove.JointStates",
    "/camera/image": "foxglove.CompressedImage",
    "/camera/calibration": "foxglove.CameraCalibration",
    "/log": "foxglove.Log",
    "/tasks": "planwright.Task",
    "/shown": "planwright.Shown",
}

KINDS = {"object": dict, "array": list, "string": str, "boolean": bool, "number": (int, float), "integer": int}


def keep_to(schema, value, where):
    """Fails unless the value conforms to the schema; covers what our schemas use."""
    if "oneOf" in schema:
        assert value in [one["const"] for one in schema["oneOf"]], where
        return
    kind = schema["type"]
    assert isinstance(value, KINDS[kind]), f"{where}: {value!r} is not of type {kind}"
    if kind in ("number", "integer"):
        assert math.isfinite(value) and value >= schema.get("minimum", -math.inf), where
        assert value <= schema.get("maximum", math.inf), where
    if kind == "object":
        for name in schema.get("required", []):
            assert name in value, f"{where} lacks {name}"
        for name, inner in schema.get("properties", {}).items():
            keep_to(inner, value[name], f"{where}.{name}")
        if "properties" in schema:
            assert set(value) <= set(schema["properties"]), f"{where}: {sorted(value)}"
    if kind == "array":
        assert schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", math.inf), where
        for item in value:
            keep_to(schema["items"], item, f"{where}[]")


def main(path):
    counts, schemas, last_time = Counter(), {}, 0
    frames, states, levels, base, entities = {}, {}, Counter(), [], {}
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        for schema, channel, message in reader.iter_messages(log_time_order=False):
            topic = channel.topic
            if topic not in schemas:
                assert schema.encoding == "jsonschema" and channel.message_encoding == "json"
                assert schema.name == SCHEMAS[topic], f"{topic}: {schema.name}"
                schemas[topic] = json.loads(schema.data)
            counts[topic] += 1
            assert message.log_time >= last_time, "time runs backwards"
            last_time = message.log_time
            value = json.loads(message.data)
            keep_to(schemas[topic], value, topic)
            if topic in ("/tf", "/tf_static"):
                for one in value["transforms"]:
                    frames[one["child_frame_id"]] = one
                    q = one["rotation"]
                    assert abs(sum(v * v for v in q.values()) - 1) < 1e-3, one
                if topic == "/tf":
                    base.append(frames["base_footprint"]["translation"])
            elif topic.startswith("/scene/") and topic != "/scene/plans":
                for entity in value["entities"]:
                    entities[entity["frame_id"]] = entity
                    for list_ in entity["triangles"]:
                        assert len(list_["indices"]) % 3 == 0
                        assert max(list_["indices"]) < len(list_["points"]) == len(list_["colors"])
            elif topic == "/tasks":
                states[value["id"]] = value["state"]
            elif topic == "/log":
                levels[value["level"]] += 1
            elif topic == "/camera/image":
                assert base64.b64decode(value["data"], validate=True).startswith(b"\x89PNG\r\n")
        summary = reader.get_summary()
    assert set(counts) == set(SCHEMAS), sorted(counts)
    assert summary.statistics.message_count == sum(counts.values())
    missing = [frame for frame in entities if frame not in frames]
    assert not missing, f"bodies without a transform: {missing}"
    bottle = frames["object/BOTTLE-1"]["translation"]
    assert math.dist((bottle["x"], bottle["y"]), (-0.8, 2.0)) < 0.02 and bottle["z"] > 0.9, bottle
    way = sum(math.dist(a.values(), b.values()) for a, b in zip(base, base[1:]))
    assert 3 < way < 20, way
    assert all(state == "succeeded" for state in states.values()), states
    assert levels[2] >= 8, levels
    seconds = last_time * 1e-9
    print(f"{path}: {sum(counts.values())} messages in {seconds:.1f} simulated seconds, {len(entities)} bodies")
    for topic, count in sorted(counts.items()):
        print(f"  {topic:26} {schemas[topic]['title']:28} {count:5}")


main(sys.argv[1])

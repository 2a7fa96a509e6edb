"""Messages carried as bytes: from CDR, which ROS 2 has on the wire, to what ROS 1 has there, and back.

Both have little-endian numbers in the order of the fields. CDR aligns them and ends strings with a zero; headers of ROS 1 have a
number `seq`. Objects for each number would take thirty times as long, and a robot tells 3,000 transforms a second."""

from struct import Struct

from conversion import FRAMES, GarbledMessage, checked_time, ros1_class

COUNT = Struct("<I")
TIME = Struct("<iI")
SIZES = {"bool": 1, "int8": 1, "uint8": 1, "int16": 2, "uint16": 2, "int32": 4, "uint32": 4, "float32": 4}
SIZES.update({"int64": 8, "uint64": 8, "float64": 8})
# What stands before CDR in little-endian, the encoding that ROS 2 has; the last two bytes do not matter.
ENCODING = b"\x00\x01\x00\x00"


class Transcoder:
    """Carries a message of a layout of ROS 2 that is nearly the same as a message of ROS 1."""

    def __init__(self, layouts, ros2, ros1):
        self.layouts = layouts
        self.ros2, self.ros1 = ros2, ros1_class(ros1)
        self.steps = self.plan(ros2, self.ros1)

    def plan(self, ros2, ros1):
        """What to do, one after the other: numbers of one size that follow each other are one step."""
        slots = list(zip(ros1.__slots__, ros1._slot_types))
        steps = []
        for name, kind in self.layouts.fields(ros2):
            slot = next((slot for slot, _ in slots if slot.lower() == name), None)
            if slot is None:
                add(steps, "skip", self.step(name, kind, None))
                continue
            while slots[0][0] != slot:
                self.insert(steps, *slots.pop(0))
            for step in self.step(name, kind, slots.pop(0)[1]):
                add(steps, *step)
        for slot in slots:
            self.insert(steps, *slot)
        return steps

    def insert(self, steps, slot, kind):
        if kind != "uint32" or slot != "seq":
            raise GarbledMessage(f"{self.ros2} has no {slot}, or in another order than ROS 1")
        add(steps, "insert")

    def step(self, name, kind, ros1):
        """The steps of a field; `ros1` is the type of the slot, or None if there is none."""
        inner, bracket, length = kind.partition("[")
        if bracket:
            element = self.step("", inner, ros1 and ros1.partition("[")[0])
            length = length.rstrip("]")
            if length:
                return element * int(length)
            numbers = len(element) == 1 and element[0][0] == "copy"
            return [("numbers", *element[0][1:])] if numbers else [("sequence", element)]
        if kind in SIZES:
            return [("copy", SIZES[kind], 1)]
        if kind == "string":
            return [("string", name in FRAMES)]
        if kind == "builtin_interfaces/msg/Time":
            return [("time",)]
        if ros1 is None or kind == "builtin_interfaces/msg/Duration":
            steps = []
            for field, inner in self.layouts.fields(kind):
                for step in self.step(field, inner, None):
                    add(steps, *step)
            return steps
        return self.plan(kind, ros1_class(ros1))

    def to_ros1(self, data):
        """What ROS 1 has on the wire for what ROS 2 has there."""
        if data[:2] != ENCODING[:2]:
            raise GarbledMessage(f"the encoding {data[:2].hex()} is not known: CDR in little-endian (0001) was expected")
        out = []
        Decoding(data[4:], out).run(self.steps, 0)
        return b"".join(out)

    def to_ros2(self, data):
        """What ROS 2 has on the wire for what ROS 1 has there."""
        out = bytearray()
        encode(self.steps, data, 0, out)
        return ENCODING + bytes(out)


def add(steps, *step):
    """Puts a step behind others."""
    if step[0] == "copy" and steps and steps[-1][:2] == step[:2]:
        step = ("copy", step[1], steps.pop()[2] + step[2])
    steps.append(step)


class Decoding:
    """A message of ROS 2 that is being read."""

    def __init__(self, data, out):
        self.data, self.out = data, out

    def numbers(self, size, position, count):
        """Reads numbers of a size."""
        position += -position % size
        end = position + size * count
        if end > len(self.data):
            raise GarbledMessage(f"it ends after {len(self.data)} bytes, and {end} were expected")
        self.out.append(self.data[position:end])
        return end

    def count(self, position):
        position += -position % 4
        if position + 4 > len(self.data):
            raise GarbledMessage(f"it ends after {len(self.data)} bytes, within a number")
        return COUNT.unpack_from(self.data, position)[0], position + 4

    def run(self, steps, position):
        for step in steps:
            what = step[0]
            if what == "copy":
                position = self.numbers(step[1], position, step[2])
            elif what == "string":
                length, position = self.count(position)
                end = position + length
                if length == 0 or end > len(self.data):
                    raise GarbledMessage(f"a text of {length} bytes is not in it")
                text = self.data[position : end - 1]
                if step[1]:
                    text = text.lstrip(b"/")
                self.out += (COUNT.pack(len(text)), text)
                position = end
            elif what == "time":
                position = self.numbers(4, position, 2)
                checked_time(*TIME.unpack(self.out[-1]))
            elif what == "insert":
                self.out.append(bytes(4))
            elif what == "numbers":
                count, position = self.count(position)
                self.out.append(COUNT.pack(count))
                if count:
                    position = self.numbers(step[1], position, step[2] * count)
            elif what == "sequence":
                count, position = self.count(position)
                if count > len(self.data):
                    raise GarbledMessage(f"{count} elements are not in it")
                self.out.append(COUNT.pack(count))
                for _ in range(count):
                    position = self.run(step[1], position)
            else:
                position = Decoding(self.data, []).run(step[1], position)
        return position


def encode(steps, data, position, out):
    """Writes a message of ROS 1 as ROS 2 has it; the end of what was read."""

    def numbers(size, count):
        out.extend(bytes(-len(out) % size))
        end = position + size * count
        if end > len(data):
            raise GarbledMessage(f"it ends after {len(data)} bytes, and {end} were expected")
        out.extend(data[position:end])
        return end

    def length():
        if position + 4 > len(data):
            raise GarbledMessage(f"it ends after {len(data)} bytes, within a number")
        return COUNT.unpack_from(data, position)[0], position + 4

    for step in steps:
        what = step[0]
        if what == "copy":
            position = numbers(step[1], step[2])
        elif what == "time":
            position = numbers(4, 2)
            checked_time(*TIME.unpack(out[-8:]))
        elif what == "insert":
            position += 4
        elif what == "skip":
            raise GarbledMessage("ROS 1 lacks a field that ROS 2 has")
        else:
            count, position = length()
            if count > len(data):
                raise GarbledMessage(f"a length of {count} is more than the message has")
            out.extend(bytes(-len(out) % 4))
            if what == "string":
                text = data[position : position + count]
                position += count
                if step[1]:
                    text = text.lstrip(b"/")
                out += COUNT.pack(len(text) + 1) + text + b"\0"
            else:
                out += COUNT.pack(count)
                if what == "numbers" and count:
                    position = numbers(step[1], step[2] * count)
                for _ in range(count if what == "sequence" else 0):
                    position = encode(step[1], data, position, out)
    return position

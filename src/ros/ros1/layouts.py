"""Messages of ROS 2 as classes of Cyclone DDS, made of the table that planwright itself uses: `src/ros/layout/interfaces.txt`."""

import os
import re
import types
from dataclasses import dataclass

from cyclonedds.idl import IdlStruct
from cyclonedds.idl import types as idl

DISTRIBUTIONS = ("humble", "iron", "jazzy", "kilted", "lyrical")
TABLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "layout")
SCALARS = {"bool": bool, "string": str}
SCALARS.update((name, getattr(idl, name)) for name in ("int8", "int16", "int32", "int64"))
SCALARS.update((name, getattr(idl, name)) for name in ("uint8", "uint16", "uint32", "uint64", "float32", "float64"))
# What Cyclone's middleware puts before requests and replies: whose they are, and a number of 64 bits in two halves.
REQUEST = ("identity", "uint8[8]"), ("low", "uint32"), ("high", "int32")
FIELD = re.compile(r"(?P<type>[\w/]+)(?P<many>\[\d*\])?$")


class TableError(Exception):
    """The table of messages cannot be used."""


def read_table(file, distribution):
    """The fields of each message in a table: for each name, a list of names and types."""
    path = os.path.join(TABLES, file)
    try:
        with open(path, encoding="utf-8") as opened:
            lines = opened.read().splitlines()
    except OSError as error:
        raise TableError(f"the table of ROS 2's messages is not there: {error}") from error
    messages, fields = {}, None
    for number, line in enumerate(lines, 1):
        line = line.split("#")[0].strip()
        heading = re.fullmatch(r"\[([\w/]+)(?: since (\w+))?\]", line)
        if heading:
            name, since = heading.groups()
            fields = []
            if since is None or DISTRIBUTIONS.index(since) <= DISTRIBUTIONS.index(distribution):
                messages[name] = fields
        elif line:
            try:
                kind, name = line.split()
                fields.append((name, kind))
            except (ValueError, AttributeError):
                raise TableError(f"{path}, line {number}: a type and a name of a field were expected, not {line!r}") from None
    return messages


class Layouts:
    """The messages of a distribution."""

    def __init__(self, distribution):
        self.messages = read_table("interfaces.txt", distribution)
        self.action_parts = read_table("action_parts.txt", distribution)
        self.messages["RequestHeader"] = [(name, kind) for name, kind in REQUEST]
        self.classes = {}

    def fields(self, name):
        """Names and types of a message's fields."""
        if name not in self.messages:
            raise TableError(f"the table of ROS 2's messages has no {name}")
        return self.messages[name]

    def message(self, name):
        """The class of a message such as `std_msgs/msg/String`."""
        if name not in self.classes:
            self.classes[name] = self.make(name, self.fields(name))
        return self.classes[name]

    def bytes_of(self, name):
        """A class for messages of a name that are carried as bytes: `carry(data)` makes one, `data` is what came."""
        made = self.make(name, self.fields(name))

        def carry(data, **_):
            message = object.__new__(made)
            message.data = data
            return message

        made.carry = made.deserialize = staticmethod(carry)
        made.serialize = lambda message, **_: message.data
        return made

    def action(self, name):
        """The classes of the messages of an action such as `nav2_msgs/action/NavigateToPose`, by part."""
        parts = {}
        for key, fields in self.action_parts.items():
            part = key.removeprefix("ACTION_")
            fields = [(field, kind.replace("ACTION", name)) for field, kind in fields]
            if part != "FeedbackMessage":
                fields.insert(0, ("request", "RequestHeader"))
            parts[part] = self.make(f"{name}_{part}", fields)
        return parts

    def service(self, name):
        """The classes of requests and replies of a service such as `action_msgs/srv/CancelGoal`."""
        return [
            self.make(f"{name}_{part}", [("request", "RequestHeader"), *self.fields(f"{name}_{part}")])
            for part in ("Request", "Response")
        ]

    def make(self, name, fields):
        """A class for a name of ROS; what is called `a/msg/B` there is `a::msg::dds_::B_` on the wire."""
        # A message without fields is one byte.
        annotations = {field: self.field_type(kind) for field, kind in fields} or {"nothing": idl.uint8}
        *packages, own = name.split("/")
        typename = "::".join([*packages, "dds_", f"{own}_"] if packages else [own])
        body = {"__annotations__": annotations}
        made = types.new_class(own, (IdlStruct,), {"typename": typename}, lambda space: space.update(body))
        return dataclass(made)

    def field_type(self, kind):
        match = FIELD.match(kind)
        if match is None:
            raise TableError(f"the table of ROS 2's messages: {kind!r} is no type")
        inner, many = match["type"], match["many"]
        element = SCALARS.get(inner) or self.message(inner)
        if many is None:
            return element
        return idl.sequence[element] if many == "[]" else idl.array[element, int(many[1:-1])]

"""The bridge's node of ROS 2: topics over Eclipse Cyclone DDS, and the one thread in which all of the bridge happens.

What ROS 1 says arrives in threads of rospy; `Node.call` brings it into the thread of the node, so that nothing else
needs locks. Times are seconds of a clock that never jumps."""

import os
import queue
import sys
import time

from cyclonedds.core import (
    DDSException,
    GuardCondition,
    InstanceState,
    Policy,
    Qos,
    ReadCondition,
    SampleState,
    ViewState,
    WaitSet,
)
from cyclonedds.domain import DomainParticipant
from cyclonedds.internal import InvalidSample
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from conversion import GarbledMessage

# How often what depends on time is looked at, in seconds.
TICK = 0.02
# How many messages of one topic are heard before others have their turn.
AT_ONCE = 50
ON_THIS_MACHINE = """<CycloneDDS><Domain Id="any">
    <General>
        <Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>
        <AllowMulticast>false</AllowMulticast>
    </General>
    <Discovery>
        <ParticipantIndex>auto</ParticipantIndex>
        <MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>
        <Peers><Peer Address="localhost"/></Peers>
    </Discovery>
</Domain></CycloneDDS>"""


def tell(text):
    """One line for whoever looks at the bridge."""
    print(f"bridge: {text}", file=sys.stderr, flush=True)


def reliable(depth):
    return qos(Policy.Reliability.Reliable(duration(milliseconds=100)), Policy.Durability.Volatile, depth)


def latched(depth=1):
    """For who comes later, too: transient local."""
    return qos(Policy.Reliability.Reliable(duration(milliseconds=100)), Policy.Durability.TransientLocal, depth)


def best_effort(depth):
    return qos(Policy.Reliability.BestEffort, Policy.Durability.Volatile, depth)


def qos(reliability, durability, depth):
    return Qos(reliability, durability, Policy.History.KeepLast(depth))


def unsigned(handles):
    """Handles as they stand beside messages: Cyclone's package gives some of them as signed numbers."""
    return {handle % 2**64 for handle in handles}


class Reader:
    """Hears a topic. `hear` gets each message and the handle of who has written it."""

    def __init__(self, node, topic, kind, quality, hear):
        self.node, self.name, self.hear = node, topic, hear
        self.reader = DataReader(node.participant, Topic(node.participant, topic, kind), qos=quality)
        mask = SampleState.NotRead | ViewState.Any | InstanceState.Any
        self.condition = ReadCondition(self.reader, mask)
        self.complained = False
        node.wait_set.attach(self.condition)
        node.readers.append(self)

    def poll(self):
        """Hears what has come."""
        for _ in range(AT_ONCE):
            if self.reader is None:
                return
            try:
                taken = self.reader.take(1)
            except DDSException as error:
                tell(f"{self.name} cannot be heard: {error}")
                return
            except Exception as error:  # A message that is not what its type says is not for anybody.
                self.complain(error)
                continue
            if not taken:
                return
            if not isinstance(taken[0], InvalidSample):
                try:
                    self.hear(taken[0], taken[0].sample_info.publication_handle)
                except GarbledMessage as error:
                    self.complain(error)

    def complain(self, error):
        if not self.complained:
            self.complained = True
            tell(f"a message of {self.name} cannot be read and is left out: {type(error).__name__}: {error}")

    def writers(self):
        """The handles of who writes what is heard here."""
        return unsigned(self.reader.get_matched_publications())

    def close(self):
        self.node.wait_set.detach(self.condition)
        self.node.readers.remove(self)
        self.condition = self.reader = None


class Writer:
    """Writes a topic."""

    def __init__(self, node, topic, kind, quality):
        self.writer = DataWriter(node.participant, Topic(node.participant, topic, kind), qos=quality)

    def write(self, message):
        self.writer.write(message)

    def readers(self):
        """The handles of who hears what is written here."""
        return unsigned(self.writer.get_matched_subscriptions())

    def close(self):
        self.writer = None


class Node:
    """A node of ROS 2, though not one that tools list."""

    def __init__(self, domain, only_this_machine):
        if only_this_machine and "CYCLONEDDS_URI" not in os.environ:
            os.environ["CYCLONEDDS_URI"] = ON_THIS_MACHINE
        self.participant = DomainParticipant(domain)
        self.wait_set = WaitSet(self.participant)
        self.guard = GuardCondition(self.participant)
        self.wait_set.attach(self.guard)
        self.readers, self.tickers = [], []
        self.calls = queue.SimpleQueue()

    def call(self, deed, *arguments):
        """Does something in the thread of the node, soon. Any thread may call this."""
        self.calls.put((deed, arguments))
        self.guard.set(True)

    def every_tick(self, deed):
        """Calls something every few milliseconds."""
        self.tickers.append(deed)

    def run(self, goes_on):
        """Hears and does what comes, as long as something says so."""
        last = 0.0
        while goes_on():
            self.wait_set.wait(duration(milliseconds=int(TICK * 1000)))
            self.guard.set(False)
            while not self.calls.empty():
                deed, arguments = self.calls.get()
                deed(*arguments)
            for reader in list(self.readers):
                reader.poll()
            now = time.monotonic()
            if now - last >= TICK:
                last = now
                for deed in list(self.tickers):
                    deed()

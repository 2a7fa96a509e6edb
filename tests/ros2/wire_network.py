"""Two hosts on one machine, and the wire between them: network namespaces with a TUN device each, and a proxy that forwards their IP
packets with seeded faults. Needs root and Linux. Times are those of a clock that never jumps (s)."""

import fcntl
import heapq
import os
import random
import select
import struct
import subprocess
import threading
import time

import wire_packets as packets

PREFIX = "pwwire"
TO_ROBOT, TO_PLAN = 0, 1
SETTINGS = ("net.ipv6.conf.all.disable_ipv6", "net.ipv6.conf.default.disable_ipv6")
TUNSETIFF, IFF_TUN, IFF_NO_PI = 0x400454CA, 0x0001, 0x1000


class Faults:
    """What the wire does to packets: each a share of them, `late` up to so many seconds for half of them. Of the ways in `ways`."""

    KINDS = ("loss", "late", "double", "reorder", "truncate", "garble", "forge")

    def __init__(self, **given):
        self.loss = self.late = self.double = self.reorder = self.truncate = 0
        # Bits flipped with the checksum left as it was, and with one that fits.
        self.garble = self.forge = 0
        self.ways = (TO_ROBOT, TO_PLAN)
        for name, value in given.items():
            assert hasattr(self, name), name
            setattr(self, name, value)

    def __str__(self):
        said = [f"{name} {getattr(self, name):g}" for name in self.KINDS if getattr(self, name)]
        if len(self.ways) == 1:
            said.append("to the " + ("robot" if self.ways == (TO_ROBOT,) else "plan"))
        return " ".join(said) or "none"


def run(*command):
    subprocess.run(command, check=True, capture_output=True, text=True)


def hinders():
    """Why there can be no hosts here; empty if there can."""
    name = f"{PREFIX}{os.getpid()}x"
    try:
        os.close(os.open("/dev/net/tun", os.O_RDWR))
        run("ip", "netns", "add", name)
        run("ip", "netns", "delete", name)
    except FileNotFoundError as error:
        return f"{error.filename} is missing"
    except subprocess.CalledProcessError as error:
        return error.stderr.strip()
    except OSError as error:
        return f"{error.filename}: {error.strerror}"
    return ""


def remove_left_over():
    """Removes hosts of checks that were killed."""
    listed = subprocess.run(("ip", "netns", "list"), capture_output=True, text=True).stdout
    for line in listed.splitlines():
        name = line.split()[0]
        process = name.removeprefix(PREFIX).rstrip("pr")
        if name.startswith(PREFIX) and process.isdigit() and not os.path.exists(f"/proc/{process}"):
            subprocess.run(("ip", "netns", "delete", name), capture_output=True)


class Network:
    """The hosts `plan` and `robot`, whose wire is whole until `faults` or `cut` say otherwise."""

    def __init__(self):
        self.plan, self.robot = (f"{PREFIX}{os.getpid()}{end}" for end in "pr")
        self.faults, self.dice = Faults(), random.Random(0)
        self.whole_again = [0.0, 0.0]
        self.counts, self.queue, self.held, self.number = {}, [], [None, None], 0
        self.watched = None
        # For how long (s) the machine has let the proxy wait at most.
        self.held_up = 0.0
        self.ends, self.is_over, self.thread = [], False, None
        try:
            for number, host in enumerate((self.plan, self.robot)):
                self.ends.append(self.host(number, host))
        except BaseException:
            self.remove()
            raise
        self.thread = threading.Thread(target=self.forward, daemon=True)
        self.thread.start()

    def host(self, number, host):
        """A host, and the end of the wire that its device has here."""
        run("ip", "netns", "add", host)
        end = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
        device = f"pw{os.getpid()}{number}"
        fcntl.ioctl(end, TUNSETIFF, struct.pack("16sH", device.encode(), IFF_TUN | IFF_NO_PI))
        run("ip", "link", "set", device, "netns", host)
        inside = ("ip", "netns", "exec", host)
        run(*inside, "sysctl", "-q", "-w", *(f"{setting}=1" for setting in SETTINGS))
        run("ip", "-n", host, "address", "add", f"10.77.0.{number + 1}/24", "dev", device)
        run("ip", "-n", host, "link", "set", "lo", "up")
        run("ip", "-n", host, "link", "set", device, "up", "multicast", "on")
        run("ip", "-n", host, "route", "add", "224.0.0.0/4", "dev", device)
        return end

    def remove(self):
        self.is_over = True
        if self.thread is not None:
            self.thread.join(2)
        for end in self.ends:
            os.close(end)
        self.ends = []
        for host in (self.plan, self.robot):
            subprocess.run(("ip", "netns", "delete", host), capture_output=True)

    def spoil(self, faults, seed):
        self.dice, self.faults, self.counts, self.held_up = random.Random(f"wire {seed}"), faults, {}, 0.0

    def cut(self, seconds, ways=(TO_ROBOT, TO_PLAN)):
        """Nothing passes for so long, which may be for ever."""
        for way in ways:
            self.whole_again[way] = time.monotonic() + seconds

    def heal(self):
        """Nothing is wrong any more; what is under way still arrives late."""
        self.faults, self.whole_again, self.watched = Faults(), [0.0, 0.0], None

    def when(self, request, deed, passes):
        """Does something once, when a request of the plan comes by, which itself passes or does not."""
        self.watched = (request, deed, passes)

    def count(self, what):
        self.counts[what] = self.counts.get(what, 0) + 1

    def forward(self):
        last = time.monotonic()
        while not self.is_over:
            now = time.monotonic()
            last, self.held_up = now, max(self.held_up, now - last)
            wait = self.queue[0][0] - time.monotonic() if self.queue else 0.05
            try:
                ready, _, _ = select.select(self.ends, (), (), min(max(wait, 0), 0.05))
            except (OSError, ValueError):
                return
            for end in ready:
                way = TO_ROBOT if end == self.ends[0] else TO_PLAN
                self.take(end, way)
            while self.queue and self.queue[0][0] <= time.monotonic():
                _, _, way, packet = heapq.heappop(self.queue)
                self.send(way, packet)

    def take(self, end, way):
        for _ in range(50):
            try:
                packet = os.read(end, 65535)
            except (BlockingIOError, OSError):
                return
            if packets.is_udp(packet):
                self.carry(packet, way)

    def carry(self, packet, way):
        is_lost = self.see(packet) if way == TO_ROBOT and self.watched else False
        faults, dice = self.faults, self.dice
        self.count("packets")
        if is_lost or time.monotonic() < self.whole_again[way]:
            self.count("cut")
            return
        if way not in faults.ways:
            return self.later(way, packet, 0)
        happens = lambda what: getattr(faults, what) and dice.random() < getattr(faults, what) and (self.count(what) or True)
        if happens("loss"):
            return
        body, is_whole = packets.header_length(packet), not packets.is_fragment(packet)
        if is_whole and happens("truncate"):
            packet = packets.truncated(packet, dice)
        if happens("garble"):
            packet = packets.garbled(packet, dice, body)
        if is_whole and len(packet) > body + 8 and happens("forge"):
            packet = packets.with_checksums(packets.garbled(packet, dice, body + 8))
        if happens("reorder") and self.held[way] is None:
            self.held[way] = packet
            return
        for _ in range(2 if happens("double") else 1):
            is_late = faults.late and dice.random() < 0.5
            self.later(way, packet, dice.uniform(0, faults.late) if is_late else 0)

    def see(self, packet):
        """Whether a packet is lost with what is done when it comes by."""
        request, deed, passes = self.watched
        if packets.is_fragment(packet) or request not in packets.requests(packet):
            return False
        self.watched = None
        self.count(f"seen {request}")
        if passes:
            self.later(TO_ROBOT, packet, 0)
        deed()
        return True

    def later(self, way, packet, seconds):
        if seconds:
            self.number += 1
            heapq.heappush(self.queue, (time.monotonic() + seconds, self.number, way, packet))
            return
        self.send(way, packet)

    def send(self, way, packet):
        held, self.held[way] = self.held[way], None
        for each in (packet, held):
            if each:
                try:
                    os.write(self.ends[1 - way], each)
                except OSError:
                    # A host takes no packet of that kind, or its queue is full.
                    self.count("refused")

"""The programs that the checks of ROS 1 start: planwright, the bridge, and what else has to end with a check."""

import atexit
import os
import queue
import signal
import subprocess
import sys
import threading
import time

import rosgraph

from checks import check

DOMAIN = int(os.environ["ROS_DOMAIN_ID"])
# What Cyclone DDS in these checks needs to stay on this machine; the bridge knows that by itself.
LOOPBACK = "file://" + os.path.abspath("tests/ros2/loopback.xml")
STARTED = []


@atexit.register
def end_all():
    for program in STARTED:
        if program.process.poll() is None:
            program.process.kill()
            program.process.wait()


# A check that runs for too long ends as one that fails does.
signal.signal(signal.SIGTERM, lambda *_: sys.exit("FAILED: it was ended, or takes too long"))


class Program:
    """A program, with the lines that it has printed."""

    def __init__(self, command, **environment):
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env={**os.environ, **environment},
            # Where this was started in the background, Ctrl-C would not be heard.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        )
        self.lines, self.said = queue.Queue(), []
        threading.Thread(target=self.read, daemon=True).start()
        STARTED.append(self)

    def read(self):
        for line in self.process.stdout:
            self.said.append(line)
            self.lines.put(line)

    def processor_time(self):
        """What it has taken so far, in seconds."""
        with open(f"/proc/{self.process.pid}/stat", encoding="utf-8") as file:
            fields = file.read().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def tell(self, text):
        self.process.stdin.write(text)
        self.process.stdin.flush()

    def expect(self, words, seconds=20):
        """The next line with these words."""
        end = time.monotonic() + seconds
        while True:
            try:
                line = self.lines.get(timeout=max(0.01, end - time.monotonic()))
            except queue.Empty:
                check(False, f"{words!r} is not said within {seconds} s, but {''.join(self.said[-10:])!r}, by {self.process.args}")
            if words in line:
                return line

    def end(self, how=signal.SIGINT, seconds=20):
        """Lets it end; its status."""
        self.process.send_signal(how)
        try:
            return self.process.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            check(False, f"{self.process.args} does not end within {seconds} s")


def bridge(*options, **environment):
    """The bridge, once it is there."""
    started = Program([sys.executable, "src/ros/ros1/bridge.py", *options], **environment)
    started.expect("the robot is in")
    return started


def wait_for_master():
    end = time.monotonic() + 30
    while not rosgraph.is_master_online():
        check(time.monotonic() < end, "the master does not come")
        time.sleep(0.1)


def eventually(condition, what, seconds=20):
    """Waits until something is so; how long that took, in seconds."""
    begin = time.monotonic()
    while not condition():
        check(time.monotonic() - begin < seconds, f"{what} (waited {seconds} s)")
        time.sleep(0.01)
    return time.monotonic() - begin

"""Serves the base of a robot as a server does that lies, and hears what a plan makes of that: a failure that names what has
happened, in time, and the end of every goal that was given up."""

import os
import signal
import subprocess
import sys
import tempfile
import time

from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

import messages as ros
from actions import FOLLOW, NAVIGATE, CancelRequest, CancelResponse, GoalInfo, GoalStatus, GoalStatusArray, RequestHeader
from checks import check

PROGRAM = sys.argv[1]
DOMAIN = int(os.environ.get("ROS_DOMAIN_ID", 77))
ACCEPTED, EXECUTING, SUCCEEDED, CANCELED, ABORTED = 1, 2, 4, 5, 6
NOW = ros.Time(0, 0)


class Liar:
    """A server that does nothing by itself."""

    def __init__(self, name="lying_base", kind=NAVIGATE):
        self.participant = participant = DomainParticipant(DOMAIN)
        self.kind = kind
        inner = f"{name}/_action/"

        def read(part, kind):
            return DataReader(participant, Topic(participant, f"rq/{inner}{part}Request", kind), qos=ros.reliable(100))

        def write(topic, kind, qos=ros.reliable(100)):
            return DataWriter(participant, Topic(participant, topic, kind), qos=qos)

        self.goals = read("send_goal", self.kind["send_goal"])
        self.accepting = write(f"rr/{inner}send_goalReply", self.kind["accepted"])
        self.asked = read("get_result", self.kind["get_result"])
        self.results = write(f"rr/{inner}get_resultReply", self.kind["result"])
        self.cancels = read("cancel_goal", CancelRequest)
        self.cancelling = write(f"rr/{inner}cancel_goalReply", CancelResponse)
        self.feedback = write(f"rt/{inner}feedback", self.kind["feedback"])
        self.status = write(f"rt/{inner}status", GoalStatusArray, ros.latched())

    def meet(self):
        """Waits until the plan and this server have found each other."""
        end = time.monotonic() + 20
        ways = (self.goals, self.asked, self.cancels), (self.accepting, self.results, self.cancelling)
        while not (
            all(reader.get_matched_publications() for reader in ways[0])
            and all(writer.get_matched_subscriptions() for writer in ways[1])
        ):
            check(time.monotonic() < end, "the plan and a server do not find each other")
            time.sleep(0.01)

    def wait(self, reader, seconds=20):
        """The next request."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for request in reader.take(1):
                return request
            time.sleep(0.002)
        return None

    def goal(self):
        goal = self.wait(self.goals)
        if goal is None:
            failure("no goal arrives", "a goal")
        return goal

    def accept(self, goal, accepted=True):
        self.accepting.write(self.kind["accepted"](goal.request, accepted, NOW))

    def result(self, request, status, code=0, text=""):
        self.results.write(self.kind["result"](request.request, status, code, text))

    def tell(self, goal, status):
        self.status.write(GoalStatusArray([GoalStatus(GoalInfo(goal.goal_id, NOW), status)]))

    def is_cancelled(self, goal, seconds=8):
        """Whether that goal is cancelled within that time."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            cancel = self.wait(self.cancels, 0.1)
            if cancel is not None and list(cancel.goal_info.goal_id) == list(goal.goal_id):
                return True
        return False

    def forget(self):
        for reader in (self.goals, self.asked, self.cancels):
            reader.take(100)


scratch = tempfile.TemporaryDirectory()
description = os.path.join(scratch.name, "pr2.sexp")
with open("world/pr2.sexp", encoding="utf-8") as file:
    text = file.read()
text = text.replace("/navigate_to_pose :time-out 60", "/lying_base :time-out 2")
for side in ("left", "right"):
    text = text.replace(f"/{side}_arm_controller/follow_joint_trajectory", f"/lying_{side}")
text = text.replace("(interface server :time-out 10)", "(interface server :time-out 3)")
with open(description, "w", encoding="utf-8") as file:
    file.write(text)

robot = subprocess.Popen([PROGRAM, "robot", "--ros2"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
plan = subprocess.Popen(
    [PROGRAM, "--robot-description", description, "--real-robot"],
    stdin=subprocess.PIPE,
    stdout=subprocess.PIPE,
    stderr=subprocess.PIPE,
    text=True,
)


def tell(text):
    plan.stdin.write(text)
    plan.stdin.flush()


def drive():
    """The plan drives on."""
    tell("(drive)\n")


def failure(what, *words):
    """The failure of the plan, in which these words are to be."""
    begin = time.monotonic()
    for line in plan.stdout:
        if line.startswith("FAILURE"):
            print(f"{what}: {line[8:].strip()[:150]}")
            check(time.monotonic() - begin < 15, f"{what}: only after {time.monotonic() - begin:.0f} s")
            for word in words:
                check(word in line, f"{what}: {word!r} is not in {line!r}")
            return
    check(False, f"{what}: the plan has ended: {plan.stderr.read()}")


try:
    for line in robot.stdout:
        if line.startswith("/detect_objects"):
            break
    tell("""(in-package :pp-tut)
(defmacro told (&body body)
  `(format t "~&FAILURE ~a~%"
           (handler-case (progn (with-real-robot ,@body) "none")
             (cram-common-failures:low-level-failure (failure)
               (format nil "~a: ~a" (type-of failure) (substitute #\\Space #\\Newline (princ-to-string failure)))))))
(defun drive ()
  (let ((?pose (make-pose "map" '((0.3 0 0) (0 0 0 1)))))
    (told (perform (a motion (type going) (target (a location (pose ?pose))))))))
(defun reach ()
  (told (perform (a motion (type moving-arm-joints) (left-configuration (1.9 0.2 1.4 -1.8 1.3 -0.6 0.4))
                                                    (right-configuration (-1.9 0.2 -1.4 -1.8 -1.3 -0.6 -0.4))))))
""")
    # Two arms begin together or not at all.
    left = Liar("lying_left", FOLLOW)
    tell("(reach)\n")
    failure("one of two servers", "MANIPULATION-LOW-LEVEL-FAILURE", "nobody serves /lying_right (waited 3 s)")
    check(left.wait(left.goals, 0.1) is None, "one arm has got its goal without the other")
    right = Liar("lying_right", FOLLOW)
    tell("(reach)\n")
    goals = [left.goal(), right.goal()]
    stamps = [goal.trajectory.header.stamp.nanoseconds() for goal in goals]
    check(stamps[0] == stamps[1] > 1e9 * time.time(), f"the arms are not to begin together: {stamps}")
    left.accept(goals[0])
    check(left.is_cancelled(goals[0], 2), "an arm whose other one is not accepted is not cancelled")
    check(1e9 * time.time() < stamps[0], "it is cancelled only after it has begun")
    left.result(left.wait(left.asked), CANCELED, -4, "")
    words = "/lying_right has not accepted its goal by when all parts were to begin together: all were cancelled"
    failure("one of two accepted", "MANIPULATION-LOW-LEVEL-FAILURE", words)
    right.accept(goals[1])
    check(right.is_cancelled(goals[1]), "an arm that is accepted late is not cancelled")
    del left, right

    drive()
    failure("no server", "NAVIGATION-LOW-LEVEL-FAILURE", "nobody serves /lying_base (waited 3 s)")

    liar, other = Liar(), Liar()
    liar.meet()
    other.meet()
    drive()
    failure("two servers", "NAVIGATION-LOW-LEVEL-FAILURE", "2 servers serve /lying_base: end all but one (waited 3 s)")
    check(liar.wait(liar.goals, 0.1) is None, "a goal is sent to two servers")
    del other
    drive()
    goal = liar.goal()
    liar.accept(goal, False)
    failure("rejected", "NAVIGATION-POSE-UNREACHABLE", "/lying_base has rejected the goal")

    drive()
    goal = liar.goal()
    liar.accept(goal)
    check(liar.is_cancelled(goal), "a goal that does not end is not cancelled")
    failure("never ends", "NAVIGATION-GOAL-NOT-REACHED", "no result of /lying_base within 2 s", "AND NOTHING SAYS")

    liar.forget()
    drive()
    goal = liar.goal()
    liar.accept(goal)
    asked = liar.wait(liar.asked)
    check(liar.is_cancelled(goal), "a goal that does not end is not cancelled")
    liar.result(asked, CANCELED)
    failure("ends when it is cancelled", "no result of /lying_base within 2 s", "; it was cancelled")

    for status, text, words in (
        (SUCCEEDED, "", ("NAVIGATION-GOAL-NOT-REACHED", "/lying_base reported success 0.30 m from the goal")),
        (ABORTED, "no\nway \x1b[31m" + "a" * 5000, ("NAVIGATION-GOAL-NOT-REACHED", "has given up: no way ^[[31maaa")),
        (ABORTED, "", ("NAVIGATION-GOAL-NOT-REACHED", "has given up: error 7")),
        (CANCELED, "", ("NAVIGATION-GOAL-NOT-REACHED", "cancelled by someone else")),
        (0, "", ("NAVIGATION-LOW-LEVEL-FAILURE", "does not know the goal any more")),
    ):
        liar.forget()
        drive()
        goal = liar.goal()
        liar.accept(goal)
        liar.result(liar.wait(liar.asked), status, 7 if status == ABORTED else 0, text)
        failure(f"status {status}", *words)

    # Answers before they are asked for, for others, and twice.
    liar.forget()
    drive()
    goal = liar.goal()
    liar.result(goal, SUCCEEDED)
    other = RequestHeader(goal.request.guid, goal.request.low + 1000, goal.request.high)
    liar.accepting.write(NAVIGATE["accepted"](other, False, NOW))
    liar.results.write(NAVIGATE["result"](other, SUCCEEDED, 0, ""))
    liar.tell(goal, SUCCEEDED)
    for _ in range(3):
        liar.accept(goal)
    asked = liar.wait(liar.asked)
    liar.results.write(NAVIGATE["result"](other, SUCCEEDED, 0, ""))
    # None of these is an end.
    liar.result(asked, EXECUTING)
    time.sleep(0.3)
    check(liar.is_cancelled(goal), "a goal without a result is not cancelled")
    failure("answers that answer nothing", "no result of /lying_base within 2 s")

    # An acceptance that comes late.
    liar.forget()
    drive()
    goal = liar.goal()
    failure("no answer", "NAVIGATION-LOW-LEVEL-FAILURE", "/lying_base has not answered (waited 5 s)")
    liar.forget()
    liar.accept(goal)
    check(liar.is_cancelled(goal), "a goal that is accepted late is not cancelled")

    # It dies with a goal, and returns.
    liar.forget()
    drive()
    goal = liar.goal()
    liar.accept(goal)
    time.sleep(0.2)
    del liar
    failure("dies", "NAVIGATION-LOW-LEVEL-FAILURE", "the server of /lying_base is gone")
    liar = Liar()
    check(liar.wait(liar.goals, 1.5) is None, "a goal is sent again")
    drive()
    again = liar.goal()
    check(list(again.goal_id) != list(goal.goal_id), "two goals have one identity")
    liar.accept(again, False)
    failure("returns", "NAVIGATION-POSE-UNREACHABLE")
    # It carries the goal out, and nobody tells any more where the robot is.
    liar.forget()
    drive()
    goal = liar.goal()
    liar.accept(goal)
    liar.tell(goal, EXECUTING)
    robot.send_signal(signal.SIGSTOP)
    check(liar.is_cancelled(goal), "without a state of the robot, the goal is not cancelled")
    failure("no state", "NAVIGATION-LOW-LEVEL-FAILURE", "no joint states for 0.")

    plan.stdin.close()
    plan.wait(timeout=20)
    told = plan.stderr.read()
    check("has answered what was not asked" in told, f"nothing is told of odd answers: {told}")
finally:
    robot.kill()
    plan.kill()
print("ROS 2: each lie ends in a failure that names it")

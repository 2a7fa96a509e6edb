"""Runs a short plan again and again on a robot at the other end of a wire that loses, delays, doubles, reorders, truncates and garbles
packets, or is cut, as a seed has it: none hangs, each ends in a success that is true or in a failure that names what has happened,
and nothing moves after that unless planwright has said that it may. Prints a line for each run and a table of all.

    wire.py PLANWRIGHT [RUNS [FIRST]]

PAIRS: how many pairs of hosts there are at once, instead of 2. KIND: only runs of this kind, or scenarios whose names have this in
them. The environment is that of tests/ros2/run. Status 3 if there can be no hosts here.
"""

import multiprocessing
import os
import random
import re
import signal
import sys
import time
import traceback

import wire_scenarios
from checks import check
from short_plan import Goal
from wire_network import TO_PLAN, TO_ROBOT, Faults, hinders, remove_left_over
from wire_pair import MOVED, Pair, RobotGone

PROGRAM = sys.argv[1]
RUNS = int(sys.argv[2]) if len(sys.argv) > 2 else 17
FIRST = int(sys.argv[3]) if len(sys.argv) > 3 else 0
# Pairs of hosts at once, and the status if there can be no hosts.
PAIRS, IMPOSSIBLE = int(os.environ.get("PAIRS", 2)), 3
# No run takes longer (s), and no robot that stands longer to be found again. A proxy that waits longer is told of.
LIMIT, AGAIN, BUSY = 60, 40, 0.3
EVER = 1e6
BOTH = (TO_ROBOT, TO_PLAN)
KINDS = {
    "whole": lambda dice: Faults(),
    "loss 1 %": lambda dice: Faults(loss=0.01),
    "loss 5 %": lambda dice: Faults(loss=0.05),
    "loss 20 %": lambda dice: Faults(loss=0.2),
    "loss 20 % one way": lambda dice: Faults(loss=0.2, ways=(dice.choice(BOTH),)),
    "late 0.3 s": lambda dice: Faults(late=0.3),
    "late 2 s": lambda dice: Faults(late=2.0),
    "doubled": lambda dice: Faults(double=0.5),
    "reordered": lambda dice: Faults(reorder=0.3),
    "truncated": lambda dice: Faults(truncate=dice.choice((0.05, 0.2))),
    "garbled": lambda dice: Faults(garble=dice.choice((0.05, 0.2))),
    "garbled, sum right": lambda dice: Faults(forge=dice.choice((0.01, 0.05, 0.2))),
    "cut for a while": lambda dice: Faults(),
    "cut for ever": lambda dice: Faults(),
    "cut one way": lambda dice: Faults(),
    "mixed": lambda dice: Faults(loss=0.05, late=0.1, double=0.1, reorder=0.1, truncate=0.02, garble=0.02),
}
# What failures say that happened.
NAMED = (
    r"nobody serves|has not answered|no result of|not begun it|is gone|does not know the goal|reported success|has rejected"
    r"|has given up|cancelled by someone else|NOTHING SAYS|no joint states|no transform|did not stand still|servers serve"
    # What arrives garbled with a checksum that fits.
    r"|has two parents|hangs on|circle of frames|transform of .* is none|joint states (lack|have)"
)
ANNOUNCED = r"NOTHING SAYS|STAND STILL|MAY STILL"


class Result:
    """What has come of a run, and what is wrong with that."""

    def __init__(self, number, kind, text, seconds, faults, panics, wrong):
        self.number, self.kind, self.text, self.seconds = number, kind, text, seconds
        self.faults, self.panics, self.wrong = faults, panics, wrong
        self.note, self.has_ended = "", False

    def __str__(self):
        wrong = "".join(f" WRONG: {what}." for what in self.wrong)
        note = f" ({self.note.strip()})" if self.note else ""
        return f"{self.number} [{self.kind}; {self.faults}] {self.text[:150]}{note}; {self.seconds:.1f} s{wrong}"


def cuts(pair, kind, dice):
    """Cuts the wire in a run of a kind that has that: says how."""
    if not kind.startswith("cut"):
        return ""
    way = (dice.choice(BOTH),) if kind == "cut one way" else BOTH
    seconds = EVER if kind == "cut for ever" else dice.choice((0.3, 1.0, 3.0, 6.0, EVER) if kind == "cut one way" else (0.3, 1.0, 3.0, 6.0))
    after = dice.uniform(0, 3.5)
    pair.later(after, lambda: pair.network.cut(seconds, way))
    whom = "" if len(way) == 2 else (" to the robot" if way == (TO_ROBOT,) else " to the plan")
    return f"cut{whom} after {after:.1f} s " + ("for ever" if seconds == EVER else f"for {seconds:g} s")


def run(pair, number, kind):
    dice = random.Random(f"run {number}")
    goal, faults, is_new = Goal(dice), KINDS[kind](dice), dice.random() < 0.2
    pair.plan.said(pair.plan.lines), pair.plan.said(pair.plan.errors)
    pair.network.spoil(faults, number)
    how = cuts(pair, kind, dice) or str(faults)
    if is_new:
        # A plan that has to find the robot over such a wire.
        pair.start_plan()
        how += ", new plan"
    begin = time.monotonic()
    pair.plan.tell(goal.call(number))
    text = pair.wait_for(number, LIMIT)
    result = Result(number, kind, text or "no end", time.monotonic() - begin, how, [], [])
    judge(pair, result, goal, text)
    return result


def judge(pair, result, goal, text):
    """Whether a run has ended as it must, and what the robot does after that, until all is well again."""
    begin, wrong = time.monotonic(), result.wrong
    if pair.network.held_up > BUSY:
        result.note += f" the machine was busy: the proxy waited for {pair.network.held_up:.1f} s"
    try:
        state = pair.now()
        if text == "done":
            beside = pair.beside(goal)
            if beside:
                wrong.append(f"the success is false: {beside}")
        elif pair.plan.process.poll() is not None:
            ended(pair.plan, "plan", result)
        elif text is None:
            wrong.append(f"it hangs: {list(pair.plan.errors.queue)[-5:]}")
        elif not re.search(NAMED, text):
            wrong.append("it does not name what happened")
        if text != "done":
            pair.watch(state, begin, 1.5)
            pair.heal()
            # What was under way arrives now.
            moved, last = pair.watch(state, begin, time.monotonic() - begin + 2.5)
            is_told = re.search(ANNOUNCED, " ".join([text or "", *pair.plan.errors.queue]))
            if moved > MOVED and not result.has_ended:
                result.note += f" moved on by {moved:.2f} for {last:.1f} s, " + ("announced" if is_told else "NOT ANNOUNCED")
                if not is_told:
                    wrong.append("it moves on")
    except RobotGone as error:
        ended(pair.robot, "robot", result, str(error))
    result.panics = pair.panics()
    pair.heal()
    recover(pair, result, text)


def ended(process, whose, result, said=""):
    """A program has ended: only a packet that is garbled with a checksum that fits may do that, by a library that reserves memory
    for as much as it announces."""
    result.has_ended = True
    said = said or " ".join(process.errors.queue)
    reason = re.search(r"memory allocation of \d+ bytes failed", said)
    result.note += f" the program of the {whose} has ended or is stuck: {reason[0] if reason else said[-200:]}"
    if "forge" not in result.faults:
        result.wrong.append("a program has ended")


def recover(pair, result, text):
    """Over a whole wire, plan and robot find each other again; processes whose threads have failed begin anew."""
    if result.panics or result.has_ended or text is None or pair.plan.process.poll() is not None:
        result.note += f" panicked: {result.panics[:2]}" if result.panics else ""
        pair.start_robot()
        pair.start_plan()
    elif text == "done":
        return
    begin, tries, first = time.monotonic(), 0, None
    while (said := pair.settle()) != "done":
        if pair.plan.process.poll() is not None:
            ended(pair.plan, "plan", result)
            return recover(pair, result, None)
        tries += 1
        first = first or str(said)
        if time.monotonic() - begin > AGAIN:
            result.wrong.append(f"plan and robot do not find each other again: {said}")
            pair.start_robot()
            pair.start_plan()
            return
        time.sleep(0.5)
    if tries:
        result.note += f" found again after {time.monotonic() - begin:.0f} s, before that: {first[:80]}"


def work(jobs, results):
    """Carries out jobs with a pair of hosts of its own."""
    os.setsid()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    pair = None
    try:
        pair = Pair(PROGRAM)
        pair.start_robot()
        pair.start_plan()
        pair.calibrate()
        while (job := jobs.get()) is not None:
            number, kind = job
            if kind in KINDS:
                results.put(run(pair, number, kind))
            else:
                results.put(wire_scenarios.run(pair, kind, Result, judge))
        results.put(None)
    except SystemExit as error:
        results.put(f"{error}")
    except Exception:
        results.put(traceback.format_exc())
    finally:
        # From here on, it ends by itself.
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        if pair is not None:
            pair.close()


def table(results):
    print(f"\n{'kind':<34}{'runs':>5}{'arrived':>9}{'failed':>8}{'told motion':>13}{'slowest':>9}{'panics':>8}{'ended':>7}")
    kinds = dict.fromkeys(result.kind for result in results)
    for kind in sorted(kinds, key=lambda kind: (kind not in KINDS, list(KINDS).index(kind) if kind in KINDS else kind)):
        of_kind = [result for result in results if result.kind == kind]
        arrived = sum(result.text == "done" for result in of_kind)
        told = sum("announced" in result.note and not result.wrong for result in of_kind)
        slowest = max(result.seconds for result in of_kind)
        ended = sum(result.has_ended for result in of_kind)
        panics = sum(bool(result.panics) for result in of_kind)
        print(f"{kind:<34}{len(of_kind):>5}{arrived:>9}{len(of_kind) - arrived:>8}{told:>13}{slowest:>7.0f} s{panics:>8}{ended:>7}")


def main():
    hindrance = hinders()
    if hindrance:
        print(f"ROS 2: no faults on the wire, since there can be no hosts here: {hindrance}", file=sys.stderr)
        sys.exit(IMPOSSIBLE)
    remove_left_over()
    only = os.environ.get("KIND")
    kinds = [kind for kind in KINDS if not only or kind == only]
    jobs, results, told = multiprocessing.Queue(), multiprocessing.Queue(), []
    for number in range(FIRST, FIRST + RUNS) if kinds else ():
        jobs.put((number, kinds[number % len(kinds)]))
    for name in wire_scenarios.ALL:
        if not only or only in name:
            jobs.put((name, name))
    workers = [multiprocessing.Process(target=work, args=(jobs, results)) for _ in range(PAIRS)]
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    # Also where whoever has started this does not want it to be ended by that.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    begin, running = time.monotonic(), len(workers)
    for worker in workers:
        jobs.put(None)
        worker.start()
    try:
        while running:
            result = results.get()
            if isinstance(result, Result):
                told.append(result)
                print(result, flush=True)
            else:
                check(result is None, result)
                running -= 1
    finally:
        for worker in workers:
            worker.terminate()
            worker.join(10)
        remove_left_over()
    table(told)
    arrived, wrong = sum(result.text == "done" for result in told), [result for result in told if result.wrong]
    slowest = max((result.seconds for result in told), default=0)
    print(
        f"ROS 2: {len(told)} runs with faults on the wire: {arrived} arrived, {len(told) - arrived} failed and said why;"
        f" the slowest took {slowest:.0f} s, all {time.monotonic() - begin:.0f} s"
    )
    check(not wrong, f"{len(wrong)} runs: " + "; ".join(f"{result.number}: {', '.join(result.wrong)}" for result in wrong))


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(130)

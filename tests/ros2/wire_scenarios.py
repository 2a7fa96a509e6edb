"""Runs on a wire that is cut in a state of a goal, for a while or for ever, and Ctrl-C on a wire that loses packets or is cut."""

import os
import random
import re
import signal
import time

from checks import check
from short_plan import Goal
from wire_network import TO_PLAN, TO_ROBOT, Faults

BOTH, EVER = (TO_ROBOT, TO_PLAN), 1e6
# The robot drives from one to the other (m, rad).
HERE, THERE = (0.0, 0.0, 0.0), (0.0, -1.4, 0.0)
# How long (s) the robot may move after Ctrl-C, as is documented, with what it takes to hear of that.
STANDS = 2.0 + 0.3
LIMIT = 60

# What happens at which request: whether that arrives, and how long after it which ways are cut. `result` is the first request
# after a goal was accepted.
CUTS = {
    "goal lost": ("goal", False, 0, BOTH),
    "accepting lost": ("goal", True, 0, BOTH),
    "cut on the way": ("result", True, 0.5, BOTH),
    "cut on the way to the robot": ("result", True, 0.5, (TO_ROBOT,)),
    "cut on the way to the plan": ("result", True, 0.5, (TO_PLAN,)),
    "cancel lost": ("cancel", False, 0, BOTH),
    "cancel's answer lost": ("cancel", True, 0, BOTH),
}
ALL = [f"{name}, {time}" for name in CUTS for time in ("3 s", "for ever")]
ALL += [f"Ctrl-C, loss {share} %, {number}" for share in (0, 20, 40) for number in range(3)]
ALL += [f"Ctrl-C, cut {name}" for name in ("before", "to the robot before")]


def far(pair):
    """A goal whose place is far from where the robot is."""
    goal, state = Goal(random.Random(1)), pair.now()
    goal.place = HERE if abs(state.y - THERE[1]) < 0.7 else THERE
    return goal


def run(pair, name, result_of, judge):
    pair.plan.said(pair.plan.lines), pair.plan.said(pair.plan.errors)
    if name.startswith("Ctrl-C") or name.startswith("cancel"):
        return stop(pair, name, result_of, judge)
    goal = far(pair)
    arm(pair, name)
    begin = time.monotonic()
    pair.plan.tell(goal.call(5_000_000))
    text = pair.wait_for(5_000_000, LIMIT)
    result = result_of(name, group(name), text or "no end", time.monotonic() - begin, seen(pair), [], [])
    judge(pair, result, goal, text)
    return result


def group(name):
    """The runs that are told of together."""
    return re.sub(r", \d+$", "", name)


def arm(pair, name):
    """Lets the wire be cut at a request."""
    pair.network.spoil(Faults(), name)
    what, _, for_how_long = name.partition(", ")
    request, passes, after, ways = CUTS[what]
    seconds = 3.0 if for_how_long == "3 s" else EVER
    cut = lambda: pair.network.cut(seconds, ways)
    pair.network.when(request, cut if after == 0 else lambda: pair.later(after, cut), passes)


def seen(pair):
    return ", ".join(f"{name} {count}" for name, count in pair.network.counts.items())


def stop(pair, name, result_of, judge):
    """Ctrl-C on the way: how long the robot moves after that, and the program lives."""
    goal, path = far(pair), os.path.join(pair.scratch.name, "drive.plan")
    x, y, _ = goal.place
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"""(in-package :pp-tut)
(let ((?pose (make-pose "map" '(({x} {y} 0) (0 0 0 1)))))
  (with-real-robot (perform (a motion (type going) (target (a location (pose ?pose)))))))
(format t "~&ARRIVED~%")
""")
    share = re.search(r"loss (\d+) %", name)
    begin = time.monotonic()
    pair.network.spoil(Faults(), name)
    before, process = pair.now(), pair.plan_command("run", path)
    while pair.now().way(before) < 0.1:
        check(time.monotonic() - begin < LIMIT, f"{name}: the robot does not begin to move: {list(process.errors.queue)}")
        time.sleep(0.005)
    if name.startswith("cancel"):
        arm(pair, name)
    elif share:
        pair.network.spoil(Faults(loss=int(share[1]) / 100), name)
    else:
        pair.network.cut(EVER, (TO_ROBOT,) if "to the robot" in name else BOTH)
    interrupted, state = time.monotonic(), pair.now()
    process.process.send_signal(signal.SIGINT)
    try:
        process.process.wait(timeout=LIMIT)
    except Exception:
        process.process.kill()
        result = result_of(name, group(name), "no end", LIMIT, seen(pair), [], [])
        judge(pair, result, None, None)
        return result
    seconds = time.monotonic() - interrupted
    moved, last = pair.watch(state, interrupted, seconds + 1)
    time.sleep(0.1)
    said = " ".join([*process.errors.queue, *process.lines.queue])
    is_told = re.search("NOTHING SAYS|STAND STILL", said)
    text = f"stands after {max(last, 0):.2f} s, ends after {seconds:.2f} s" + (", TOLD TO USE THE EMERGENCY STOP" if is_told else "")
    result = result_of(name, group(name), text, seconds, seen(pair), [], [])
    if last > STANDS and not is_told:
        result.wrong.append(f"it moves on for {last:.1f} s: {said[-300:]}")
    if "ARRIVED" in said:
        result.wrong.append("the plan goes on after Ctrl-C")
    if "panicked" in said:
        result.wrong.append(f"a thread has failed: {said[-300:]}")
    # What was on the way.
    pair.heal()
    after = pair.now()
    more, _ = pair.watch(after, time.monotonic(), 1.5)
    if more > 0.02 and not is_told:
        result.wrong.append(f"it moves by {more:.2f} when the wire is whole again")
    return result

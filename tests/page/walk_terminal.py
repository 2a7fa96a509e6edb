"""Types inputs in planwright in a terminal, as a person would, and says how long that takes.

    walk_terminal.py PLANWRIGHT EXPECTED <INPUTS (a JSON list of texts)

EXPECTED is what the last input has to show.
"""

import json
import os
import pty
import re
import select
import sys
import tempfile
import time

program, expected = os.path.abspath(sys.argv[1]), sys.argv[2]
inputs = json.load(sys.stdin)
ESCAPE = re.compile(r"\x1b(?:\[[0-9;?]*[A-Za-z]|\][^\x07]*\x07|[=>])|\r")
PROMPT = re.compile(r"(?:^|\n)[A-Z][A-Z0-9-]*(?: \w*\d\]| stopped)?> $")
SECONDS_PER_INPUT = 60

begin = time.monotonic()
with tempfile.TemporaryDirectory() as home:
    child, terminal = pty.fork()
    if child == 0:
        os.environ.update(HOME=home, XDG_STATE_HOME=home, TERM="xterm", COLUMNS="120", LINES="40")
        os.execv(program, [program])

    def until_prompt(lines):
        """What is shown until the program waits again, after so many ends of lines."""
        shown, end = "", time.monotonic() + SECONDS_PER_INPUT
        while time.monotonic() < end:
            # A pause after a prompt: nothing comes any more.
            ready, _, _ = select.select([terminal], [], [], 0.02)
            if ready:
                shown += os.read(terminal, 65536).decode(errors="replace")
            elif shown.count("\n") >= lines and PROMPT.search(ESCAPE.sub("", shown)):
                return ESCAPE.sub("", shown)
        sys.exit(f"no prompt after {SECONDS_PER_INPUT} s: {ESCAPE.sub('', shown)[-400:]!r}")

    until_prompt(0)
    opened = time.monotonic() - begin
    for text in inputs:
        # Each line as it is typed; the prompt indents by itself, as the page does.
        lines = text.split("\n")
        os.write(terminal, "".join(line.strip() + "\r" for line in lines).encode())
        shown = until_prompt(len(lines))
    seconds = time.monotonic() - begin
    os.write(terminal, b"\x04")
    os.close(terminal)
    os.waitpid(child, 0)

if " ".join(expected.split()) not in " ".join(shown.split()):
    sys.exit(f"the terminal shows {shown!r} instead of {expected!r}")
print(f"in a terminal: prompt after {opened:.1f} s, the same inputs done after {seconds:.1f} s")

"""Reads with other tools what planwright has written for them."""

import json
import os
import random
import sqlite3
import subprocess
import sys
from pathlib import Path

import duckdb
import pandas

program, folder = sys.argv[1], Path(sys.argv[2])


def written(source, name):
    """The file that is written from a source."""
    path = folder / name
    subprocess.run([program, "ask", source, "--sqlite", path], check=True, stdout=subprocess.DEVNULL)
    return path


def opened(path):
    """A connection to a file, whose integrity is checked."""
    connection = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)], path
    assert connection.execute("PRAGMA quick_check").fetchall() == [("ok",)], path
    return connection


def answers(source, goal, show):
    """The answers to a goal, as planwright prints them."""
    command = [program, "ask", source, goal, "--show", show, "--json"]
    text = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    return [tuple(json.loads(line).values()) for line in text.splitlines()]


# The facts of a sweep answer as they do in Prolog.
told = folder / "told"
facts = opened(written(told, "told.db"))
lines = {path.stem: path.read_text().count("\n") for path in told.glob("*.jsonl")}
for table, file in [("run", "records"), ("task", "task"), ("param", "param"), ("failure", "failure")]:
    assert facts.execute(f"SELECT count(*) FROM {table}").fetchone()[0] == lines[file], table
for goal, show, query in [
    (
        "(fact run :run ?run :outcome ?outcome :class ?class :time ?time)",
        "?run ?outcome ?class ?time",
        "SELECT run, outcome, class, time FROM run ORDER BY rowid",
    ),
    (
        "(and (fact run :run ?run :outcome :failure) (fact failure :run ?run :task ?task :class ?class)"
        " (fact task :run ?run :task ?task :type ?type))",
        "?run ?task ?class ?type",
        "SELECT run, task, failure.class, type FROM run JOIN failure USING (run) JOIN task USING (run, task)"
        " WHERE outcome = 'failure' ORDER BY run.rowid, failure.rowid",
    ),
    (
        '(fact draw :name "bottle.y" :run ?run :value ?y)',
        "?run ?y",
        "SELECT run, value FROM draw WHERE name = 'bottle.y' ORDER BY rowid",
    ),
]:
    expected, found = answers(told, goal, show), facts.execute(query).fetchall()
    assert found == expected and found, (query, found[:3], expected[:3])

# Rows of any length and values of any kind come back as they are.
chance = random.Random(7)
texts = ["", "\0", 'a"b\'c', "äöü ß 🤖", "12", "1e5", " 7 ", "-", "x" * 4061, "y" * 5000, "z" * 3_000_000]
rows = [(i, chance.choice(texts[:-1]) * chance.randrange(4)) for i in range(30_000)] + [
    (i, text) for i, text in enumerate(texts, 30_000)
]
numbers = [0, 1, -1, 127, 128, -129, 2**31, -(2**47), 2**53 + 1, 2**63 - 1, -(2**63), 0.1, -1e300, 5e-324]
with open(folder / "log.jsonl", "w", encoding="utf-8") as out:
    for i, text in rows:
        out.write(json.dumps({"time": i, "text": text, "extra": numbers[i % len(numbers)]}) + "\n")
log = opened(written(folder / "log.jsonl", "log.db"))
found = log.execute("SELECT time, text, extra FROM log ORDER BY rowid").fetchall()
assert found == [(float(i), text, numbers[i % len(numbers)]) for i, text in rows]
assert log.execute("SELECT count(*) FROM task").fetchone() == (0,)
assert log.execute("SELECT text FROM log WHERE rowid = 20000").fetchone() == (rows[19_999][1],)

# A file may be larger than 1 GB: the page there is SQLite's own.
if os.statvfs(folder).f_bavail * os.statvfs(folder).f_frsize > 4 << 30:
    with open(folder / "param.jsonl", "w", encoding="utf-8") as out:
        for i in range(260):
            out.write(json.dumps({"run": i, "text": chr(97 + i % 26) * (1 << 22)}) + "\n")
    large = written(folder / "param.jsonl", "large.db")
    assert large.stat().st_size > 1 << 30
    large = opened(large)
    found = large.execute("SELECT run, length(text), substr(text, -1) FROM param ORDER BY rowid").fetchall()
    assert found == [(i, 1 << 22, chr(97 + i % 26)) for i in range(260)]

# What is there is not destroyed, and what SQLite has left of it is not applied.
for name in ["told.db", "told/task.jsonl"]:
    before = (folder / name).read_bytes()
    done = subprocess.run([program, "ask", told, "--sqlite", folder / name], stderr=subprocess.PIPE, text=True)
    assert done.returncode == 2 and (folder / name).read_bytes() == before, done
(folder / "new.db-journal").write_text("what is left")
done = subprocess.run([program, "ask", told, "--sqlite", folder / "new.db"], stderr=subprocess.PIPE, text=True)
assert done.returncode == 2 and "new.db-journal is there already" in done.stderr, done
# A full disk leaves nothing.
full = "ulimit -f 40; exec \"$@\""
done = subprocess.run(["bash", "-c", f"trap '' XFSZ; {full}", "-", program, "ask", told, "--sqlite", folder / "full.db"])
assert done.returncode == 2 and not list(folder.glob("full.db*")), done

# pandas reads the file, and DuckDB what pandas has read, and the folder itself.
assert len(pandas.read_sql("SELECT * FROM task", facts)) == lines["task"]
goal, show = (
    "(and (fact run :run ?run :outcome :failure) (fact failure :run ?run :task ?task :class ?class)"
    " (fact task :run ?run :task ?task :kind :performed :type ?type))",
    "?run ?task ?class ?type",
)
expected = sorted(answers(told, goal, show))
query = """
    SELECT run, task, failure.class, type FROM {run} run JOIN {failure} failure USING (run) JOIN {task} task USING (run, task)
    WHERE outcome = 'failure' AND kind = 'performed' ORDER BY 1, 2, 3, 4"""
run, failure, task = (pandas.read_sql(f"SELECT * FROM {table}", facts) for table in ("run", "failure", "task"))
found = duckdb.sql(query.format(run="run", failure="failure", task="task")).fetchall()
assert found == expected and found, (found[:3], expected[:3])
failure, task = (f"read_json('{told}/{name}.jsonl')" for name in ("failure", "task"))
run = f"(SELECT world AS run, outcome FROM read_json('{told}/records.jsonl'))"
found = duckdb.sql(query.format(run=run, failure=failure, task=task)).fetchall()
assert found == expected, (found[:3], expected[:3])
print("SQLite, pandas and DuckDB read it")

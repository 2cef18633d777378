#!/usr/bin/env python3
"""Kills the program while it writes, and lets pairs of writers write one session at once.

    kills_and_writers.py PROGRAM [KILLS [PAIRS]]        (1000 and 200)

Two sessions of one robot differ in every sample. A kill (SIGKILL, SIGINT, SIGTERM in turn) comes at a
random moment of `simulate --force` over the session of the other; a pair of writers writes both at
once. Afterwards `identify` reads what is there: it must be one of the two sessions whole, or the
program must say that the samples are another's. What is left behind is counted: after SIGINT and
SIGTERM nothing, after SIGKILL nothing once the next write into that folder is done.

Exit status 1 where a mixture was not said, a session could not be read, or a file was left behind.
"""

import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time

POSES = 4000


def scenario(path, side):
    """Two robots that are told apart by what was measured, with samples of the same length."""
    json.dump({
        "format": "truepose-scenario/1", "name": side,
        "robot": {"name": "r", "joints": [{"name": "pan", "kind": "revolute", "axis": [0, 0, 1],
                                             "point_mm": [0, 0, 0], "limits": [-180, 180]}],
                  "tool": {"position_mm": [250, 0, 300], "quaternion_wxyz": [1, 0, 0, 0]}},
        "poses": {"sweep": {"joint": 1, "from_deg": -170, "to_deg": 170, "step_deg": 340 / POSES}},
        "effects": [{"effect": "joint-zero-offset", "joint": 1,
                     "parameters": {"offset_deg": 1.0 if side == "A" else -2.0}}],
        "noise": {"sigma_mm": 0.01, "kind": "gauss"}, "seed": 1}, open(path, "w"))


def simulate(program, folder, side):
    return [program, "simulate", os.path.join(folder, side + ".scenario.json"),
            "--out", os.path.join(folder, "s", "s.json"), "--force"]


def state(program, folder):
    """Which session is there: A, B, said (a mixture that is said), mixed, or broken."""
    path = os.path.join(folder, "s", "s.json")
    if not os.path.exists(path):
        return "none"
    named = json.load(open(path))["name"]
    ran = subprocess.run([program, "identify", path, "--json"], capture_output=True, text=True)
    if ran.returncode != 0:
        return "broken: " + ran.stderr[:300]
    found = json.loads(ran.stdout)["parameters"][0]["value"]
    is_a = abs(found - 1.0) < 0.1
    if not is_a and abs(found + 2.0) > 0.1:
        return "broken: " + str(found)
    if is_a == (named == "A"):
        return named
    return "said" if "are not those that this session was saved with" in ran.stderr else "mixed"


def left(folder):
    return [name for name in os.listdir(os.path.join(folder, "s")) if name.startswith(".truepose-")]


def main():
    program = os.path.abspath(sys.argv[1])
    kills, pairs = [int(n) for n in (sys.argv[2:] + ["1000", "200"][len(sys.argv) - 2:])]
    rng = random.Random(7)
    counts = {}
    failures = []

    def count(what):
        counts[what] = counts.get(what, 0) + 1

    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, "s"))
        for side in "AB":
            scenario(os.path.join(folder, side + ".scenario.json"), side)
        began = time.time()
        subprocess.run(simulate(program, folder, "A"), check=True)
        takes_s = time.time() - began
        slowest_s = 0.0
        for k in range(kills):
            how = [signal.SIGKILL, signal.SIGINT, signal.SIGTERM][k % 3]
            writer = subprocess.Popen(simulate(program, folder, "AB"[k % 2]), stderr=subprocess.DEVNULL)
            time.sleep(rng.uniform(0.0, 1.3 * takes_s))
            ended = writer.poll() is not None
            sent = time.time()
            writer.send_signal(how)
            writer.wait()
            slowest_s = max(slowest_s, time.time() - sent)
            name = "ended before" if ended else how.name
            behind = left(folder)
            if behind and how != signal.SIGKILL:
                # What an earlier SIGKILL left is not this one's: only new files count.
                own = [n for n in behind if n.startswith(".truepose-%d-" % writer.pid)]
                if own:
                    count("left behind after " + how.name)
                    failures.append((k, how.name, own))
            if behind and how == signal.SIGKILL:
                count("left until the next write after SIGKILL")
            is_there = state(program, folder)
            count(name + ": " + is_there.split(":")[0])
            if is_there == "mixed" or is_there.startswith(("broken", "none")):
                failures.append((k, how.name, is_there))
        subprocess.run(simulate(program, folder, "A"), check=True)
        if left(folder):
            failures.append(("after the last write", left(folder)))
        for k in range(pairs):
            both = [subprocess.Popen(simulate(program, folder, side), stderr=subprocess.DEVNULL)
                    for side in "AB"]
            codes = [writer.wait() for writer in both]
            is_there = state(program, folder)
            count("pair: " + is_there.split(":")[0])
            if is_there not in ("A", "B", "said") or codes != [0, 0] or left(folder):
                failures.append(("pair", k, is_there, codes, left(folder)))
    for what in sorted(counts):
        print(f"{counts[what]:6} {what}")
    print(f"{takes_s:.3f} s for one write; the slowest end after a signal {slowest_s:.3f} s")
    for failure in failures[:20]:
        print("FAILURE", failure)
    print(f"{len(failures)} failures of {kills} kills and {pairs} pairs")
    return 1 if failures or slowest_s > 1.0 else 0


if __name__ == "__main__":
    sys.exit(main())

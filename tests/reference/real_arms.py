#!/usr/bin/env python3
"""What is to be expected on a real robot: for every session of a folder the time, the held-out error of
`identify` and of `diagnose`, the names, and what predicts without a name.

    python3 tests/reference/real_arms.py PROGRAM FOLDER [--timeout SECONDS] [--only PART] [-- OPTIONS OF DIAGNOSE]

Sessions should mark held-out rows (`use`); the figures of others are cross-validated. Exit status 0.
"""

import argparse
import json
import pathlib
import resource
import subprocess
import sys
import time


def run(command, timeout):
    """The JSON answer of a command, processor seconds, or why there is none."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        return None, timeout, f"unfinished after {timeout:.0f} s"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime - before.ru_utime
    if done.returncode != 0:
        return None, seconds, done.stderr.strip().splitlines()[-1:]
    return json.loads(done.stdout), seconds, ""


def mm(value):
    return "-" if value is None else f"{value:.4f}"


def line(program, session, timeout, options):
    answer, seconds, why = run([program, "diagnose", str(session), "--json", *options], timeout)
    if answer is None:
        return [session.stem, f"{seconds:.1f}", "-", "-", "-", f"{why}", "-"]
    held_out = answer["held_out"]
    names = [
        found["effect"] + (f" {found['joint']}" if found.get("joint") else "") for found in answer["found"]
    ]
    unnamed = answer.get("unnamed")
    rest = "-"
    if unnamed:
        rest = f"{mm(unnamed['held_out_before_mm'])} → {mm(unnamed['held_out_after_mm'])}: " + ", ".join(
            unnamed["over"]
        )
    return [
        session.stem,
        f"{seconds:.1f}",
        mm(held_out["start_mm"]),
        mm(held_out["identified_mm"]),
        mm(held_out["end_mm"]),
        ", ".join(names) or "-",
        rest,
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--timeout", type=float, default=200)
    parser.add_argument("--only", default="", help="sessions whose name holds this")
    own, options = sys.argv[1:], []
    if "--" in own:
        at = own.index("--")
        own, options = own[:at], own[at + 1 :]
    given = parser.parse_args(own)
    print("| session | s | nominal | identify | diagnose | names | unnamed |")
    print("|---|---|---|---|---|---|---|")
    for session in sorted(given.folder.glob("*.json")):
        if given.only in session.stem and "samples" in json.loads(session.read_text()):
            print("| " + " | ".join(line(given.program, session, given.timeout, options)) + " |", flush=True)


if __name__ == "__main__":
    main()

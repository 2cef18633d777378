"""The hash that crates/session/src/sessions/files/hash.rs pins, computed from its description and nothing else.

Run: python3 tests/reference/sample_hash.py
"""
import hashlib
import math
import struct

digest = hashlib.sha256()


def label(text):
    data = text.encode()
    digest.update(struct.pack("<Q", len(data)) + data)


def numbers(name, values):
    label(name)
    digest.update(struct.pack("<Q", len(values)) + struct.pack(f"<{len(values)}d", *values))


label("truepose-samples/1")
label("revolute")
numbers("axis", [0, 0, 1])
numbers("point", [0, 0, 0])
numbers("tool", [250, 0, 300])
numbers("turn", [1, 0, 0, 0])
numbers("target", [0, 0, 0])
numbers("q", [0, 90 * (math.pi / 180)])
for _ in ("q_read", "dir", "speed"):
    label("none")
numbers("x", [250, 0])
numbers("y", [0, 250])
for _ in ("z", "load", "temperature", "time", "target", "setup", "held out"):
    label("none")
print(digest.hexdigest())

#!/usr/bin/env python3
"""What a parser of structured text (blark, from PyPI) reads in a file with a table.

    python3 structured_text.py TABLE.st

prints a line `position compensation` for each element of its array. A file that is no structured
text ends in an error.
"""

import sys

import blark

parsed = blark.parse_source_code(open(sys.argv[1], encoding="utf-8").read())
if parsed.exception is not None:
    sys.exit(str(parsed.exception))
array = parsed.transform().items[0].items[0]


def members(node):
    """Every `name := value` below a node, in the order of the text."""
    if isinstance(node, (list, tuple)):
        return [member for part in node for member in members(part)]
    if isinstance(node, blark.transform.StructureElementInitialization):
        return [(str(node.name), str(node.value))]
    inside = [part for name, part in getattr(node, "__dict__", {}).items() if name != "meta"]
    return members(inside) if inside else []


pairs = members(array.init.value)
for (first, position), (second, compensation) in zip(pairs[::2], pairs[1::2], strict=True):
    if (first, second) != ("Position", "Compensation"):
        sys.exit(f"{first} and {second} in place of Position and Compensation")
    print(float(position), float(compensation))

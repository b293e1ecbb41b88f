"""Ants [Ferranti 2009] in Python: a program for `tautline conform`. Each ant goes where ants have been least; ties go
to the first side in the order of the compass. That order is the argument, and another one than NESW is a slip.

tautline conform RUN -- python3 ants.py
"""

import json
import sys
from collections import Counter

ORDER = sys.argv[1] if len(sys.argv) > 1 else "NESW"
OFFSETS = {"N": (0, -1), "E": (1, 0), "S": (0, 1), "W": (-1, 0)}


def main():
    entered = Counter()
    for line in map(json.loads, sys.stdin):
        if "end" in line:
            return
        if "step" not in line:
            if (line["scheme"], line["rule"]) != ("ants", "published"):
                sys.exit("ants: this is no run of ants, as published")
            entered.update(map(tuple, line["starts"]))
            continue
        tried = ""
        # The ants of a team move act one after the other: each sees what those before it have counted.
        for (x, y), sides in zip(line["cells"], line["sides"]):
            beyond = {side: (x + OFFSETS[side][0], y + OFFSETS[side][1]) for side in ORDER if side in sides}
            side = min(beyond, key=lambda side: entered[beyond[side]], default=".")
            if side != ".":
                entered[beyond[side]] += 1
            tried += side
        print(json.dumps({"tried": tried}), flush=True)


main()

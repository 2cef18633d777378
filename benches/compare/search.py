"""Times numpy on the work of `cargo bench --bench diagnosis`, in processor time.

    pip install numpy
    python3 benches/compare/search.py [SAMPLES]

The plain way to look for missing effects in samples like those of the benchmark: the columns of
every name at every setting that `truepose diagnose` tries (all gear orders from 3 to 360, forty
times of a shift, runout and wobble of orders 2 to 6, …), their Gram matrix for each of ten folds,
and up to eight effects picked forward, each as a group, while the ten-fold cross-validated sum of
squares falls. The columns are made in chunks, for all of them at once would need some 20 GB.

There is no null distribution, no shape without a name, no rival and no interval here: `diagnose`
does these as well.
"""
import sys
import time

import numpy as np

SAMPLES = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
FOLDS, PICKS, CHUNK = 10, 8, 8_000
RADII, HEIGHTS = np.array([250.0, 370.0]), np.array([300.0, 340.0])
ORDERS, TIMES = range(3, 361), 40


def session(n):
    """The benchmark's robot: backlash 0.05 deg and eccentricity 0.06 deg, noise 0.03 mm."""
    rng = np.random.default_rng(7)
    s = {
        "q": np.radians(340 * (rng.random(n) - 0.5)),
        "side": np.where(rng.random(n) > 0.5, 1.0, -1.0),
        "speed": np.radians(rng.choice([0.0, 5.0, 20.0], n)),
        "load": rng.choice([0.0, 3.0, 6.0], n),
        "time": 6.0 * np.arange(n),
        "target": rng.integers(0, 2, n),
    }
    s["speed"] *= s["side"]
    s["warmth"] = 6 * (1 - np.exp(-s["time"] / (0.2 * s["time"][-1])))
    angle = s["q"] + np.radians(0.06) * np.sin(s["q"] - 0.7) - s["side"] * np.radians(0.025)
    r = RADII[s["target"]]
    s["points"] = np.stack([r * np.cos(angle), r * np.sin(angle), HEIGHTS[s["target"]]])
    s["points"] += 0.03 * rng.standard_normal((3, n))
    return s


def columns(s, part, last):
    """Every candidate's columns for some samples, and the groups they belong to."""
    q, side, speed = s["q"][part], s["side"][part], s["speed"][part]
    load, warmth, t = s["load"][part], s["warmth"][part], s["time"][part]
    r, h = RADII[s["target"][part]], HEIGHTS[s["target"][part]]
    c, d, zero, one = np.cos(q), np.sin(q), np.zeros_like(q), np.ones_like(q)
    tangent = np.stack([-r * d, r * c, zero])
    radial, axial = np.stack([c, d, zero]), np.stack([zero, zero, one])
    frame = [np.stack(e) for e in ([one, zero, zero], [zero, one, zero], [zero, zero, one])]
    groups = []

    def angle(*values):
        groups.append([tangent * v for v in values])

    angle(one)
    groups.append([radial])
    angle(q)
    angle(d, c)
    angle(np.sin(2 * q), np.cos(2 * q))
    for k in ORDERS:
        angle(np.sin(k * q), np.cos(k * q))
    angle(side)
    travel = np.abs(np.diff(q, prepend=q[0]))
    for fade in np.radians([0.5, 1, 2, 4, 8, 16]):
        angle(side * (1 - 2 * np.exp(-travel / fade)))
    angle(speed)
    angle(warmth)
    groups.append([radial * (r * warmth)])
    for k in range(2, 7):
        ck, sk = np.cos(k * q), np.sin(k * q)
        groups.append([np.stack([ck, sk, zero]), np.stack([-sk, ck, zero])])
        groups.append([axial * (r * ck), axial * (r * sk)])
    groups.append([axial * load])
    groups.append([axial * (r * d), -axial * (r * c)])
    groups.append(frame)
    groups.append([np.stack([r * c, r * d, h])])
    groups.append([f * t for f in frame])
    for k in range(TIMES):
        after = (t > last * (0.1 + 0.8 * (k + 0.5) / TIMES)).astype(float)
        groups.append([f * after for f in frame])
    sizes = [len(g) for g in groups]
    return np.concatenate([np.stack([v.ravel() for v in g]) for g in groups]), sizes


def gram_of_folds(s):
    n = len(s["q"])
    last = s["time"][-1]
    grams, sizes = None, None
    fold_of = (np.arange(0, n, CHUNK) // CHUNK) % FOLDS
    for fold, start in zip(fold_of, range(0, n, CHUNK)):
        part = slice(start, min(start + CHUNK, n))
        a, sizes = columns(s, part, last)
        r = RADII[s["target"][part]]
        q = s["q"][part]
        nominal = np.stack([r * np.cos(q), r * np.sin(q), HEIGHTS[s["target"][part]]])
        e = (s["points"][:, part] - nominal).ravel()
        a = np.vstack([a, e])
        if grams is None:
            grams = np.zeros((FOLDS, len(a), len(a)))
        grams[fold] += a @ a.T
    return grams, sizes


def left(gram, rows):
    """Sum of squares that a fit of these columns leaves."""
    g, h = gram[np.ix_(rows, rows)], gram[rows, -1]
    return gram[-1, -1] - h @ np.linalg.lstsq(g, h, rcond=1e-12)[0]


def cross_validated(grams, total, rows):
    unseen = 0.0
    for own in grams:
        rest = total - own
        x = np.linalg.lstsq(rest[np.ix_(rows, rows)], rest[rows, -1], rcond=1e-12)[0]
        unseen += own[-1, -1] - 2 * x @ own[rows, -1] + x @ own[np.ix_(rows, rows)] @ x
    return unseen


def search(s):
    grams, sizes = gram_of_folds(s)
    total = grams.sum(axis=0)
    first = np.concatenate([[0], np.cumsum(sizes)])
    group = [list(range(a, b)) for a, b in zip(first, first[1:])]
    chosen, rows = [0, 1], group[0] + group[1]
    unseen = cross_validated(grams, total, rows)
    for _ in range(PICKS):
        open_groups = [k for k in range(len(group)) if k not in chosen]
        best = min(open_groups, key=lambda k: left(total, rows + group[k]))
        after = cross_validated(grams, total, rows + group[best])
        if after >= unseen * (1 - 1e-4):
            break
        chosen, rows, unseen = [*chosen, best], rows + group[best], after
    return chosen, len(total) - 1


s = session(SAMPLES)
start = time.process_time()
chosen, width = search(s)
spent = time.process_time() - start
print(f"{SAMPLES} samples, {width} columns, groups {chosen}: {spent:.2f} s of processor time")

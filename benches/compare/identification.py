"""Times numpy on the work of `cargo bench --bench identification`, in processor time.

    pip install numpy
    python3 benches/compare/identification.py

A million samples like those of the benchmark (other random numbers): the paper's sums by region,
vectorised, and Gauss-Newton with an analytic Jacobian for nine parameters.
"""
import statistics
import time

import numpy as np

n = 1_000_000
rng = np.random.default_rng(7)
q = np.pi * (rng.random(n) - 0.5)
side = np.where(rng.random(n) > 0.5, 1.0, -1.0)
theta = q * 1.0002 + 0.01 + 3e-4 * np.sin(q - 0.7) - side * 2e-4
x = 249 * np.cos(theta) + 0.3 + 0.1 * (rng.random(n) - 0.5)
y = 249 * np.sin(theta) - 0.2 + 0.1 * (rng.random(n) - 0.5)
z = 300.1 + 0.1 * (rng.random(n) - 0.5)


def regional():
    dx, dy = 250 * np.cos(q) - x, 250 * np.sin(q) - y
    edges = np.linspace(-np.pi / 2, np.pi / 2, 7)
    region = np.clip(np.searchsorted(edges, q) - 1, 0, 5)
    count = np.bincount(region, minlength=6)
    return np.bincount(region, dx, 6) / count, np.bincount(region, dy, 6) / count / 250


def exact():
    p = np.zeros(9)
    for _ in range(10):
        s, c = np.sin(q), np.cos(q)
        sine = p[2] * s - p[3] * c
        t = (1 + p[1]) * q + p[0] + np.arcsin(sine) - side * p[4] / 2
        radius = 250 + p[5]
        ct, st = np.cos(t), np.sin(t)
        r = np.concatenate([x - radius * ct - p[6], y - radius * st - p[7], z - 300 - p[8]])
        slope = 1 / np.sqrt(1 - sine * sine)
        jacobian = np.zeros((3 * n, 9))
        for k, d in enumerate([np.ones(n), q, s * slope, -c * slope, -side / 2]):
            jacobian[:n, k] = -radius * st * d
            jacobian[n : 2 * n, k] = radius * ct * d
        jacobian[:n, 5], jacobian[n : 2 * n, 5] = ct, st
        jacobian[:n, 6] = jacobian[n : 2 * n, 7] = jacobian[2 * n :, 8] = 1
        step = np.linalg.solve(jacobian.T @ jacobian, jacobian.T @ r)
        p += step
        if np.max(np.abs(step)) < 1e-9:
            return p


for work in (regional, exact):
    work()
    times = []
    for _ in range(5):
        start = time.process_time()
        work()
        times.append(1000 * (time.process_time() - start))
    print(f"{work.__name__}: {statistics.median(times):.1f} ms of processor time")

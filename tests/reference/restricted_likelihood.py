#!/usr/bin/env python3
"""The restricted likelihood of a white and a slow noise beside three columns, by scipy and without the formula of the
program: the density of what no column reaches, K'y with K an orthonormal basis of the null space of X'.

    python tests/reference/restricted_likelihood.py > tests/reference/restricted_likelihood.json

82 points, 3.5 s apart, in three coordinates; columns and residual are sines, so that both sides write
them down. Noise along each axis: sigma^2 (1 + ratio exp(-|t - u| / tau)). The common size is profiled out, constants left out.
`fit::noise::restricted` compares its own with it.
"""
import json

import numpy as np
from scipy.linalg import block_diag, null_space
from scipy.stats import multivariate_normal

TAU, RATIO, SIGMA = 40.0, [2.0, 0.0, 0.5], [0.05, 0.02, 0.11]
times = 3.5 * np.arange(82)
n = len(times)


def wild(i, j):
    return np.sin((i + 3) * (2 * j + 5) * 0.37)


rows = np.arange(3 * n)
x = np.column_stack([wild(rows, j) for j in range(3)])
y = 0.1 * wild(rows, 9)
apart = np.abs(times[:, None] - times[None, :])
noise = block_diag(*[s * s * (np.eye(n) + r * np.exp(-apart / TAU)) for s, r in zip(SIGMA, RATIO)])
k = null_space(x.T)
z, covariance = k.T @ y, k.T @ noise @ k
freedom = len(z)
# Of the density at size 1: -(f ln 2 pi + ln det + square) / 2.
square = z @ np.linalg.solve(covariance, z)
density = multivariate_normal(np.zeros(freedom), covariance).logpdf(z)
ln_det = -2 * density - freedom * np.log(2 * np.pi) - square
variance = square / freedom
print(json.dumps({"ln_likelihood": -0.5 * (freedom * np.log(variance) + ln_det), "scale": np.sqrt(variance)}))

# SPDX-License-Identifier: BSD-3-Clause
"""Prints the values that the tests of solvers/comparison quote from SciPy. Run by hand; the tests do not need it."""
import numpy as np
import scipy
from scipy import stats

print("scipy", scipy.__version__)

i = np.arange(80)
a, b = (37 * i + 5) % 101, (53 * i + 11) % 97
for count in (12, 40):
    d = (a - b)[:count]
    d = d + np.where(d < 0, -1, 1) * (i[:count] + 1) / 64  # no ties, no zeros
    assert len(set(abs(d))) == count and np.all(d != 0)
    print("wilcoxon exact", count, d[:3], stats.wilcoxon(d, mode="exact"))
for shift in (0, 10):
    print("wilcoxon approx, a and b +", shift, np.count_nonzero(a - b - shift), "pairs",
          stats.wilcoxon(a, b + shift, zero_method="wilcox", correction=True, mode="approx"))

p, s = np.meshgrid(np.arange(12), np.arange(5), indexing="ij")
costs = (7 * p + 5 * s * s + p * s) % 11 + s
print("friedman", costs[:2].tolist(), stats.friedmanchisquare(*costs.T))

for x, df in ((0.5, 1), (3.2, 2), (9.28, 3), (15.0, 8), (60.0, 19), (400.0, 3)):
    print("chi2.sf", x, df, repr(stats.chi2.sf(x, df)))
for q in (1e-300, 1e-20, 1e-5, 0.025, 0.2, 0.5, 0.6, 0.975, 0.995):
    print("norm.ppf", q, repr(stats.norm.ppf(q)))
for x in (-10, -37):
    print("norm.cdf", x, repr(stats.norm.cdf(x)))
for q, k in ((1.0, 2), (3.3, 3), (3.3, 10), (5.0, 20), (0.5, 3)):
    print("studentized_range.cdf", q, k, repr(stats.studentized_range.cdf(q, k, np.inf)))

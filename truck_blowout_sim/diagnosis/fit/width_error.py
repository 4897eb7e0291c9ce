"""What a fall of the sum of squares supports at most, since the widths are estimates.

The fall is in units of the widths: how far good models of the truck differ. As a Gaussian's, 12
would be much. But widths are estimated, and a model is nearer to the truck in one maneuver than in
the next: the mean square that it leaves differs by a factor from run to run. So a fall follows the
square of a t-law. What says more than that says of the effect cannot be said: where runs agree on
an amount that changes hardly more than widths allow, they may agree on what the model does wrong.

References: Student 1908; Satterthwaite 1946 (degrees of freedom of an estimated variance).
Known limits: one factor for all channels; how much runs differ is a judgement (see `by_chance.py`).
Validated with: test/diagnosis/test_width_error.py (a t-law's quantiles; Gaussian for many runs).
"""

from __future__ import annotations

import numpy as np
from scipy.stats import chi2
from scipy.stats import t as student

RUN_SCATTER = 0.4  # of the logarithm of the mean square that a model leaves, from run to run


def degrees_of(runs: int) -> float:
    """Degrees of freedom of widths that ``runs`` show: a chi-square's log has variance 2 / n."""
    return 2.0 / (RUN_SCATTER**2 * (1.0 + 1.0 / max(runs, 1)))


def most_supported(fall: float, degrees: float) -> float:
    """Support that is as rare by chance, were the widths known, as the fall is by the t-law."""
    rare = float(student.logsf(np.sqrt(max(fall, 0.0)), degrees))
    return float(chi2.isf(2.0 * np.exp(rare), 1))

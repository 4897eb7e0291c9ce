"""Whether an event stands out of what its force seems to do at all other times.

Every second of every run, baseline too, gives an apparent amount of the event's force there, since
no model is exact. These amounts a are taken as a process without rest,

    a ~ N(0, tau^2 [(1 - rho) I + rho exp(-|t_i - t_j| / l) within a run])

and the event as one common amount A over one stretch of each training run. In one of the runs, tau
may be many times as large as in the others: its maneuver may be the one that the model is worst at.
The support is twice the log of

    sum_process L(process, stretches free, A ~ N(0, wide^2))
    / sum_process [L(process) + L(process, stretches free, A ~ N(0, ambient^2))]

with the stretches of each run averaged over, so that a free choice costs what it must, and with
wind, slope and sliding of everyday size on the other side. Size, share and length of the process
are summed over a grid: the recordings decide. In a long log, whose instruments drift, nearly all of
it may last, for 30 s, 300 s and so on. An unseen run may have the event, or not: even odds.

References: Kass and Raftery 1995 (Bayes factors); Rasmussen and Williams 2006, ch. 2 and 5 (process
and its marginal likelihood); Tukey 1960 (contaminated normal: few observations of another scale).
Known limits: linear in the amount, so not for what acts near a limit only (loss of grip, a lost
tire); stretches begin and end at whole seconds; what acts from the first second on is steady.
Validated with: test/diagnosis/test_windows.py (closed forms; false alarms of simulated processes).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.effects.base import Timing
from truck_blowout_sim.diagnosis.fit.stretches import lasting, of_stretches, stretches

Floats = NDArray[np.float64]
# tau in standard errors of one second, from none to more than any model is off
_SIZES: Floats = np.concatenate([[0.0], 2.0 ** np.arange(-4.0, 7.0)])
_SHARES = (0.5, 0.9)  # rho: from half of it to nearly all
_LENGTHS_S = (3.0, np.inf)  # l: of a maneuver, or as long as the run
_LASTING = 0.99  # rho of what drifts over minutes: nearly all of it lasts
_OWN_SIZES = (4.0, 16.0, 64.0)  # times as large as in the other runs, mostly for a maneuver
_AMOUNTS: Floats = np.geomspace(0.5, 200.0, 30)  # standard errors of the clearest stretch
_UNLIKELY = 20.0  # log-likelihood by which what is not looked at is worse than the best
_LIKELIER = float(np.log(20.0))
_DIM = 1e-9


@dataclass(frozen=True, eq=False)
class Windows:
    """What each second of each run shows of an event's force, the nuisances marginalized.

    Attributes:
        information: [n, n] w_i' C^-1 w_j of the responses to a force over one second; ``gradient``:
            [n] w_i' C^-1 r.
        run: [n] position of the run; ``time_s``: [n] when the second begins.
        trained: [n] whether the event acts in the run; ``unseen``: [n] whether it may.
        timing: of the event: a pulse ends again, a step lasts, a ramp grows and lasts.
        bounds: between which the amount lies; ``ambient``: its everyday size, 1 sigma; ``wide``: 1
            sigma of what an event may be.
    """

    information: Floats
    gradient: Floats
    run: NDArray[np.int64]
    time_s: Floats
    trained: NDArray[np.bool_]
    unseen: NDArray[np.bool_]
    timing: Timing
    bounds: tuple[float, float]
    ambient: float
    wide: float

    @cached_property
    def scale(self) -> float:
        """Information on the amount in a middling second."""
        own = np.diag(self.information)
        seen = own[own > _DIM * max(float(own.max(initial=0.0)), 1e-300)]
        return float(np.median(seen)) if seen.size else 0.0

    @property
    def without_unseen(self) -> Windows:
        """The same, but for the unseen runs."""
        kept = np.flatnonzero(~self.unseen)
        return replace(self, information=self.information[np.ix_(kept, kept)],
                       gradient=self.gradient[kept], run=self.run[kept], time_s=self.time_s[kept],
                       trained=self.trained[kept], unseen=self.unseen[kept])

    def support(self) -> float:
        """Twice the log of the odds, at even odds before; 0 where no run shows the event."""
        if self.scale <= 0.0 or not self.trained.any():
            return 0.0
        found = [one for process in self._processes() for one in self._weighed(process)]
        usual = max((one[0] for one in found), default=0.0)
        # a run of its own size is asked about where that alone is 20 times as likely: it takes time
        found += [one for process in self._restless_runs() for one in self._weighed(
            process, usual + _LIKELIER)]
        idle, ambient, wide = np.array(found).T if found else np.zeros((3, 1))
        return 2.0 * float(log_sum(wide) - np.logaddexp(log_sum(idle), log_sum(ambient)))

    def _processes(self) -> Iterator[Floats]:
        """Square roots [n, n] of the correlations that the restless force may have."""
        yield np.eye(self.run.size)
        for share, length in (*product(_SHARES, _LENGTHS_S), *self._drifts()):
            yield self._root(share, length)

    def _drifts(self) -> Iterator[tuple[float, float]]:
        """Of long logs, whose instruments drift: ten times a maneuver's length, and so on."""
        longest = max((float(np.ptp(self.time_s[self.run == k])) for k in np.unique(self.run)),
                      default=0.0)
        length = 10.0 * min(_LENGTHS_S)
        while length < longest:
            yield _LASTING, length
            length *= 10.0

    def _restless_runs(self) -> Iterator[Floats]:
        """The same where one run has more of it than the others."""
        root = self._root(max(_SHARES), min(_LENGTHS_S))
        for own, size in product(np.unique(self.run), _OWN_SIZES):
            yield np.where(self.run == own, size, 1.0)[:, None] * root

    def _root(self, share: float, length_s: float) -> Floats:
        """Square root of a correlation: a share of it lasts for so long."""
        same = self.run[:, None] == self.run[None, :]
        apart = np.abs(self.time_s[:, None] - self.time_s[None, :])
        return np.asarray(np.linalg.cholesky((1.0 - share) * np.eye(self.run.size)
                                             + share * same * np.exp(-apart / length_s)))

    def _weighed(self, root: Floats, least: float = -np.inf
                 ) -> Iterator[tuple[float, float, float]]:
        """Log-likelihoods for each size: nothing, an everyday event, an event of any size.

        Also for sizes that are unlikely without the event: with it, the force may be calm.
        ``least``: none if nothing is less likely than that at every size.
        """
        value, vector = np.linalg.eigh(root.T @ self.information @ root / self.scale)
        value, loaded = np.maximum(value, 0.0), root @ vector / np.sqrt(self.scale)
        seen, reach = loaded.T @ self.gradient, self.information @ loaded
        widened = 1.0 + np.square(_SIZES)[:, None] * value
        idle = 0.5 * (np.square(_SIZES)[:, None] * np.square(seen) / widened
                      - np.log(widened)).sum(axis=1)
        if idle.max() <= least:
            return
        owners = [np.flatnonzero(self.run == k)
                  for k in np.unique(self.run[self.trained | self.unseen])]
        for size, wide, rest in zip(_SIZES, widened, idle, strict=True):
            taken = size**2 / wide
            runs = [(*self._stretches(
                self.gradient[own] - reach[own] @ (taken * seen),
                self.information[np.ix_(own, own)] - (reach[own] * taken) @ reach[own].T,
                self.time_s[own]), bool(self.unseen[own[0]])) for own in owners]
            if rest + _most(runs) > idle.max() - _UNLIKELY:
                ambient, event = self._events(runs)
                yield rest, rest + ambient, rest + event

    def _events(self, runs: Sequence[tuple[Floats, Floats, bool]]) -> tuple[float, float]:
        """Log-likelihood gained by an everyday event and by one of any size, stretches averaged.

        ``runs``: slope and bend of the stretches of each run, and whether it is an unseen one.
        """
        clearest = max((float(b.max(initial=0.0)) for _, b, unseen in runs if not unseen),
                       default=0.0)
        if clearest <= 0.0:
            return 0.0, 0.0
        amounts = np.concatenate([-_AMOUNTS[::-1], _AMOUNTS]) / np.sqrt(clearest)
        amounts = amounts[(amounts > self.bounds[0]) & (amounts < self.bounds[1])]
        if amounts.size < 2:
            return 0.0, 0.0
        gained = np.zeros(amounts.size)
        for s, b, unseen in (one for one in runs if one[0].size):
            with_it = log_sum(np.outer(amounts, s) - 0.5 * np.outer(amounts**2, b))
            with_it = with_it - np.log(s.size)
            gained = gained + (np.logaddexp(with_it, 0.0) - np.log(2.0) if unseen else with_it)
        return self._over(amounts, gained, self.ambient), self._over(amounts, gained, self.wide)

    def _stretches(self, slope: Floats, bend: Floats, time_s: Floats) -> tuple[Floats, Floats]:
        """Slope and bend of every stretch of one run that begins after its first second."""
        apart_s = float(time_s[1] - time_s[0]) if time_s.size > 1 else 0.0
        if self.timing != "pulse":
            slope, bend = lasting(slope, bend)
        return of_stretches(self.timing, slope, bend,
                            *stretches(self.timing, slope.size, 1, slope.size - 1, apart_s))

    @staticmethod
    def _over(amounts: Floats, gained: Floats, sigma: float) -> float:
        """Log of the mean of a likelihood over amounts of this sigma."""
        density = gained - 0.5 * np.square(amounts / sigma) + np.log(np.abs(np.gradient(amounts)))
        return float(log_sum(density)) - np.log(sigma * np.sqrt(2.0 * np.pi))


def log_sum(logs: Floats) -> Floats:
    """Log of the sum of exp over the last axis; scipy's takes ten times as long on short ones."""
    most = logs.max(axis=-1, keepdims=True)
    return np.asarray(most[..., 0] + np.log(np.exp(logs - most).sum(axis=-1)))


def _most(runs: Sequence[tuple[Floats, Floats, bool]]) -> float:
    """Log-likelihood that an event could gain at most, each run its own best stretch and amount."""
    return sum(float(np.max(np.square(s) / (2.0 * np.maximum(b, _DIM)), initial=0.0))
               for s, b, _ in runs)

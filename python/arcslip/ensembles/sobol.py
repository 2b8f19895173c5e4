"""Sobol indices of ensembles, by SALib."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..extras import required

if TYPE_CHECKING:
    from .ensemble import Ensemble


class SobolIndices(NamedTuple):
    """The share of the variance of a quantity that parameters account for (Saltelli et al. 2010).

    Attributes
    ----------
    parameters : tuple of str
    first : array, shape (parameters,)
        By each parameter alone: S_i = V[E[Y | x_i]] / V[Y].
    total : array, shape (parameters,)
        By each with all its interactions: T_i = 1 - V[E[Y | x without x_i]] / V[Y].
    first_error, total_error : array, shape (parameters,)
        Half the width of their confidence intervals of 95 %, by bootstrap.
    """

    parameters: tuple[str, ...]
    first: NDArray[np.float64]
    total: NDArray[np.float64]
    first_error: NDArray[np.float64]
    total_error: NDArray[np.float64]


def _bounds(name: str, kind: str, numbers: Sequence[float]) -> tuple[str, list[float]]:
    """Return a distribution as SALib has it."""
    if kind == "uniform":
        return "unif", list(numbers)
    if kind == "normal":
        return "norm", list(numbers)
    if kind == "truncated_normal":
        mean, deviation, lower, upper = numbers
        return "truncnorm", [lower, upper, mean, deviation]
    if kind == "lognormal":
        mean, deviation = numbers
        variance = math.log(1 + (deviation / mean) ** 2)
        return "lognorm", [math.log(mean) - variance / 2, math.sqrt(variance)]
    known = ["normal", "uniform", "lognormal", "truncated_normal"]
    raise ValueError(f"found the distribution {kind!r} of {name!r}, must be one of {known}")


def saltelli(
    distributions: Mapping[str, Mapping[str, Sequence[float]]], count: int, *, seed: int = 1
) -> dict[str, NDArray[np.float64]]:
    """Return samples from which Sobol indices follow: what `Scene.ensemble` takes, and `Ensemble.sobol_indices` reads.

    Parameters
    ----------
    distributions : mapping
        Of each parameter, as `for_each` of a scene has them: ``{"damper.normal_load": {"normal": [30, 3]}}``.
    count : int
        The number N of base samples, a power of two; with d parameters there are N (d + 2) samples.
    seed : int
        Of the scrambling of Sobol's sequence.

    Returns
    -------
    dict
        An array of N (d + 2) values for each parameter.

    Raises
    ------
    ValueError
        For a count that is no power of two, and an unknown distribution.
    ImportError
        If SALib is not installed: the extra ``arcslip[ensemble]`` has it.

    Examples
    --------
    >>> samples = arcslip.saltelli({"k.value": {"uniform": [0.9, 1.1]}, "c.value": {"normal": [0.1, 0.01]}}, 8)
    >>> samples["k.value"].shape
    (32,)
    """
    if count < 2 or count & (count - 1):
        raise ValueError(f"found count={count}, must be a power of two, at least 2")
    if not distributions or any(len(each) != 1 for each in distributions.values()):
        raise ValueError(f"found distributions={distributions!r}, must have one distribution for each of some parameters")
    design = required("SALib.sample.sobol", "ensemble")
    found = [_bounds(name, *next(iter(each.items()))) for name, each in distributions.items()]
    problem = {
        "num_vars": len(found),
        "names": list(distributions),
        "bounds": [numbers for _, numbers in found],
        "dists": [kind for kind, _ in found],
    }
    values = design.sample(problem, count, calc_second_order=False, seed=seed)
    return {name: np.ascontiguousarray(values[:, i]) for i, name in enumerate(distributions)}


def _parameters(ensemble: Ensemble) -> list[str]:
    """Return the names of the parameters that were varied: the columns between the number of a sample and its status."""
    names = list(ensemble.columns)
    return names[names.index("sample") + 1 : names.index("status")]


def _check(ensemble: Ensemble, parameters: Sequence[str]) -> None:
    """Check that samples are those of `saltelli`: in each group the sample i + 1 differs from the first one in parameter i."""
    step = len(parameters) + 2
    values = np.stack([ensemble[name] for name in parameters], axis=1)
    if len(values) % step == 0 and len(values) > 0:
        groups = values.reshape(-1, step, len(parameters))
        mixed, of_first = groups[:, 1:-1], groups[:, :1]
        if all(
            np.array_equal(np.delete(mixed[:, i], i, 1), np.delete(of_first[:, 0], i, 1))
            and np.array_equal(mixed[:, i, i], groups[:, -1, i])
            for i in range(len(parameters))
        ):
            return
    raise ValueError("found other samples than those of arcslip.saltelli(), from which alone Sobol indices follow")


def indices(ensemble: Ensemble, quantity: str, seed: int) -> SobolIndices:
    """Return the Sobol indices of a quantity: `Ensemble.sobol_indices`."""
    parameters = _parameters(ensemble)
    _check(ensemble, parameters)
    values = np.asarray(ensemble[quantity], dtype=float)
    missing = int((~np.isfinite(values) | (ensemble["status"] != "complete")).sum())
    if missing:
        raise ValueError(f"{missing} of {len(values)} samples have no {quantity}: without these there are no indices")
    if np.ptp(values) == 0:
        raise ValueError(f"{quantity} is the same in all samples, and has no variance")
    analysis = required("SALib.analyze.sobol", "ensemble")
    problem = {"num_vars": len(parameters), "names": parameters, "bounds": [[0, 1]] * len(parameters)}
    found: dict[str, Any] = analysis.analyze(problem, values, calc_second_order=False, seed=seed)
    return SobolIndices(tuple(parameters), *(np.asarray(found[key]) for key in ("S1", "ST", "S1_conf", "ST_conf")))

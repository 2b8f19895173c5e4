"""Optima: what a search for the best design found."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from .quantities import Facts, Quantity, as_facts
from .results import Result
from .tables import Table

#: What an optimum has of its own, before the columns of its table.
OWN = ("design", "amplitude", "feasible", "response", "certificate", "gradient", "ranges", "varied")


class Optimum(Result):
    """The design with the lowest resonance peak, and its certificate: a result of a study of kind "optimum".

    Its main table, `course`, has the designs that were evaluated. Where no optimum was found, `design` is empty and
    `amplitude` is NaN.
    """

    @property
    def design(self) -> dict[str, Quantity]:
        """The values of the parameters that were varied, each with its unit: what `Scene.replace` takes."""
        return {name: Quantity(self._found[name], unit=self._unit(name)) for name in self.varied if name in self._found}

    @property
    def amplitude(self) -> Quantity:
        """The amplitude of the highest peak, or of the criterion over several cases, in m."""
        return Quantity(self._found.get("amplitude", math.nan), unit="m")

    @property
    def feasible(self) -> bool:
        """Whether the design satisfies the constraints."""
        return bool(self._found.get("feasible", False))

    @property
    def response(self) -> Facts:
        """The quantities of the response at the peak, as a point of a branch has them."""
        return Facts({name: value for name, value in self._found.items() if name not in {*self.varied, "feasible"}})

    @property
    def certificate(self) -> Facts | None:
        """The evidence that the design is a minimum: `stationarity`, `complementarity`, `curvature`, `peaks` and so on.

        None where no design could be certified.
        """
        found = self.facts.get("certificate")
        return None if found is None else Facts(found)

    @property
    def gradient(self) -> dict[str, Quantity]:
        """The derivative of the amplitude by each parameter, in m over the parameter's unit; empty without a certificate."""
        slopes = self.facts.get("certificate", {}).get("gradient", {})
        return {name: Quantity(slope, unit=_per(self._unit(name))) for name, slope in slopes.items()}

    @property
    def ranges(self) -> dict[str, tuple[Facts, ...]]:
        """The tolerance ranges of each parameter, in its unit, the narrowest first; empty without a certificate.

        From `lower` to `upper` the amplitude is at most 1 + `share` times the lowest one, and all limits hold. The ends may
        be bounds of the parameter, `lower_is_bound`, or those of limits, `lower_is_limit`.
        """
        ranges = self.facts.get("certificate", {}).get("ranges", {})
        return {name: as_facts(of_parameter) for name, of_parameter in ranges.items()}

    @property
    def _found(self) -> dict[str, Any]:
        return self.facts.get("optimum") or {}

    @property
    def varied(self) -> tuple[str, ...]:
        """The names of the parameters that were varied."""
        return tuple(name for name in self.main.columns if name != "amplitude")

    def _unit(self, name: str) -> str:
        return self.main.units.get(name, "")

    def _names(self) -> list[str]:
        return [*OWN, *super()._names()]

    def __getitem__(self, name: str) -> Any:
        return getattr(self, name) if name in OWN else super().__getitem__(name)

    def __repr__(self) -> str:
        design = [f"{name} = {value:.6g} {value.unit}".rstrip(" -") for name, value in self.design.items()]
        amplitude = [f"amplitude {self.amplitude:.6g} m"] if design else []
        study = [f"optimum of {self.study!r}" if self.study else "optimum"]
        settings = [f"{name} = {value:.6g}" for name, value in self.set.items()]
        return f"<{', '.join([*study, *settings, *design, *amplitude, self.status])}>"


def _per(unit: str) -> str:
    """Return the unit of an amplitude over another one."""
    if unit in ("", "-"):
        return "m" if unit == "-" else ""
    return f"m/({unit})" if " " in unit or "/" in unit else f"m/{unit}"


def result(about: Mapping[str, Any], tables: dict[str, Table], labels: Mapping[str, str]) -> Result:
    """Return a result, an optimum where it is that of a search."""
    return (Optimum if about["noun"] == "search" else Result)(about, tables, labels)

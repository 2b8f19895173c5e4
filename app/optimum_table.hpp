#pragma once

#include <arcslip/optimize/optimum_study.hpp>
#include <arcslip/scene/scene.hpp>

#include <iosfwd>
#include <span>

namespace arcslip::app {

/// Optima for people: the values found, the amplitude, how sure and how sharp they are, both ways compared.
void write_table(std::ostream& out, const scene::Scene& scene,
                 std::span<const optimize::OptimumResult> results);
/// Curves of optima for people: their ends and their events.
void write_table(std::ostream& out, const scene::Scene& scene,
                 std::span<const optimize::OptimumCurveResult> results);

}  // namespace arcslip::app

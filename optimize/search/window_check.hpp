#pragma once
// Whether the highest value of an optimum is a resonance peak, or lies at an end of the window, where a wider
// window may contain a higher one. Not installed.

#include <arcslip/optimize/evaluation/design_evaluations.hpp>
#include <arcslip/scene/scene.hpp>

#include <optional>
#include <string>

namespace arcslip::optimize {

/// A peak of the best design that is the highest of its case or of all, within 1e-6, at an end of the window.
struct ValueAtEnd {
  std::size_t in_case = 0;
  bool upper = false;  // the upper end
  double omega = 0;    // rad/s
};
std::optional<ValueAtEnd> value_at_end(DesignEvaluations& designs);

/// What lies beyond that end for the best design, by a response traced there: a resonance peak, or nothing,
/// where the amplitude rises on to an end far beyond, as it does to that of a static force.
struct BeyondEnd {
  bool resonance = true;  // or not known
  std::string text;       // sentences: natural frequencies over the bounds, and a window with the peak inside
};
/// Throws Interrupted.
BeyondEnd look_beyond(DesignEvaluations& designs, const ValueAtEnd& value, scene::FrequencyUnit unit);

}  // namespace arcslip::optimize

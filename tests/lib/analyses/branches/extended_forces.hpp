#pragma once
// The forces of an element over a period, marched from event to event, in extended precision.

#include "lib/analyses/branches/extended_series.hpp"

#include <vector>

namespace extended {

/// What an element does over the period: one thing throughout, or several.
enum class State { slip, stick, open, closed, several };
const char* name(State state);

/// One element over a period: the coefficients of its forces, conjugate as those of a Series.
struct Forces {
  std::vector<Complex> tangential, normal;
  Real work = 0;                                      // J per period
  Real tangential_rounding = 0, normal_rounding = 0;  // N
  Real tangential_preload = 0, normal_preload = 0;    // N: Evaluation::preload
  State state = State::several;
};

/// Of extended_precision.hpp.
struct Law {
  Real k_t, mu, k_n, N_0;
};

/// x_t, x_n: an empty series where there is no such motion.
Forces forces(const Law& law, const Series& x_t, const Series& x_n);

}  // namespace extended

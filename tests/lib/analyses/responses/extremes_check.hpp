#pragma once
// What a row of the extremes promises, checked.

#include "lib/analyses/responses/extremes.hpp"

namespace extremes {

/// Traces the branches of the row and checks each of their points, stops and peaks.
void check(const Extreme& extreme);

}  // namespace extremes

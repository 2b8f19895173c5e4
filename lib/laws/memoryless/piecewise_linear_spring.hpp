#pragma once
// A spring whose force is a table: "table": [[q_0, f_0], [q_1, f_1], ...], m and N, with at least two points
// and q ascending. f is linear between the points, and continues the first and the last segment beyond them.
// f(0) need not be a point nor 0. A table that mirrors itself is antisymmetric.
//
// Coefficients are exact (piecewise_linear.hpp). Fields: factor (-) of all forces, 1 by default.

#include <arcslip/laws/law_type.hpp>

#include <utility>
#include <vector>

namespace arcslip::elements {

struct PiecewiseLinearTable {
  std::vector<std::pair<double, double>> points;  // q (m), f (N)
  friend bool operator==(const PiecewiseLinearTable&, const PiecewiseLinearTable&) = default;
};

/// "piecewise_linear_spring". Its options are a PiecewiseLinearTable.
const LawType& piecewise_linear_spring();

}  // namespace arcslip::elements

#pragma once

#include <Eigen/Core>

namespace arcslip::continuation {

/// Whether all entries are finite, as allFinite(), by packets: 0 x is 0, or NaN where x is not finite.
template <class Derived>
bool all_finite(const Eigen::DenseBase<Derived>& x) {
  return (0 * x.derived().array()).sum() == 0;
}

}  // namespace arcslip::continuation

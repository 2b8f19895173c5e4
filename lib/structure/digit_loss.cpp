#include <arcslip/structure/digit_loss.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::structure {
namespace {

using Eigen::Index, Eigen::VectorXd;

constexpr double free = 1e-9;  // x^T K x of a mode that is not distinguished from a rigid-body motion

// Quadratic forms of x in the entries of A, and in their absolute values.
struct Forms {
  double of = 0, absolute = 0;
};

Forms forms(const scene::SparseMatrix& A, const Partition& parts, const VectorXd& x) {
  long double of = 0, absolute = 0;
  for (std::size_t c = 0; c < parts.place.size(); ++c) {
    const Index j = parts.place[c];
    if (j < 0) continue;
    for (auto k = static_cast<std::size_t>(A.starts[c]); k < static_cast<std::size_t>(A.starts[c + 1]); ++k) {
      const Index i = parts.place[static_cast<std::size_t>(A.row_of[k])];
      if (i < 0) continue;
      const long double term = static_cast<long double>(x[i]) * A.values[k] * x[j];
      of += term;
      absolute += std::abs(term);
    }
  }
  return {static_cast<double>(of), static_cast<double>(absolute)};
}

}  // namespace

Rounding rounding(const scene::Matrices& matrices, const Partition& parts, double sigma, double accuracy,
                  Index modes, const std::function<VectorXd(Index)>& mode) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  Rounding found;
  for (Index j = 0; j < modes; ++j) {
    const VectorXd x = mode(j);
    const Forms K = forms(*matrices.stiffness.matrix, parts, x), M = forms(*matrices.mass.matrix, parts, x);
    const double last_digits = eps * (K.absolute + sigma * M.absolute),
                 unknown = last_digits + std::max(free, accuracy);
    const bool is_free = std::abs(K.of) <= unknown;
    const double change = 4 * last_digits / (is_free ? 1 : std::abs(K.of));
    if (!(change <= found.change)) found.change = change;
    found.of_stiffness = std::max(found.of_stiffness, 4 * last_digits);
    if (!is_free) break;
    found.free_below = std::max(found.free_below, std::sqrt(unknown / M.of));
  }
  return found;
}

}  // namespace arcslip::structure

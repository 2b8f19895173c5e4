#include <arcslip/continuation/tracing/transverse_space.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace arcslip::continuation {
namespace {

constexpr Eigen::Index most_borders = 3;
constexpr double least_cosines = 0.2;       // product of those between two spaces: below, the sign is open
constexpr double dependent_column = 1e-12;  // of a column, left by those before it

}  // namespace

// b = [J F_p] d for generic d, which are then the first X. One after the other in one vector, as all columns
// here.
void TransverseSpace::choose_borders(Eigen::Index size) {
  const Eigen::Index count = std::min(most_borders, size - 1);
  s_.transverse.b.resize(count * size);
  y_.resize(size);
  for (Eigen::Index j = 0; j < count; ++j) {
    factors_.apply(factors_.generic_direction(static_cast<int>(j)), y_);
    s_.transverse.b.segment(j * size, size) = y_;
  }
}

// Makes a column orthogonal to those before it, of length 1 and with a positive part along what it was.
// False: it depends on them.
bool TransverseSpace::orthonormalize(Vector& basis, Eigen::Index column) {
  const Eigen::Index size = x_.size();
  const double before = std::sqrt(factors_.dot(x_, x_));
  for (int sweep = 0; sweep < 2; ++sweep)
    for (Eigen::Index i = 0; i < column; ++i) {
      y_ = basis.segment(i * size, size);
      x_ -= factors_.dot(y_, x_) * y_;
    }
  const double length = std::sqrt(factors_.dot(x_, x_));
  if (!(length > dependent_column * before) || !std::isfinite(length)) return false;
  basis.segment(column * size, size) = x_ / length;
  return true;
}

// The orthonormal basis of X = B^-1 b across the tangent. False: B is singular.
bool TransverseSpace::measure(const CurvePoint& place, Vector& basis) {
  const Vector& b = s_.transverse.b;
  const Eigen::Index size = place.v.size();
  basis.resize(b.size());
  for (Eigen::Index j = 0; j < b.size() / size; ++j) {
    x_ = b.segment(j * size, size);
    if (!factors_.apply_inverse(x_)) return false;
    x_ -= factors_.dot(place.tangent, x_) * place.tangent;
    if (!orthonormalize(basis, j)) return false;
  }
  return true;
}

// Of the products of both bases.
double TransverseSpace::determinant(const Vector& one, const Vector& other) {
  const Eigen::Index size = x_.size(), count = one.size() / size;
  std::array<std::array<double, most_borders>, most_borders> a{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j) {
      x_ = one.segment(i * size, size);
      y_ = other.segment(j * size, size);
      a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = factors_.dot(x_, y_);
    }
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
         a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

TransverseSpace::Sign TransverseSpace::compare(TrialStep& trial) {
  const auto& [b, basis] = s_.transverse;
  if (b.size() == 0) return Sign::kept;
  trial.has_basis = measure(trial.end, trial.basis);
  if (!trial.has_basis || basis.size() != b.size()) return Sign::open;
  const double cosines = determinant(basis, trial.basis);
  if (std::abs(cosines) < least_cosines) return Sign::open;
  return cosines > 0 ? Sign::kept : Sign::changed;
}

void TransverseSpace::keep(TrialStep& trial, const CurvePoint& place) {
  if (place.orientation != 0) return;
  if (s_.transverse.b.size() == 0) {
    choose_borders(place.v.size());
    trial.has_basis = false;
  }
  if (!trial.has_basis) trial.has_basis = measure(place, trial.basis);
  if (trial.has_basis)
    s_.transverse.basis = trial.basis;
  else
    s_.transverse.basis.resize(0);  // compare() is then open
}

}  // namespace arcslip::continuation

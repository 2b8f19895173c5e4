#include <arcslip/continuation/linear/near_singular.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace arcslip::continuation {
namespace {

// In [1/2, 1] or the negative of that, symmetric in i and j; by the finalizer of SplitMix64 (Steele, Lea and
// Flood, OOPSLA 2014).
double generic_factor(Eigen::Index i, Eigen::Index j) {
  const auto low = static_cast<std::uint64_t>(std::min(i, j));
  const auto high = static_cast<std::uint64_t>(std::max(i, j));
  std::uint64_t x = ((low << 32) ^ high) + 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  x ^= x >> 31;
  const double size = 0.5 + 0.5 * static_cast<double>(x >> 11) * 0x1p-53;
  return (x & 1) != 0 ? size : -size;
}

// visit(i, j, entry) for each entry of the pattern; a dense matrix has them all.
template <class Visit>
void each_entry(Matrix& J, const Visit& visit) {
  for (Eigen::Index j = 0; j < J.cols(); ++j)
    for (Eigen::Index i = 0; i < J.rows(); ++i) visit(i, j, J(i, j));
}
template <class Visit>
void each_entry(SparseMatrix& J, const Visit& visit) {
  for (Eigen::Index j = 0; j < J.outerSize(); ++j)
    for (SparseMatrix::InnerIterator entry(J, j); entry; ++entry) visit(entry.row(), j, entry.valueRef());
}

template <class AnyMatrix>
void change_by_entries(AnyMatrix& J, double share) {
  each_entry(J, [&](Eigen::Index i, Eigen::Index j, double& entry) {
    entry += share * generic_factor(i, j) * std::abs(entry);
  });
}

template <class AnyMatrix>
void change_by_rows_and_columns(AnyMatrix& J, const Nudge& nudge) {
  Vector of_row = Vector::Zero(J.rows()), of_column = Vector::Zero(J.cols());
  each_entry(J, [&](Eigen::Index i, Eigen::Index j, const double& entry) {
    of_row[i] = std::max(of_row[i], std::abs(entry));
    of_column[j] = std::max(of_column[j], std::abs(entry));
  });
  const double largest = of_row.size() > 0 && of_row.maxCoeff() > 0 ? of_row.maxCoeff() : 1;
  each_entry(J, [&](Eigen::Index i, Eigen::Index j, double& entry) {
    double size = std::max(of_row[i], of_column[j]);
    const double smaller = std::min(of_row[i], of_column[j]);
    if (nudge.size == Nudge::Size::of_smaller && smaller > 0) size = smaller;
    entry += nudge.share * generic_factor(i, j) * (size > 0 ? size : largest);
  });
}

}  // namespace

bool nudged(const Jacobian& J, const Nudge& nudge, Jacobian& nearby) {
  const auto change = [&](auto& matrix) {
    if (nudge.size == Nudge::Size::of_entry)
      change_by_entries(matrix, nudge.share);
    else
      change_by_rows_and_columns(matrix, nudge);
  };
  if (std::holds_alternative<const Operator*>(J)) return false;
  nearby = J;
  if (auto* dense = std::get_if<Matrix>(&nearby)) change(*dense);
  if (auto* sparse = std::get_if<SparseMatrix>(&nearby)) change(*sparse);
  return true;
}

}  // namespace arcslip::continuation

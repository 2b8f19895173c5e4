#include <arcslip/continuation/bordered_sparse.hpp>
#include <arcslip/continuation/refinement.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace arcslip::continuation {
namespace {

constexpr double border_power = -5;  // of n: the size of [R D] beside [J C]

double power_of_two(double largest) {
  return largest > 0 && std::isfinite(largest) ? std::ldexp(1.0, -std::ilogb(largest)) : 1.0;
}

int number_of_entries(const SparseMatrix& J, std::int64_t m) {
  const std::int64_t entries = J.nonZeros() + 2 * m * J.rows() + m * m;
  if (entries > std::numeric_limits<int>::max())
    throw std::length_error("the bordered matrix has " + std::to_string(entries) +
                            " entries, more than the " + std::to_string(std::numeric_limits<int>::max()) +
                            " that a sparse matrix of int indices holds");
  return static_cast<int>(entries);
}

}  // namespace

// The pattern is compared while it is written: against the copy of the values this costs next to nothing.
bool BorderedSparse::assemble(const SparseMatrix& J, const Borders& borders) {
  const int n = static_cast<int>(J.rows()), m = borders.width(), entries = number_of_entries(J, m);
  bool new_pattern = matrix_.rows() != n + m || matrix_.nonZeros() != entries;
  if (new_pattern) {
    matrix_ = SparseMatrix(n + m, n + m);
    matrix_.resizeNonZeros(entries);
  }
  int* outer = matrix_.outerIndexPtr();
  int* inner = matrix_.innerIndexPtr();
  double* value = matrix_.valuePtr();
  int k = 0;
  for (int j = 0; j < n; ++j) {
    new_pattern = new_pattern || outer[j] != k;
    outer[j] = k;
    const int begin = J.outerIndexPtr()[j];
    const int count = J.isCompressed() ? J.outerIndexPtr()[j + 1] - begin : J.innerNonZeroPtr()[j];
    const int* rows = J.innerIndexPtr() + begin;
    new_pattern = new_pattern || !std::equal(rows, rows + count, inner + k);
    std::copy_n(rows, count, inner + k);
    std::copy_n(J.valuePtr() + begin, count, value + k);
    k += count;
    for (int i = 0; i < m; ++i, ++k) {
      inner[k] = n + i;
      value[k] = borders.rows(j, i);
    }
  }
  for (int j = 0; j < m; ++j) {
    outer[n + j] = k;
    for (int i = 0; i < n + m; ++i, ++k) {
      inner[k] = i;
      value[k] = i < n ? borders.columns(i, j) : borders.corner(i - n, j);
    }
  }
  outer[n + m] = k;
  scale(n);
  return new_pattern;
}

void BorderedSparse::scale(int n) {
  const int* outer = matrix_.outerIndexPtr();
  const int* inner = matrix_.innerIndexPtr();
  double* value = matrix_.valuePtr();
  const Eigen::Index size = matrix_.rows();
  const int of_borders = static_cast<int>(border_power * std::log2(n + 1.0));
  scales_.setZero(size);
  row_sums_.setZero(size);
  column_sums_.setZero(size);
  for (int k = 0; k < outer[n]; ++k) scales_[inner[k]] = std::max(scales_[inner[k]], std::abs(value[k]));
  for (double& scale : scales_) scale = power_of_two(scale);
  column_scales_.setZero(size - n);
  for (Eigen::Index j = n; j < size; ++j) {
    double& scale = column_scales_[j - n];
    for (int k = outer[j]; k < outer[j + 1]; ++k)
      scale = std::max(scale, std::abs(value[k]) * scales_[inner[k]]);
    scale = power_of_two(scale);
    for (int k = outer[j]; k < outer[j + 1]; ++k) value[k] *= scale;
  }
  scales_.tail(size - n) *= std::ldexp(1.0, of_borders);
  for (Eigen::Index j = 0; j < size; ++j)
    for (int k = outer[j]; k < outer[j + 1]; ++k) {
      column_sums_[j] += std::abs(value[k]);
      value[k] *= scales_[inner[k]];
      row_sums_[inner[k]] += std::abs(value[k]);
    }
  row_sums_.tail(size - n) *= Refinement::of_full_row(n);
  column_sums_.tail(size - n) *= Refinement::of_full_row(n);
}

}  // namespace arcslip::continuation

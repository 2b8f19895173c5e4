#include <arcslip/hbm/linear/sparsity_pattern.hpp>

#include <algorithm>
#include <complex>

namespace arcslip::hbm {
namespace {

// Shares of the entries and multiplications of dense factors up to which sparse ones cost less: measured,
// with solutions for a few right hand sides.
struct Shares {
  double entries, multiplications;
};
constexpr Shares of_elimination{0.04, 0.04}, of_lu{0.4, 0.2};

bool is_cheaper(const SparsityPattern::Matrix& pattern, Shares share) {
  const auto n = static_cast<double>(pattern.rows());
  return static_cast<double>(pattern.nonZeros()) <= share.entries * n * n &&
         continuation::ComplexSparseLU(pattern).multiplications() <= share.multiplications * n * n * n / 3;
}

}  // namespace

SparsityPattern::Matrix SparsityPattern::matrix() const {
  std::vector<int> outer(1, 0), inner;
  std::size_t entry = 0;
  for (Eigen::Index j = 0; j < n_; ++j) {
    for (Eigen::Index i = 0; i < n_; ++i)
      if (is_linked_[entry++]) inner.push_back(static_cast<int>(i));
    outer.push_back(static_cast<int>(inner.size()));
  }
  const std::vector<std::complex<double>> zeros(inner.size());
  return Eigen::Map<const Matrix>(n_, n_, outer.back(), outer.data(), inner.data(), zeros.data());
}

int position(const SparsityPattern::Matrix& in, Eigen::Index i, Eigen::Index j) {
  const int* const rows = in.innerIndexPtr();
  const int* const begin = rows + in.outerIndexPtr()[j];
  const int* const end = rows + in.outerIndexPtr()[j + 1];
  return static_cast<int>(std::lower_bound(begin, end, static_cast<int>(i)) - rows);
}

bool sparse_is_cheaper(const SparsityPattern::Matrix& pattern) {
  return is_cheaper(pattern, of_elimination);
}

bool sparse_is_cheaper_than_lu(const SparsityPattern::Matrix& pattern) {
  return is_cheaper(pattern, of_lu);
}

}  // namespace arcslip::hbm

#include <arcslip/hbm/sparse_links.hpp>

namespace arcslip::hbm {
namespace {

constexpr double sparse_share = 0.04;  // of the multiplications of dense factors, each of which costs less

}  // namespace

std::optional<continuation::ComplexSparseLU::Matrix> sparse_pattern(Eigen::Index n,
                                                                    std::span<const Links> links) {
  const auto all = static_cast<double>(n) * static_cast<double>(n);
  std::vector<bool> is_linked(static_cast<std::size_t>(n * n), false);
  std::vector<Eigen::Triplet<std::complex<double>>> linked;
  const auto link = [&](Eigen::Index i, Eigen::Index j) {
    std::vector<bool>::reference known = is_linked[static_cast<std::size_t>(i + j * n)];
    if (!known) linked.emplace_back(i, j, 1);
    known = true;
  };
  for (Eigen::Index i = 0; i < n; ++i) link(i, i);
  for (const Links& part : links) {
    if (static_cast<double>(part.size()) * static_cast<double>(part.size()) > sparse_share * all) return {};
    for (const Eigen::Index j : part)
      for (const Eigen::Index i : part) link(i, j);
  }
  continuation::ComplexSparseLU::Matrix pattern(n, n);
  pattern.setFromTriplets(linked.begin(), linked.end());
  if (static_cast<double>(pattern.nonZeros()) > sparse_share * all) return {};
  if (continuation::ComplexSparseLU(pattern).multiplications() >
      sparse_share * all * static_cast<double>(n) / 3)
    return {};
  return pattern;
}

}  // namespace arcslip::hbm

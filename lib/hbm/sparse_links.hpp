#pragma once
// The sparsity pattern of a structure, by which coordinates its parts link.

#include <arcslip/continuation/linear/sparse_algebra.hpp>

#include <optional>
#include <span>
#include <vector>

namespace arcslip::hbm {

/// Coordinates that one part links to each other.
using Links = std::vector<Eigen::Index>;

/// The n x n matrix of all links, with its diagonal. Null where factors of the dense matrix cost less.
std::optional<continuation::ComplexSparseLU::Matrix> sparse_pattern(Eigen::Index n,
                                                                    std::span<const Links> links);

}  // namespace arcslip::hbm

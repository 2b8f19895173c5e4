#pragma once
// Distributions of a random number: normal, uniform, lognormal, and normal between two bounds.

#include <array>
#include <span>
#include <string_view>

namespace arcslip::sampling {

enum class DistributionType { normal, uniform, lognormal, truncated_normal };

/// A distribution by its numbers, in the order of distribution_types. Mean and standard deviation are those
/// of the number itself, also where its logarithm is normal; of a truncated normal distribution they are
/// those before it is truncated.
struct Distribution {
  DistributionType type = DistributionType::normal;
  std::array<double, 4> values{};
  friend bool operator==(const Distribution&, const Distribution&) = default;
};

struct DistributionDescription {
  DistributionType type;
  std::string_view name;
  std::span<const std::string_view> values;  // what they are
};

std::span<const DistributionDescription> distribution_types();
const DistributionDescription& description(DistributionType type);

/// Returns the number below which samples lie with a probability between 0 and 1, both excluded.
double quantile(const Distribution& of, double probability);
/// Returns the probability of a sample below a number; of one above it, to all digits of a small one.
double probability_below(const Distribution& of, double number);
double probability_above(const Distribution& of, double number);

}  // namespace arcslip::sampling

#include <arcslip/sampling/distribution.hpp>

#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::sampling {
namespace {

// In double throughout, so that a long double of another width changes no sample; infinite numbers are valid.
using Policy =
    boost::math::policies::policy<boost::math::policies::promote_double<false>,
                                  boost::math::policies::overflow_error<boost::math::policies::ignore_error>>;
using Normal = boost::math::normal_distribution<double, Policy>;

constexpr std::array<std::string_view, 2> mean_and_deviation = {"mean", "standard deviation"};
constexpr std::array<std::string_view, 2> ends = {"lower end", "upper end"};
constexpr std::array<std::string_view, 4> truncated = {"mean", "standard deviation", "lower end",
                                                       "upper end"};
constexpr std::array<DistributionDescription, 4> descriptions = {
    {{DistributionType::normal, "normal", mean_and_deviation},
     {DistributionType::uniform, "uniform", ends},
     {DistributionType::lognormal, "lognormal", mean_and_deviation},
     {DistributionType::truncated_normal, "truncated_normal", truncated}}};

double below(double z) {
  return std::isinf(z) ? (z > 0 ? 1 : 0) : boost::math::cdf(Normal(), z);
}

double above(double z) {
  return below(-z);
}

/// Returns the logarithm of a lognormal number as mean and standard deviation.
Normal logarithm(const Distribution& of) {
  const double ratio = of.values[1] / of.values[0];
  const double variance = std::log1p(ratio * ratio);
  return {std::log(of.values[0]) - 0.5 * variance, std::sqrt(variance)};
}

/// Returns the place of a number in the standard normal distribution that a distribution is made of.
double standardized(const Distribution& of, double number) {
  if (of.type == DistributionType::lognormal) {
    const Normal log = logarithm(of);
    return number > 0 ? (std::log(number) - log.mean()) / log.standard_deviation()
                      : -std::numeric_limits<double>::infinity();
  }
  return (number - of.values[0]) / of.values[1];
}

double truncated_quantile(const Distribution& of, double probability) {
  const auto [mean, deviation, lower, upper] = of.values;
  const double a = (lower - mean) / deviation, b = (upper - mean) / deviation;
  // The tail that has more digits.
  const bool mirrored = a > 0;
  const double from = mirrored ? above(b) : below(a), to = mirrored ? above(a) : below(b);
  const double share = mirrored ? 1 - probability : probability;
  const double z = boost::math::quantile(Normal(), std::clamp(from + share * (to - from), 1e-300, 1 - 1e-16));
  return std::clamp(mean + deviation * (mirrored ? -z : z), lower, upper);
}

}  // namespace

std::span<const DistributionDescription> distribution_types() {
  return descriptions;
}

const DistributionDescription& description(DistributionType type) {
  return descriptions[static_cast<std::size_t>(type)];
}

double quantile(const Distribution& of, double probability) {
  switch (of.type) {
    case DistributionType::uniform:
      return std::clamp((1 - probability) * of.values[0] + probability * of.values[1], of.values[0],
                        of.values[1]);
    case DistributionType::lognormal: {
      const Normal log = logarithm(of);
      return std::exp(log.mean() + log.standard_deviation() * boost::math::quantile(Normal(), probability));
    }
    case DistributionType::truncated_normal:
      return truncated_quantile(of, probability);
    default:
      return of.values[0] + of.values[1] * boost::math::quantile(Normal(), probability);
  }
}

double probability_below(const Distribution& of, double number) {
  if (of.type == DistributionType::uniform || of.type == DistributionType::truncated_normal) {
    const std::size_t first = of.type == DistributionType::uniform ? 0 : 2;
    if (number <= of.values[first]) return 0;
    if (number >= of.values[first + 1]) return 1;
    if (of.type == DistributionType::uniform) return (number - of.values[0]) / (of.values[1] - of.values[0]);
    const double lower = below(standardized(of, of.values[2])), upper = below(standardized(of, of.values[3]));
    return (below(standardized(of, number)) - lower) / (upper - lower);
  }
  return below(standardized(of, number));
}

double probability_above(const Distribution& of, double number) {
  if (of.type == DistributionType::uniform || of.type == DistributionType::truncated_normal)
    return 1 - probability_below(of, number);
  return above(standardized(of, number));
}

}  // namespace arcslip::sampling

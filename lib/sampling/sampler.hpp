#pragma once
// Samples of random parameters. A sample is a function of the plan and of its index alone: any thread and any
// machine computes any of them.

#include <arcslip/sampling/distribution.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::sampling {

/// How samples fill the space of the parameters: independently; with one sample in each of `count` equally
/// probable intervals of each parameter; by the sequence of Sobol, shifted at random (digital shift).
enum class Design { random, latin_hypercube, sobol };

struct DesignName {
  std::string_view text;
  Design value;
};
std::span<const DesignName> designs();

/// Parameters that are drawn independently of each other, and how.
struct Plan {
  std::vector<std::pair<std::string, Distribution>> parameters{};
  long count = 0;  // of samples; 0: there is no plan
  long seed = 1;
  Design design = Design::random;
  friend bool operator==(const Plan&, const Plan&) = default;
};

inline constexpr int largest_sample_count = 1'000'000'000;
inline constexpr int most_sampled_parameters = 1000;

class Sampler {
 public:
  explicit Sampler(Plan plan);
  Sampler(Sampler&&) noexcept;
  Sampler& operator=(Sampler&&) noexcept;
  ~Sampler();

  /// Returns a value of each parameter. Several threads may call it at the same time.
  std::vector<double> operator()(std::size_t index) const;
  /// Returns the probabilities whose quantiles these are, between 0 and 1, both excluded.
  std::vector<double> probabilities(std::size_t index) const;

 private:
  class Permutation;
  struct Sequence;

  Plan plan_;
  std::unique_ptr<const Sequence> sequence_;  // that of the design
};

}  // namespace arcslip::sampling

#include <arcslip/sampling/sampler.hpp>

#include <boost/random/sobol.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <random>

namespace arcslip::sampling {
namespace {

constexpr std::array<DesignName, 3> design_names = {
    {{"random", Design::random}, {"latin_hypercube", Design::latin_hypercube}, {"sobol", Design::sobol}}};

/// Streams of random bits for different uses.
enum class Stream : std::uint32_t { sample, permutation, shift };

/// Generator and seeding are those of the standard, which are the same everywhere; its distributions are not.
std::mt19937_64 generator(std::uint64_t seed, Stream stream, std::uint64_t index) {
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  std::seed_seq all{low(seed), low(seed >> 32), static_cast<std::uint32_t>(stream), low(index),
                    low(index >> 32)};
  return std::mt19937_64(all);
}

/// Returns the middle of one of 2^53 equal intervals between 0 and 1.
double between_0_and_1(std::uint64_t bits) {
  return std::min((static_cast<double>(bits >> 11) + 0.5) * 0x1p-53, 1 - 0x1p-53);
}

}  // namespace

std::span<const DesignName> designs() {
  return design_names;
}

/// A permutation of 0 ... count - 1 by a Feistel network, computed element by element: numbers beyond the
/// last one are permuted again until one is within (cycle walking).
class Sampler::Permutation {
 public:
  Permutation(std::uint64_t count, std::mt19937_64 random)
      : count_(count), half_((static_cast<unsigned>(std::bit_width(count - 1)) + 1) / 2) {
    for (std::uint64_t& key : keys_) key = random();
  }

  std::uint64_t operator()(std::uint64_t index) const {
    if (count_ == 1) return 0;
    do {
      index = once(index);
    } while (index >= count_);
    return index;
  }

 private:
  std::uint64_t once(std::uint64_t index) const {
    const std::uint64_t mask = (std::uint64_t{1} << half_) - 1;
    std::uint64_t left = index >> half_, right = index & mask;
    for (const std::uint64_t key : keys_) {
      const std::uint64_t next = left ^ (mixed(right ^ key) & mask);
      left = right;
      right = next;
    }
    return (left << half_) | right;
  }

  /// Returns the finalizer of SplitMix64 (Steele, Lea and Flood 2014).
  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }

  std::uint64_t count_;
  unsigned half_;  // bits of each of the two halves of an index
  std::array<std::uint64_t, 8> keys_{};
};

struct Sampler::Sequence {
  std::optional<boost::random::sobol> sobol;
  std::vector<std::uint64_t> shifts;
  std::vector<Permutation> permutations;
};

Sampler::Sampler(Plan plan) : plan_(std::move(plan)) {
  Sequence of;
  const std::size_t parameters = plan_.parameters.size();
  const auto seed = static_cast<std::uint64_t>(plan_.seed);
  if (plan_.design == Design::sobol && parameters > 0) {
    of.sobol.emplace(parameters);
    std::mt19937_64 random = generator(seed, Stream::shift, 0);
    for (std::size_t k = 0; k < parameters; ++k) of.shifts.push_back(random());
  } else if (plan_.design == Design::latin_hypercube) {
    for (std::size_t k = 0; k < parameters; ++k)
      of.permutations.emplace_back(static_cast<std::uint64_t>(plan_.count),
                                   generator(seed, Stream::permutation, k));
  }
  sequence_ = std::make_unique<const Sequence>(std::move(of));
}

Sampler::Sampler(Sampler&&) noexcept = default;
Sampler& Sampler::operator=(Sampler&&) noexcept = default;
Sampler::~Sampler() = default;

std::vector<double> Sampler::probabilities(std::size_t index) const {
  std::vector<double> all(plan_.parameters.size());
  if (sequence_->sobol) {
    boost::random::sobol sobol = *sequence_->sobol;
    // Boost's sequence begins with the second point of Sobol's, whose first one is zero.
    std::vector<std::uint64_t> point(all.size());
    if (index > 0) {
      sobol.seed(index - 1);
      for (std::uint64_t& coordinate : point) coordinate = sobol();
    }
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = between_0_and_1(point[k] ^ sequence_->shifts[k]);
    return all;
  }
  std::mt19937_64 random = generator(static_cast<std::uint64_t>(plan_.seed), Stream::sample, index);
  for (double& probability : all) probability = between_0_and_1(random());
  const auto count = static_cast<double>(plan_.count);
  for (std::size_t k = 0; k < sequence_->permutations.size(); ++k)
    all[k] = std::min((static_cast<double>(sequence_->permutations[k](index)) + all[k]) / count, 1 - 0x1p-53);
  return all;
}

std::vector<double> Sampler::operator()(std::size_t index) const {
  std::vector<double> all = probabilities(index);
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = quantile(plan_.parameters[k].second, all[k]);
  return all;
}

}  // namespace arcslip::sampling

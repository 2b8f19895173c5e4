// Samples: how they fill the space of the parameters, and what they depend on.
#include "catch.hpp"

#include <arcslip/sampling/sampler.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

using namespace arcslip::sampling;

namespace {

Plan plan(Design design, long count, std::size_t parameters = 3, long seed = 1) {
  Plan made{.parameters = {}, .count = count, .seed = seed, .design = design};
  for (std::size_t k = 0; k < parameters; ++k)
    made.parameters.emplace_back(std::string(1, static_cast<char>('a' + k)),
                                 Distribution{DistributionType::uniform, {0, 1}});
  return made;
}

/// The interval of `count` equal ones in which a sample lies.
long interval(double x, long count) {
  return static_cast<long>(std::floor(x * static_cast<double>(count)));
}

constexpr std::array all_designs = {Design::random, Design::latin_hypercube, Design::sobol};

}  // namespace

TEST_CASE("a sample depends on the plan and on its index alone") {
  for (const Design design : all_designs) {
    const Sampler one(plan(design, 50)), other(plan(design, 50)), of_seed(plan(design, 50, 3, 2));
    std::set<std::vector<double>> different;
    for (std::size_t i = 50; i-- > 0;) {
      CHECK(one(i) == other(i));
      CHECK(one(i) != of_seed(i));
      different.insert(one(i));
    }
    CHECK(different.size() == 50);
    CHECK(one(49) == other(49));
  }
}

TEST_CASE("a further parameter leaves the samples of the others as they are") {
  for (const Design design : all_designs) {
    const Sampler few(plan(design, 20, 2)), more(plan(design, 20, 3));
    for (std::size_t i = 0; i < 20; ++i) {
      const std::vector<double> a = few(i), b = more(i);
      CHECK(a[0] == b[0]);
      CHECK(a[1] == b[1]);
    }
  }
}

TEST_CASE("independent samples have the distribution of the plan") {
  constexpr int count = 20'000;
  const Sampler sampler(plan(Design::random, count));
  std::vector<double> first;
  double product = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<double> x = sampler(i);
    first.push_back(x[0]);
    product += (x[0] - 0.5) * (x[1] - 0.5) * 12 / count;
  }
  std::sort(first.begin(), first.end());
  double largest = 0;  // the distance of Kolmogorov and Smirnov, beyond 1.95/sqrt(n) once in a thousand seeds
  for (std::size_t i = 0; i < count; ++i)
    largest = std::max(largest, std::abs(first[i] - (static_cast<double>(i) + 0.5) / count));
  CHECK(largest < 1.95 / std::sqrt(count));
  CHECK(std::abs(product) < 3.3 / std::sqrt(count));  // the correlation of two parameters, likewise
}

TEST_CASE("a Latin hypercube has one sample in each interval of each parameter") {
  for (const long count : {1L, 2L, 3L, 17L, 1000L, 4097L}) {
    const Sampler sampler(plan(Design::latin_hypercube, count));
    std::vector<std::set<long>> intervals(3);
    long in_order = 0;
    for (long i = 0; i < count; ++i) {
      const std::vector<double> x = sampler(static_cast<std::size_t>(i));
      for (std::size_t k = 0; k < 3; ++k) intervals[k].insert(interval(x[k], count));
      in_order += interval(x[0], count) == interval(x[1], count);
    }
    for (const auto& each : intervals) CHECK(static_cast<long>(each.size()) == count);
    if (count > 100) CHECK(in_order < 12);  // about one of all by chance
  }
}

TEST_CASE("samples by the sequence of Sobol lie in each elementary interval of two parameters once") {
  const Sampler sampler(plan(Design::sobol, 256));
  for (const long columns : {1L, 2L, 16L, 64L, 256L}) {
    const long rows = 256 / columns;
    std::set<std::pair<long, long>> cells;
    for (std::size_t i = 0; i < 256; ++i) {
      const std::vector<double> x = sampler(i);
      cells.emplace(interval(x[0], columns), interval(x[1], rows));
    }
    CHECK(cells.size() == 256);
  }
}

TEST_CASE("the digits between samples of Sobol's sequence are those of the published one") {
  // (0, 0), (1/2, 1/2), (3/4, 1/4), (1/4, 3/4), (3/8, 3/8): Bratley and Fox 1988. A shift of the binary
  // digits cancels between two samples.
  const Sampler sampler(plan(Design::sobol, 8, 2));
  const std::vector<std::pair<long, long>> eighths = {{0, 0}, {4, 4}, {6, 2}, {2, 6}, {3, 3}};
  const std::vector<double> first = sampler(0);
  for (std::size_t i = 0; i < eighths.size(); ++i) {
    const std::vector<double> x = sampler(i);
    CHECK((interval(x[0], 8) ^ interval(first[0], 8)) == eighths[i].first);
    CHECK((interval(x[1], 8) ^ interval(first[1], 8)) == eighths[i].second);
  }
}

TEST_CASE("probabilities lie between 0 and 1, both excluded, also of the last of many samples") {
  for (const Design design : all_designs) {
    const Sampler sampler(plan(design, largest_sample_count, 1));
    for (const std::size_t i : {std::size_t{0}, std::size_t{largest_sample_count - 1}}) {
      CHECK(sampler.probabilities(i).front() > 0);
      CHECK(sampler.probabilities(i).front() < 1);
    }
  }
  const Sampler many(plan(Design::sobol, 4, most_sampled_parameters));
  CHECK(many(3).size() == most_sampled_parameters);
}

TEST_CASE("samples are those of earlier versions, so that ensembles can be continued") {
  const auto check = [](Design design, double first, double second) {
    const std::vector<double> x = Sampler(plan(design, 10)).probabilities(7);
    CHECK(x[0] == first);
    CHECK(x[1] == second);
  };
  check(Design::random, 0.79306654834369317, 0.93714934958664342);
  check(Design::latin_hypercube, 0.27930665483436934, 0.093714934958664342);
  check(Design::sobol, 0.54379749946596623, 0.32121205848001472);
}

#include <arcslip/observables/sampled_errors.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::observables {
namespace {

constexpr int every = 5;             // points
constexpr double most_bent = 0.5;    // of the moduli from straight lines, by the last error
constexpr double negligible = 3e-4;  // the same, absolute

}  // namespace

bool SampledErrors::wants(const Multipliers& multipliers, double arclength) {
  Moduli here{{}, arclength};
  for (const auto& each : multipliers) here.of.push_back(std::abs(each));
  double bend = std::numeric_limits<double>::infinity();
  if (last_.of.size() == here.of.size() && before_.of.size() == here.of.size()) {
    bend = 0;
    const double ahead = (arclength - last_.arclength) / (last_.arclength - before_.arclength);
    for (std::size_t i = 0; i < here.of.size(); ++i)
      bend = std::max(bend, std::abs(here.of[i] - last_.of[i] - ahead * (last_.of[i] - before_.of[i])));
  }
  bent_ += bend;
  before_ = std::exchange(last_, std::move(here));
  if (since_ > 0 && since_ < every && bent_ <= std::max(most_bent * error_, negligible)) {
    ++since_;
    return false;
  }
  return true;
}

void SampledErrors::take(double error) {
  since_ = error > 0 ? 1 : 0;
  error_ = error;
  bent_ = 0;
}

}  // namespace arcslip::observables

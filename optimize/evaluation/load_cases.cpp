#include <arcslip/optimize/evaluation/load_cases.hpp>

#include <arcslip/control/ordered_parallel_for.hpp>
#include <arcslip/optimize/nlopt/interrupted.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::optimize {

void LoadCases::add(std::unique_ptr<PeakAmplitude> peaks, double weight) {
  all_.push_back({std::move(peaks), weight});
  sum_ += weight;
}

template <class Move>
void LoadCases::each(const Move& move) {
  std::size_t moved = 0;
  control::in_order(
      size(), threads_, control_.child(), [&](std::size_t c) { return &move(*all_[c].peaks); },
      [&](const PeakState*) { ++moved; });
  if (moved < size()) throw Interrupted();
}

void LoadCases::at(std::span<const double> design) {
  each([&](PeakAmplitude& peaks) -> const PeakState& { return peaks.at(design); });
}

void LoadCases::trace(std::span<const double> design, observables::Steps steps) {
  each([&](PeakAmplitude& peaks) -> const PeakState& { return peaks.trace(design, steps); });
}

bool LoadCases::is_at(std::span<const double> design) const {
  return std::all_of(all_.begin(), all_.end(), [&](const Each& each) {
    return std::equal(design.begin(), design.end(), each.peaks->state().design.begin(),
                      each.peaks->state().design.end());
  });
}

bool LoadCases::are_traced() const {
  return std::all_of(all_.begin(), all_.end(), [](const Each& each) { return each.peaks->state().traced; });
}

double LoadCases::weight(std::size_t c) const {
  return criterion_ == Criterion::mean ? all_[c].weight / sum_ : all_[c].weight;
}

std::size_t LoadCases::highest() const {
  std::size_t most = 0;
  for (std::size_t c = 1; c < size(); ++c)
    if (height(c) > height(most)) most = c;
  return most;
}

std::size_t LoadCases::highest_of(std::size_t group) const {
  return criterion_ == Criterion::mean ? group : highest();
}

double LoadCases::value() const {
  double sum = 0, most = 0;
  for (std::size_t c = 0; c < size(); ++c) {
    const double here = height(c);
    if (std::isnan(here)) return here;
    sum += here;
    most = std::max(most, here);
  }
  return criterion_ == Criterion::mean ? sum : most;
}

Vector LoadCases::gradient() const {
  Vector sum = Vector::Zero(static_cast<Eigen::Index>(state(0).design.size()));
  for (std::size_t g = 0; g < groups(); ++g) {
    const std::size_t c = highest_of(g);
    sum += weight(c) * state(c).peaks[state(c).highest].gradient;
  }
  return sum;
}

PeakWork LoadCases::work() const {
  PeakWork sum;
  for (const Each& each : all_) {
    const PeakWork& work = each.peaks->work();
    sum.responses += work.responses;
    sum.followed += work.followed;
    sum.factorizations += work.factorizations;
  }
  return sum;
}

}  // namespace arcslip::optimize

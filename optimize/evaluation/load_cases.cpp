#include <arcslip/optimize/evaluation/load_cases.hpp>

#include <arcslip/control/ordered_parallel_for.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace arcslip::optimize {

void LoadCases::add(std::unique_ptr<PeakAmplitude> peaks, double weight) {
  all_.push_back({std::move(peaks), weight});
  sum_ += weight;
}

void LoadCases::at(std::span<const double> design) {
  std::atomic<bool> goes_on = true;
  const auto move = [&](std::size_t c) { return &all_[c].peaks->at(design); };
  studies::in_order(size(), threads_, goes_on, move, [](const PeakState*) {});
}

void LoadCases::trace(std::span<const double> design, observables::Steps steps) {
  std::atomic<bool> goes_on = true;
  const auto trace = [&](std::size_t c) { return &all_[c].peaks->trace(design, steps); };
  studies::in_order(size(), threads_, goes_on, trace, [](const PeakState*) {});
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

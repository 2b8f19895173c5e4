#pragma once
// The largest amplitudes A_c of several cases at one design p, and the one number that is made of them:
//
//   worst   V = max_c w_c A_c
//   mean    V = sum_c w_c A_c,  where the weights are divided by their sum
//
// Both are a sum over groups of cases of the highest in the group: one group, or a group for each case.

#include <arcslip/optimize/peaks/peak_amplitude.hpp>
#include <arcslip/optimize/search/design.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace arcslip::optimize {

class Cases {
 public:
  explicit Cases(Criterion criterion) : criterion_(criterion) {}

  /// weight: above 0. All are over the same parameters.
  void add(std::unique_ptr<PeakAmplitude> peaks, double weight);

  /// Moves all cases to a design, by following their peaks or by a response each.
  void at(std::span<const double> design);
  void trace(std::span<const double> design, observables::Steps steps = observables::Steps::events);
  bool stand_at(std::span<const double> design) const;
  /// Whether they came there by responses.
  bool are_traced() const;

  std::size_t size() const { return all_.size(); }
  PeakAmplitude& peaks(std::size_t c) const { return *all_[c].peaks; }
  const PeakState& state(std::size_t c) const { return all_[c].peaks->state(); }
  double weight(std::size_t c) const;
  std::size_t group(std::size_t c) const { return criterion_ == Criterion::mean ? c : 0; }
  std::size_t groups() const { return criterion_ == Criterion::mean ? size() : 1; }

  /// w_c A_c; infinity where it is unbounded, NaN where there is no response.
  double height(std::size_t c) const { return weight(c) * state(c).amplitude(); }
  /// The case of the greatest w_c A_c, among all or in a group.
  std::size_t highest() const;
  std::size_t highest_of(std::size_t group) const;

  /// V; infinity where a case is unbounded, NaN where one has no response.
  double value() const;
  /// dV/dp_k, m over the unit of p_k, where V is finite; at a kink that of a highest peak of each group.
  Vector gradient() const;

  PeakWork work() const;

 private:
  struct Each {
    std::unique_ptr<PeakAmplitude> peaks;
    double weight;
  };

  Criterion criterion_;
  std::vector<Each> all_;
  double sum_ = 0;  // of the weights
};

}  // namespace arcslip::optimize

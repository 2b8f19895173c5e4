#pragma once
// The largest amplitudes A_c of several load cases at a design p, and the criterion V over the cases:
//
//   worst   V = max_c w_c A_c
//   mean    V = sum_c w_c A_c,  with weights normalized to sum 1
//
// Both are a sum over groups of cases of the maximum in the group: one group, or one group for each case.

#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/evaluation/optimum_problem.hpp>
#include <arcslip/optimize/peaks/peak_amplitude.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace arcslip::optimize {

class LoadCases {
 public:
  /// threads: how many cases are evaluated at the same time, with the results of one. control: that of the
  /// peaks.
  explicit LoadCases(Criterion criterion, int threads = 1, control::Control control = {})
      : criterion_(criterion), threads_(threads), control_(std::move(control)) {}

  /// weight: above 0. All cases have the same design parameters.
  void add(std::unique_ptr<PeakAmplitude> peaks, double weight);

  /// Moves all cases to a design, by tracking their peaks or by a new response for each.
  void at(std::span<const double> design);
  void trace(std::span<const double> design, observables::Steps steps = observables::Steps::events);
  bool is_at(std::span<const double> design) const;
  /// Whether all were moved by new responses.
  bool are_traced() const;

  std::size_t size() const { return all_.size(); }
  PeakAmplitude& peaks(std::size_t c) const { return *all_[c].peaks; }
  const PeakState& state(std::size_t c) const { return all_[c].peaks->state(); }
  double weight(std::size_t c) const;
  std::size_t group(std::size_t c) const { return criterion_ == Criterion::mean ? c : 0; }
  std::size_t groups() const { return criterion_ == Criterion::mean ? size() : 1; }

  /// w_c A_c; infinity if unbounded, NaN without a response.
  double height(std::size_t c) const { return weight(c) * state(c).amplitude(); }
  /// The case with the largest w_c A_c, of all cases or of a group.
  std::size_t highest() const;
  std::size_t highest_of(std::size_t group) const;

  /// V; infinity if a case is unbounded, NaN if one has no response.
  double value() const;
  /// dV/dp_k, m over the unit of p_k, for finite V; at a kink that of a highest peak of each group.
  Vector gradient() const;

  PeakWork work() const;

 private:
  template <class Move>
  void each(const Move& move);

  struct Each {
    std::unique_ptr<PeakAmplitude> peaks;
    double weight;
  };

  Criterion criterion_;
  int threads_;
  control::Control control_;
  std::vector<Each> all_;
  double sum_ = 0;  // of the weights
};

}  // namespace arcslip::optimize

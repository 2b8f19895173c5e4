#pragma once
// Stability of the solutions of harmonic balance: Floquet multipliers along them (time/floquet.hpp), their
// error, and where they leave the unit circle.
//
// The error is that of the neglected harmonics: the largest difference of a multiplier from those along the
// refined motion of the truncation estimate (truncation.hpp). It is an estimate of first order, not a bound.
//
// Bifurcations are zeros along the branch of
//   period_doubling     prod (1 + mu_i)
//   neimark_sacker      prod_{i < j} (1 - mu_i mu_j), at a complex pair
//   symmetry_breaking   prod (1 + lambda_i), with the multipliers lambda of the map over half a period, where
//   the
//                       harmonics are odd only
// A multiplier 1 is a fold, or a branch point (continuation/events/monitor.hpp). Where a phase of contact is
// born or vanishes, multipliers may jump: stability_lost is a jump of the largest modulus across 1.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/observables/response.hpp>
#include <arcslip/time/floquet.hpp>
#include <arcslip/time/hill.hpp>

#include <complex>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::observables {

class Observer;

/// For solutions of one model, of any harmonics. Owns its buffers; one for each thread.
class StabilityAnalysis {
 public:
  using Multipliers = std::vector<std::complex<double>>;

  /// by_hill: by Hill's method, of laws without memory only.
  explicit StabilityAnalysis(bool by_hill = false) : by_hill_(by_hill) {}

  /// At the last place of an evaluator of `problem`, whose parameters are p. False: unknown().
  bool move_to(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, const continuation::Vector& p);

  const Multipliers& multipliers() const { return hill_ ? hill_->multipliers() : floquet_->multipliers(); }
  const Multipliers& half_multipliers() const {
    return hill_ ? hill_->half_multipliers() : floquet_->half_multipliers();
  }

  /// Why there are none, or were none at one of the places so far, as the end of a sentence; empty: there
  /// were.
  const std::string& unknown() const { return unknown_; }

 private:
  continuation::Vector p_;
  bool by_hill_;
  std::optional<time::Floquet> floquet_;  // one of these
  std::optional<time::Hill> hill_;
  std::string unknown_;
  std::vector<time::ElementCourse> courses_;
};

/// How many lie outside the unit circle, by more than rounding.
int count_unstable(const std::vector<std::complex<double>>& multipliers);

/// The largest distance of one of the multipliers from the nearest of the others.
double distance(const std::vector<std::complex<double>>& multipliers,
                const std::vector<std::complex<double>>& others);

/// Of the complex pair nearest to the unit circle: its argument over 2 pi, in (0, 1/2). no_value: none.
double rotation_number(const std::vector<std::complex<double>>& multipliers);

/// Of an event at which a pair crosses the unit circle: its rotation number.
void set_rotation(ResponseEvent& event);

/// Without losses of stability at nonsmooth folds, and where another event tells them.
void drop_told_losses(std::vector<ResponseEvent>& events);

/// The multipliers at a point; null: not known there.
using MultipliersAt = std::function<const std::vector<std::complex<double>>*(const continuation::Accepted&)>;

/// Losses of stability of a branch: Neimark-Sacker points, jumps of the largest multiplier across the circle,
/// and, by the multipliers over half a period where motions are antisymmetric, breaks of symmetry, otherwise
/// period doublings.
std::vector<continuation::Monitor> stability_monitors(const MultipliersAt& of_period,
                                                      const MultipliersAt& of_half_period = {});

/// Those of the branches that an observer watches (Observer::watch_stability()).
std::vector<continuation::Monitor> stability_monitors(const std::shared_ptr<Observer>& observer);

}  // namespace arcslip::observables

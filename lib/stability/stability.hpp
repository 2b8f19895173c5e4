#pragma once
// Stability of the solutions of harmonic balance: Floquet multipliers along them (stability/floquet.hpp),
// their error, and where they leave the unit circle. Of a structure with more than 100 degrees of freedom,
// those of its 50 lowest natural modes, the others without inertia.
//
// The error is that of the neglected harmonics: the largest change of a multiplier by those of the refined
// motion of the truncation estimate (observables/truncation.hpp), plus that by the upper half of them, since
// the first alone may vanish by chance. It is an estimate of first order, not a bound.
//
// Bifurcations are zeros along the branch of functions of all multipliers (multipliers.hpp):
//   period_doubling     a multiplier -1
//   neimark_sacker      a complex pair on the unit circle
//   symmetry_breaking   a multiplier -1 of the map over half a period, where the harmonics are odd only
// A multiplier 1 is a fold, or a branch point (continuation/events/monitor.hpp). Where a phase of contact is
// born or vanishes, multipliers may jump: stability_lost is a jump of the largest modulus across 1 that no
// other event there explains, by how many multipliers are unstable on both sides: a fold and a multiplier -1
// explain a change by 1, a pair on the circle one by 2. A positive one that goes through 1 steeply but
// without a jump, as at a fold just after grazing, is no loss of its own.

#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/stability/floquet.hpp>
#include <arcslip/stability/hill.hpp>
#include <arcslip/stability/multipliers.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::observables {

/// For solutions of one model, of any harmonics. Owns its buffers; one for each thread.
class StabilityAnalysis {
 public:
  /// by_hill: by Hill's method, of laws without memory only.
  explicit StabilityAnalysis(bool by_hill = false) : by_hill_(by_hill) {}

  /// At the last place of an evaluator of `problem`, whose parameters are p. False: unknown().
  bool move_to(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, const continuation::Vector& p);
  /// At unknowns of `problem`, where no element reports contacts: forces are not evaluated.
  bool move_to(const hbm::HbmProblem& problem, continuation::In u, const continuation::Vector& p);

  const Multipliers& multipliers() const { return hill_ ? hill_->multipliers() : floquet_->multipliers(); }
  const Multipliers& half_multipliers() const {
    return hill_ ? hill_->half_multipliers() : floquet_->half_multipliers();
  }
  /// What the inertia of modes left out may change in a multiplier: as much as that of the upper half of
  /// those kept changes those of the lower half. 0: none is left out.
  double modal_error();

  /// Why there are none, or were none at one of the places so far, as the end of a sentence; empty: there
  /// were.
  const std::string& unknown() const { return unknown_; }

 private:
  bool prepare(const hbm::HbmProblem& problem, const continuation::Vector& p);
  void go_to_large(const model::Model& model, const time::EquationOfMotion& equation);
  bool compute(const hbm::HbmProblem& problem, const continuation::Vector& p);

  continuation::Vector p_;
  bool by_hill_;
  std::optional<time::Floquet> floquet_;  // one of these
  std::optional<time::Hill> hill_;
  std::optional<time::Floquet> coarse_;  // of a large structure: with half of the modes
  std::string unknown_;
  double omega_ = 0;  // of the last place
  std::optional<elements::Harmonics> harmonics_;
  std::vector<time::ElementCourse> courses_;
};

/// The multipliers that bifurcations belong to: of half a period, where there are such.
const Multipliers& of_map(const StabilityAnalysis& found, const hbm::HbmProblem& problem);

/// At an event of a branch: `unstable` without the multipliers that make it one, which are outside the circle
/// or not by rounding and by what the harmonics left out change, and the rotation number of a Neimark-Sacker
/// point.
void set_apart(const std::string& kind, ResponsePoint& point);

/// location_estimate of the bifurcations of a branch: the error of their multipliers, over the change of the
/// multiplier on the circle between the points on both sides.
void estimate_bifurcations(ResponseBranch& branch);

/// The multipliers at a point; null: not known there.
using MultipliersAt = std::function<const Multipliers*(const continuation::Accepted&)>;

/// Losses of stability of a branch: Neimark-Sacker points, jumps of the largest multiplier across the circle,
/// and, by the multipliers over half a period where motions are antisymmetric, breaks of symmetry, otherwise
/// period doublings.
std::vector<continuation::Monitor> stability_monitors(const MultipliersAt& of_period,
                                                      const MultipliersAt& of_half_period = {});

}  // namespace arcslip::observables

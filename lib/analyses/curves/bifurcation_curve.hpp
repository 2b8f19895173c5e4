#pragma once
// Curves of bifurcations of the responses over the excitation frequency, over a further parameter: period
// doublings, breaks of symmetry and Neimark-Sacker points (bifurcations.hpp), from one that was found on a
// branch. So are points of phase resonance (analyses/branches/phase_resonance.hpp), at which the motion does
// not bifurcate.
//
// A curve ends where the pair of a Neimark-Sacker point becomes real: at 1 on a curve of folds, at -1 on one
// of period doublings; and where the multipliers jump across the unit circle, as at the birth of slip. Each
// end is looked at: the jump is determined by the multipliers on both sides of it.

#include <arcslip/analyses/curves/bifurcations.hpp>
#include <arcslip/analyses/curves/special_curve.hpp>
#include <arcslip/control/run_control.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::observables {

class BifurcationTracer final : public CurveTracer {
 public:
  /// kind: of event_kinds::of_curves, or phase_resonance. report, control: as for SpecialCurveTracer.
  BifurcationTracer(std::shared_ptr<const hbm::HbmProblem> problem, std::string kind, OverParameter way,
                    const FrequencyWindow& window, std::shared_ptr<CurveSection> section, Report report,
                    control::Control control = {});

  SpecialCurve run(const SpecialPoint& start, int direction) override;
  bool passes(const SpecialCurve& curve, const SpecialPoint& through) const override;

 private:
  std::optional<continuation::Vector> start_of(const SpecialPoint& start) const;
  std::vector<continuation::Monitor> monitors() const;
  ResponsePoint observe(const continuation::Accepted& now);
  void set_end(const continuation::Branch& branch, SpecialCurveEnd& end) const;
  std::optional<double> jump_beyond(const continuation::Point& last) const;
  bool is_pair() const;
  bool is_phase() const;
  bool ends_curve(const std::string& event) const;

  std::string kind_;
  FrequencyWindow window_;
  std::shared_ptr<CurveSection> section_;
  Report report_;
  control::Control control_;
  std::shared_ptr<const continuation::Problem> equations_;
};

}  // namespace arcslip::observables

#pragma once
// Results of a curve of special points: its parts, their stops, their events and the estimates of these.

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/parameter_trace.hpp>
#include <arcslip/analyses/curves/special_curve.hpp>
#include <arcslip/results/response.hpp>
#include <arcslip/scene/scene.hpp>

#include <optional>
#include <string>
#include <vector>

namespace arcslip::observables {

/// Whether a kind of special point is that of a bifurcation with a curve of its own kind.
bool is_bifurcation(const std::string& kind);

/// Whether it is continued as a zero of a function of the solution: a bifurcation, or phase resonance.
bool is_zero_of_function(const std::string& kind);

class CurveParts {
 public:
  /// kind: of the points of the curves (results/event_kinds.hpp).
  CurveParts(std::string kind, scene::FrequencyUnit unit, OverParameter way);

  /// A curve of peaks turns where a peak meets a minimum of the amplitude over the frequency; the part on
  /// minima, up to the next turn, is left out. Other curves are one part. Those of bifurcations begin and end
  /// with events of their kind.
  std::vector<ResponseBranch> of(const SpecialCurve& curve) const;

  /// Arclengths at which a curve turns back in the parameter, ascending.
  static std::vector<double> turns(const SpecialCurve& curve);

  ResponseBranch failed(double over, const std::string& message) const;
  /// A result stopped before all curves were found, while searching the response at `over`.
  ResponseBranch stopped(double over) const;

 private:
  std::optional<ResponseBranch> between(double begin, double end, const SpecialCurve& curve) const;
  bool belongs_to_another(const SpecialCurve& curve, const SpecialCurve::EventAt& each) const;
  void finish(ResponseBranch& part, const SpecialCurve& curve, bool is_first, bool is_last) const;
  Stop stop(const SpecialCurveEnd& end, double begin, bool has_points, Status& status) const;

  void add_ends(const SpecialCurve& curve, ResponseBranch& part) const;

  std::string kind_;
  bool peaks_;
  std::string what_;
  scene::FrequencyUnit unit_;
  OverParameter way_;
};

/// Sets the estimates of an event of the curve at this arclength, where they are known: parameter_estimate,
/// location_estimate, those of the amplitude and of the shares of stick.
void estimate_change(const SpecialCurve& curve, double arclength, ResponseEvent& event);

}  // namespace arcslip::observables

#pragma once
// Curves of special points of the branches over the excitation frequency, over one more parameter: resonance
// peaks and folds. Found on the branch at the range's beginning, followed by continuation of the equations
// that define them (continuation/stationary.hpp).

#include <arcslip/observables/curve_section.hpp>
#include <arcslip/observables/frequency_branch.hpp>
#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/over_parameter.hpp>

#include <functional>
#include <string>
#include <vector>

namespace arcslip::observables {

/// A special point on the branch over the frequency, to start from.
struct SpecialPoint {
  continuation::Vector x;  // unknowns and frequency
  bool nonsmooth = false;
};

/// Those in a frequency window at the beginning of the range.
struct SpecialPoints {
  std::shared_ptr<const hbm::HbmProblem> problem;
  std::vector<SpecialPoint> points;
  bool unbounded = false;  // an unbounded resonance ends the branch
  std::string failure;     // why there are none, or not all
};

/// kind: the event, "peak" or "fold".
SpecialPoints special_points(const OverParameter& way, const FrequencyWindow& window,
                             const std::string& kind);

/// What was recorded of one curve, in the order of arclength.
struct SpecialCurve {
  struct At {
    double arclength = 0;
    double second = 0;  // second derivative of the amplitude, or of the frequency, along the frequency branch
    ResponsePoint point;
  };
  struct EventAt {
    double arclength = 0;
    ResponseEvent event;
  };
  std::vector<At> points;
  std::vector<EventAt> events;
  continuation::Branch branch;  // without its points' unknowns but for the ends
  continuation::Vector end;     // unknowns and frequency at the last point
  bool left_window = false;     // of the frequency
  std::string unbounded;        // why, where the response grows without bound
};

/// curve: the equations, in the parameter way.index. monitors: in addition to that of the frequency window.
/// progress: after each point, with its value of the parameter and its frequency; false stops.
SpecialCurve follow(const std::shared_ptr<const hbm::HbmProblem>& problem,
                    const std::shared_ptr<const continuation::Problem>& curve, const OverParameter& way,
                    const FrequencyWindow& window, const continuation::Vector& start,
                    const std::shared_ptr<CurveSection>& section, std::vector<continuation::Monitor> monitors,
                    const std::function<bool(double over, double omega)>& progress);

}  // namespace arcslip::observables

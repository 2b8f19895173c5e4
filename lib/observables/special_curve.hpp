#pragma once
// Curves of special points of the branches over the excitation frequency, over one more parameter: resonance
// peaks and folds. Found on the branch at the range's beginning, followed by continuation of the equations
// that define them (continuation/stationary.hpp).
//
// A special point may come to a corner of the branches, where a friction element begins to slip at a reversal
// of its motion, and sit there while the parameter goes on: the slope has opposite signs on the two sides.
// The curve then follows the corner (hbm/slip_corner.hpp), until the slope vanishes on one of the sides.

#include <arcslip/hbm/slip_corner.hpp>
#include <arcslip/observables/curve_section.hpp>
#include <arcslip/observables/frequency_branch.hpp>
#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/over_parameter.hpp>

#include <functional>
#include <memory>
#include <optional>
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

/// What is special, as the zero of the slope of a quantity along the branch over the frequency.
struct SpecialKind {
  std::string event;  // "peak" or "fold"
  continuation::Quantity quantity;
  bool maximum = false;  // of the quantity only
};
SpecialKind peak_kind(const std::shared_ptr<const hbm::HbmProblem>& problem);
SpecialKind fold_kind();

/// What was recorded of one curve, in the order of arclength.
struct SpecialCurve {
  struct At {
    double arclength = 0;
    double second = 0;  // derivative of the quantity along the frequency branch; 0 at corners
    ResponsePoint point;
  };
  struct EventAt {
    double arclength = 0;
    ResponseEvent event;
  };
  std::vector<At> points;
  std::vector<EventAt>
      events;                 // those of the monitors, and "corner" where the curve comes to one or leaves it
  std::vector<double> turns;  // arclengths of the corners where the parameter turns back
  continuation::Stop stop;
  continuation::Counts counts;
  continuation::Vector end;  // unknowns and frequency at the last point
  bool left_window = false;  // of the frequency
  bool vanishes =
      false;  // at a corner that the branch over the frequency touches from one side, or surpassed
  std::string unbounded;  // why, where the response grows without bound
};

class SpecialCurveTracer {
 public:
  using Progress = std::function<bool(double over, double omega)>;

  /// monitors: of the curve, in addition to that of the frequency window. progress: after each point, with
  /// its value of the parameter and its frequency; false stops.
  SpecialCurveTracer(std::shared_ptr<const hbm::HbmProblem> problem, SpecialKind kind, OverParameter way,
                     const FrequencyWindow& window, std::vector<continuation::Monitor> smooth_monitors,
                     std::vector<continuation::Monitor> corner_monitors,
                     std::shared_ptr<CurveSection> section, Progress progress);

  SpecialCurve run(const SpecialPoint& start);

 private:
  struct Place {
    continuation::Vector x;  // unknowns and frequency
    double over = 0;
    int direction = 1;
    std::optional<hbm::SlipCorner> corner;  // none on smooth parts
  };

  continuation::Branch trace(const Place& from);
  std::optional<Place> to_corner(const Place& at);
  std::optional<Place> from_corner(const Place& at, bool slip) const;
  bool is_surpassed(const Place& at) const;
  std::optional<continuation::Vector> corrected(const continuation::Problem& problem,
                                                const continuation::Vector& x, double over,
                                                const continuation::Vector& row) const;
  // The unknowns at a corner: those of the smooth parts, and its two angles.
  static continuation::Vector with_angles(const continuation::Vector& x, const hbm::SlipCorner& corner);
  static hbm::SlipCorner at_angles(hbm::SlipCorner corner, const continuation::Vector& all);
  continuation::Vector parameters(const continuation::Vector& x, double over) const;
  bool inside(double over) const { return over >= way_.lower() && over <= way_.upper(); }

  std::shared_ptr<const hbm::HbmProblem> problem_;
  SpecialKind kind_;
  OverParameter way_;
  FrequencyWindow window_;
  std::vector<continuation::Monitor> smooth_monitors_, corner_monitors_;
  std::shared_ptr<CurveSection> section_;
  Progress progress_;
  std::shared_ptr<const continuation::Problem> smooth_;
  SpecialCurve result_;
  double arclength_ = 0;  // where the part begins
};

}  // namespace arcslip::observables

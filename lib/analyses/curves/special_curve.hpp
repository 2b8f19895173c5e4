#pragma once
// Curves of special points of the branches over the excitation frequency, resonance peaks and folds, over a
// further parameter. Found on a branch at one value of the parameter, they are continued by their defining
// equations (continuation/special_points/stationary.hpp).
//
// A special point may reach a corner of the branches, where a friction element starts to slip at a reversal
// of its motion, and stay there while the parameter changes: the slope has opposite signs on the two sides.
// The curve then follows the corner (hbm/grazing_problem.hpp), until the slope vanishes on one side.

#include <arcslip/analyses/branches/frequency_branch.hpp>
#include <arcslip/analyses/branches/parameter_trace.hpp>
#include <arcslip/analyses/curves/special_point_observer.hpp>
#include <arcslip/analyses/curves/special_points.hpp>
#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/hbm/grazing_problem.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::observables {

/// The kind of special points, as zeros of the slope of a quantity along the branch over the frequency.
struct SpecialKind {
  std::string event;  // event_kinds::peak or fold
  continuation::StationaryQuantity quantity;
  bool maximum = false;  // of the quantity only
};
SpecialKind peak_kind(const std::shared_ptr<const hbm::HbmProblem>& problem);
SpecialKind fold_kind();

/// The start or end of a curve, and its reason.
struct SpecialCurveEnd {
  continuation::BranchStop stop;
  continuation::Vector x;                   // unknowns and frequency
  double over = 0;                          // the parameter
  int direction = 1;                        // of the parameter, where it stopped
  bool left_window = false;                 // of the frequency
  bool vanishes = false;                    // at a corner that the branch touches from one side, or surpassed
  bool closed = false;                      // the curve returned to its start
  bool goes_on = false;                     // another curve starts or ends there
  std::string unbounded{};                  // why, where the response grows without bound
  const results::Reason* reason = nullptr;  // of results/reasons.hpp, where the curve is complete for it,
  std::string why{};                        // and the sentence that reports it, without the place
};

/// The record of one curve, in order of arclength.
struct SpecialCurve {
  struct At {
    double arclength = 0;
    double second = 0;  // derivative of the quantity along the frequency branch; 0 at corners
    ResponsePoint point;
    std::optional<hbm::Corner> corner{};  // none on smooth parts
    double kappa = 0;                     // of Neimark-Sacker points (bifurcations.hpp)
  };
  struct EventAt {
    double arclength = 0;
    ResponseEvent event;
  };
  std::vector<At> points;
  std::vector<EventAt> events;           // of the monitors, and where the curve reaches or leaves a corner
  std::vector<double> turns;             // arclengths of the corners where the parameter turns back
  std::optional<SpecialCurveEnd> begin;  // none: it starts at an end of the range
  SpecialCurveEnd end;
  SolverSummary solver{};
};

/// Joins the two halves of a curve traced from one of its points, in the order of `ahead`.
SpecialCurve joined(SpecialCurve back, SpecialCurve ahead);

/// Traces curves of special points of one kind.
class CurveTracer {
 public:
  using Report = std::function<void(double over, double omega)>;

  CurveTracer(std::shared_ptr<const hbm::HbmProblem> problem, OverParameter way)
      : problem_(std::move(problem)), way_(std::move(way)) {}
  virtual ~CurveTracer() = default;

  /// direction: of the parameter, +1 or -1.
  virtual SpecialCurve run(const SpecialPoint& start, int direction) = 0;

  /// Whether a curve passes through a special point.
  virtual bool passes(const SpecialCurve& curve, const SpecialPoint& through) const = 0;

  /// A point of a curve, to start from or to search for.
  SpecialPoint point_of(const SpecialCurve::At& at) const;

 protected:
  /// Between the neighbouring points a and b of a curve: whether the curve, corrected from a guess (u, omega,
  /// over) in the plane with the normal `row`, passes through the point sought.
  using LiesOn = std::function<bool(const SpecialCurve::At& a, const SpecialCurve::At& b,
                                    const continuation::Vector& guess, const continuation::Vector& row)>;
  // The first of the `points` of a curve beyond its passage through a special point; 0: none.
  std::size_t passage(const SpecialCurve& curve, std::size_t points, const SpecialPoint& through,
                      const LiesOn& lies_on) const;
  std::optional<continuation::Vector> corrected(const continuation::Problem& problem,
                                                const continuation::Vector& x, double over,
                                                const continuation::Vector& row, double reach) const;
  bool is_same(const continuation::Vector& x, const continuation::Vector& y) const;
  bool is_at(const continuation::Vector& v, const SpecialPoint& point) const;  // v: x and over
  continuation::Vector parameters(const continuation::Vector& x, double over) const;
  bool inside(double over) const { return over >= way_.lower() && over <= way_.upper(); }

  std::shared_ptr<const hbm::HbmProblem> problem_;
  OverParameter way_;
};

/// Terminal, where the frequency leaves the window. n: where it stands among the unknowns.
continuation::Monitor window_monitor(const FrequencyWindow& window, Eigen::Index n);
inline constexpr const char* window_event = "window";

/// Where a curve turns in the frequency.
continuation::Monitor turn_monitor(Eigen::Index n);

class SpecialCurveTracer final : public CurveTracer {
 public:
  /// monitors: of the curve, in addition to that of the frequency window. report: called after each point,
  /// with its value of the parameter and its frequency; control: asked in between, too.
  SpecialCurveTracer(std::shared_ptr<const hbm::HbmProblem> problem, SpecialKind kind, OverParameter way,
                     const FrequencyWindow& window, std::vector<continuation::Monitor> smooth_monitors,
                     std::vector<continuation::Monitor> corner_monitors,
                     std::shared_ptr<CurveSection> section, Report report, control::Control control = {});

  SpecialCurve run(const SpecialPoint& start, int direction) override;
  bool passes(const SpecialCurve& curve, const SpecialPoint& through) const override {
    return passage(curve, curve.points.size(), through) > 0;
  }

 private:
  struct CurveStart {
    continuation::Vector x;  // unknowns and frequency
    double over = 0;
    int direction = 1;
    std::optional<hbm::Corner> corner;  // none on smooth parts
  };

  continuation::Branch trace(const CurveStart& from);
  std::optional<CurveStart> part_beyond(const continuation::Branch& branch,
                                        const std::optional<hbm::Corner>& corner);
  std::vector<continuation::Monitor> monitors_from(const CurveStart& from) const;
  ResponsePoint observe(const continuation::Accepted& now, const CurveStart& from);
  bool grows_ahead(const continuation::Accepted& now);
  continuation::Observer recording(const CurveStart& from);
  using CurveTracer::passage;
  std::size_t passage(const SpecialCurve& curve, std::size_t points, const SpecialPoint& through) const;
  bool comes_back(std::size_t begin);
  void end_at(std::size_t count, bool closed);
  bool is_repeated(const SpecialCurve::EventAt& event) const;
  std::optional<CurveStart> to_corner(const CurveStart& at);
  struct Comparison {
    CurveStart place;
    hbm::CornerSlopes slopes;
  };
  std::optional<Comparison> corner_nearby(const CurveStart& at, const hbm::Corner& corner, int direction,
                                          double nearby) const;
  bool is_special(const hbm::CornerSlopes& slopes) const;
  std::optional<CurveStart> leave_corner(const CurveStart& at, bool above);
  std::optional<CurveStart> to_crossing_corner(const CurveStart& at);
  std::optional<CurveStart> from_corner(const CurveStart& at, bool above) const;
  std::optional<CurveStart> seen_beyond(const CurveStart& at);
  std::optional<CurveStart> seen_beyond(const CurveStart& at, OtherBranches others);
  std::optional<continuation::Vector> at_depth(const CurveStart& at, double depth, double reach) const;
  bool is_surpassed(const CurveStart& at) const;

  SpecialKind kind_;
  FrequencyWindow window_;
  std::vector<continuation::Monitor> smooth_monitors_, corner_monitors_;
  std::shared_ptr<CurveSection> section_;
  Report report_;
  control::Control control_;
  std::shared_ptr<const continuation::Problem> smooth_;
  SpecialCurve result_;
  double arclength_ = 0;  // where the part begins
};

}  // namespace arcslip::observables

#pragma once
// Continuation of a curve of optima, piece by piece, with the transitions between pieces. Not installed.

#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/curve/active_set.hpp>
#include <arcslip/optimize/curve/optimum_curve.hpp>
#include <arcslip/optimize/evaluation/design_space.hpp>
#include <arcslip/optimize/evaluation/interruption.hpp>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::optimize {

using continuation::text;

inline constexpr double u_turn = -0.9;  // cosine of the tangents before and after

/// At a point of a piece.
struct Seen {
  OptimumPoint point;
  double slope;     // d ln A / dsigma of the optimum
  int orientation;  // of the tangent there (ActiveSetPoint)
};

class CurveOfOptima {
 public:
  CurveOfOptima(const scene::Scene& scene, const OptimumProblem& problem, const DesignVariable& along,
                const OptimumCurveOptions& options);
  OptimumCurve run();

 private:
  static constexpr double between_responses = 0.5;  // of y and sigma

  static OptimumProblem with_along(OptimumProblem problem, const DesignVariable& along);
  // Limit of pieces without progress: the active set may cycle, and peaks be lost and found, at one point.
  void guard();
  std::size_t size() const { return problem_.over.size(); }
  const ScaledParameter& sigma() const { return scaled_.back(); }
  std::string place(double s) const { return text(along_.name, " = ", sigma().value(s)); }
  bool end(observables::Status status, const results::Reason& reason, std::string message);
  bool end_interrupted();
  // Finds the first optimum by a search, and its active set.
  bool begin();
  bool hold_flat(std::vector<double>& design);
  OptimalitySetting setting() { return {peaks_, scaled_, reference_}; }
  std::shared_ptr<const OptimalityData> data() { return setting().of(here_.active); }
  // Determines the active set and solves its equations at the first optimum, exchanging
  // violated inequalities.
  bool settle(const std::vector<double>& design);
  static const OptimalityEvaluator& evaluator(const continuation::Accepted& now);
  OptimumPoint point(const OptimalityEvaluator& at);
  // Continues from the current point to the end of the active set or of the range, or until a response
  // is due.
  void piece();
  struct Piece {
    continuation::Branch branch;
    std::map<double, Seen> seen;  // by arclength
    std::vector<Inequality> may_change;
    bool response_due = false;
  };
  Piece trace_piece();
  std::vector<continuation::Monitor> monitors(const std::vector<Inequality>& may_change) const;
  continuation::Options trace_options();
  std::unique_ptr<OptimalityEvaluator> move_to_end(Piece& piece);
  void end_at_boundary(double s);
  void check_window();
  // The equations at the end of a piece: with the tracked peaks, or, if trials have lost these, with those of
  // a new response.
  std::unique_ptr<OptimalityEvaluator> at_last_point();
  void stop_with(const continuation::BranchStop& stop);
  // The curve ends where the active peaks no longer depend on a parameter; at its end a trace may turn back
  // onto itself.
  static void end_at_u_turn(continuation::Branch& branch);
  // Adds points and events in the order of the curve. A piece starts at the end of the last one.
  void keep(const continuation::Branch& branch, const std::map<double, Seen>& seen);
  double distance(const OptimumPoint& a, const OptimumPoint& b) const;
  double way_since_response(const OptimumPoint& at);
  // The active set that continues the curve. which: index in may_change; its size: another peak joins.
  void change(std::size_t which, const std::vector<Inequality>& may_change, const OptimalityEvaluator& at);
  // A turn in s from one piece to the next. before: dsigma of the last tangent.
  void note_turn(double before, const OptimumPoint& at);
  // The direction in which the slack of the changed inequality increases.
  void orient(const Inequality& watched);
  void end_flat(const std::string& parameter);
  // A free parameter on which no active peak depends.
  std::optional<std::size_t> without_influence();
  // Traces the response at the current point.
  void verify();
  void set_safe();
  // Returns to the point of the last response.
  void go_back();
  // An active peak cannot be tracked further: identifies it in a response slightly beyond.
  void lost(const continuation::BranchStop& stop);
  // Continues from slightly beyond the end of a piece, with the peaks there. way: -1 if s turns, to a piece
  // with peaks of other kinds. False: no such optimum; here_ is then unchanged.
  bool goes_on(const ActiveSetPoint& last, double by, int way);
  // Identifies the active peaks in the response at here_.z, and the parameters without influence.
  bool find_beyond(const ActiveSetPoint& last, double by);
  // The tangent of the continued curve, by its orientation. False: none, or it leads back onto the
  // same piece.
  bool direct(const ActiveSetPoint& last, const OptimalityEvaluator& at);
  static bool same_kinds(const std::vector<KnownPeak>& before, const OptimalityEvaluator& at);
  void changed(const std::vector<KnownPeak>& before, const OptimalityEvaluator& at);
  void finish();

  const scene::Scene& scene_;
  const OptimumProblem& problem_;
  const DesignVariable& along_;
  const OptimumCurveOptions& options_;
  const control::Control control_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  const char* phase_ = "the search for the first optimum";
  DesignSpace space_;  // of the design and, last, s
  double unit_;
  PeakAmplitude peaks_;
  std::vector<ScaledParameter> scaled_;
  OptimumCurve curve_;
  ActiveSetPoint here_;
  double reference_ = 1;
  double step_ = 0;  // the last one
  std::string flat_;
  bool ended_ = false;

  // Where the last response was.
  std::optional<ActiveSetPoint> safe_;
  std::optional<OptimumPoint> checked_;
  std::size_t safe_points_ = 0, safe_events_ = 0;
  double interval_ = between_responses;  // of y and sigma
  bool rewound_ = false;

  std::optional<OptimumPoint> mark_;
  int idle_ = 0;
};

}  // namespace arcslip::optimize

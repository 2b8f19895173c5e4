#pragma once
// How a curve of optima is followed: piece by piece, and from one to the next. Not installed.

#include <arcslip/continuation/problem/text.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/optimize/curve/active_set.hpp>
#include <arcslip/optimize/curve/optimum_curve.hpp>
#include <arcslip/optimize/curve/standing.hpp>
#include <arcslip/optimize/search/design_space.hpp>
#include <arcslip/optimize/search/watch.hpp>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::optimize {

using continuation::text;

/// At a point of a piece.
struct Seen {
  OptimumPoint point;
  double slope;     // d ln A / dsigma of the optimum
  int orientation;  // of the tangent there (Standing)
};

class CurveOfOptima {
 public:
  CurveOfOptima(const scene::Scene& scene, const OptimumProblem& problem, const DesignVariable& along,
                const OptimumCurveOptions& options);
  OptimumCurve run();

 private:
  static constexpr double between_responses = 0.5;  // of y and sigma

  static OptimumProblem with_along(OptimumProblem problem, const DesignVariable& along);
  // Pieces that lead nowhere: the active set may change to and fro, and peaks be lost and found, at one
  // place.
  void guard();
  std::size_t size() const { return problem_.over.size(); }
  const ScaledParameter& sigma() const { return scaled_.back(); }
  std::string place(double s) const { return text(along_.name, " = ", sigma().value(s)); }
  bool end(observables::Status status, const results::Reason& reason, std::string message);
  bool end_interrupted();
  // The first optimum, by search, and its active set.
  bool begin();
  bool hold_flat(std::vector<double>& design);
  OptimalitySetting setting() { return {peaks_, scaled_, reference_}; }
  std::shared_ptr<const OptimalityData> data() { return setting().of(here_.active); }
  // The active set and the solution of its equations at the first optimum: what is violated is exchanged.
  bool settle(const std::vector<double>& design);
  static const OptimalityEvaluator& evaluator(const continuation::Accepted& now);
  OptimumPoint point(const OptimalityEvaluator& at);
  // From where it stands to the end of the active set, of the range, or until a response is due.
  void piece();
  // The equations at the end of a piece: with the peaks that were followed, or, where trials have led those
  // astray, with those of a new response.
  std::unique_ptr<OptimalityEvaluator> at_last_point();
  void stop_with(const continuation::Stop& stop);
  // Where the active peaks cease to depend on a parameter the curve ends, and at its end a trace may turn
  // round and come back on itself.
  static void end_at_u_turn(continuation::Branch& branch);
  // Points and events in the order of the curve. The first point of a piece is where the last one ended.
  void keep(const continuation::Branch& branch, const std::map<double, Seen>& seen);
  double distance(const OptimumPoint& a, const OptimumPoint& b) const;
  double way_since_response(const OptimumPoint& at);
  // The active set that goes on where this one ends. which: of may_change; its size: another peak joins.
  void change(std::size_t which, const std::vector<Inequality>& may_change, const OptimalityEvaluator& at);
  // A turn in s from one piece to the next. before: dsigma of the last tangent.
  void note_turn(double before, const OptimumPoint& at);
  // The way in which the inequality that has changed holds more and more.
  void orient(const Inequality& watched);
  void end_flat(const std::string& parameter);
  // A free parameter on which no active peak depends.
  std::optional<std::size_t> without_influence();
  // The response where the curve stands.
  void verify();
  void set_safe();
  // To where the last response was.
  void go_back();
  // An active peak cannot be followed farther: what it is in a response a little beyond.
  void lost(const continuation::Stop& stop);
  // From a little beyond the end of a piece, with the peaks as they are there. way: -1 where s turns, to a
  // piece with peaks of other kinds. False: there is no such optimum; here_ is then as it was.
  bool goes_on(const Standing& last, double by, int way);
  // The active peaks in the response at here_.z, and what has no influence there.
  bool find_beyond(const Standing& last, double by);
  // The tangent that goes on, by its orientation. False: there is none, or it leads back on the same piece.
  bool direct(const Standing& last, const OptimalityEvaluator& at);
  static bool same_kinds(const std::vector<KnownPeak>& before, const OptimalityEvaluator& at);
  void changed(const std::vector<KnownPeak>& before, const OptimalityEvaluator& at);
  void finish();

  const scene::Scene& scene_;
  const OptimumProblem& problem_;
  const DesignVariable& along_;
  const OptimumCurveOptions& options_;
  Watch watch_;
  DesignSpace space_;  // of the design and, last, s
  double unit_;
  PeakAmplitude peaks_;
  std::vector<ScaledParameter> scaled_;
  OptimumCurve curve_;
  Standing here_;
  double reference_ = 1;
  double step_ = 0;  // the last one
  std::string flat_;
  bool ended_ = false;

  // Where the last response was.
  std::optional<Standing> safe_;
  std::optional<OptimumPoint> checked_;
  std::size_t safe_points_ = 0, safe_events_ = 0;
  double interval_ = between_responses;  // of y and sigma
  bool rewound_ = false;

  std::optional<OptimumPoint> mark_;
  int idle_ = 0;
};

}  // namespace arcslip::optimize

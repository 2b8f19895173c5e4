#include <arcslip/analyses/curves/curves.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/other_solutions.hpp>
#include <arcslip/analyses/branches/resonances.hpp>
#include <arcslip/analyses/curves/bifurcation_curve.hpp>
#include <arcslip/analyses/curves/special_curve.hpp>
#include <arcslip/analyses/curves/special_curve_results.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

namespace arcslip::observables {
namespace {

using continuation::Accepted;
using continuation::Monitor;
using continuation::StopReason;
using continuation::Vector;

// Shares of the range of the parameter.
constexpr double between_ends[] = {0.5,   0.25,  0.75, 0.125,
                                   0.375, 0.625, 0.875};  // where a response is looked at in any case
constexpr double least_apart = 1.0 / 64;                  // of responses that are looked at
constexpr double just_beyond = 1e-3;                      // the end of a curve
constexpr double meeting = 1e-5;                          // relative: ends of curves that are nearer meet
constexpr std::size_t most_responses = 24;

// The curves of one kind over one parameter. They are started from the special points of responses at some
// values of the parameter: first both ends of its range, then next to each end of a curve within it, and
// wherever no response is near. Each curve is traced once, from the first response that shows it.
class Curves {
 public:
  Curves(std::vector<std::string> kinds, const scene::Scene& scene, const CurveRange& range,
         const control::Control& control, double least = 0, std::optional<BranchLimits> all = {})
      : kinds_(std::move(kinds)),
        peaks_(kinds_.front() == event_kinds::peak),
        unit_(scene.frequency_unit),
        to_rad_per_s_(scene::to_rad_per_s(unit_)),
        window_{range.frequency_from * to_rad_per_s_, range.frequency_to * to_rad_per_s_},
        way_(over_parameter(scene, range.over, range.from, range.to, control)),
        parts_(kinds_.front(), unit_, way_),
        control_(control),
        stability_(range.stability),
        least_(least),
        all_(std::move(all)) {}

  std::vector<ResponseBranch> run() {
    look_at(0);
    if (control_.keep_going()) look_at(1);
    for (const double share : between_ends) to_look_at_.push_back(share);
    for (std::size_t i = 0;
         i < to_look_at_.size() && looked_at_.size() < most_responses && control_.keep_going(); ++i)
      if (!is_looked_at(to_look_at_[i])) look_at(to_look_at_[i]);
    see_which_meet();
    std::vector<ResponseBranch> branches;
    for (const Found& found : found_) {
      int part_before = 0;
      for (auto& part : reported(found)) {
        part.parent = std::exchange(part_before, 1);
        branches.push_back(std::move(part));
      }
    }
    if (!control_.keep_going()) {
      if (branches.empty() || branches.back().stop.reason != reasons::user)
        branches.push_back(parts_.stopped(way_.value(looked_at_.back())));
      return branches;
    }
    if (branches.empty()) {
      const std::string why =
          failure_.empty() ? unbounded_.empty() ? what_was_looked_at() : unbounded_ : failure_;
      branches.push_back(parts_.failed(
          way_.from, "no " + what() + " was found at " + way_.name + " = " + to_digits(way_.from, 8) +
                         ", nor up to " + to_digits(way_.to, 8) + ", between " +
                         frequency_text(window_.lower, unit_) + " and " +
                         frequency_text(window_.upper, unit_) + (why.empty() ? "" : ": " + why)));
      if (failure_.empty() && unbounded_.empty() && is_bifurcation(kinds_.front()))
        branches.back().found_none = seen_;
    } else if (!failure_.empty()) {
      branches.push_back(parts_.failed(failed_at_, failure_));
    }
    branches.front().untraced = untraced_;
    return branches;
  }

 private:
  struct Found {
    std::string kind;
    SpecialCurve curve;
    std::shared_ptr<const hbm::HbmProblem> problem;
    double seconds;
    std::string doubt, unknown_stability;
  };

  std::string what() const {
    return kinds_.size() > 1 ? "bifurcation" : event_kinds::words_of(kinds_.front());
  }

  std::string what_was_looked_at() const {
    if (is_bifurcation(kinds_.front())) {
      const std::string values = " " + std::to_string(looked_at_.size()) + " values of " + way_.name;
      if (!all_)
        return "the branch that begins at " + frequency_text(window_.lower, unit_) + " was looked at, for" +
               values + ", and no other (\"branches\": \"all\")";
      return "the branches from the ends of the window and those that leave them were looked at, for" +
             values + ", up to " + std::to_string(most_seen_) + " of them; others were " +
             (all_->searches > 0
                  ? "searched for at " + std::to_string(all_->searches) +
                        (all_->searches == 1 ? " frequency" : " frequencies") + " of each value"
                  : "not searched for (\"searches\")");
    }
    if (is_zero_of_function(kinds_.front())) return "";
    Vector p = model::defaults(*way_.model);
    p[way_.index] = way_.from;
    return text_of(resonances(*way_.model, p), window_, unit_);
  }

  bool is_looked_at(double share) const {
    return std::any_of(looked_at_.begin(), looked_at_.end(),
                       [&](double other) { return std::abs(other - share) < least_apart; });
  }

  // share: of the range, 0 at its beginning.
  void look_at(double share) {
    looked_at_.push_back(share);
    const double over = way_.value(share);
    const SpecialPoints response = seen_at(over);
    if (!control_.keep_going()) return;
    most_seen_ = std::max(most_seen_, response.branches);
    take(response.looked_at);
    tell_untraced(response.untraced, over);
    tell_leaving(response.leaving, over);
    double highest = 0;
    for (const SpecialPoint& start : response.points) highest = std::max(highest, start.amplitude);
    for (const SpecialPoint& start : response.points) {
      if (start.amplitude < least_ * highest) continue;
      follow(start, share);
      if (!control_.keep_going()) return;
    }
    if (unbounded_.empty()) unbounded_ = response.unbounded;
    if (!response.unknown_stability.empty() && failure_.empty()) {
      failed_at_ = over;
      failure_ = "the stability of the response at " + way_.name + " = " + to_digits(over, 8) +
                 " is not known, and curves may be missing: " + response.unknown_stability;
    }
    if (response.failure.empty() || !failure_.empty()) return;
    failed_at_ = over;
    failure_ = "the response at " + way_.name + " = " + to_digits(over, 8) +
               " could not be continued through the window, and curves may be missing: " + response.failure;
  }

  SpecialPoints seen_at(double over) {
    // Bifurcations of further branches are left to Branches::all.
    const auto others = is_bifurcation(kinds_.front()) ? OtherBranches::none : OtherBranches::from_ends;
    if (!all_) return special_points(way_, over, window_, kinds_, others, control_);
    const auto report = [this](const control::Progress& now) {
      progress_.points = now.points;
      progress_.frequency = now.frequency;
      progress_.step = now.step;
      control_.report(progress_);
    };
    return special_points_of_all(way_, over, window_, kinds_, *all_, unit_,
                                 control_.child({.report = report}));
  }

  void take(const LookedAt& responses) {
    seen_.amplitude = std::max(seen_.amplitude, responses.amplitude);
    seen_.estimate = std::fmax(seen_.estimate, responses.estimate);
    seen_.flagged = seen_.flagged || responses.flagged;
  }

  // One of each reason.
  void tell_untraced(const std::vector<std::string>& all, double over) {
    const auto why = [](const std::string& text) { return text.substr(text.rfind(": ") + 1); };
    for (const std::string& each : all)
      if (std::none_of(untraced_.begin(), untraced_.end(),
                       [&](const std::string& other) { return why(other) == why(each); }))
        untraced_.push_back("at " + way_.name + " = " + to_digits(over, 8) + ", " + each);
  }

  // The first of them: there may be some at each value of the parameter.
  void tell_leaving(const std::vector<LeavingBranch>& all, double over) {
    if (all.empty()) return;
    tell_untraced({"the branch that leaves at the " + event_kinds::words_of(all.front().kind) + " at " +
                   frequency_text(all.front().omega, unit_) +
                   ": only one branch was looked at (\"branches\" is \"one\")"},
                  over);
  }

  void follow(const SpecialPoint& start, double share) {
    const auto began = std::chrono::steady_clock::now();
    const std::unique_ptr<CurveTracer> tracer = make_tracer(start);
    const auto passes = [&](const Found& found) {
      return found.kind == start.kind && is_alike(found, *start.problem) &&
             passes_an_image(*tracer, found.curve, start);
    };
    if (std::any_of(found_.begin(), found_.end(), passes)) return;
    const int ahead = way_.direction();
    SpecialCurve curve = tracer->run(start, share == 1 ? -ahead : ahead);
    if (share > 0 && share < 1 && !is_stopped(curve.end) && !curve.end.closed) {
      SpecialCurve back = tracer->run(start, -ahead);
      if (!goes_the_same_way(curve, back)) curve = joined(std::move(back), std::move(curve));
    }
    if (curve.end.closed) curve = begun_at_a_turn(std::move(curve));
    drop_parts_of(*tracer, start, curve);
    look_beyond(curve.end);
    if (curve.begin) look_beyond(*curve.begin);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - began;
    Vector p = hbm::parameters_at(*start.problem, start.x[start.problem->size()]);
    p[way_.index] = start.over;
    std::string doubt = doubt_of_rounding(*way_.model, p, curve.solver);
    found_.push_back({start.kind, std::move(curve), start.problem, seconds.count(), std::move(doubt),
                      section_->unknown_stability()});
  }

  // The images of a motion have the same curve.
  static bool passes_an_image(const CurveTracer& tracer, const SpecialCurve& curve,
                              const SpecialPoint& point) {
    const Eigen::Index n = point.problem->size();
    const auto all = images(*point.problem, point.x.head(n));
    return std::any_of(all.begin(), all.end(), [&](const Vector& u) {
      SpecialPoint image = point;
      image.x.head(n) = u;
      return tracer.passes(curve, image);
    });
  }

  // Of motions with the same symmetry and period.
  static bool is_alike(const Found& found, const hbm::HbmProblem& problem) {
    return found.problem->harmonics() == problem.harmonics();
  }

  static bool is_stopped(const SpecialCurveEnd& end) {
    return end.stop.reason == StopReason::user && end.unbounded.empty();
  }

  // From a corner that is special in one direction only.
  static bool goes_the_same_way(const SpecialCurve& a, const SpecialCurve& b) {
    if (a.points.size() < 2 || b.points.size() < 2) return b.points.size() < 2;
    const auto way = [](const SpecialCurve& curve) {
      return curve.points[1].point.over - curve.points[0].point.over;
    };
    return way(a) * way(b) > 0;
  }

  // So that a closed curve is not cut in the middle of a part.
  static SpecialCurve begun_at_a_turn(SpecialCurve curve) {
    const auto turns = CurveParts::turns(curve);
    if (turns.empty()) return curve;
    const double begin = turns.front(),
                 length = curve.points.back().arclength - curve.points.front().arclength;
    curve.points.pop_back();  // the first one again
    const auto rotate = [&](auto& all) {
      for (auto& each : all)
        if (each.arclength <= begin) each.arclength += length;
      std::stable_sort(all.begin(), all.end(),
                       [](const auto& a, const auto& b) { return a.arclength < b.arclength; });
    };
    rotate(curve.points);
    rotate(curve.events);
    std::rotate(curve.turns.begin(),
                curve.turns.begin() + (!curve.turns.empty() && curve.turns.front() == begin),
                curve.turns.end());
    if (!curve.turns.empty() && curve.turns.back() == begin) curve.turns.back() += length;
    return curve;
  }

  void look_beyond(const SpecialCurveEnd& end) {
    if (end.closed || end.over == way_.lower() || end.over == way_.upper()) return;
    to_look_at_.push_back(way_.share(end.over) + just_beyond * end.direction * way_.direction());
  }

  // A failed curve is covered by one traced through all of it from the other side.
  void drop_parts_of(const CurveTracer& tracer, const SpecialPoint& start, const SpecialCurve& curve) {
    std::erase_if(found_, [&](const Found& earlier) {
      if (earlier.kind != start.kind || !is_alike(earlier, *start.problem)) return false;
      const auto& points = earlier.curve.points;
      const auto passes = [&](const SpecialCurve::At& at) {
        return passes_an_image(tracer, curve, tracer.point_of(at));
      };
      return !points.empty() && passes(points.front()) && passes(points[points.size() / 2]) &&
             passes(points.back());
    });
  }

  // Where several elements start to slip at once, a curve of peaks or folds may have to be traced from both
  // sides.
  void see_which_meet() {
    std::vector<SpecialCurveEnd*> ends;
    for (Found& found : found_) {
      if (found.curve.points.empty() || is_zero_of_function(found.kind)) continue;
      if (found.curve.begin) ends.push_back(&*found.curve.begin);
      ends.push_back(&found.curve.end);
    }
    std::erase_if(ends, [](const SpecialCurveEnd* end) {
      const bool fails =
          end->stop.reason == StopReason::step_too_small || end->stop.reason == StopReason::event;
      return !fails || end->vanishes || end->left_window || end->closed || !end->unbounded.empty();
    });
    const auto near = [](double a, double b) { return std::abs(a - b) <= meeting * std::abs(b); };
    for (SpecialCurveEnd* end : ends)
      end->goes_on = std::any_of(ends.begin(), ends.end(), [&](const SpecialCurveEnd* other) {
        return other != end && near(other->over, end->over) &&
               near(other->x[other->x.size() - 1], end->x[end->x.size() - 1]);
      });
  }

  std::vector<ResponseBranch> reported(const Found& found) const {
    OverParameter way = way_;
    way.model = found.problem->shared_model();
    auto parts = CurveParts(found.kind, unit_, way).of(found.curve);
    parts.front().solver = found.curve.solver;
    parts.front().solver.unknowns = found.problem->size() + 1;
    parts.front().solver.seconds = found.seconds;
    for (ResponseBranch& part : parts) {
      part.solver.linear_solver = found.curve.solver.linear_solver;
      part.unknown_stability = found.unknown_stability;
      if (part.status != Status::complete || found.doubt.empty()) continue;
      part.doubt = found.doubt;
      part.stop.message += "; " + found.doubt;
    }
    return parts;
  }

  std::unique_ptr<CurveTracer> make_tracer(const SpecialPoint& start) {
    const auto& problem = start.problem;
    const bool zeros = is_zero_of_function(start.kind);
    const auto section = std::make_shared<CurveSection>(problem, way_.index);
    if (stability_ || is_bifurcation(start.kind))
      section->watch_stability(is_bifurcation(start.kind) ? StabilityRequest(true) : stability_);
    section_ = section;
    const Eigen::Index n = problem->size();
    const auto report = [this, points = 0L, last = 0.0](double over, double omega) mutable {
      progress_.points = ++points;
      progress_.frequency = omega / to_rad_per_s_;
      progress_.step = last > 0 ? (omega - last) / to_rad_per_s_ : 0;
      progress_.share_done = way_.share(over);
      last = omega;
      control_.report(progress_);
    };
    if (zeros)
      return std::make_unique<BifurcationTracer>(problem, start.kind, way_, window_, section, report,
                                                 control_);
    return std::make_unique<SpecialCurveTracer>(
        problem, peaks_ ? peak_kind(problem) : fold_kind(), way_, window_,
        with_folds(peaks_ ? amplitude_monitors(section) : fold_monitors(n)),
        peaks_ ? amplitude_monitors(section) : std::vector{turn_monitor(n)}, section, report, control_);
  }

  // n: where the frequency stands among the unknowns.
  static std::vector<Monitor> fold_monitors(Eigen::Index n) {
    return {turn_monitor(n), continuation::cusp_monitor()};
  }

  static std::vector<Monitor> with_folds(std::vector<Monitor> monitors) {
    monitors.push_back(continuation::fold_monitor());
    return monitors;
  }

  std::vector<std::string> kinds_;
  bool peaks_;
  std::shared_ptr<CurveSection> section_;  // of the last tracer
  scene::FrequencyUnit unit_;
  double to_rad_per_s_;
  FrequencyWindow window_;
  OverParameter way_;
  CurveParts parts_;
  const control::Control control_;
  control::Progress progress_;
  std::vector<double> looked_at_, to_look_at_;  // shares of the range
  std::vector<Found> found_;
  StabilityRequest stability_;
  const double least_;  // share of the highest point of a response, of those that start a curve
  const std::optional<BranchLimits> all_;  // of all branches, where these are looked at
  int most_seen_ = 0;                      // branches at one value
  LookedAt seen_;                          // at all values
  std::vector<std::string> untraced_;
  double failed_at_ = 0;
  std::string failure_, unbounded_;
};

}  // namespace

std::vector<ResponseBranch> resonance_peaks(const scene::Scene& scene, const CurveRange& range,
                                            const control::Control& control) {
  return high_resonance_peaks(scene, range, 0, control);
}

std::vector<ResponseBranch> high_resonance_peaks(const scene::Scene& scene, const CurveRange& range,
                                                 double share, const control::Control& control) {
  const bool phase = range.resonance == Resonance::phase;
  return Curves({phase ? event_kinds::phase_resonance : event_kinds::peak}, scene, range, control, share)
      .run();
}

std::vector<ResponseBranch> fold_curves(const scene::Scene& scene, const CurveRange& range,
                                        const control::Control& control) {
  return Curves({event_kinds::fold}, scene, range, control).run();
}

std::vector<ResponseBranch> bifurcation_curves(const scene::Scene& scene, const BifurcationRange& range,
                                               const control::Control& control) {
  std::vector<std::string> kinds(event_kinds::of_curves.begin(), event_kinds::of_curves.end());
  if (range.of == BifurcationsOf::period_doubling) kinds = {event_kinds::period_doubling};
  if (range.of == BifurcationsOf::neimark_sacker) kinds = {event_kinds::neimark_sacker};
  if (range.of == BifurcationsOf::symmetry_breaking) kinds = {event_kinds::symmetry_breaking};
  return Curves(std::move(kinds), scene,
                {range.over, range.from, range.to, range.frequency_from, range.frequency_to, true}, control,
                0, range.branches == Branches::all ? std::optional(range.limits) : std::nullopt)
      .run();
}

}  // namespace arcslip::observables

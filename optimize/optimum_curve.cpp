#include <arcslip/optimize/optimum_curve.hpp>

#include <arcslip/continuation/tracer.hpp>
#include <arcslip/optimize/active_set.hpp>
#include <arcslip/optimize/design_space.hpp>
#include <arcslip/optimize/standing.hpp>
#include <arcslip/optimize/text.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <map>
#include <utility>

namespace arcslip::optimize {
namespace {

using continuation::Accepted;
using continuation::Event;
using continuation::Matrix;
using continuation::Monitor;
using continuation::Needs;
using continuation::StopReason;
using observables::Status;
using Kind = Inequality::Kind;

constexpr double nearly_as_high = 1e-3;    // relative: peaks that may be active at the first optimum
constexpr double nearly_bound = 1e-6;      // of y
constexpr double higher = 1e-7;            // of ln A: a peak above the active ones
constexpr int most_exchanges = 20;         // of the active set at the first optimum
constexpr double between_responses = 0.5;  // of y and sigma
constexpr double least_between = 0.02;     // the same, where the way is gone again
constexpr double flat_slope = 1e-5;        // d ln A / dsigma of less: an extreme over s
constexpr double u_turn = -0.9;            // cosine of the tangents before and after
constexpr double probe = 1e-4;             // of z and sigma: how an inequality changes along a piece
constexpr double smallest_step = 1e-8;
constexpr std::array<double, 5> beyond = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2};  // of the end of a piece
constexpr double progress = 1e-5;                                         // of y and sigma
constexpr int most_idle = 60;
constexpr double same_point = 1e-9;  // of y and sigma

struct Seen {
  OptimumPoint point;
  double slope;  // d ln A / dsigma of the optimum
};

class Follow {
 public:
  Follow(const scene::Scene& scene, const OptimumProblem& problem, const scene::DesignVariable& along,
         const OptimumCurveOptions& options)
      : scene_(scene),
        problem_(problem),
        along_(along),
        options_(options),
        space_(scene, with_along(problem, along)),
        unit_(scene::to_rad_per_s(scene.frequency_unit)),
        peaks_(space_.model(), space_.parameters(),
               {problem.frequency_from * unit_, problem.frequency_to * unit_}) {
    for (std::size_t k = 0; k <= problem.over.size(); ++k)
      scaled_.emplace_back(space_.lower()[k], space_.upper()[k]);
    curve_.along = along.name;
    if (!(options.points >= 1)) throw OptionsError(text("points = ", options.points, ": at least 1"));
    if (!(options.seconds >= 0)) throw OptionsError(text("seconds = ", options.seconds, ": at least 0"));
    if (!(options.step > 0 && options.step <= 1))
      throw OptionsError(text("step = ", options.step, ": above 0, and at most 1"));
  }

  OptimumCurve run() {
    try {
      if (begin())
        while (!ended_) {
          piece();
          if (!ended_) guard();
        }
    } catch (const std::exception& thrown) {
      end(Status::failed, name(Reason::objective_failed),
          text("it threw \"", thrown.what(), "\" at ", place(here_.sigma)));
    }
    finish();
    return std::move(curve_);
  }

 private:
  static OptimumProblem with_along(OptimumProblem problem, const scene::DesignVariable& along) {
    if (!problem.cases.empty() || !problem.scatter.empty())
      throw OptionsError("an optimum over several cases is not followed over \"" + along.name +
                         "\"; leave the cases out, or ask for single values of it");
    if (!problem.limits.empty() || !problem.linear_limits.empty())
      throw OptionsError("an optimum with limits is not followed over \"" + along.name +
                         "\"; leave the limits out, or ask for single values of it");
    problem.over.push_back(along);
    return problem;
  }

  // Pieces that lead nowhere: the active set may change to and fro, and peaks be lost and found, at one
  // place.
  void guard() {
    if (!mark_ || distance(*mark_, curve_.points.back()) > progress) {
      mark_ = curve_.points.back();
      idle_ = 0;
    } else if (++idle_ == most_idle) {
      end(Status::stopped, "no_progress",
          text("at ", place(here_.sigma), " ", most_idle,
               " pieces of the curve came one after the other within ", progress, " of the logarithms"));
    } else if (options_.seconds > 0 && seconds() >= options_.seconds) {
      end(Status::stopped, "time_limit",
          text("the limit of ", options_.seconds, " s was reached at ", place(here_.sigma)));
    }
  }

  std::size_t size() const { return problem_.over.size(); }
  const ScaledParameter& sigma() const { return scaled_.back(); }
  std::string place(double s) const { return text(along_.name, " = ", sigma().value(s)); }

  bool end(Status status, std::string reason, std::string message) {
    curve_.status = status;
    curve_.stop.reason = std::move(reason);
    curve_.stop.message = std::move(message);
    ended_ = true;
    return false;
  }

  // The first optimum, by search, and its active set.
  bool begin() {
    scene::Scene at = scene_;
    scene::set(at, along_.name, along_.lower);
    OptimumOptions search = options_.search;
    search.certificate = false;
    curve_.start = optimum(at, problem_, search);
    const Optimum& first = curve_.start;
    const std::string where = text("at ", along_.name, " = ", along_.lower, ": ");
    if (first.status != Status::complete || first.stop.reason == "flat" || first.design.empty())
      return end(first.status == Status::complete ? Status::failed : first.status, first.stop.reason,
                 where + first.stop.message);
    std::vector<double> design = first.design;
    design.push_back(along_.lower);
    const PeakState& state = peaks_.trace(design);
    if (state.peaks.empty() || !state.complete)
      return end(Status::failed, "no_response", where + state.message);
    reference_ = state.amplitude();
    here_.sigma = sigma().scaled(along_.lower);
    here_.active.held.assign(size(), 0);
    for (std::size_t i = 0; i < state.peaks.size(); ++i)
      if (state.peaks[i].amplitude >= (1 - nearly_as_high) * reference_ && !state.peaks[i].rises_inwards())
        here_.active.peaks.push_back(i);
    for (std::size_t k = 0; k < size(); ++k)
      for (const int side : {-1, 1})
        if (side * (scaled_[k].scaled(scaled_[k].bound(side)) - scaled_[k].scaled(design[k])) < nearly_bound)
          here_.active.held[k] = side;
    if (!hold_flat(design))
      return end(Status::failed, "flat",
                 text(where, "the amplitude does not depend on ", flat_,
                      " there, but does between there and its bounds: which value to follow is not told"));
    return settle(design);
  }

  bool hold_flat(std::vector<double>& design) {
    const auto result = setting().hold_flat(here_.active, design);
    for (const auto& [k, value] : result.moved)
      curve_.notes.push_back(text("at ", place(here_.sigma), " ", problem_.over[k].name, " = ", value,
                                  " has no influence, and was moved to its bound ", design[k]));
    if (result.flat) flat_ = problem_.over[*result.flat].name;
    return !result.flat;
  }

  OptimalitySetting setting() { return {peaks_, scaled_, reference_}; }
  std::shared_ptr<const OptimalityData> data() { return setting().of(here_.active); }

  // The active set and the solution of its equations at the first optimum: what is violated is exchanged.
  bool settle(const std::vector<double>& design) {
    for (int k = 0; k < most_exchanges; ++k) {
      if (!peaks_.follow_to(design, here_.active.peaks)) break;
      Vector weights;
      here_.z = setting().estimate(here_.active, weights);
      OptimalityEvaluator at(data());
      if (!here_.correct(at)) {
        auto& peaks = here_.active.peaks;
        if (peaks.size() < 2) break;
        peaks.erase(peaks.begin() + (std::min_element(weights.begin(), weights.end()) - weights.begin()));
        continue;
      }
      if (exchange(here_.active, at)) continue;
      here_.take(at);
      curve_.points.push_back(point(at));
      set_safe();
      return true;
    }
    return end(
        Status::failed, "no_exchange",
        text("at ", along_.name, " = ", along_.lower,
             ": the optimum was found, but no set of equally high peaks satisfies its equations; it may "
             "sit at a kink, or a parameter may have no influence"));
  }

  static const OptimalityEvaluator& evaluator(const Accepted& now) {
    return static_cast<const OptimalityEvaluator&>(now.at);
  }

  OptimumPoint point(const OptimalityEvaluator& at) {
    OptimumPoint p;
    p.along = at.design().back();
    p.design.assign(at.design().begin(), at.design().end() - 1);
    p.amplitude = reference_ * std::exp(at.level());
    for (std::size_t i = 0; i < at.active_peaks().size(); ++i)
      p.peaks.push_back({at.active_peaks()[i].kind, at.active_peaks()[i].omega(),
                         at.weights()[static_cast<Eigen::Index>(i)]});
    Eigen::Index heaviest = 0;
    at.weights().maxCoeff(&heaviest);
    p.response = peaks_.observe(at.active_peaks()[static_cast<std::size_t>(heaviest)]);
    p.at_bound = here_.active.held;
    p.minimum = at.is_minimum();
    return p;
  }

  // From where it stands to the end of the active set, of the range, or until a response is due.
  void piece() {
    const auto of = data();
    std::vector<Inequality> may_change = inequalities(here_.active);
    const Eigen::Index tau = here_.active.unknowns() - 1;
    std::vector<Monitor> monitors;
    for (std::size_t i = 0; i < may_change.size(); ++i)
      monitors.push_back(
          {.name = text("change ", i),
           .value = [each = may_change[i]](const Accepted& now) { return evaluator(now).slack(each); },
           .crossing = continuation::Crossing::falling,
           .terminal = true});
    monitors.push_back({.name = "peak_joins",
                        .value = [](const Accepted& now) { return evaluator(now).distance_of_others(); },
                        .crossing = continuation::Crossing::falling,
                        .terminal = true});
    const auto slope = [tau](const Accepted& now) { return now.tangent[tau]; };
    const auto level = [tau](const Accepted& now) { return now.u[tau]; };
    using continuation::Crossing;
    monitors.push_back({.name = "minimum", .value = slope, .crossing = Crossing::rising, .quantity = level});
    monitors.push_back({.name = "maximum", .value = slope, .crossing = Crossing::falling, .quantity = level});
    Monitor turn = continuation::fold_monitor();
    turn.name = "turning_point";
    monitors.push_back(turn);

    continuation::Options options;
    options.lower = sigma().scaled(along_.lower);
    options.upper = sigma().scaled(along_.upper);
    options.step.largest_parameter = options_.step * (options.upper - options.lower);
    options.step.initial = step_;
    options.step.smallest = smallest_step;
    options.points = std::max<long>(1, options_.points - static_cast<long>(curve_.points.size()) + 1);
    if (options_.seconds > 0) options.seconds = std::max(options_.seconds - seconds(), 1e-9);

    std::map<double, Seen> seen;  // by arclength
    bool due = false, user = false;
    std::exception_ptr thrown;
    const auto observe = [&](const Accepted& now, const Event*) {
      seen[now.arclength] = {point(evaluator(now)), evaluator(now).slope_along()};
      const OptimumPoint& at = seen[now.arclength].point;
      try {
        user = options_.progress && !options_.progress(at);
      } catch (...) {
        thrown = std::current_exception();
        user = true;
      }
      due = way_since_response(at) >= interval_;
      return !due && !user;
    };
    continuation::Start start{here_.z, Vector::Constant(1, here_.sigma), 0, 1, here_.tangent};
    auto branch = continuation::trace(optimality(of), start, options, monitors, observe);
    end_at_u_turn(branch);
    ++curve_.work.pieces;
    curve_.work.points += branch.counts.points;
    curve_.work.evaluations += branch.counts.residuals;
    curve_.work.hessians += branch.counts.jacobians;
    keep(branch, seen);
    if (thrown) std::rethrow_exception(thrown);
    if (branch.points.empty()) {
      lost(branch.stop);
      return;
    }
    const auto& last = branch.points.back();
    here_.z = last.u;
    here_.sigma = last.parameter;
    here_.tangent = last.tangent;
    if (branch.points.size() > 1) step_ = last.arclength - branch.points[branch.points.size() - 2].arclength;
    const std::vector<std::size_t> indices = here_.active.peaks;
    const auto end_of_piece = at_last_point();
    if (!end_of_piece) {
      end(Status::stopped, "lost_peak",
          "at " + place(here_.sigma) + " a new response does not have the peaks that were followed");
      return;
    }
    const OptimalityEvaluator& at = *end_of_piece;
    here_.take(at);
    here_.orient(at);
    for (Inequality& each : may_change)
      if (each.kind == Kind::peak)
        each.index = here_.active.peaks[static_cast<std::size_t>(
            std::find(indices.begin(), indices.end(), each.index) - indices.begin())];
    switch (branch.stop.reason) {
      case StopReason::boundary:
        verify();
        if (ended_ || rewound_) return;
        if (last.parameter >= options.upper)
          end(Status::complete, "boundary", "the optimum was followed up to " + place(last.parameter));
        else
          end(Status::stopped, "turned_back",
              "the curve of optima turned back, and left the range at " + place(last.parameter));
        return;
      case StopReason::event:
        change(branch.events.back().monitor, may_change, at);
        return;
      case StopReason::user:
        if (due && !user)
          verify();
        else
          stop_with(branch.stop);
        return;
      case StopReason::step_too_small:
      case StopReason::not_evaluated:
      case StopReason::start_failed:
        lost(branch.stop);
        return;
      default:
        stop_with(branch.stop);
    }
  }

  // The equations at the end of a piece: with the peaks that were followed, or, where trials have led those
  // astray, with those of a new response.
  std::unique_ptr<OptimalityEvaluator> at_last_point() {
    auto at = std::make_unique<OptimalityEvaluator>(data());
    const OptimumPoint& last = curve_.points.back();
    if (here_.move(*at) && at->residual().cwiseAbs().maxCoeff() <= same_level) return at;
    std::vector<double> design = last.design;
    design.push_back(last.along);
    std::vector<KnownPeak> wanted;
    for (const OptimumPeak& peak : last.peaks) wanted.push_back({peak.kind, peak.omega, last.amplitude});
    here_.active.peaks = find_again(peaks_.trace(design), wanted, same_level);
    if (here_.active.peaks.empty()) return nullptr;
    at = std::make_unique<OptimalityEvaluator>(data());
    return here_.move(*at) ? std::move(at) : nullptr;
  }

  void stop_with(const continuation::Stop& stop) {
    end(Status::stopped, continuation::name(stop.reason), "at " + place(here_.sigma) + ": " + stop.message);
  }

  // Where the active peaks cease to depend on a parameter the curve ends, and at its end a trace may turn
  // round and come back on itself.
  static void end_at_u_turn(continuation::Branch& branch) {
    for (std::size_t i = 0; i < branch.events.size(); ++i) {
      const Event& event = branch.events[i];
      const std::size_t after = event.after;
      if (event.monitor != "turning_point" || !event.nonsmooth || after + 1 >= branch.points.size() ||
          branch.points[after].tangent.dot(branch.points[after + 1].tangent) > u_turn)
        continue;
      branch.stop = {StopReason::step_too_small, 0, 0, "the curve turns round and comes back on itself"};
      branch.points.resize(after + 1);
      branch.events.erase(branch.events.begin() + static_cast<std::ptrdiff_t>(i), branch.events.end());
      return;
    }
  }

  // Points and events in the order of the curve. The first point of a piece is where the last one ended.
  void keep(const continuation::Branch& branch, const std::map<double, Seen>& seen) {
    const auto find = [&](double arclength) {
      const auto at = seen.find(arclength);
      return at == seen.end() ? nullptr : &at->second;
    };
    std::vector<std::size_t> index;
    for (const auto& each : branch.points) {
      const Seen* at = find(each.arclength);
      if (at && (curve_.points.empty() || distance(at->point, curve_.points.back()) > same_point))
        curve_.points.push_back(at->point);
      index.push_back(curve_.points.empty() ? 0 : curve_.points.size() - 1);
    }
    for (const Event& event : branch.events) {
      const bool changes = event.monitor.starts_with("change") || event.monitor == "peak_joins";
      const Seen* at = find(event.point.arclength);
      // Along the curve the amplitude is stationary at turning points, too, where over s it is not.
      const bool only_turns = event.monitor != "turning_point" && at && std::abs(at->slope) > flat_slope;
      if (!changes && !only_turns && at)
        curve_.events.push_back({event.monitor, "", 0, event.nonsmooth, at->point, index[event.after]});
    }
  }

  double distance(const OptimumPoint& a, const OptimumPoint& b) const {
    double most = std::abs(sigma().scaled(a.along) - sigma().scaled(b.along));
    for (std::size_t k = 0; k < size(); ++k)
      most = std::max(most, std::abs(scaled_[k].scaled(a.design[k]) - scaled_[k].scaled(b.design[k])));
    return most;
  }

  double way_since_response(const OptimumPoint& at) {
    if (!checked_) return 0;
    return distance(at, *checked_);
  }

  // The active set that goes on where this one ends.
  void change(const std::string& monitor, const std::vector<Inequality>& may_change,
              const OptimalityEvaluator& at) {
    const bool joins = monitor == "peak_joins";
    const Inequality what = joins ? Inequality{Kind::peak, *at.highest_other()}
                                  : may_change[static_cast<std::size_t>(std::stoul(monitor.substr(7)))];
    OptimumEvent event{"", "", 0, false, point(at), curve_.points.size() - 1};
    const double before = here_.tangent[here_.z.size()];
    const bool was_active = std::find(may_change.begin(), may_change.end(), what) != may_change.end() &&
                            (what.kind == Kind::peak || here_.active.held[what.index] == what.side);
    if (what.kind == Kind::bound) {
      event.kind = was_active ? "bound_left" : "bound_reached";
      event.parameter = problem_.over[what.index].name;
    } else {
      event.kind = was_active ? "peak_leaves" : "peak_joins";
      event.omega = peaks_.state().peaks[what.index].omega();
    }
    curve_.events.push_back(std::move(event));
    const auto next_set = exchanged(here_.active, what, at);
    if (!next_set) {
      end(Status::stopped, "no_exchange",
          "at " + place(here_.sigma) + ": no set of active peaks and bounds goes on from here");
      return;
    }
    here_.active = next_set->active;
    const std::vector<double> design = at.design();
    here_.z.resize(here_.active.unknowns());
    Eigen::Index next = 0;
    for (std::size_t k = 0; k < size(); ++k)
      if (here_.active.held[k] == 0) here_.z[next++] = scaled_[k].scaled(design[k]);
    for (std::size_t i = 1; i < next_set->weights.size(); ++i) here_.z[next++] = next_set->weights[i];
    here_.z[next] = at.level();
    orient(next_set->watched);
    if (!ended_) note_turn(before, curve_.events.back().point);
  }

  // A turn in s from one piece to the next. before: dsigma of the last tangent.
  void note_turn(double before, const OptimumPoint& at) {
    if (before * here_.tangent[here_.z.size()] < 0)
      curve_.events.push_back({"turning_point", "", 0, true, at, curve_.points.size() - 1});
  }

  // The way in which the inequality that has changed holds more and more.
  void orient(const Inequality& watched) {
    OptimalityEvaluator at(data());
    const Eigen::Index n = here_.z.size();
    const auto go = [&](double by) {
      Standing there = here_;
      there.z += by * here_.tangent.head(n);
      there.sigma += by * here_.tangent[n];
      return there.move(at);
    };
    here_.tangent = Vector::Unit(n + 1, n);
    bool known = go(0) && here_.take_tangent(at, here_.tangent);
    double slack[2] = {0, 0};
    for (const int side : {0, 1}) {
      known = known && go(side == 0 ? -probe : probe);
      if (known) slack[side] = at.slack(watched);
    }
    if (!known || slack[0] == slack[1] || !go(0)) {
      end(Status::stopped, "no_exchange",
          "at " + place(here_.sigma) +
              ": the active peaks and bounds change, and there is no single optimum beyond");
      return;
    }
    if (slack[1] < slack[0]) here_.turn_back();
    here_.take(at);
  }

  // The response where the curve stands.
  void verify() {
    rewound_ = false;
    const PeakState& state = peaks_.trace(here_.design);
    const double level = here_.peaks.empty() ? 0 : here_.peaks[0].amplitude;
    if (!(state.amplitude() <= (1 + higher) * level)) {
      interval_ /= 2;
      if (interval_ >= least_between && safe_) {
        go_back();
        return;
      }
      if (state.unbounded)
        return static_cast<void>(
            end(Status::stopped, "unbounded", "at " + place(here_.sigma) + ": " + state.message));
      end(Status::stopped, "other_peak",
          text("at ", place(here_.sigma), " the response has a peak of ", state.amplitude(),
               " m above that of ", level, " m which was followed, and it came up in between"));
      return;
    }
    const auto found = find_again(peaks_.state(), here_.peaks, same_level);
    if (found.empty())
      return static_cast<void>(
          end(Status::stopped, "lost_peak",
              "at " + place(here_.sigma) + " a new response does not have the peaks that were followed"));
    here_.active.peaks = found;
    set_safe();
  }

  void set_safe() {
    checked_ = curve_.points.empty() ? std::optional<OptimumPoint>{} : curve_.points.back();
    safe_ = here_;
    safe_points_ = curve_.points.size();
    safe_events_ = curve_.events.size();
    interval_ = std::min(between_responses, 2 * interval_);
  }

  // To where the last response was.
  void go_back() {
    here_ = *safe_;
    curve_.points.resize(safe_points_);
    curve_.events.resize(safe_events_);
    rewound_ = true;
    step_ = 0;
    peaks_.trace(here_.design);
    const auto found = find_again(peaks_.state(), here_.peaks, same_level);
    if (found.empty())
      end(Status::stopped, "lost_peak",
          "at " + place(here_.sigma) + " a new response does not have the peaks that were followed");
    else
      here_.active.peaks = found;
  }

  // An active peak cannot be followed farther: what it is in a response a little beyond.
  void lost(const continuation::Stop& stop) {
    const std::string where = "at " + place(here_.sigma) + ": ";
    if (here_.tangent.size() == 0 || here_.design.empty())
      return static_cast<void>(end(Status::failed, continuation::name(stop.reason), where + stop.message));
    verify();
    if (ended_ || rewound_) return;
    const Standing last = here_;
    for (const double by : beyond)
      for (const int way : {1, -1})
        if (goes_on(last, by, way)) {
          step_ = 0;
          return;
        }
    here_ = last;
    end(Status::stopped, "lost_peak",
        where +
            "the active peaks cannot be followed, and no optimum near by goes on beyond: " + stop.message);
  }

  // From a little beyond the end of a piece, with the peaks as they are there. way: -1 where s turns, to a
  // piece with peaks of other kinds. False: there is no such optimum; here_ is then as it was.
  bool goes_on(const Standing& last, double by, int way) {
    const Eigen::Index n = last.z.size();
    here_.z = last.z + by * last.tangent.head(n);
    here_.sigma = last.sigma + way * by * last.tangent[n];
    if (here_.sigma <= sigma().scaled(along_.upper) && find_beyond(last, by)) {
      OptimalityEvaluator at(data());
      ActiveSet next_set = here_.active;
      if (here_.correct(at) && !exchange(next_set, at) && (way > 0 || !same_kinds(last.peaks, at)) &&
          direct(last, at)) {
        changed(last.peaks, at);
        if (here_.tangent.size() == last.tangent.size()) note_turn(last.tangent[n], point(at));
        here_.take(at);
        return true;
      }
    }
    here_ = last;
    return false;
  }

  // The active peaks in the response at here_.z, and what has no influence there.
  bool find_beyond(const Standing& last, double by) {
    std::vector<double> design;
    Eigen::Index next = 0;
    for (std::size_t k = 0; k < size(); ++k)
      design.push_back(last.active.held[k] != 0 ? last.design[k] : scaled_[k].value(here_.z[next++]));
    design.push_back(sigma().value(here_.sigma));
    const PeakState& state = peaks_.trace(design);
    if (state.unbounded) return false;
    const auto found = find_again(state, last.peaks, 100 * by);
    if (found.empty()) return false;
    here_.active.peaks = found;
    if (!hold_flat(design)) return false;
    Vector weights;
    if (here_.active.held != last.active.held) here_.z = setting().estimate(here_.active, weights);
    return true;
  }

  // The tangent that goes on, by its orientation. False: there is none, or it leads back on the same piece.
  bool direct(const Standing& last, const OptimalityEvaluator& at) {
    if (here_.active.held != last.active.held) {
      here_.tangent = {};
      return true;
    }
    if (!here_.take_tangent(at, last.tangent)) return false;
    if (here_.orientation != last.orientation) here_.turn_back();
    return here_.tangent.dot(last.tangent) >= u_turn || !same_kinds(last.peaks, at);
  }

  static bool same_kinds(const std::vector<KnownPeak>& before, const OptimalityEvaluator& at) {
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before[i].kind != at.active_peaks()[i].kind) return false;
    return true;
  }

  void changed(const std::vector<KnownPeak>& before, const OptimalityEvaluator& at) {
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before[i].kind != at.active_peaks()[i].kind)
        curve_.events.push_back(
            {"peak_changes", "", at.active_peaks()[i].omega(), false, point(at), curve_.points.size() - 1});
  }

  void finish() {
    curve_.work.peaks = peaks_.work();
    curve_.work.seconds = seconds();
    if (curve_.points.empty()) return;
    const OptimumPoint& last = curve_.points.back();
    std::vector<double> design = last.design;
    design.push_back(last.along);
    curve_.stop.message += text("; the last amplitude is ", last.amplitude, " m at ", space_.text(design));
  }

  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }

  const scene::Scene& scene_;
  const OptimumProblem& problem_;
  const scene::DesignVariable& along_;
  const OptimumCurveOptions& options_;
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
  double interval_ = between_responses;
  bool rewound_ = false;

  std::optional<OptimumPoint> mark_;
  int idle_ = 0;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace

OptimumCurve optimum_curve(const scene::Scene& scene, const OptimumProblem& problem,
                           const scene::DesignVariable& along, const OptimumCurveOptions& options) {
  return Follow(scene, problem, along, options).run();
}

}  // namespace arcslip::optimize

// Where one piece of a curve of optima ends and another begins, and the responses that say whether it may.

#include <arcslip/analyses/branches/stop_reason.hpp>
#include <arcslip/optimize/curve/curve_of_optima.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace arcslip::optimize {
namespace {

using observables::Status;
using Kind = Inequality::Kind;

constexpr double least_between = 0.02;  // of ln A: the same, where the way is gone again
constexpr double probe = 1e-4;          // of z and sigma: how an inequality changes along a piece
constexpr std::array<double, 5> distances_beyond = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2};  // of the end of a piece
constexpr double least_progress = 1e-5;                                             // of y and sigma
constexpr int most_idle_pieces = 60;

}  // namespace

void CurveOfOptima::guard() {
  if (!mark_ || distance(*mark_, curve_.points.back()) > least_progress) {
    mark_ = curve_.points.back();
    idle_ = 0;
  } else if (++idle_ == most_idle_pieces) {
    end(Status::stopped, reasons::no_progress,
        text("at ", place(here_.sigma), " ", most_idle_pieces, " consecutive pieces of the curve lie within ",
             least_progress, " of each other in the logarithms"));
  } else if (!control_.keep_going()) {
    end_interrupted();
  }
}

void CurveOfOptima::change(std::size_t which, const std::vector<Inequality>& may_change,
                           const OptimalityEvaluator& at) {
  const Inequality what =
      which < may_change.size() ? may_change[which] : Inequality{Kind::peak, *at.highest_other()};
  OptimumEvent event{"", "", 0, false, point(at), curve_.points.size() - 1};
  const double before = here_.tangent[here_.z.size()];
  const bool was_active = std::find(may_change.begin(), may_change.end(), what) != may_change.end() &&
                          (what.kind == Kind::peak || here_.active.held[what.index] == what.side);
  if (what.kind == Kind::bound) {
    event.kind = was_active ? event_kinds::bound_left : event_kinds::bound_reached;
    event.parameter = problem_.over[what.index].name;
  } else {
    event.kind = was_active ? event_kinds::peak_leaves : event_kinds::peak_joins;
    event.omega = peaks_.state().peaks[what.index].omega();
  }
  curve_.events.push_back(std::move(event));
  const auto next_set = exchanged(here_.active, what, at);
  if (!next_set) {
    end(Status::stopped, reasons::no_exchange,
        "at " + place(here_.sigma) + ": no set of active peaks and bounds continues the curve");
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

void CurveOfOptima::note_turn(double before, const OptimumPoint& at) {
  if (before * here_.tangent[here_.z.size()] < 0)
    curve_.events.push_back({event_kinds::turning_point, "", 0, true, at, curve_.points.size() - 1});
}

void CurveOfOptima::orient(const Inequality& watched) {
  OptimalityEvaluator at(data());
  const Eigen::Index n = here_.z.size();
  const auto go = [&](double by) {
    ActiveSetPoint there = here_;
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
    if (const auto flat = without_influence()) return end_flat(problem_.over[*flat].name);
    end(Status::stopped, reasons::no_exchange,
        "at " + place(here_.sigma) +
            ": the active peaks and bounds change, and beyond this point the optimum is not unique");
    return;
  }
  if (slack[1] < slack[0]) here_.turn_back();
  here_.take(at);
}

void CurveOfOptima::end_flat(const std::string& parameter) {
  end(Status::stopped, reasons::flat,
      text("at ", place(here_.sigma), ": beyond this point the highest peak does not depend on ", parameter,
           ", and the optimum is not unique"));
}

std::optional<std::size_t> CurveOfOptima::without_influence() {
  const PeakState& state = peaks_.state();
  for (std::size_t k = 0; k < size(); ++k) {
    const auto has_influence = [&](std::size_t i) {
      const Peak& peak = state.peaks[i];
      return std::abs(peak.gradient[static_cast<Eigen::Index>(k)] * scaled_[k].slope(state.design[k])) >
             no_influence * peak.amplitude;
    };
    const auto& active = here_.active.peaks;
    if (here_.active.held[k] == 0 && std::none_of(active.begin(), active.end(), has_influence)) return k;
  }
  return {};
}

void CurveOfOptima::verify() {
  rewound_ = false;
  const PeakState& state = peaks_.trace(here_.design);
  const double level = here_.peaks.empty() ? 0 : here_.peaks[0].amplitude;
  if (!(state.amplitude() <= (1 + higher_peak) * level)) {
    interval_ /= 2;
    if (interval_ >= least_between && safe_) {
      go_back();
      return;
    }
    if (state.unbounded)
      return static_cast<void>(
          end(Status::stopped, reasons::unbounded, "at " + place(here_.sigma) + ": " + state.message));
    end(Status::stopped, reasons::other_peak,
        text("at ", place(here_.sigma), " the response has a peak of ", state.amplitude(),
             " m, higher than the tracked one of ", level, " m; it appeared since the last response"));
    return;
  }
  const auto found = find_again(peaks_.state(), here_.peaks, same_level);
  if (found.empty())
    return static_cast<void>(
        end(Status::stopped, reasons::lost_peak,
            "at " + place(here_.sigma) + " a newly traced response does not have the tracked peaks"));
  here_.active.peaks = found;
  set_safe();
}

void CurveOfOptima::set_safe() {
  // Only a way without a surprise allows a longer one: at one place many responses may be traced.
  if (!curve_.points.empty() && way_since_response(curve_.points.back()) >= interval_)
    interval_ = std::min(between_responses, 2 * interval_);
  checked_ = curve_.points.empty() ? std::optional<OptimumPoint>{} : curve_.points.back();
  safe_ = here_;
  safe_points_ = curve_.points.size();
  safe_events_ = curve_.events.size();
}

void CurveOfOptima::go_back() {
  here_ = *safe_;
  curve_.points.resize(safe_points_);
  curve_.events.resize(safe_events_);
  rewound_ = true;
  step_ = 0;
  peaks_.trace(here_.design);
  const auto found = find_again(peaks_.state(), here_.peaks, same_level);
  if (found.empty())
    end(Status::stopped, reasons::lost_peak,
        "at " + place(here_.sigma) + " a newly traced response does not have the tracked peaks");
  else
    here_.active.peaks = found;
}

void CurveOfOptima::lost(const continuation::BranchStop& stop) {
  const std::string where = "at " + place(here_.sigma) + ": ";
  if (here_.tangent.size() == 0 || here_.design.empty())
    return static_cast<void>(end(Status::failed, observables::reason_of(stop.reason), where + stop.message));
  verify();
  if (ended_ || rewound_) return;
  const ActiveSetPoint last = here_;
  flat_.clear();
  for (const double by : distances_beyond)
    for (const int way : {1, -1})
      if (goes_on(last, by, way)) {
        step_ = 0;
        return;
      }
  here_ = last;
  if (!flat_.empty()) return end_flat(flat_);
  end(Status::stopped, reasons::lost_peak,
      where +
          "the active peaks cannot be continued, and no nearby optimum continues the curve: " + stop.message);
}

bool CurveOfOptima::goes_on(const ActiveSetPoint& last, double by, int way) {
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

bool CurveOfOptima::find_beyond(const ActiveSetPoint& last, double by) {
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

bool CurveOfOptima::direct(const ActiveSetPoint& last, const OptimalityEvaluator& at) {
  if (here_.active.held != last.active.held) {
    here_.tangent = {};
    return true;
  }
  if (!here_.take_tangent(at, last.tangent)) return false;
  if (here_.orientation != last.orientation) here_.turn_back();
  return here_.tangent.dot(last.tangent) >= u_turn || !same_kinds(last.peaks, at);
}

bool CurveOfOptima::same_kinds(const std::vector<KnownPeak>& before, const OptimalityEvaluator& at) {
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i].kind != at.active_peaks()[i].kind) return false;
  return true;
}

void CurveOfOptima::changed(const std::vector<KnownPeak>& before, const OptimalityEvaluator& at) {
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i].kind != at.active_peaks()[i].kind)
      curve_.events.push_back({event_kinds::peak_changes, "", at.active_peaks()[i].omega(), false, point(at),
                               curve_.points.size() - 1});
}

}  // namespace arcslip::optimize

#include <arcslip/analyses/curves/special_curve_results.hpp>

#include <arcslip/analyses/branches/branch_recording.hpp>
#include <arcslip/analyses/branches/stop_reason.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/reasons.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::StopReason;

constexpr double same_event = 1e-6;  // events that differ by less, relatively, are one

// Between two turns at one corner.
bool is_one_place(const ResponseBranch& part) {
  const Solution &first = part.points.front(), &last = part.points.back();
  return part.points.size() <= 2 && std::abs(first.over - last.over) <= same_event * std::abs(last.over) &&
         std::abs(first.omega - last.omega) <= same_event * last.omega;
}

bool is_extreme(const ResponseEvent& event) {
  return event.kind == event_kinds::minimum || event.kind == event_kinds::maximum;
}

}  // namespace

bool is_bifurcation(const std::string& kind) {
  return event_kinds::contains(event_kinds::of_curves, kind);
}

bool is_zero_of_function(const std::string& kind) {
  return is_bifurcation(kind) || kind == event_kinds::phase_resonance;
}

CurveParts::CurveParts(std::string kind, scene::FrequencyUnit unit, OverParameter way)
    : kind_(std::move(kind)),
      peaks_(kind_ == event_kinds::peak),
      what_(event_kinds::words_of(kind_)),
      unit_(unit),
      way_(std::move(way)) {}

// The start and the end as events, but for the end of a closed curve, and one at a resonance, an event
// itself.
void CurveParts::add_ends(const SpecialCurve& curve, ResponseBranch& part) const {
  part.of = kind_;
  if (part.points.empty()) return;
  if (!curve.begin || curve.begin->reason != &reasons::resonance)
    part.events.insert(part.events.begin(), {kind_, false, true, part.points.front(), 0});
  if (curve.end.closed || curve.end.reason == &reasons::resonance) return;
  part.events.push_back({kind_, false, true, part.points.back(), part.points.size() - 1});
}

ResponseBranch CurveParts::failed(double over, const std::string& message) const {
  ResponseBranch result = described(*way_.model, way_.name);
  result.status = Status::failed;
  result.stop = {reasons::start_failed, over, 0, message};
  return result;
}

ResponseBranch CurveParts::stopped(double over) const {
  ResponseBranch result = described(*way_.model, way_.name);
  result.status = Status::stopped;
  result.stop = {reasons::user, over, 0, "stopped by the caller before all curves were found"};
  return result;
}

// At a cusp a curve of folds turns in everything, and where a curve of peaks turns, dA/ds = dA/dp dp/ds is
// zero: neither is an event of its own.
bool CurveParts::belongs_to_another(const SpecialCurve& curve, const SpecialCurve::EventAt& each) const {
  const results::EventKind& first = peaks_ ? event_kinds::fold : event_kinds::cusp;
  return each.event.kind != first && each.event.kind != event_kinds::corner &&
         std::any_of(curve.events.begin(), curve.events.end(), [&](const auto& other) {
           const auto &a = other.event.point, &b = each.event.point;
           return other.event.kind == first && std::abs(a.omega - b.omega) <= same_event * a.omega &&
                  std::abs(a.over - b.over) <= same_event * (way_.upper() - way_.lower());
         });
}

std::vector<double> CurveParts::turns(const SpecialCurve& curve) {
  std::vector<double> turns = curve.turns;
  for (const auto& each : curve.events)
    if (each.event.kind == event_kinds::fold) turns.push_back(each.arclength);
  std::sort(turns.begin(), turns.end());
  return turns;
}

// From one arclength to another; none: it has no points there, or is for the most part no curve of peaks.
std::optional<ResponseBranch> CurveParts::between(double begin, double end, const SpecialCurve& curve) const {
  std::vector<std::pair<double, double>> course;
  for (const auto& at : curve.points) course.emplace_back(at.arclength, at.point.amplitude);
  Course part;
  double peaks = 0, others = 0;  // arclengths
  for (const auto& at : curve.points) {
    if (!(at.arclength >= begin && at.arclength < end)) continue;
    const double length = part.points.empty() ? 0 : at.arclength - part.points.back().first;
    (at.second <= 0 ? peaks : others) += length;
    part.points.emplace_back(at.arclength, at.point);
  }
  if (part.points.empty() || (peaks_ && others > peaks)) return {};
  for (const auto& each : curve.events) {
    if (each.arclength < begin || each.arclength > end || belongs_to_another(curve, each)) continue;
    if (is_extreme(each.event) && !departs(course, each.arclength, each.event.point.amplitude)) continue;
    ResponseEvent& event = part.events.emplace_back(each.arclength, each.event).second;
    estimate_change(curve, each.arclength, event);
    if (peaks_ && each.arclength == begin) part.points.emplace(part.points.begin(), begin, event.point);
    if (peaks_ && each.arclength == end) part.points.emplace_back(end, event.point);
  }
  ResponseBranch branch = described(*way_.model, way_.name);
  part.move_to(branch);
  return branch;
}

std::vector<ResponseBranch> CurveParts::of(const SpecialCurve& curve) const {
  std::vector<ResponseBranch> parts;
  std::vector<double> ends;
  if (peaks_) ends = turns(curve);
  ends.push_back(HUGE_VAL);
  double begin = -HUGE_VAL;
  for (std::size_t k = 0; k < ends.size(); begin = ends[k++]) {
    auto part = between(begin, ends[k], curve);
    if (!part || (is_one_place(*part) && curve.points.size() > part->points.size())) continue;
    if (is_zero_of_function(kind_)) add_ends(curve, *part);
    finish(*part, curve, begin == -HUGE_VAL, ends[k] == HUGE_VAL);
    parts.push_back(std::move(*part));
  }
  if (parts.empty()) {
    parts.push_back(described(*way_.model, way_.name));
    finish(parts.back(), curve, true, true);
  }
  return parts;
}

void CurveParts::finish(ResponseBranch& part, const SpecialCurve& curve, bool is_first, bool is_last) const {
  const double first = curve.points.empty() ? curve.end.over : curve.points.front().point.over;
  if (is_last) {
    part.stop = stop(curve.end, first, !part.points.empty(), part.status);
  } else {
    SpecialCurveEnd turn;
    turn.vanishes = true;
    turn.over = part.points.back().over;
    part.stop = stop(turn, first, true, part.status);
  }
  if (!is_first || !curve.begin) return;
  Status status = Status::complete;
  const Stop begin = stop(*curve.begin, HUGE_VAL, true, status);
  if (status != Status::failed && !curve.begin->reason) return;
  const std::string end = part.stop.message;
  if (status == Status::failed && part.status != Status::failed) part.stop = begin;
  if (status == Status::failed) part.status = Status::failed;
  part.stop.message = "at its start, " + begin.message + "; at its end, " + end;
}

Stop CurveParts::stop(const SpecialCurveEnd& end, double begin, bool has_points, Status& status) const {
  const std::string where = way_.name + " = " + to_digits(end.over, 8);
  if (has_points && end.vanishes) {
    status = Status::complete;
    return {reasons::fold, end.over, end.over,
            (peaks_ ? "the peak meets a minimum of the amplitude over the frequency, and vanishes beyond "
                    : "the fold meets another at a grazing point, and vanishes beyond ") +
                where};
  }
  if (!end.unbounded.empty()) {
    status = Status::complete;
    return {reasons::unbounded, end.over, end.over,
            "the " + what_ + " grows without bound near " + where + ", and beyond " + end.unbounded};
  }
  if (end.reason) {
    status = Status::complete;
    return {*end.reason, end.over, end.over, end.why + ", at " + where};
  }
  if (end.closed) {
    status = Status::complete;
    return {reasons::closed, end.over, end.over, "the curve is closed: it returned to " + where};
  }
  if (end.left_window) {
    status = Status::complete;
    return {reasons::boundary, end.over, way_.to,
            "the " + what_ + " leaves the window at " + frequency_text(end.x[end.x.size() - 1], unit_) +
                ", at " + where};
  }
  if (has_points && end.goes_on) {
    status = Status::complete;
    return {reasons::corner, end.over, end.over,
            "the " + what_ + " reaches a grazing point at " + where + ", from which another curve continues"};
  }
  status = status_of(end.stop.reason);
  Stop stop{reason_of(end.stop.reason), end.stop.value, end.stop.limit, end.stop.message};
  if (end.stop.reason == StopReason::boundary) {
    stop.limit = begin == way_.to ? way_.from : way_.to;
    stop.message = (stop.value != begin  ? "reached the end of the range at "
                    : begin == way_.from ? "returned to the start of the range at "
                                         : "returned to the end of the range at ") +
                   way_.name + " = " + to_digits(stop.value, 8);
  } else if (!has_points) {
    stop.message = "no curve was started from the " + what_ + " at " + where + ": " + stop.message;
  } else if (end.stop.reason == StopReason::step_too_small) {
    stop.message = "the curve could not be continued beyond " + where + ": probably the " + what_ +
                   " is at a kink of the response there, where a phase of " +
                   (is_bifurcation(kind_) ? "contact" : "friction") + " starts or ends";
  } else {
    stop.message += ", near " + where;
  }
  return stop;
}

}  // namespace arcslip::observables

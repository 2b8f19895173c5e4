// Where a curve of special points has been before: which point lies on it, and whether it comes back.

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/curves/special_curve.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Vector;

constexpr double same_frequency = 1e-6,
                 same_motion = 1e-4;   // relative: special points that differ by less are one
constexpr double beyond_chord = 1e-2;  // of a chord of the curve: where a point may still lie on it
constexpr double near_chord = 1e-3;    // of the frequency, farther off than the chord is long

}  // namespace

SpecialCurve joined(SpecialCurve back, SpecialCurve ahead) {
  const auto reversed = [](auto& all) {
    std::reverse(all.begin(), all.end());
    for (auto& each : all) each.arclength = -each.arclength;
  };
  const auto put_before = [](auto& all, auto& rest) {
    all.insert(all.end(), std::make_move_iterator(rest.begin()), std::make_move_iterator(rest.end()));
  };
  reversed(back.points);
  reversed(back.events);
  if (!back.points.empty() && !ahead.points.empty()) back.points.pop_back();  // the point both begin at
  put_before(back.points, ahead.points);
  put_before(back.events, ahead.events);
  std::reverse(back.turns.begin(), back.turns.end());
  for (double& turn : back.turns) turn = -turn;
  back.turns.insert(back.turns.end(), ahead.turns.begin(), ahead.turns.end());
  back.begin = std::move(back.end);
  back.end = std::move(ahead.end);
  add(ahead.solver, back.solver);
  return back;
}

// The curve between two of its points is corrected in the plane across their chord that contains the point
// sought: so it is distinguished from others where it turns, too.
std::size_t CurveTracer::passage(const SpecialCurve& curve, std::size_t points, const SpecialPoint& through,
                                 const LiesOn& lies_on) const {
  const Eigen::Index n = problem_->size();
  const auto all_of = [&](const Solution& point) {
    Vector v(n + 2);
    v << Eigen::Map<const Vector>(point.unknowns.data(), n), point.omega, point.over;
    return v;
  };
  Vector sought(n + 2), scales(n + 2);
  sought << through.x, through.over;
  scales << problem_->scales(), problem_->parameters()[model::frequency].change(),
      problem_->parameters()[static_cast<std::size_t>(way_.index)].scale;
  for (std::size_t i = 1; i < points; ++i) {
    const auto &a = curve.points[i - 1], &b = curve.points[i];
    if (std::abs(a.point.omega - through.x[n]) >
        2 * std::abs(b.point.omega - a.point.omega) + near_chord * a.point.omega)
      continue;
    const Vector first = all_of(a.point), chord = all_of(b.point) - first;
    const Vector scaled = chord.cwiseQuotient(scales), way = (sought - first).cwiseQuotient(scales);
    const double length = scaled.norm(), share = way.dot(scaled) / (length * length);
    if (!(share >= -beyond_chord && share <= 1 + beyond_chord) || (way - share * scaled).norm() > length)
      continue;
    if (lies_on(a, b, first + share * chord, scaled.cwiseQuotient(scales) / length)) return i;
  }
  return 0;
}

std::size_t SpecialCurveTracer::passage(const SpecialCurve& curve, std::size_t points,
                                        const SpecialPoint& through) const {
  const Eigen::Index n = problem_->size();
  const auto lies_on = [&](const std::optional<hbm::Corner>& corner, const Vector& guess, const Vector& row) {
    const auto problem = corner ? hbm::corner_points(problem_, *corner) : smooth_;
    const Vector x = corner ? hbm::with_angles(guess.head(n + 1), *corner) : Vector(guess.head(n + 1));
    Vector border = Vector::Zero(x.size() + 1);
    border.head(n + 1) = row.head(n + 1);
    border[x.size()] = row[n + 1];
    const auto v = corrected(*problem, x, guess[n + 1], border, HUGE_VAL);
    return v && is_at(*v, through);
  };
  return passage(
      curve, points, through,
      [&](const SpecialCurve::At& a, const SpecialCurve::At& b, const Vector& guess, const Vector& row) {
        return lies_on(a.corner, guess, row) ||
               (a.corner.has_value() != b.corner.has_value() && lies_on(b.corner, guess, row));
      });
}

SpecialPoint CurveTracer::point_of(const SpecialCurve::At& at) const {
  const Eigen::Index n = problem_->size();
  SpecialPoint point{problem_, at.point.over, Vector(n + 1), at.corner.has_value()};
  point.x << Eigen::Map<const Vector>(at.point.unknowns.data(), n), at.point.omega;
  return point;
}

// Between its turns, a curve that is where it has been before is closed, or, in the other direction, has
// turned round at a corner beyond which there is nothing.
bool SpecialCurveTracer::comes_back(std::size_t begin) {
  auto& points = result_.points;
  std::vector<std::size_t> turns;
  for (const auto& each : result_.events)
    if (each.event.kind == event_kinds::fold && begin < points.size() &&
        each.arclength > points[begin].arclength)
      turns.push_back(static_cast<std::size_t>(
          std::upper_bound(points.begin(), points.end(), each.arclength,
                           [](double s, const auto& at) { return s < at.arclength; }) -
          points.begin()));
  turns.push_back(points.size());
  std::sort(turns.begin(), turns.end());
  for (const std::size_t end : turns) {
    const std::size_t middle = (begin + end) / 2;
    if (begin > 1 && middle > begin && middle < end) {
      if (const std::size_t i = passage(result_, begin, point_of(points[middle]))) {
        const auto chord = [&](std::size_t k) {
          return std::pair(points[k].point.over - points[k - 1].point.over,
                           points[k].point.omega - points[k - 1].point.omega);
        };
        const auto [p, w] = chord(i);
        const auto [q, v] = chord(middle);
        end_at(begin, p * q >= 0 && w * v >= 0);
        return true;
      }
    }
    begin = end;
  }
  return false;
}

// Whether an event came up before, at the same place.
bool SpecialCurveTracer::is_repeated(const SpecialCurve::EventAt& event) const {
  return std::any_of(result_.events.begin(), result_.events.end(), [&](const auto& other) {
    const auto &a = other.event.point, &b = event.event.point;
    return other.arclength < event.arclength && other.event.kind == event.event.kind &&
           std::abs(a.omega - b.omega) <= same_frequency * b.omega &&
           std::abs(a.over - b.over) <= same_frequency * std::abs(b.over);
  });
}

void SpecialCurveTracer::end_at(std::size_t count, bool closed) {
  auto& points = result_.points;
  if (closed)  // round to the first point, which lies between two others
    for (const std::size_t from : {count / 2, std::size_t{1}}) {
      SpecialCurve rest;
      rest.points.assign(points.begin() + static_cast<std::ptrdiff_t>(from),
                         points.begin() + static_cast<std::ptrdiff_t>(count));
      if (const std::size_t i = passage(rest, rest.points.size(), point_of(points.front()))) {
        count = from + i;
        break;
      }
    }
  const bool beyond = closed && count < points.size();
  const double last_point = points[count - 1].arclength, end = beyond ? points[count].arclength : last_point;
  std::erase_if(result_.events, [&](const auto& each) {
    return each.arclength > end || (each.arclength > last_point && is_repeated(each));
  });
  std::erase_if(result_.turns, [&](double turn) { return turn > end; });
  points.resize(count);
  if (beyond) {
    points.push_back(points.front());
    points.back().arclength = end;
  }
  const SpecialPoint last = point_of(points.back());
  result_.end = {};
  result_.end.x = last.x;
  result_.end.over = last.over;
  result_.end.closed = closed;
  result_.end.vanishes = !closed;
}

bool CurveTracer::is_at(const Vector& v, const SpecialPoint& point) const {
  return is_same(v, point.x) &&
         std::abs(v[v.size() - 1] - point.over) <= same_frequency * std::abs(point.over);
}

bool CurveTracer::is_same(const Vector& x, const Vector& y) const {
  const Eigen::Index n = problem_->size();
  return std::abs(x[n] - y[n]) <= same_frequency * y[n] &&
         (x.head(n) - y.head(n)).norm() <= same_motion * y.head(n).norm();
}

}  // namespace arcslip::observables

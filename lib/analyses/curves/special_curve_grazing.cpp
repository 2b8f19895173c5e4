// Transitions of a curve of special points: it reaches a corner of the branches, leaves it, or reaches
// another one.

#include <arcslip/analyses/curves/special_curve.hpp>

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/fourier/series.hpp>
#include <arcslip/observables/amplitude.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Vector;

constexpr double near_corner = 1e-3;      // relative: where a corner is looked for
constexpr double corners_meeting = 1e-6;  // of mu F_n: where two corners meet
// Of the parameter: from one part of the curve to the next.
constexpr double besides[] = {1e-6, 1e-5, 1e-4, 1e-3};
constexpr double least_change =
    1e-12;                           // of the parameter, from a corner to the smooth part that begins there
constexpr double zero_slope = 1e-6;  // of the slope on the other side of a corner
constexpr double as_large = 1e-4;    // relative: one of two extremes that change places
constexpr int most_steps = 20;       // of Newton's method, to a given depth of slip
constexpr double same_depth = 1e-6;  // relative
constexpr double seen_besides[] = {1e-5, 1e-4, 1e-3};  // of the parameter: where responses are looked at
constexpr double in_sight = 1e-2;                      // of the frequency
constexpr double root_reach = 3;  // of the root of that depth, which the parameter may change with

}  // namespace

// The solution near (x, over) in the plane row . ((x, over)' - (x, over)) = 0, no farther off than `reach`,
// relative.
std::optional<Vector> CurveTracer::corrected(const continuation::Problem& problem, const Vector& x,
                                             double over, const Vector& row, double reach) const {
  continuation::Counts counts;
  continuation::Corrector corrector(problem, parameters(x, over), way_.index, {}, counts);
  const Eigen::Index n = x.size();
  Vector v(n + 1), scales(n + 1);
  v << x, over;
  scales << problem.scales(), over;
  const Vector guess = v;
  if (!corrector.correct(v, row, false).converged) return {};
  if ((v - guess).cwiseQuotient(scales).norm() > reach * (1 + guess.cwiseQuotient(scales).norm())) return {};
  return v;
}

// The corner at a slightly different parameter, and the slopes on its sides.
std::optional<SpecialCurveTracer::Comparison> SpecialCurveTracer::corner_nearby(const CurveStart& at,
                                                                                const hbm::Corner& corner,
                                                                                int direction,
                                                                                double nearby) const {
  const Eigen::Index n = problem_->size();
  const auto unknowns = n + 1 + static_cast<Eigen::Index>(corner.angles.size());
  const double over = at.over * (1 + direction * nearby);
  if (!inside(over)) return {};
  const auto v = corrected(*hbm::corner_points(problem_, corner), hbm::with_angles(at.x, corner), over,
                           Vector::Unit(unknowns + 1, unknowns), near_corner);
  if (!v) return {};
  const Vector all = v->head(unknowns);
  hbm::CornerSides sides(problem_, corner, kind_.quantity);
  return Comparison{{all.head(n + 1), over, direction, hbm::at_angles(corner, all)},
                    sides.slopes(all, parameters(all, over))};
}

bool SpecialCurveTracer::is_special(const hbm::CornerSlopes& slopes) const {
  return kind_.maximum ? slopes.is_maximum() : slopes.is_extreme();
}

// The corner near a point, and the direction in which it is special. On one side of it the slope is near
// zero; if the corner is special neither before nor beyond the sign change of that slope, the special
// point ends.
std::optional<SpecialCurveTracer::CurveStart> SpecialCurveTracer::to_corner(const CurveStart& at) {
  for (const auto& corner :
       hbm::corners_near(*problem_, at.x.head(problem_->size()), parameters(at.x, at.over), near_corner))
    for (const double nearby : besides) {
      std::vector<hbm::CornerSlopes> found;
      for (const int direction : {at.direction, -at.direction}) {
        const auto there = corner_nearby(at, corner, direction, nearby);
        if (!there) continue;
        if (is_special(there->slopes)) return there->place;
        found.push_back(there->slopes);
      }
      if (found.size() == 2 &&
          (found[0].below * found[1].below < 0) != (found[0].above * found[1].above < 0)) {
        result_.end.vanishes = true;
        return {};
      }
    }
  return {};
}

// The continuation from a corner where the slope on one side changes sign: if it vanishes, a smooth curve
// starts on that side; if it jumps, another corner crosses this one.
std::optional<SpecialCurveTracer::CurveStart> SpecialCurveTracer::leave_corner(const CurveStart& at,
                                                                               bool above) {
  hbm::CornerSides sides(problem_, *at.corner, kind_.quantity);
  const auto slopes = sides.slopes(hbm::with_angles(at.x, *at.corner), parameters(at.x, at.over));
  const double changes = above ? slopes.above : slopes.below, other = above ? slopes.below : slopes.above;
  return std::abs(changes) <= zero_slope * std::abs(other) ? from_corner(at, above) : to_crossing_corner(at);
}

// Two crossing corners exchange their order along the frequency, with a different slope between them. The
// special point continues at one of them, or, if it is at neither, has met the other one.
std::optional<SpecialCurveTracer::CurveStart> SpecialCurveTracer::to_crossing_corner(const CurveStart& at) {
  const auto crossing =
      hbm::corners_near(*problem_, at.x.head(problem_->size()), parameters(at.x, at.over), corners_meeting);
  bool found = false;
  for (const auto& corner : crossing)
    for (const double nearby : besides)
      if (const auto there = corner_nearby(at, corner, at.direction, nearby)) {
        if (is_special(there->slopes)) return there->place;
        found = true;
      }
  result_.end.vanishes = found && crossing.size() > 1;
  return {};
}

// Comparison of responses on both sides of a point: the special point continues as that of the response
// beyond, or, if that has one less, has met its counterpart. So a curve passes kinks of any kind, such as a
// new reversal while an element slips, near which slopes vary with the square root of the distance.
std::optional<SpecialCurveTracer::CurveStart> SpecialCurveTracer::seen_beyond(const CurveStart& at) {
  // One that is not on the branch from rest is looked for on others as well.
  const bool several = may_have_several_responses(problem_->model());
  if (const auto next = seen_beyond(at, OtherBranches::none); next || result_.end.vanishes || !several)
    return next;
  return seen_beyond(at, OtherBranches::from_ends);
}

std::optional<SpecialCurveTracer::CurveStart> SpecialCurveTracer::seen_beyond(const CurveStart& at,
                                                                              OtherBranches others) {
  const Eigen::Index n = problem_->size();
  for (const double nearby : seen_besides) {
    const auto seen = [&](int direction) {
      std::vector<SpecialPoint> near;
      const double over = at.over * (1 + direction * nearby);
      if (!inside(over)) return near;
      const auto response = special_points(way_, over, window_, {kind_.event}, others, control_);
      if (!response.failure.empty() || !response.unbounded.empty()) return near;
      for (const SpecialPoint& point : response.points)
        if (std::abs(point.x[n] / at.x[n] - 1) < in_sight) near.push_back(point);
      return near;
    };
    const auto distance = [&](const SpecialPoint& point) {
      return (point.x.head(n) - at.x.head(n)).norm() / at.x.head(n).norm() +
             std::abs(point.x[n] / at.x[n] - 1);
    };
    const auto nearest = [&](const std::vector<SpecialPoint>& points) {
      return std::min_element(points.begin(), points.end(),
                              [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    };
    const auto reaches = [&](const SpecialPoint& point) {
      return distance(point) < root_reach * std::sqrt(nearby);
    };
    const auto before = seen(-at.direction), beyond = seen(at.direction);
    if (before.empty() || !reaches(*nearest(before))) continue;
    if (beyond.size() + 1 == before.size()) {
      result_.end.vanishes = true;
      return {};
    }
    if (beyond.size() != before.size() || !reaches(*nearest(beyond))) continue;
    const SpecialPoint& next = *nearest(beyond);
    const CurveStart place{next.x, next.over, at.direction, {}};
    return next.nonsmooth ? to_corner(place) : place;
  }
  return {};
}

// Whether the displacement attains its maximum at two different instants of the period, or at two places of
// the response. The maximum of two
// functions of the frequency has a convex kink where they cross: it is no peak, and a peak that reaches it
// ends, exceeded by the other. Extrema that are equal by a symmetry of the motion do not cross.
bool SpecialCurveTracer::is_surpassed(const CurveStart& at) const {
  const auto& harmonics = problem_->harmonics();
  const auto evaluator = problem_->hbm_evaluator();
  const auto u = at.x.head(problem_->size());
  if (evaluator->move_to(u, parameters(at.x, at.over), continuation::Needs::residual) !=
      continuation::Evaluated::ok)
    return false;
  Amplitude amplitude(harmonics);
  Vector motion(harmonics.size()), other(harmonics.size());
  const Extreme largest = amplitude.of(*evaluator, u, motion);
  for (int place = 0; place < evaluator->stiffness().places(); ++place) {
    evaluator->stiffness().response(u, evaluator->force_factor(), other, place);
    for (const Extreme& extreme : amplitude.all(other))
      if (extreme.amplitude > (1 - as_large) * largest.amplitude &&
          !elements::is_image(harmonics, other, motion, extreme.theta - largest.theta,
                              extreme.sign * largest.sign))
        return true;
  }
  return false;
}

// The smooth curve that starts where the slope vanishes on one side of a corner. There h is prescribed, not
// the parameter, which may vary with any power of h: with its square root at the onset of slip.
std::optional<SpecialCurveTracer::CurveStart> SpecialCurveTracer::from_corner(const CurveStart& at,
                                                                              bool above) const {
  const Eigen::Index n = problem_->size();
  const double size = hbm::corner_size(*problem_, *at.corner, at.x.head(n), parameters(at.x, at.over));
  for (const double nearby : besides) {
    const auto v =
        at_depth(at, (above ? nearby : -nearby) * size, near_corner + root_reach * std::sqrt(nearby));
    if (!v) continue;
    const double over = (*v)[n + 1];
    if (inside(over) && std::abs(over - at.over) > least_change * at.over)
      return CurveStart{v->head(n + 1), over, over > at.over ? 1 : -1, {}};
  }
  return {};
}

// The special point of the smooth branches at which a corner has a given h, within the relative distance
// `reach`: Newton's method for all three conditions, with h moved to its value before each step.
std::optional<Vector> SpecialCurveTracer::at_depth(const CurveStart& at, double depth, double reach) const {
  const Eigen::Index n = problem_->size();
  continuation::NewtonOptions one_step;
  one_step.iterations = 1;
  continuation::Counts counts;
  continuation::Corrector corrector(*smooth_, parameters(at.x, at.over), way_.index, one_step, counts);
  hbm::Corner corner = *at.corner;
  Vector v(n + 2), scales(n + 2), d(n), row = Vector::Zero(n + 2);
  v << at.x, at.over;
  scales << smooth_->scales(), at.over;
  const Vector begin = v;
  for (int k = 0; k < most_steps; ++k) {
    const Vector p = parameters(v.head(n + 1), v[n + 1]);
    const auto h = hbm::corner_excess(*problem_, corner, v.head(n), p);
    if (!h || !((v - begin).cwiseQuotient(scales).norm() <= reach * (1 + begin.cwiseQuotient(scales).norm())))
      return {};
    hbm::corner_direction(*problem_, corner, v.head(n), p, d);
    v.head(n) += (depth - *h) / d.squaredNorm() * d;
    hbm::corner_gradient(*problem_, corner, v.head(n), p, d);
    row.head(n) = d;
    row[n + 1] = hbm::corner_derivative(*problem_, corner, v.head(n), p, way_.index);
    row /= row.norm();
    if (corrector.correct(v, row, false).converged && std::abs(depth - *h) <= same_depth * std::abs(depth))
      return v;
  }
  return {};
}

}  // namespace arcslip::observables

#include <arcslip/analyses/branches/passages.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::observables {

using continuation::Vector;

namespace {

constexpr int most_corrections = 20;
constexpr const char* passage = "passage";
constexpr double at_value = 1e-14, not_moved = 1e-3;  // relative

}  // namespace

continuation::Monitor passage_monitor(double value) {
  return {passage, [value](const continuation::Accepted& now) { return now.parameter - value; }};
}

Passages::Passages(const hbm::HbmProblem& problem, Vector p, int parameter)
    : problem_(problem), p_(std::move(p)), parameter_(parameter), value_(p_[parameter]) {}

bool Passages::has(const Vector& other) const {
  return std::any_of(u.begin(), u.end(), [&](const Vector& each) {
    return (other - each).norm() <= same_solution * each.norm();
  });
}

bool Passages::add(const Vector& other) {
  if (has(other)) return false;
  u.push_back(other);
  return true;
}

// Corrected at the value, where that leads no farther.
void Passages::add_near(const Vector& guess, bool is_located) {
  const auto corrected = hbm::response_near(problem_, p_, guess);
  if (corrected && (!is_located || (*corrected - guess).norm() <= not_moved * guess.norm()))
    add(*corrected);
  else if (is_located)
    add(guess);
  else
    doubt = "another response, where the branch passes the frequency, could not be corrected";
}

// Where the branch passes the value between a fold and a point next to it: corrected in planes normal to the
// tangent at the fold, since at the value the equations are nearly singular. From the fold the parameter
// changes as the square of the way. share: of the parameter between the two.
void Passages::add_between(const continuation::Point& fold, const continuation::Point& nearby, double share) {
  const Eigen::Index n = fold.u.size();
  Vector at_fold(n + 1), normal(n + 1);
  at_fold << fold.u, fold.parameter;
  normal << fold.tangent.head(n).normalized(), 0;
  continuation::NewtonOptions newton;
  continuation::Counts counts;
  continuation::Corrector corrector(problem_, p_, parameter_, newton, counts);
  double way = std::sqrt(share) * normal.head(n).dot(nearby.u - fold.u);
  Vector v;
  for (int k = 0; k < most_corrections; ++k) {
    v = at_fold + way * normal;
    if (!corrector.correct(v, normal, false).converged) break;
    const double ratio = (value_ - fold.parameter) / (v[n] - fold.parameter);
    if (!(ratio > 0)) break;
    if (std::abs(v[n] - value_) <= at_value * value_) {
      add(v.head(n));
      return;
    }
    way *= std::sqrt(ratio);
  }
  add_near(fold.u + std::sqrt(share) * (nearby.u - fold.u), false);
}

void Passages::take(const continuation::Branch& branch) {
  for (const continuation::Event& event : branch.events) {
    if (event.monitor == passage) add_near(event.point.u, event.located);
    if (event.monitor != event_kinds::fold || event.after + 1 >= branch.points.size()) continue;
    for (const std::size_t i : {event.after, event.after + 1}) {
      const continuation::Point &fold = event.point, &nearby = branch.points[i];
      const double share = (fold.parameter - value_) / (fold.parameter - nearby.parameter);
      if (share > 0 && share < 1) add_between(fold, nearby, share);
    }
  }
}

}  // namespace arcslip::observables

#include <arcslip/continuation/tracing/jacobian_watch.hpp>

#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/continuation/problem/text.hpp>

#include <cmath>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr long seldom = 8;           // checks at the 1st, 8th, 64th ... occasion
constexpr double standstill = 1e-3;  // of the longest step: with a wrong Jacobian shorter ones end the branch
constexpr long many_rejections = 20;  // which are also more than a quarter of the points

bool is_due(long times) {
  while (times > 0 && times % seldom == 0) times /= seldom;
  return times == 1;
}

}  // namespace

namespace {

// The derivatives of the problem that this one is made of, if any, over all parameters that change.
JacobianError wrong_entry(const Problem& problem, PlaceOfProblem place) {
  const PlaceOfProblem own = place;
  const Problem* of = &problem;
  while (const Problem* next = of->made_of(place)) of = next;
  for (const int k : place.changing)
    if (auto found = doubt_jacobian(*of, place.u, place.p, k); !found.message.empty()) return found;
  if (of == &problem) return {};
  auto found = doubt_jacobian(problem, own.u, own.p, own.changing.front());
  if (found.by_differences) return {};  // of this library, from derivatives that are right
  if (!found.message.empty())
    found.message = "second derivatives are wrong: in the equations of the curve " + found.message;
  return found;
}

}  // namespace

void JacobianWatch::look_at(const Vector& v) {
  if (!options_.check_jacobian || !s_.jacobian_doubt.empty() || !v.allFinite()) return;
  const Eigen::Index n = v.size() - 1;
  PlaceOfProblem place{v.head(n), s_.p, {s_.free}};
  place.p[s_.free] = v[n];
  const JacobianError found = wrong_entry(problem_, std::move(place));
  if (found.message.empty()) return;
  s_.jacobian_doubt = found.message;
  s_.jacobian_error = found.by_differences ? 0 : found.relative;
  s_.branch.warnings.push_back(found.message + " (at " + text(v[n]) +
                               "): tangents and events are equally wrong, and the branch may end early");
}

void JacobianWatch::check_some() {
  if (is_due(s_.branch.counts.points)) look_at(s_.here.v);
}

// Far beyond, differences are of what F is there, if it is anything.
bool JacobianWatch::is_near(const Vector& v, const Vector& from) const {
  const Eigen::Index n = v.size() - 1;
  const Vector scales = problem_.scales();
  const double of_p = problem_.parameters()[static_cast<std::size_t>(s_.free)].change();
  const double size = 1 + from.head(n).cwiseQuotient(scales).norm() + std::abs(from[n]) / of_p;
  return (v - from).head(n).cwiseQuotient(scales).norm() + std::abs(v[n] - from[n]) / of_p <= size;
}

void JacobianWatch::suspect(const Vector& v) {
  if (!is_due(++s_.slow)) return;
  look_at(s_.here.v);
  if (is_near(v, s_.here.v)) look_at(v);
}

std::string JacobianWatch::doubt(const Vector& v, const Vector& guess) {
  look_at(guess);
  if (is_near(v, guess)) look_at(v);
  return s_.jacobian_doubt.empty() ? std::string() : "; " + s_.jacobian_doubt;
}

bool JacobianWatch::can_continue() const {
  if (s_.jacobian_doubt.empty() || s_.jacobian_error == 0) return true;  // 0: a default difference
  const Counts& counts = s_.branch.counts;
  return s_.step >= standstill * s_.longest &&
         !(counts.rejected_steps >= many_rejections && 4 * counts.rejected_steps > counts.points);
}

}  // namespace arcslip::continuation

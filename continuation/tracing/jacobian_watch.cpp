#include <arcslip/continuation/tracing/jacobian_watch.hpp>

#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/continuation/problem/text.hpp>

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

void JacobianWatch::look_at(const Vector& v) {
  if (!options_.check_jacobian || !s_.jacobian_doubt.empty() || !v.allFinite()) return;
  const Eigen::Index n = v.size() - 1;
  Vector p = s_.p;
  p[s_.free] = v[n];
  const JacobianError found = doubt_jacobian(problem_, v.head(n), p, s_.free);
  if (found.message.empty()) return;
  s_.jacobian_doubt = found.message;
  s_.jacobian_error = found.relative;
  s_.branch.warnings.push_back(found.message + " (at " + text(v[n]) +
                               "): tangents and events are equally wrong, and the branch may end early");
}

void JacobianWatch::check_some() {
  if (is_due(s_.branch.counts.points)) look_at(s_.here.v);
}

void JacobianWatch::suspect(const Vector& v) {
  if (!is_due(++s_.slow)) return;
  look_at(s_.here.v);
  look_at(v);
}

std::string JacobianWatch::doubt(const Vector& v) {
  if (s_.jacobian_doubt.empty()) look_at(v);
  return s_.jacobian_doubt.empty() ? std::string() : "; " + s_.jacobian_doubt;
}

bool JacobianWatch::can_continue() const {
  if (s_.jacobian_doubt.empty()) return true;
  const Counts& counts = s_.branch.counts;
  return s_.step >= standstill * s_.longest &&
         !(counts.rejected_steps >= many_rejections && 4 * counts.rejected_steps > counts.points);
}

}  // namespace arcslip::continuation

// What a trace finds out about its problem on the way: whether the Jacobian is that of F, and why steps were
// tried in vain.

#include <arcslip/continuation/jacobian_check.hpp>
#include <arcslip/continuation/text.hpp>
#include <arcslip/continuation/tracer.hpp>

namespace arcslip::continuation {
namespace {

constexpr long seldom = 8;  // looks at the Jacobian: the 1st, 8th, 64th ... time that there is reason for one
constexpr double standstill =
    1e-3;  // of the longest step: so short, a branch with a wrong Jacobian gets no further
constexpr long many_rejections = 20;  // which are also more than a quarter of the points

}  // namespace

bool Tracer::is_due(long times) {
  while (times > 0 && times % seldom == 0) times /= seldom;
  return times == 1;
}

void Tracer::look_at_jacobian(const Vector& v) {
  if (!options_.check_jacobian || !s_.jacobian_doubt.empty() || !v.allFinite()) return;
  Vector p = s_.p;
  p[s_.free] = v[n_];
  const JacobianError found = doubt_jacobian(*problem_, v.head(n_), p, s_.free);
  if (found.message.empty()) return;
  s_.jacobian_doubt = found.message;
  s_.jacobian_error = found.relative;
  s_.branch.warnings.push_back(found.message + " (at " + text(v[n_]) +
                               "): tangents and events are as wrong, and the branch may end early");
}

// A correction that came to v did not converge as Newton's method does.
void Tracer::suspect(const Vector& v) {
  if (!is_due(++s_.slow)) return;
  look_at_jacobian(s_.here.v);
  look_at_jacobian(v);
}

// To go on a message where Newton's method failed.
std::string Tracer::doubt(const Vector& v) {
  if (s_.jacobian_doubt.empty()) look_at_jacobian(v);
  return s_.jacobian_doubt.empty() ? std::string() : "; " + s_.jacobian_doubt;
}

bool Tracer::gets_on() const {
  if (s_.jacobian_doubt.empty()) return true;
  const Counts& counts = s_.branch.counts;
  return s_.step >= standstill * s_.longest &&
         !(counts.rejected_steps >= many_rejections && 4 * counts.rejected_steps > counts.points);
}

Tracer::Attempt Tracer::refuse(Rejected why, double value, double limit, Attempt as) {
  rejection_.why = why;
  rejection_.value = value;
  rejection_.limit = limit;
  return as;
}

void Tracer::log_rejection() {
  if (!options_.on_rejection) return;
  rejection_.arclength = s_.here.arclength;
  rejection_.parameter = s_.here.v[n_];
  rejection_.step = s_.step;
  rejection_.words = rejection_.why == Rejected::quantity ? monitors_[unresolved_].name : failure_;
  options_.on_rejection(rejection_);
}

}  // namespace arcslip::continuation

#include <arcslip/continuation/corrector.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::continuation {
namespace {

// Chord steps that cost less than new factors: a factorization is n/3 solves, an evaluation with Jacobian somewhat
// more than one without.
double chord_steps_worth_a_factorization(int n) { return std::clamp(n / 8.0, 1.0, 8.0); }

constexpr double smallest_damping = 1.0 / 256;
constexpr double smallest_relevant_state = 1e-6;  // in scales: below, corrections are measured absolutely

}  // namespace

Corrector::Corrector(const Problem& problem, Vector p, int free, const NewtonOptions& options, Counts& counts)
    : options_(options), counts_(counts), evaluator_(problem.evaluator()), lu_(problem.size()), p_(std::move(p)),
      weights_(problem.size() + 1), F_p_(problem.size()), dv_(problem.size() + 1), next_(problem.size() + 1),
      trial_(problem.size() + 1), free_(free),
      longest_chord_(chord_steps_worth_a_factorization(problem.size())) {
  const double parameter_scale = problem.parameters()[static_cast<std::size_t>(free)].scale;
  weights_.head(problem.size()) = problem.scales().cwiseAbs2().cwiseInverse();
  weights_[problem.size()] = 1 / (parameter_scale * parameter_scale);
  parameter_floor_ = 1e-3 * parameter_scale;
}

double Corrector::norm_u(const Vector& v) const {
  const Eigen::Index n = v.size() - 1;
  return std::sqrt((v.head(n).array().square() * weights_.head(n).array()).sum());
}

double Corrector::size(const Vector& dv, const Vector& v) const {
  const Eigen::Index n = v.size() - 1;
  const double u = norm_u(dv) / std::max(norm_u(v), smallest_relevant_state);
  const double p = std::abs(dv[n]) / std::max(std::abs(v[n]), parameter_floor_);
  return std::max(u, p);
}

bool Corrector::evaluate(const Vector& v, Needs needs) {
  const Eigen::Index n = v.size() - 1;
  p_[free_] = v[n];
  ++counts_.residuals;
  if (needs == Needs::jacobian) ++counts_.jacobians;
  return evaluator_->move_to(v.head(n), p_, needs) == Evaluated::ok && evaluator_->residual().allFinite();
}

bool Corrector::factorize(const Vector& row) {
  evaluator_->parameter_derivative(free_, F_p_);
  ++counts_.factorizations;
  return F_p_.allFinite() && lu_.factorize(evaluator_->jacobian(), F_p_, row);
}

void Corrector::solve(Vector& dv) const {
  const Eigen::Index n = dv.size() - 1;
  dv.head(n) = -evaluator_->residual();
  dv[n] = 0;
  ++counts_.solves;
  lu_.solve(dv);
}

bool Corrector::linearize(const Vector& v, const Vector& row) {
  return evaluate(v, Needs::jacobian) && factorize(row);
}

bool Corrector::tangent(Vector& t) const {
  t.setZero();
  t[t.size() - 1] = 1;
  ++counts_.solves;
  lu_.solve(t);
  const double length = std::sqrt(dot(t, t));
  if (!std::isfinite(length) || length == 0) return false;
  t /= length;
  return true;
}

// New factors at v and the Newton correction there.
bool Corrector::renew(const Vector& v, const Vector& row, Vector& dv) {
  if (!linearize(v, row)) return false;
  solve(dv);
  return dv.allFinite();
}

Correction Corrector::correct(Vector& v, const Vector& row, bool keep_factors) {
  Correction result;
  const auto give_up = [&](bool evaluated) {
    result.evaluated = evaluated;
    return result;
  };

  bool fresh = !keep_factors;
  if (fresh) {
    if (!renew(v, row, dv_)) return give_up(false);
  } else {
    if (!evaluate(v, Needs::residual)) return give_up(false);
    solve(dv_);
  }

  double damping = 1;
  double now = size(dv_, v);
  result.first = now;
  for (result.iterations = 1; result.iterations <= options_.iterations; ++result.iterations) {
    trial_ = v + damping * dv_;
    const bool evaluated = evaluate(trial_, Needs::residual);
    double next = std::numeric_limits<double>::infinity();
    if (evaluated) {
      solve(next_);
      next = size(next_, trial_);
      if (!(next >= 0)) next = std::numeric_limits<double>::infinity();
    }
    const double ratio = now > 0 ? next / now : 0;
    if (result.iterations == 1) result.contraction = ratio;

    if (damping == 1 && ratio <= options_.chord_contraction) {
      v = trial_;
      std::swap(dv_, next_);
      now = next;
      if (next * ratio <= (1 - ratio) * options_.tolerance) {  // error left after this last correction
        v += dv_;
        result.last = next;
        result.converged = true;
        return result;
      }
      const double steps_left = std::log(options_.tolerance / next) / std::log(ratio);
      if (steps_left > longest_chord_) {
        if (!renew(v, row, dv_)) return give_up(false);
        fresh = true;
        now = size(dv_, v);
      } else {
        fresh = false;
      }
      continue;
    }
    if (next <= options_.rounding_level && now <= options_.rounding_level && fresh) {  // stagnates at rounding
      v = trial_;
      result.last = next;
      result.converged = true;
      return result;
    }
    if (!fresh) {  // old factors are to blame: renew, at the trial point if it is nearer
      if (ratio < 1) v = trial_;
      if (!renew(v, row, dv_)) return give_up(false);
      fresh = true;
      damping = 1;
      now = size(dv_, v);
      continue;
    }
    if (ratio < 1 - damping / 4) {  // monotone: go on from here
      v = trial_;
      if (!renew(v, row, dv_)) return give_up(false);
      damping = std::min(1.0, 2 * damping);
      now = size(dv_, v);
      continue;
    }
    damping /= 2;
    if (damping < smallest_damping) return give_up(evaluated);
  }
  return result;
}

}  // namespace arcslip::continuation

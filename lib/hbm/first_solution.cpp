#include <arcslip/hbm/problem.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>
#include <arcslip/control/run_control.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace arcslip::hbm {

using continuation::Evaluated;
using continuation::Needs;

namespace {

constexpr double least_part = 1e-3;  // of the excitation
constexpr long longest_ramp = 3000;  // points; some 300 are usual, a branch that closes on itself never ends

// Points on the way to a response are none of its branch.
void add_without_points(continuation::Counts counts, continuation::Counts& work) {
  counts.points = counts.rejected_steps = 0;
  work += counts;
}

// The branch over the excitation factors from -1 to 1, from one of them on, such as from rest at 0. If all
// laws are antisymmetric, u at -1 is -u at 1: so it may leave rest on either side, or return through 0, where
// u need not be zero.
std::optional<Vector> ramp(const std::shared_ptr<const HbmProblem>& problem, Vector p, double from,
                           const Vector& u, const control::Control& control, continuation::Counts& work) {
  const int factor = problem->excitation_factor();
  p[factor] = from;
  continuation::Options options;
  options.lower = -1;
  options.upper = 1;
  options.check_jacobian = false;
  options.step.largest_parameter = 0.01;
  options.points = longest_ramp;
  options.control = control;
  const auto branch = continuation::trace(problem, {u, p, factor, 1}, options);
  add_without_points(branch.counts, work);
  if (branch.stop.reason != continuation::StopReason::boundary) return {};
  const double end = branch.points.back().parameter;
  if (end != 1 && !(end == -1 && problem->model().antisymmetric))
    return {};  // from a kink it may lead nowhere
  return end * branch.points.back().u;
}

// The response of the structure with its elements linearized at rest: all sliders stuck. Newton's method from
// there, not from rest, where J may be all but singular: a motion of no size leaves the mean of a memory
// open.
Vector stuck_response(const HbmProblem& problem, const Vector& p, continuation::Counts& work) {
  const auto at = problem.hbm_evaluator();
  const Vector rest = Vector::Zero(problem.size());
  if (at->move_to(rest, p, Needs::jacobian) != Evaluated::ok)
    return Vector::Constant(rest.size(), std::nan(""));
  continuation::LU<double> lu(rest.size());
  lu.factorize(std::get<Eigen::MatrixXd>(at->jacobian()));
  Vector response(rest.size());
  lu.solve(at->residual(), response);
  work += {.residuals = 1, .jacobians = 1, .factorizations = 1, .solves = 1};
  return -response;
}

// The ramp from the largest part of the excitation at which Newton's method converges.
std::optional<Vector> ramp_from_part(const std::shared_ptr<const HbmProblem>& problem, const Vector& p,
                                     const control::Control& control, continuation::Counts& work) {
  Vector part = p;
  double& factor = part[problem->excitation_factor()];
  for (factor = 0.5; factor >= least_part && control.keep_going(); factor *= 0.5)
    if (const auto u = response_near(*problem, part, stuck_response(*problem, part, work), work))
      return ramp(problem, p, factor, *u, control, work);
  return {};
}

// A spring in place of each element, as stiff as that may be. p: the parameters of the model, extended.
model::Model with_springs(model::Model model, Vector& p) {
  for (const auto& element : model.elements)
    for (std::size_t i = 0; i < element.directions.size(); ++i) {
      const double stiffness = element.law->traits(element.fields(p), static_cast<int>(i)).stiffness;
      if (!std::isfinite(stiffness)) continue;
      model.springs.push_back({static_cast<int>(p.size()), element.directions[i]});
      if (!element.next.empty()) model.springs.back().next = element.next[i];
      model.linked = model.linked || model.springs.back().next.size() > 0;
      model.parameters.push_back({"", "N/m", stiffness, 1, 0, stiffness});
      p.conservativeResize(p.size() + 1);
      p[p.size() - 1] = stiffness;
    }
  return model;
}

// The response with these springs: of a structure that rests on its contacts, under a constant force alone.
Vector response_on_springs(const HbmProblem& problem, const Vector& p) {
  Vector with = p.head(p.size() - 1);
  const model::Model model = with_springs(problem.model(), with);
  DynamicStiffness linear(model, problem.coordinates(), problem.harmonics());
  Vector u = Vector::Zero(problem.size());
  if (!linear.move_to(with)) return Vector::Constant(u.size(), std::nan(""));
  linear.force(u);
  linear.solve(u);
  return u;
}

// Continuation in a factor of the element forces, the last parameter, from a linear structure at 0 to the
// scene at 1.
class Gradual final : public continuation::Problem {
 public:
  Gradual(std::shared_ptr<const HbmProblem> problem, const DynamicStiffness& linear)
      : problem_(std::move(problem)),
        linear_(linear),
        parameters_(problem_->parameters().begin(), problem_->parameters().end()) {
    parameters_.push_back({"element_factor", "-", 1, 1, 0, 1});
  }
  int size() const override { return problem_->size(); }
  std::span<const continuation::Parameter> parameters() const override { return parameters_; }
  Vector scales() const override { return problem_->scales(); }
  std::unique_ptr<continuation::Evaluator> evaluator() const override {
    return std::make_unique<Evaluator>(*problem_, linear_);
  }

 private:
  // At factor 0: Z u - f of the linear structure. Auxiliary unknowns keep their own equations.
  class Evaluator final : public continuation::Evaluator {
   public:
    Evaluator(const HbmProblem& problem, const DynamicStiffness& linear)
        : inner_(problem.hbm_evaluator()),
          linear_(linear),
          displacements_(problem.coordinates().unknowns * problem.harmonics().size()),
          R_(problem.size()),
          elements_(problem.size()),
          Z_(problem.size(), problem.size()),
          jacobian_(Eigen::MatrixXd(problem.size(), problem.size())) {}

    Evaluated move_to(continuation::In u, continuation::In p, Needs needs) override {
      const Evaluated result = inner_->move_to(u, p.head(p.size() - 1), needs);
      if (result != Evaluated::ok) return result;
      const double factor = p[p.size() - 1];
      R_ = inner_->residual();
      linear_.residual(u, inner_->force_factor(), R_);  // of the displacements
      elements_ = inner_->residual() - R_;
      R_ += factor * elements_;
      if (needs == Needs::residual) return result;
      Z_.setZero();
      linear_.add_to(Z_);
      auto& J = std::get<Eigen::MatrixXd>(jacobian_);
      J = std::get<Eigen::MatrixXd>(inner_->jacobian());
      J.topRows(displacements_) = (factor * J + (1 - factor) * Z_).topRows(displacements_).eval();
      return result;
    }
    const Vector& residual() const override { return R_; }
    const continuation::Jacobian& jacobian() const override { return jacobian_; }
    void parameter_derivative(int, continuation::Out dR) const override { dR = elements_; }  // by the factor
    std::uint64_t piece() const override { return inner_->piece(); }

   private:
    std::unique_ptr<HbmEvaluator> inner_;
    const DynamicStiffness& linear_;
    Eigen::Index displacements_;
    Vector R_, elements_;
    Eigen::MatrixXd Z_;
    continuation::Jacobian jacobian_;
  };

  std::shared_ptr<const HbmProblem> problem_;
  const DynamicStiffness& linear_;
  std::vector<continuation::Parameter> parameters_;
};

std::optional<Vector> gradual(const std::shared_ptr<const HbmProblem>& problem, const Vector& p, bool springs,
                              const control::Control& control, continuation::Counts& work) {
  Vector with = p.head(p.size() - 1);
  const model::Model model = springs ? with_springs(problem->model(), with) : problem->model();
  DynamicStiffness linear(model, problem->coordinates(), problem->harmonics());
  Vector u = Vector::Zero(problem->size());
  if (!linear.move_to(with)) return {};
  linear.force(u);
  linear.solve(u);
  if (!u.allFinite()) return {};
  continuation::Options options;
  options.lower = 0;
  options.upper = 1;
  options.check_jacobian = false;
  options.points = longest_ramp;
  options.control = control;
  const auto equations = std::make_shared<const Gradual>(problem, linear);
  Vector at(p.size() + 1);
  at << p, 0;
  const auto branch = continuation::trace(equations, {u, at, static_cast<int>(p.size()), 1}, options);
  add_without_points(branch.counts, work);
  if (branch.stop.reason != continuation::StopReason::boundary || branch.points.back().parameter != 1)
    return {};
  return branch.points.back().u;
}

constexpr int random_starts = 200, unknowns_of_starts = 4000;  // fewer starts of large problems
constexpr double farthest_start = 4;                           // decades from the scale, on both sides

// Newton's method from motions at random, the same in each run: of a size for the mean and one for all
// harmonics, which fall as 1/n^2.
std::optional<Vector> from_random_starts(const HbmProblem& problem, const Vector& p,
                                         const control::Control& control, continuation::Counts& work) {
  const Harmonics& h = problem.harmonics();
  const Vector scales = problem.scales();
  std::mt19937_64 random(1);
  const auto between = [&](double a, double b) {
    return a + (b - a) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  Vector u(problem.size());
  const int starts = std::min(random_starts, unknowns_of_starts / problem.size());
  for (int start = 0; start < starts && control.keep_going(); ++start) {
    const double mean = std::pow(10, between(-farthest_start, farthest_start));
    const double moving = std::pow(10, between(-farthest_start, farthest_start));
    for (Eigen::Index at = 0; at < u.size(); at += h.size())
      for (int n = 0; n <= h.order; ++n) {
        if (!h.has(n)) continue;
        const double size = scales[at] * (n == 0 ? mean : moving / (n * n));
        u[at + h.cosine_index(n)] = size * between(-1, 1);
        if (n > 0) u[at + h.sine_index(n)] = size * between(-1, 1);
      }
    if (const auto found = response_near(problem, p, u, work)) return found;
  }
  return {};
}

}  // namespace

Vector linear_response(const HbmProblem& problem, const Vector& p) {
  DynamicStiffness stiffness(problem.model(), problem.coordinates(), problem.harmonics());
  Vector u = Vector::Zero(problem.size());
  if (!stiffness.move_to(p.head(p.size() - 1))) return Vector::Constant(u.size(), std::nan(""));
  stiffness.force(u);
  stiffness.solve(u);
  return u;
}

std::optional<Vector> response_near(const HbmProblem& problem, const Vector& p, const Vector& guess,
                                    continuation::Counts& work) {
  if (!guess.allFinite()) return {};
  const int n = problem.size();
  continuation::NewtonOptions newton;
  newton.iterations = 30;
  continuation::Corrector corrector(problem, p, model::frequency, newton, work);
  Vector v(n + 1);
  v << guess, p[model::frequency];
  if (!corrector.correct(v, Vector::Unit(n + 1, n), false).converged) return {};
  return v.head(n);
}

std::optional<Vector> response_near(const HbmProblem& problem, const Vector& p, const Vector& guess) {
  continuation::Counts work;
  return response_near(problem, p, guess, work);
}

SteadyState steady_state(const std::shared_ptr<const HbmProblem>& problem, const Vector& p,
                         const control::Control& control) {
  SteadyState found;
  const auto stopped = [&] { return !control.keep_going(); };
  const auto is_found = [&](std::optional<Vector> u) {
    found.u = std::move(u);
    return found.u.has_value();
  };
  const auto is_near = [&](const Vector& guess) {
    return is_found(response_near(*problem, p, guess, found.work));
  };
  const Vector rest = Vector::Zero(problem->size());
  if (stopped() || is_near(rest)) return found;
  if (stopped() || is_near(linear_response(*problem, p))) return found;
  if (stopped() || is_near(stuck_response(*problem, p, found.work))) return found;
  if (stopped() || is_near(response_on_springs(*problem, p))) return found;
  if (is_found(ramp(problem, p, 0, rest, control, found.work))) return found;
  if (is_found(ramp_from_part(problem, p, control, found.work))) return found;
  for (const bool springs : {false, true})
    if (stopped() || is_found(gradual(problem, p, springs, control, found.work))) return found;
  found.u = from_random_starts(*problem, p, control, found.work);
  return found;
}

}  // namespace arcslip::hbm

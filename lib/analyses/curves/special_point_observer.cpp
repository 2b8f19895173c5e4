#include <arcslip/analyses/curves/special_point_observer.hpp>

#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <cmath>
#include <utility>

namespace arcslip::observables {

using continuation::Accepted;
using continuation::Evaluated;
using continuation::In;
using continuation::Needs;
using continuation::Out;
using continuation::Vector;

namespace {

constexpr double chord = 1e-3;  // relative: between the points of a curve, so that it is smooth to the eye

}  // namespace

CurveSection::CurveSection(std::shared_ptr<const hbm::HbmProblem> problem, int over)
    : problem_(std::move(problem)),
      over_(over),
      observer_(problem_),
      evaluator_(problem_->hbm_evaluator()),
      border_(problem_->size(), 1),
      u_(problem_->size()),
      scales_(problem_->size() + 1),
      tangent_(scales_.size()) {
  scales_ << problem_->scales(), problem_->parameters()[model::frequency].scale;
  // Until there is a tangent, a border row that no symmetry makes orthogonal to it.
  for (Eigen::Index i = 0; i < scales_.size(); ++i)
    tangent_[i] = (1 + 0.3 * std::sin(7.0 * static_cast<double>(i))) * scales_[i];
}

bool CurveSection::move_to(In x, In p, Needs needs) {
  u_ = x.head(u_.size());
  p_ = p;
  p_[model::frequency] = x[u_.size()];
  return evaluator_->move_to(u_, p_, needs) == Evaluated::ok;
}

// The tangent of the branch over the frequency, with the last one as border row.
bool CurveSection::linearize() {
  const Eigen::Index n = u_.size();
  Vector row = tangent_.cwiseQuotient(scales_).cwiseQuotient(scales_);
  row /= tangent_.cwiseQuotient(scales_).norm();
  border_.rows.col(0) = row.head(n);
  border_.corner(0, 0) = row[n];
  evaluator_->parameter_derivative(model::frequency, border_.columns.col(0));
  if (!solver_) solver_ = continuation::suitable_solver(evaluator_->jacobian());
  if (!solver_->factorize(evaluator_->jacobian(), border_)) return false;
  Vector t = Vector::Unit(n + 1, n);
  solver_->solve(t);
  const double length = t.cwiseQuotient(scales_).norm();
  if (!(length > 0) || !std::isfinite(length)) return false;
  tangent_ = t / length;
  return true;
}

ResponsePoint CurveSection::observe(In x, In p, PointCondition held, const Observed& asked) {
  move_to(x, p, Needs::jacobian);
  linearize();
  continuation::Scratch none;
  return observer_.observe({u_, p_, tangent_, 0, *evaluator_, *solver_, p_[model::frequency], none}, held,
                           asked);
}

ResponsePoint CurveSection::observe(const Accepted& now, PointCondition held) {
  ResponsePoint point = observe(now.u, now.p, held, {.maxima = held != PointCondition::parameter});
  point.over = now.parameter;
  return point;
}

const StabilityAnalysis* CurveSection::stability(const Accepted& now) {
  if (!move_to(now.u, now.p, Needs::residual)) return nullptr;
  return observer_.stability(
      {u_, p_, tangent_, 0, *evaluator_, now.bordered, p_[model::frequency], now.scratch});
}

double CurveSection::amplitude_slope(const Accepted& now) {
  if (!move_to(now.u, now.p, Needs::residual)) return std::nan("");
  const Eigen::Index n = u_.size();
  return observer_.amplitude_change(
      *evaluator_, u_, now.tangent.head(n),
      {{model::frequency, now.tangent[n]}, {over_, now.tangent[now.tangent.size() - 1]}});
}

namespace {

// dA/du = L^T a and dA/dp_k = a . dx/dp_k with the observed coordinate x = L u + x_0 and a = sign
// phi(theta_hat).
class AmplitudeGradient {
 public:
  AmplitudeGradient(const hbm::HbmProblem& problem, std::shared_ptr<const std::optional<double>> instant)
      : instant_(std::move(instant)),
        harmonics_(problem.harmonics()),
        changes_(problem.coordinates().linear() > 0 || problem.model().absolute),
        amplitude_(harmonics_),
        x_(harmonics_.size()),
        a_(x_.size()) {}

  void by_unknowns(const hbm::HbmEvaluator& at, In u, Out dA) {
    const Extreme extreme = extreme_of(at, u);
    elements::series_basis(harmonics_, extreme.theta, a_);
    a_ *= extreme.sign;
    at.stiffness().response_transposed(a_, dA, extreme.place);
  }

  double by_parameter(const hbm::HbmEvaluator& at, In u, int k) {
    if (!changes_) return 0;
    const Extreme extreme = extreme_of(at, u);
    at.stiffness().response_derivative(k, u, at.force_factor(), x_, extreme.place);
    return amplitude_change(harmonics_, extreme, x_);
  }

 private:
  Extreme extreme_of(const hbm::HbmEvaluator& at, In u) {
    if (!instant_ || !*instant_) return amplitude_.of(at, u, x_);
    at.stiffness().response(u, at.force_factor(), x_);
    return amplitude_.near(x_, **instant_);
  }

  std::shared_ptr<const std::optional<double>> instant_;
  elements::Harmonics harmonics_;
  bool changes_;  // the response, with parameters, at fixed u
  Amplitude amplitude_;
  Vector x_, a_;
};

}  // namespace

std::vector<continuation::Monitor> amplitude_monitors(const std::shared_ptr<CurveSection>& section) {
  const auto slope = [section](const continuation::Accepted& now) { return section->amplitude_slope(now); };
  const auto amplitude = [section](const continuation::Accepted&) { return section->last_amplitude(); };
  std::vector<continuation::Monitor> monitors{
      {event_kinds::minimum, slope, continuation::Crossing::rising, amplitude},
      {event_kinds::maximum, slope, continuation::Crossing::falling, amplitude}};
  monitors.front().chord_tolerance = chord;
  for (auto& monitor : monitors) monitor.divides_at_kinks = false;  // a curve ends at a kink, see corners
  return monitors;
}

continuation::StationaryQuantity amplitude_quantity(const std::shared_ptr<const hbm::HbmProblem>& problem,
                                                    std::shared_ptr<const std::optional<double>> instant) {
  const auto gradient = std::make_shared<AmplitudeGradient>(*problem, std::move(instant));
  const auto of = [](continuation::Evaluator& at) -> const hbm::HbmEvaluator& {
    return static_cast<const hbm::HbmEvaluator&>(at);
  };
  return {[=](continuation::Evaluator& at, In u, In, Out dA) { gradient->by_unknowns(of(at), u, dA); },
          [=](continuation::Evaluator& at, In u, In, int k) { return gradient->by_parameter(of(at), u, k); }};
}

}  // namespace arcslip::observables

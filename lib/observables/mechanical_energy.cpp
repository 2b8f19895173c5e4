#include <arcslip/observables/mechanical_energy.hpp>

#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Vector;

constexpr int instants = 8;   // looked at, for each order of the energy
constexpr int halvings = 52;  // of the time between two of them

}  // namespace

MechanicalEnergy::MechanicalEnergy(std::shared_ptr<const hbm::HbmProblem> problem)
    : problem_(std::move(problem)) {
  const model::Model& model = problem_->model();
  const Vector p = model::defaults(model);
  M_ = model::mass_matrix(model, p);
  K_ = model::stiffness_matrix(model, p);
  const elements::Harmonics& h = problem_->harmonics();
  const int count = instants * (h.order + 1) * (h.odd ? 1 : 2);
  basis_.resize(h.size(), count);
  for (int k = 0; k < count; ++k) elements::series_basis(h, h.span() * k / count, basis_.col(k));
}

double MechanicalEnergy::of(const hbm::HbmEvaluator& at, continuation::In u, continuation::In rest) {
  const elements::Harmonics& h = problem_->harmonics();
  const Eigen::MatrixXd& P = problem_->coordinates().P;
  const Eigen::MatrixXd x = at.stiffness().motion(P, u, at.force_factor());
  Eigen::MatrixXd velocity(x.rows(), x.cols()), acceleration(x.rows(), x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    elements::series_slope(h, x.col(i), velocity.col(i));
    elements::series_slope(h, velocity.col(i), acceleration.col(i));
  }
  velocity *= at.stiffness().base_frequency();

  // The largest kinetic energy: of the instants, then where its power is zero next to that.
  Eigen::Index best = 0;
  const Eigen::MatrixXd v = velocity.transpose() * basis_;
  v.cwiseProduct(M_ * v).colwise().sum().maxCoeff(&best);
  Vector phi(h.size()), now(x.cols());
  const double step = h.span() / static_cast<double>(basis_.cols());
  double from = step * static_cast<double>(best - 1), to = step * static_cast<double>(best + 1);
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (from + to);
    elements::series_basis(h, middle, phi);
    now.noalias() = velocity.transpose() * phi;
    (now.dot(M_ * (acceleration.transpose() * phi)) > 0 ? from : to) = middle;
  }
  elements::series_basis(h, 0.5 * (from + to), phi);
  now.noalias() = velocity.transpose() * phi;
  const double kinetic = 0.5 * now.dot(M_ * now);
  now.noalias() = (x - at.stiffness().motion(P, rest, at.force_factor())).transpose() * phi;
  return kinetic + 0.5 * now.dot(K_ * now);
}

}  // namespace arcslip::observables

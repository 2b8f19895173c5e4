#include <arcslip/hbm/linear_modes.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/control/run_control.hpp>

#include <cmath>
#include <complex>

namespace arcslip::hbm {
namespace {

constexpr double massless = 1e-14;  // a mode: its mu relative to the largest
constexpr double rigid = 1e-10;     // v^T K v over the terms that it is made of
constexpr int shifts = 8;           // tried, by factors of 100
// The damping of a mode grows to its own from this share of it.
constexpr double least_damping = 1e-4, same_eigenvalue = 1e-12;
constexpr int damping_steps = 60, most_iterations = 30, most_coordinates = 300;

// F = D X of the fundamental of an element, its own unknowns eliminated: D = k + i omega c.
ComplexMatrix fundamental_stiffness(const elements::Harmonics& h, const elements::Law& law,
                                    const Eigen::MatrixXd& J) {
  const int n = h.excited(1), a = h.cosine_index(n), b = h.sine_index(n), c = h.size();
  const int d = law.directions(), all = d + law.auxiliary();
  ComplexMatrix D(all, all);
  for (int j = 0; j < all; ++j)
    for (int i = 0; i < all; ++i)
      D(i, j) = 0.5 * Complex(J(i * c + a, j * c + a) + J(i * c + b, j * c + b),
                              J(i * c + a, j * c + b) - J(i * c + b, j * c + a));
  if (all == d) return D;
  return D.topLeftCorner(d, d) -
         D.topRightCorner(d, all - d) * continuation::solve_complex(D.bottomRightCorner(all - d, all - d),
                                                                    D.bottomLeftCorner(all - d, d));
}

// M v = mu (K + shift M) v with the smallest shift that makes that definite.
continuation::SymmetricModes shifted_modes(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K) {
  const double size = K.cwiseAbs().maxCoeff() / std::max(M.cwiseAbs().maxCoeff(), 1e-300);
  continuation::Cholesky cholesky;
  if (cholesky.factorize(K))
    if (auto modes = continuation::symmetric_modes(M, K); modes.values.size() > 0) return modes;
  double shift = 1e-8 * size;
  for (int k = 0; k < shifts; ++k, shift *= 100) {
    if (!cholesky.factorize(K + shift * M)) continue;
    if (auto modes = continuation::symmetric_modes(M, K + shift * M); modes.values.size() > 0) return modes;
  }
  return {};
}

struct LinearizedMatrices {
  Eigen::MatrixXd M, C, K;
};

// The largest stiffness of contacts and other laws of one displacement; where a force without memory couples
// displacements, or pushes away from rest, its tangent.
Eigen::MatrixXd stiffness_at_rest(const elements::Law& law, elements::Fields fields) {
  const int d = law.directions();
  const Eigen::MatrixXd tangent = elements::tangent_at_rest(law, fields);
  if (law.memory() == 0 && (d > 1 || tangent(0, 0) < 0)) return tangent;
  Eigen::VectorXd largest(d);
  for (int i = 0; i < d; ++i) largest[i] = law.stiffness(fields, i, 0);
  return largest.asDiagonal();
}

LinearizedMatrices linearized(const HbmProblem& problem, const Vector& p, const HbmEvaluator* at,
                              double omega) {
  const model::Model& model = problem.model();
  const Vector own = p.head(static_cast<Eigen::Index>(model.parameters.size()));
  const Eigen::MatrixXd& P = problem.coordinates().P;
  LinearParts parts(model, P, problem.harmonics());
  parts.move_to(own);
  LinearizedMatrices all{parts.matrices().M, parts.matrices().C, parts.matrices().K};
  auto& [M, C, K] = all;
  if (const auto& damping = model.damping)
    C += damping->alpha_at(own) * M + (damping->beta_at(own) + damping->loss_factor_at(own) / omega) * K;
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const model::NonlinearPart& element = model.elements[e];
    const std::vector<double> fields = element.fields(own);
    const int d = element.law->directions();
    Eigen::MatrixXd E = Eigen::MatrixXd::Zero(P.cols(), d), Ke = Eigen::MatrixXd::Zero(d, d), Ce = Ke;
    for (int i = 0; i < d; ++i) {
      const DirectionInY direction(P, element.directions[static_cast<std::size_t>(i)]);
      for (const auto& [row, value] : direction.entries()) E(row, i) = value;
    }
    if (!at) {
      Ke = stiffness_at_rest(*element.law, fields);
    } else {
      const ComplexMatrix D =
          fundamental_stiffness(problem.harmonics(), *element.law, at->element(e).jacobian());
      Ke = 0.5 * (D + D.transpose()).real();
      Ce = 0.5 / omega * (D + D.transpose()).imag();
    }
    K += E * Ke * E.transpose();
    C += E * Ce * E.transpose();
  }
  return all;
}

}  // namespace

std::vector<LinearMode> linear_modes(const HbmProblem& problem, const Vector& p, const HbmEvaluator* at,
                                     double omega) {
  const auto [M, C, K] = linearized(problem, p, at, omega);
  if (!K.allFinite() || !C.allFinite()) return {};

  const auto found = shifted_modes(M, K);
  std::vector<LinearMode> modes;
  if (found.values.size() == 0) return modes;
  const double least = massless * found.values.maxCoeff();
  for (Eigen::Index j = found.values.size(); j-- > 0;) {
    if (!(found.values[j] > least)) continue;
    const Vector v = found.V.col(j).normalized();
    const double mass = v.dot(M * v), stiffness = v.dot(K * v);
    const double terms = v.cwiseAbs().dot(K.cwiseAbs() * v.cwiseAbs());
    LinearMode mode{LinearMode::Kind::oscillation, 0, 0, v, mass};
    if (std::abs(stiffness) <= rigid * terms) {
      mode.kind = LinearMode::Kind::rigid_body;
    } else if (stiffness < 0) {
      mode.kind = LinearMode::Kind::unstable;
    } else {
      mode.omega = std::sqrt(stiffness / mass);
      mode.damping_ratio = v.dot(C * v) / (2 * mode.omega * mass);
    }
    modes.push_back(std::move(mode));
  }
  return modes;
}

std::optional<DampedMode> damped_mode(const HbmProblem& problem, const Vector& p, const HbmEvaluator& at,
                                      const LinearMode& undamped, const control::Control& control) {
  const auto [M, C, K] = linearized(problem, p, &at, undamped.omega);
  if (M.rows() > most_coordinates) return {};
  DampedMode mode{undamped.omega, 0, undamped.shape.cast<Complex>()};
  Complex mu = undamped.omega * undamped.omega;  // omega^2 (1 + 2 i zeta)
  for (int step = 0; step <= damping_steps; ++step) {
    const double share = std::pow(least_damping, 1 - static_cast<double>(step) / damping_steps);
    bool converged = false;
    for (int k = 0; k < most_iterations && !converged; ++k) {  // Rayleigh quotients, of symmetric matrices
      if (!control.keep_going()) return {};
      const ComplexMatrix A = K.cast<Complex>() + Complex(0, mode.omega * share) * C.cast<Complex>();
      const ComplexMatrix v = continuation::solve_complex(A - mu * M.cast<Complex>(), M * mode.shape);
      if (converged = !v.allFinite(); converged) break;  // the shift is the eigenvalue itself
      mode.shape = v.col(0) / v.col(0).norm();
      const Complex before = mu, mass = mode.shape.conjugate().dot(M * mode.shape);
      mu = mode.shape.conjugate().dot(A * mode.shape) / mass;
      if (!(mu.real() > 0)) return {};
      mode.omega = std::sqrt(mu.real());
      converged = std::abs(mu - before) <= same_eigenvalue * std::abs(mu);
    }
    if (!converged) return {};
  }
  mode.damping_ratio = 0.5 * mu.imag() / mu.real();
  return mode;
}

Vector unknowns_of(const HbmProblem& problem, const ComplexVector& shape) {
  const elements::Harmonics& h = problem.harmonics();
  const int n = h.excited(1);
  Vector u = Vector::Zero(problem.size());
  for (int i = 0; i < problem.coordinates().unknowns; ++i) {
    u[i * h.size() + h.cosine_index(n)] = shape[i].real();
    u[i * h.size() + h.sine_index(n)] = -shape[i].imag();
  }
  return u;
}

}  // namespace arcslip::hbm

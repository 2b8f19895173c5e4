#include <arcslip/time/linear_motion.hpp>

#include <arcslip/time/event_driven.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace arcslip::time {
namespace {

constexpr double massless = 1e-13;  // smallest eigenvalue of M scaled to a unit diagonal

void require_mass(const EquationOfMotion& equation) {
  const auto fail = [&](Eigen::Index i) {
    const auto& names = equation.dof_names;
    const std::string name = i < static_cast<Eigen::Index>(names.size())
                                 ? "\"" + names[static_cast<std::size_t>(i)] + "\""
                                 : "number " + std::to_string(i + 1);
    throw SingularMass(
        "degree of freedom " + name +
        " has no mass of its own (M is singular); an integration in time between events needs one");
  };
  const Vector diagonal = equation.M.diagonal();
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    if (!(diagonal[i] > 0)) fail(i);
  const Vector scale = diagonal.cwiseSqrt().cwiseInverse();
  const auto modes = continuation::symmetric_modes(scale.asDiagonal() * equation.M * scale.asDiagonal());
  if (modes.values[0] > massless) return;
  Eigen::Index i = 0;
  (scale.asDiagonal() * modes.V.col(0)).cwiseAbs().maxCoeff(&i);
  fail(i);
}

// Largest |eigenvalue| of A over M.
double largest_over(const continuation::Cholesky& mass, const Matrix& A) {
  return continuation::symmetric_eigenvalues(mass.reduced(A)).cwiseAbs().maxCoeff();
}

}  // namespace

LinearMotion::LinearMotion(const EquationOfMotion& equation) : equation_(equation) {
  require_mass(equation);
  const int n = equation.dofs();
  mass_.factorize(equation.M);
  stiffness_ = mass_.solve(equation.K);
  damping_ = mass_.solve(equation.C);
  Matrix stuck = equation.K;
  for (const Element& element : equation.elements) {
    over_mass_.push_back(mass_.solve(element.direction));
    stuck_.push_back(0);
    if (element.slip_limit > 0)
      stuck += element.stiffness * element.direction * element.direction.transpose();
  }
  // Every contact state lies between K and K with all elements stuck.
  double fastest = std::sqrt(std::max(largest_over(mass_, equation.K), largest_over(mass_, stuck))) +
                   largest_over(mass_, equation.C);
  for (const HarmonicForce& force : equation.forces)
    fastest = std::max(fastest, force.harmonic * equation.omega);
  longest_ = fastest > 0 ? 1 / fastest : std::numeric_limits<double>::infinity();
  X_.resize(order + 1);
  V_.resize(order + 1);
  force_.setZero(n, order + 1);
  acceleration_.setZero(n, order + 1);
  hilbert_ = Matrix::NullaryExpr(order + 1, order + 1, [](Eigen::Index i, Eigen::Index j) {
    return 1.0 / static_cast<double>(i + j + 1);
  });
}

void LinearMotion::set_stuck(std::size_t e, bool stuck) {
  if (static_cast<bool>(stuck_[e]) == stuck) return;
  stuck_[e] = stuck;
  stiffness_ = mass_.solve(equation_.K);  // anew: a sum that grows and shrinks would gather rounding
  for (std::size_t i = 0; i < stuck_.size(); ++i)
    if (stuck_[i])
      stiffness_ +=
          equation_.elements[i].stiffness * over_mass_[i] * equation_.elements[i].direction.transpose();
}

void LinearMotion::expand_force(double t, double h) {
  force_.setZero();
  for (const HarmonicForce& part : equation_.forces) {
    const double rate = part.harmonic * equation_.omega;
    std::complex<double> c = std::complex<double>(part.cosine, -part.sine) * std::polar(1.0, rate * t);
    for (int k = 0; k <= order; ++k) {
      force_.col(k) += c.real() * part.direction;
      c *= std::complex<double>(0, rate * h / (k + 1));
    }
  }
  acceleration_ = force_;
  mass_.solve_in_place(acceleration_);
}

void LinearMotion::expand(double t, double h, const Matrix& X, const Matrix& V, const Matrix& g) {
  h_ = h;
  expand_force(t, h);
  X_[0] = X;
  V_[0] = V;
  for (std::size_t k = 0; k < order; ++k) {
    const double factor = h / static_cast<double>(k + 1);
    X_[k + 1] = factor * V_[k];
    Matrix& next = V_[k + 1];
    next.noalias() = -stiffness_ * X_[k];
    next.noalias() -= damping_ * V_[k];
    next.col(0) += acceleration_.col(static_cast<Eigen::Index>(k));
    if (k == 0)
      for (std::size_t e = 0; e < over_mass_.size(); ++e)
        next.noalias() += over_mass_[e] * g.row(static_cast<Eigen::Index>(e));
    next *= factor;
  }
}

void LinearMotion::at(double s, Matrix& X, Matrix& V) const {
  X = X_[order];
  V = V_[order];
  for (std::size_t k = order; k-- > 0;) {
    X = s * X + X_[k];
    V = s * V + V_[k];
  }
}

Eigen::RowVectorXd LinearMotion::along(const Vector& d, double s) const {
  Eigen::RowVectorXd q = d.transpose() * X_[order];
  for (std::size_t k = order; k-- > 0;) q = s * q + d.transpose() * X_[k];
  return q;
}

namespace {

double project(const std::vector<Matrix>& terms, const Vector& d, LinearMotion::Series& c) {
  double size = 0;
  for (std::size_t k = 0; k < c.size(); ++k) {
    c[k] = d.dot(terms[k].col(0));
    size += d.cwiseAbs().dot(terms[k].col(0).cwiseAbs());
  }
  return size;
}

}  // namespace

double LinearMotion::displacement(const Vector& d, Series& c) const {
  return project(X_, d, c);
}

double LinearMotion::velocity(const Vector& d, Series& c) const {
  return project(V_, d, c);
}

LinearMotion::Work LinearMotion::work(double s) const {
  Matrix velocity(force_.rows(), order + 1), force = force_;
  double power = 1;
  for (int k = 0; k <= order; ++k, power *= s) {
    velocity.col(k) = power * V_[static_cast<std::size_t>(k)].col(0);
    force.col(k) *= power;
  }
  const Matrix integrated = h_ * s * velocity * hilbert_;
  return {force.cwiseProduct(integrated).sum(), (equation_.C * velocity).cwiseProduct(integrated).sum()};
}

}  // namespace arcslip::time

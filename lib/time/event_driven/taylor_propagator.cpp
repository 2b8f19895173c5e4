#include <arcslip/time/event_driven/taylor_propagator.hpp>

#include <arcslip/control/run_control.hpp>
#include <arcslip/time/event_driven/event_driven.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

namespace arcslip::time {
namespace {

constexpr double long_term = 5e7;  // multiplications by the stiffness in a term of the series: some 20 ms
constexpr double singular_mass = 1e-13;  // smallest eigenvalue of M scaled to a unit diagonal

void require_mass(const EquationOfMotion& equation) {
  const auto fail = [&](Eigen::Index i) {
    const auto& names = equation.dof_names;
    const std::string name = i < static_cast<Eigen::Index>(names.size())
                                 ? "\"" + names[static_cast<std::size_t>(i)] + "\""
                                 : "number " + std::to_string(i + 1);
    throw SingularMass("degree of freedom " + name + " has no mass of its own (M is singular)");
  };
  const Vector diagonal = equation.M.diagonal();
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    if (!(diagonal[i] > 0)) fail(i);
  const Vector scale = diagonal.cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * equation.M * scale.asDiagonal();
  const Vector values = continuation::symmetric_eigenvalues(scaled);
  if (values.size() == 0) fail(0);  // overflow
  if (values[0] > singular_mass) return;
  Eigen::Index i = 0;
  (scale.asDiagonal() * continuation::symmetric_modes(scaled).V.col(0)).cwiseAbs().maxCoeff(&i);
  fail(i);
}

// values: none where a matrix overflowed.
double largest_magnitude(const Vector& values) {
  if (values.size() == 0)
    throw SingularMass("a mass is so small that the stiffness or the damping over it overflows");
  return values.cwiseAbs().maxCoeff();
}

// The norm of a symmetric A over M: its largest |eigenvalue|. Without symmetry an upper bound of the norm.
double largest_over(const continuation::Cholesky& mass, const Matrix& A) {
  if (A == A.transpose()) return largest_magnitude(continuation::symmetric_eigenvalues(mass.reduced(A)));
  const Matrix even = mass.reduced(0.5 * (A + A.transpose())), skew = mass.reduced(0.5 * (A - A.transpose()));
  return largest_magnitude(continuation::symmetric_eigenvalues(even)) +
         largest_magnitude(continuation::singular_values(skew).values);
}

// A diagonal matrix above (sign 1) all stiffnesses of a part, or below (-1) them, and 0: by the sums of the
// rows' absolute values, where there are several directions.
Matrix bound(const LinearMotion::Part& part, double sign) {
  const Eigen::Index d = part.directions.cols();
  Vector most = Vector::Zero(d);
  for (const Matrix& stiffness : part.stiffnesses)
    for (Eigen::Index i = 0; i < d; ++i) {
      const Matrix T = 0.5 * (stiffness + stiffness.transpose());
      const double nearby = T.row(i).cwiseAbs().sum() - std::abs(T(i, i));
      most[i] = std::max(most[i], sign * T(i, i) + nearby);
    }
  return sign * most.asDiagonal();
}

// The largest norm of the skew parts of its stiffnesses, in the norm that M makes.
double largest_skew(const continuation::Cholesky& mass, const LinearMotion::Part& part) {
  double most = 0;
  for (const Matrix& T : part.stiffnesses) most = std::max(most, 0.5 * (T - T.transpose()).norm());
  if (most == 0) return 0;
  return most * largest_over(mass, part.directions * part.directions.transpose());
}

}  // namespace

std::optional<double> fastest(const EquationOfMotion& equation, const std::vector<LinearMotion::Part>& parts,
                              const control::Control& control) {
  const auto stopped = [&, n = static_cast<double>(equation.dofs())] {
    return n * n * n > long_term && !control.keep_going();
  };
  if (stopped()) return {};
  require_mass(equation);
  continuation::Cholesky mass;
  mass.factorize(equation.M);
  Matrix stiffest = equation.K, softest = equation.K;
  double skew = 0;
  for (const LinearMotion::Part& part : parts) {
    stiffest += part.directions * bound(part, 1) * part.directions.transpose();
    softest += part.directions * bound(part, -1) * part.directions.transpose();
    if (stopped()) return {};
    skew += largest_skew(mass, part);
  }
  // Whatever the modes, the symmetric part of K' lies between these two.
  double most = 0;
  for (const Matrix* K : {&softest, &stiffest}) {
    if (stopped()) return {};
    most = std::max(most, largest_over(mass, *K));
  }
  if (stopped()) return {};
  return std::sqrt(most + skew) + largest_over(mass, equation.C);
}

LinearMotion::LinearMotion(const EquationOfMotion& equation, std::vector<Part> parts,
                           const control::Control& control)
    : equation_(equation), parts_(std::move(parts)) {
  const auto highest = fastest(equation, parts_, control);
  stopped_ = !highest;
  if (stopped_) return;
  double most = *highest;
  const int n = equation.dofs();
  mass_.factorize(equation.M);
  stiffness_ = mass_.solve(equation.K);
  damping_ = mass_.solve(equation.C);
  circulatory_ = equation.circulatory();
  for (const Part& part : parts_) {
    over_mass_.push_back(mass_.solve(part.directions));
    const Eigen::Index d = part.directions.cols();
    in_modes_.push_back(Matrix::Zero(d, d));
    mode_rates_.emplace_back();
  }
  for (const HarmonicForce& force : equation.forces) most = std::max(most, force.harmonic * equation.omega);
  longest_ = most > 0 ? 1 / most : std::numeric_limits<double>::infinity();
  X_.resize(order + 1);
  V_.resize(order + 1);
  force_.setZero(n, order + 1);
  acceleration_.setZero(n, order + 1);
  force_rate_.setZero(n, order + 1);
  hilbert_ = Matrix::NullaryExpr(order + 1, order + 1, [](Eigen::Index i, Eigen::Index j) {
    return 1.0 / static_cast<double>(i + j + 1);
  });
}

void LinearMotion::vary(const EquationRates* rates) {
  rates_ = rates;
  if (stopped_ || !rates) return;
  const auto over_mass = [&](const Matrix& A) { return A.size() > 0 ? Matrix(mass_.solve(A)) : Matrix(); };
  mass_rate_ = over_mass(rates->M);
  damping_rate_ = over_mass(rates->C);
  stiffness_rate_ = over_mass(rates->K);
}

void LinearMotion::set_stiffness(std::size_t a, const Matrix& stiffness, const Matrix* rate) {
  if (stopped_) return;
  mode_rates_[a] = rate && !rate->isZero(0) ? *rate : Matrix();
  if (in_modes_[a] == stiffness) return;
  in_modes_[a] = stiffness;
  stiffness_ = mass_.solve(equation_.K);  // anew: a sum that grows and shrinks would gather rounding
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (!in_modes_[i].isZero(0))
      stiffness_ += over_mass_[i] * in_modes_[i] * parts_[i].directions.transpose();
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

void LinearMotion::expand_force_rate(double t, double h) {
  force_rate_.setZero();
  // visit(k, c, c before) for each term of c exp(i n omega (t + s h)).
  const auto each_term = [&](const HarmonicForce& part, auto&& visit) {
    const double rate = part.harmonic * equation_.omega;
    std::complex<double> before,
        c = std::complex<double>(part.cosine, -part.sine) * std::polar(1.0, rate * t);
    for (int k = 0; k <= order; ++k) {
      visit(k, c, before);
      before = c;
      c *= std::complex<double>(0, rate * h / (k + 1));
    }
  };
  if (rates_->omega != 0)
    for (const HarmonicForce& part : equation_.forces)
      each_term(part, [&](int k, std::complex<double> c, std::complex<double> before) {
        force_rate_.col(k) -=
            rates_->omega * part.harmonic * (t * c.imag() + h * before.imag()) * part.direction;
      });
  for (const HarmonicForce& part : rates_->forces)
    each_term(part, [&](int k, std::complex<double> c, std::complex<double>) {
      force_rate_.col(k) += c.real() * part.direction;
    });
  mass_.solve_in_place(force_rate_);
}

// Term k of what drives the variation with the parameter; next: x''_k of the motion in its first column.
void LinearMotion::add_rate(std::size_t k, Matrix& next) const {
  auto last = next.rightCols(1);
  last += force_rate_.col(static_cast<Eigen::Index>(k));
  if (mass_rate_.size() > 0) last.noalias() -= mass_rate_ * next.col(0);
  if (damping_rate_.size() > 0) last.noalias() -= damping_rate_ * V_[k].col(0);
  if (stiffness_rate_.size() > 0) last.noalias() -= stiffness_rate_ * X_[k].col(0);
  for (std::size_t a = 0; a < parts_.size(); ++a)
    if (mode_rates_[a].size() > 0)
      last.noalias() -= over_mass_[a] * (mode_rates_[a] * (parts_[a].directions.transpose() * X_[k].col(0)));
}

bool LinearMotion::expand(double t, double h, const Matrix& X, const Matrix& V, const Matrix& g,
                          const control::Control& control) {
  const double multiplications = static_cast<double>(stiffness_.size()) * static_cast<double>(X.cols());
  const bool takes_long = control.can_end() && multiplications > long_term;
  t_ = t;
  h_ = h;
  expand_force(t, h);
  if (rates_) expand_force_rate(t, h);
  X_[0] = X;
  V_[0] = V;
  for (std::size_t k = 0; k < order; ++k) {
    if (takes_long && !control.keep_going()) return false;
    const double factor = h / static_cast<double>(k + 1);
    X_[k + 1] = factor * V_[k];
    Matrix& next = V_[k + 1];
    next.noalias() = -stiffness_ * X_[k];
    next.noalias() -= damping_ * V_[k];
    next.col(0) += acceleration_.col(static_cast<Eigen::Index>(k));
    if (k == 0) {
      Eigen::Index row = 0;
      for (const Matrix& D : over_mass_) {
        next.noalias() += D * g.middleRows(row, D.cols());
        row += D.cols();
      }
    }
    if (rates_) add_rate(k, next);
    next *= factor;
  }
  return true;
}

void LinearMotion::at(double s, Matrix& X, Matrix& V) const {
  X = X_[order];
  V = V_[order];
  for (std::size_t k = order; k-- > 0;) {
    X = s * X + X_[k];
    V = s * V + V_[k];
  }
}

Vector LinearMotion::acceleration(double s) const {
  Vector a = order * V_[order].col(0);
  for (std::size_t k = order - 1; k > 0; --k) a = s * a + static_cast<double>(k) * V_[k].col(0);
  return a / h_;
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

void LinearMotion::observed(Series& x, Series& v) const {
  displacement(equation_.response, x);
  velocity(equation_.response, v);
  for (const BaseMotion& part : equation_.base) {
    const std::complex<double> rate(0, part.harmonic * equation_.omega);
    std::complex<double> c = std::complex<double>(part.cosine, -part.sine) * std::exp(rate * t_);
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] += c.real();
      v[k] += (rate * c).real();
      c *= rate * h_ / static_cast<double>(k + 1);
    }
  }
}

LinearMotion::Work LinearMotion::work(double s) const {
  Matrix velocity(force_.rows(), order + 1), force = force_;
  double power = 1;
  for (int k = 0; k <= order; ++k, power *= s) {
    velocity.col(k) = power * V_[static_cast<std::size_t>(k)].col(0);
    force.col(k) *= power;
  }
  const Matrix integrated = h_ * s * velocity * hilbert_;
  Work work{force.cwiseProduct(integrated).sum(), (equation_.C * velocity).cwiseProduct(integrated).sum()};
  if (circulatory_.size() == 0) return work;
  Matrix displacement(force_.rows(), order + 1);
  power = 1;
  for (int k = 0; k <= order; ++k, power *= s)
    displacement.col(k) = power * X_[static_cast<std::size_t>(k)].col(0);
  work.viscous += (circulatory_ * displacement).cwiseProduct(integrated).sum();
  return work;
}

}  // namespace arcslip::time

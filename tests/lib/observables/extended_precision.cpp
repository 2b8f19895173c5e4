#include "lib/observables/extended_precision.hpp"

#include <arcslip/elements/contact_2d.hpp>
#include <arcslip/elements/gap_spring.hpp>
#include <arcslip/elements/jenkins.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace extended {

using namespace arcslip;

namespace {

constexpr Real pi = std::numbers::pi_v<Real>, turn = 2 * pi;
constexpr Real touching = 1e-9L;  // rad: roots of a pair that is nearer change an integral by its cube

// Nodes and weights of Gauss and Legendre on [-1, 1].
constexpr int nodes = 16;
const std::array<std::pair<Real, Real>, nodes>& gauss() {
  static const auto rule = [] {
    std::array<std::pair<Real, Real>, nodes> all;
    for (int i = 0; i < nodes; ++i) {
      Real x = std::cos(pi * (static_cast<Real>(i) + 0.75L) / (nodes + 0.5L)), slope = 0;
      for (int newton = 0; newton < 10; ++newton) {
        Real before = 1, value = x;
        for (int k = 2; k <= nodes; ++k)
          before = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * before) / k);
        slope = nodes * (x * value - before) / (x * x - 1);
        x -= value / slope;
      }
      all[static_cast<std::size_t>(i)] = {x, 2 / ((1 - x * x) * slope * slope)};
    }
    return all;
  }();
  return rule;
}

Complex unit(Real theta) {
  return {std::cos(theta), std::sin(theta)};
}

// The root in [a, b], where g has one sign at a (or is 0 there) and the other at b.
Real bisected(const Series& g, const Series& rate, Real level, Real a, Real b) {
  const Real at_a = g.value(a) - level;
  if (at_a == 0) return a;
  const bool rises = at_a < 0;
  Real theta = (a + b) / 2;
  for (int i = 0; i < 200 && b > a; ++i) {
    const Real value = g.value(theta) - level;
    if (value == 0) return theta;
    ((value < 0) == rises ? a : b) = theta;
    const Real newton = theta - value / rate.value(theta);
    const Real next = newton > a && newton < b ? newton : (a + b) / 2;
    if (std::abs(next - theta) <= 1e-19L * turn || next == a || next == b) return next;
    theta = next;
  }
  return theta;
}

}  // namespace

const char* name(State state) {
  constexpr const char* names[] = {"slip", "stick", "open", "closed", "several"};
  return names[static_cast<int>(state)];
}

Series::Series(std::vector<Complex> X) : X_(std::move(X)) {
  for (const Complex& each : X_) bound_ += std::abs(each);
}

Real Series::value(Real theta) const {
  const Complex step = unit(theta);
  Complex sum = 0;
  for (std::size_t n = X_.size(); n-- > 1;) sum = (sum + X_[n]) * step;
  return X_[0].real() + sum.real();
}

Series Series::rate() const {
  std::vector<Complex> dX(X_.size());
  for (std::size_t n = 0; n < X_.size(); ++n) dX[n] = Complex(0, static_cast<Real>(n)) * X_[n];
  return Series(std::move(dX));
}

Series Series::times(Real factor) const {
  std::vector<Complex> X = X_;
  for (Complex& each : X) each *= factor;
  return Series(std::move(X));
}

Series Series::plus(const Series& other) const {
  std::vector<Complex> X = X_;
  for (std::size_t n = 0; n < X.size(); ++n) X[n] += other.X_[n];
  return Series(std::move(X));
}

Series Series::plus(Real constant) const {
  std::vector<Complex> X = X_;
  X[0] += constant;
  return Series(std::move(X));
}

std::vector<Real> Series::roots(Real begin) const {
  const Series first = rate();
  const Real steepest = first.bound(), most_bent = first.rate().bound();
  std::vector<Real> found;
  if (steepest == 0) return found;
  const auto search = [&](auto&& self, Real a, Real b, Real at_a, Real at_b) -> void {
    const Real middle = (a + b) / 2, half = (b - a) / 2, at_middle = value(middle);
    if (std::abs(at_middle) > steepest * half) return;
    const bool changes = (at_a <= 0) != (at_b <= 0);
    if (half < touching || std::abs(first.value(middle)) > most_bent * half) {
      if (changes) found.push_back(bisected(*this, first, 0, a, b));
      return;
    }
    self(self, a, middle, at_a, at_middle);
    self(self, middle, b, at_middle, at_b);
  };
  const int pieces = 4 * order();
  const Real at_begin = value(begin);
  Real a = begin, at_a = at_begin;
  for (int i = 1; i <= pieces; ++i) {
    const Real b = begin + turn * static_cast<Real>(i) / static_cast<Real>(pieces);
    const Real at_b = i == pieces ? at_begin : value(b);
    search(search, a, b, at_a, at_b);
    a = b;
    at_a = at_b;
  }
  return found;
}

std::pair<Real, Real> Series::range() const {
  Real high = value(0), low = high;
  for (const Real theta : rate().roots(0.1L)) {
    high = std::max(high, value(theta));
    low = std::min(low, value(theta));
  }
  return {high, low};
}

namespace {

// One element over a period: the coefficients of its forces, conjugate as those of a Series.
struct Forces {
  std::vector<Complex> tangential, normal;
  Real work = 0;                                      // J per period
  Real tangential_rounding = 0, normal_rounding = 0;  // N
  Real tangential_preload = 0, normal_preload = 0;    // N: Evaluation::preload
  State state = State::several;
};

struct Law {
  Real k_t, mu, k_n, N_0;
};

class March {
 public:
  March(const Law& law, const Series& x_t, const Series& x_n) : law_(law), x_t_(x_t), x_n_(x_n) {
    const Series& any = x_t.empty() ? x_n : x_t;
    order_ = any.order();
    const Series none(std::vector<Complex>(static_cast<std::size_t>(order_ + 1)));
    N_ = (x_n.empty() ? none : x_n.times(law.k_n)).plus(law.N_0);
    forces_.tangential.resize(static_cast<std::size_t>(order_ + 1));
    forces_.normal.resize(static_cast<std::size_t>(order_ + 1));
  }

  Forces run() {
    const Real at_rest = std::max(law_.N_0, Real(0));
    const auto [highest, lowest] = N_.range();
    const bool closed = lowest > 0, open = highest <= 0;
    if (!x_n_.empty()) normal(closed, open, at_rest);
    if (x_t_.empty()) {
      forces_.state = closed ? State::closed : open ? State::open : State::several;
      return forces_;
    }
    forces_.state = open ? State::open : State::several;
    if (open) return forces_;
    if (law_.mu == 0) {
      if (closed) forces_.state = State::slip;
      return forces_;
    }
    tangential(closed);
    return forces_;
  }

 private:
  void normal(bool closed, bool open, Real at_rest) {
    if (open) {
      forces_.normal[0] = -at_rest;
      forces_.normal_rounding = at_rest;
      return;
    }
    if (closed && at_rest > 0) {
      for (int n = 0; n <= order_; ++n) forces_.normal[static_cast<std::size_t>(n)] = law_.k_n * x_n_[n];
      forces_.normal_rounding = law_.k_n * x_n_.bound();
      forces_.normal_preload = at_rest;
      return;
    }
    const auto ends = period(N_.roots(0.1L));
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
      if (N_.value((ends[i] + ends[i + 1]) / 2) > 0)
        add(
            ends[i], ends[i + 1], [&](Real theta) { return N_.value(theta); }, forces_.normal);
    forces_.normal[0] -= at_rest;
    forces_.normal_rounding = std::abs(law_.N_0) + law_.k_n * x_n_.bound();
  }

  void tangential(bool closed) {
    const Series h = N_.times(law_.mu / law_.k_t);
    const Series lower = x_t_.plus(h.times(-1)), upper = x_t_.plus(h);
    if (closed) {
      const Real a = lower.range().first, b = upper.range().second;
      if (a <= b) {
        for (int n = 0; n <= order_; ++n)
          forces_.tangential[static_cast<std::size_t>(n)] = law_.k_t * x_t_[n];
        forces_.tangential[0] -= law_.k_t * (a + b) / 2;
        forces_.tangential_rounding = law_.k_t * x_t_.moving() + law_.mu * N_.moving();
        forces_.tangential_preload =
            law_.k_t * std::abs(x_t_[0]) + law_.mu * (std::abs(law_.N_0) + std::abs(N_[0] - law_.N_0));
        forces_.state = State::stick;
        return;
      }
    }
    forces_.tangential_rounding =
        law_.k_t * x_t_.bound() +
        law_.mu * (std::abs(law_.N_0) + (law_.k_n > 0 ? law_.k_n * x_n_.bound() : 0));
    std::vector<Real> all = N_.roots(0.1L);
    for (const Series* bound : {&lower, &upper})
      for (const Real theta : bound->rate().roots(0.1L)) all.push_back(theta);
    std::sort(all.begin(), all.end());
    const auto ends = period(all);
    const Series lower_rate = lower.rate(), upper_rate = upper.rate(), rate = x_t_.rate();
    Real w = x_t_.value(ends.front());
    for (const bool counts : {false, true}) {
      for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const Real a = ends[i], b = ends[i + 1];
        if (!(b > a)) continue;
        if (N_.value((a + b) / 2) <= 0) {
          w = x_t_.value(b);
          continue;
        }
        const Real low = lower.value(b), high = upper.value(b);
        // The bound that carries the slider first.
        const Real from_below = low > w ? onset(lower, lower_rate, w, a, b) : b;
        const Real from_above = high < w ? onset(upper, upper_rate, w, a, b) : b;
        const Real begin = std::min(from_below, from_above);
        const Real sign = low > w && from_below <= from_above ? 1 : -1;
        if (counts) {
          add_tangential(a, begin, rate, [&](Real theta) { return law_.k_t * (x_t_.value(theta) - w); });
          add_tangential(begin, b, rate, [&](Real theta) { return sign * law_.mu * N_.value(theta); });
        }
        if (low > w || high < w) w = sign > 0 ? low : high;
      }
    }
  }

  // Where a monotonic bound reaches w in [a, b].
  static Real onset(const Series& bound, const Series& rate, Real w, Real a, Real b) {
    const bool reached = (bound.value(a) - w) * (bound.value(b) - w) >= 0;
    return reached ? a : bisected(bound, rate, w, a, b);
  }

  // The period from the first of these angles on, with the last one a turn later.
  static std::vector<Real> period(std::vector<Real> angles) {
    if (angles.empty()) angles.push_back(0);
    angles.push_back(angles.front() + turn);
    return angles;
  }

  template <class Force>
  void add_tangential(Real a, Real b, const Series& rate, const Force& force) {
    std::vector<Complex> by_rate(1);
    add(a, b, force, forces_.tangential);
    add(
        a, b, [&](Real theta) { return force(theta) * rate.value(theta); }, by_rate);
    forces_.work += turn * by_rate[0].real();
  }

  // F_n += integral of f exp(-i n theta) over pi, of the mean over 2 pi.
  template <class Function>
  void add(Real a, Real b, const Function& f, std::vector<Complex>& F) const {
    if (!(b > a)) return;
    const int panels = 1 + static_cast<int>((b - a) * static_cast<Real>(std::max(order_, 1)) / pi);
    const Real half = (b - a) / static_cast<Real>(2 * panels);
    for (int panel = 0; panel < panels; ++panel)
      for (const auto& [x, weight] : gauss()) {
        const Real theta = a + half * (static_cast<Real>(2 * panel + 1) + x);
        const Complex step = unit(-theta);
        Complex power = weight * half * f(theta) / pi;
        F[0] += power / Real(2);
        for (std::size_t n = 1; n < F.size(); ++n) F[n] += (power *= step);
      }
  }

  Law law_;
  const Series &x_t_, &x_n_;
  Series N_;
  int order_ = 0;
  Forces forces_;
};

// The inverse of a symmetric matrix, in units in which its terms are of one size.
ComplexMatrix inverted(const ComplexMatrix& Z, const Matrix& magnitude) {
  Vector unit(Z.rows());
  for (Eigen::Index i = 0; i < unit.size(); ++i)
    unit[i] = magnitude(i, i) > 0 ? 1 / std::sqrt(magnitude(i, i)) : Real(1);
  const ComplexMatrix scaled = unit.asDiagonal() * Z * unit.asDiagonal();
  return unit.asDiagonal() * ComplexMatrix(scaled.inverse()) * unit.asDiagonal();
}

// Directions of parts have small integers as weights; the library has the inverse of a matrix of such.
Real as_written(double weight) {
  const double nearest = std::round(weight);
  return std::abs(weight - nearest) < 1e-9 ? nearest : weight;
}

}  // namespace

Equations::Equations(const scene::Scene& scene, const hbm::HbmProblem& problem)
    : h_(problem.harmonics()), unknowns_(problem.coordinates().unknowns) {
  const Eigen::MatrixXd& P = problem.coordinates().P;
  const Eigen::MatrixXd inverse = P.inverse();
  // Rows b_j: the unknowns are b_j . x. The library's coordinates x = P y, with the unknowns first, but for
  // the rounding of B^T P = (1 0).
  Matrix B(P.rows(), unknowns_);
  for (Eigen::Index j = 0; j < unknowns_; ++j)
    for (Eigen::Index i = 0; i < P.rows(); ++i) B(i, j) = as_written(inverse(j, i));
  Matrix coordinates = P.cast<Real>();
  Matrix defect = B.transpose() * coordinates;
  defect.leftCols(unknowns_) -= Matrix::Identity(unknowns_, unknowns_);
  coordinates -= B * (B.transpose() * B).inverse() * defect;
  const auto in_coordinates = [&](const scene::Direction& d) -> Vector {
    Vector full = Vector::Zero(P.rows());
    for (const auto& term : d) full[term.dof] += term.weight;
    return coordinates.transpose() * full;
  };
  const auto take = [&](const std::vector<scene::Part>& parts, std::vector<Part>& to) {
    for (const auto& part : parts) to.push_back({part.values[0], in_coordinates(part.directions[0])});
  };
  take(scene.masses, masses_);
  take(scene.dampers, dampers_);
  take(scene.springs, springs_);
  for (const auto& part : scene.excitation)
    forces_.push_back({h_.excited(part.harmonic),
                       Complex(part.values[0], part.harmonic == 0 ? 0 : -part.values[1]),
                       in_coordinates(part.directions[0])});
  for (const auto& part : scene.elements) {
    const auto& v = part.values;
    Element element;
    if (part.type == &elements::jenkins())
      element = {v[0], v[1], 0, v[2], in_coordinates(part.directions[0]), {}};
    else if (part.type == &elements::gap_spring())
      element = {0, 0, v[0], -static_cast<Real>(v[0]) * v[1], {}, in_coordinates(part.directions[0])};
    else if (part.type == &elements::contact_2d())
      element = {
          v[0], v[2], v[1], v[3], in_coordinates(part.directions[0]), in_coordinates(part.directions[1])};
    else
      throw std::invalid_argument("no law for the element " + part.name);
    elements_.push_back(std::move(element));
  }
  response_ = in_coordinates(scene.response());
}

Series Equations::along(const Vector& direction, const ComplexMatrix& y) const {
  if (direction.size() == 0) return {};
  std::vector<Complex> X(static_cast<std::size_t>(h_.order + 1));
  for (int n = 0; n <= h_.order; ++n)
    for (Eigen::Index i = 0; i < direction.size(); ++i)
      X[static_cast<std::size_t>(n)] += direction[i] * y(i, n);
  return Series(std::move(X));
}

Evaluation Equations::at(const Eigen::VectorXd& u, double omega) const {
  const Eigen::Index all = response_.size(), linear = all - unknowns_;
  const Real base = static_cast<Real>(omega) / h_.period;
  ComplexMatrix y = ComplexMatrix::Zero(all, h_.order + 1), R = y;
  Matrix size = Matrix::Zero(all, h_.order + 1);  // of the terms of R
  Vector preload = Vector::Zero(all);
  for (Eigen::Index i = 0; i < unknowns_; ++i)
    for (int n = 0; n <= h_.order; ++n)
      if (h_.has(n))
        y(i, n) =
            Complex(u[i * h_.size() + h_.cosine_index(n)], n == 0 ? 0 : -u[i * h_.size() + h_.sine_index(n)]);
  Evaluation result;
  for (int n = 0; n <= h_.order; ++n) {
    if (!h_.has(n)) continue;
    const Real w = static_cast<Real>(n) * base;
    ComplexMatrix Z = ComplexMatrix::Zero(all, all);
    Matrix magnitude = Matrix::Zero(all, all);
    const auto add = [&](const std::vector<Part>& parts, Complex factor) {
      for (const Part& part : parts) {
        Z += (factor * part.value) * (part.direction * part.direction.transpose()).cast<Complex>();
        magnitude += (std::abs(factor) * std::abs(part.value)) *
                     (part.direction.cwiseAbs() * part.direction.cwiseAbs().transpose());
      }
    };
    add(springs_, 1);
    add(masses_, -w * w);
    add(dampers_, Complex(0, w));
    ComplexVector f = ComplexVector::Zero(all);
    Vector f_size = Vector::Zero(all);
    for (const Force& force : forces_)
      if (force.order == n) {
        f += force.amplitude * force.direction.cast<Complex>();
        f_size += std::abs(force.amplitude) * force.direction.cwiseAbs();
      }
    Vector y_error = Vector::Zero(all);  // of the coordinates that no element sees, over the unit of rounding
    if (linear > 0) {
      const ComplexMatrix inverse =
          inverted(Z.bottomRightCorner(linear, linear), magnitude.bottomRightCorner(linear, linear));
      y.col(n).tail(linear) =
          inverse * (f.tail(linear) - Z.bottomLeftCorner(linear, unknowns_) * y.col(n).head(unknowns_));
      y_error.tail(linear) =
          inverse.cwiseAbs() * (f_size.tail(linear) + magnitude.bottomRows(linear) * y.col(n).cwiseAbs());
    }
    R.col(n) = Z * y.col(n) - f;
    size.col(n) = f_size + magnitude * y.col(n).cwiseAbs() + Z.cwiseAbs() * y_error;
    const Complex speed(0, static_cast<Real>(n));
    for (const Part& damper : dampers_) {
      Complex elongation = 0;
      for (Eigen::Index i = 0; i < all; ++i) elongation += damper.direction[i] * y(i, n);
      result.viscous += pi * static_cast<Real>(n) * w * damper.value * std::norm(elongation);
    }
    const Complex power = (f.conjugate().transpose() * (speed * y.col(n)))(0);
    result.input += pi * power.real();
    for (Eigen::Index i = 0; i < all; ++i)
      result.energy_rounding += pi * static_cast<Real>(n) * size(i, n) * std::abs(y(i, n));
  }
  for (const Element& element : elements_) {
    const Series x_t = along(element.tangential, y), x_n = along(element.normal, y);
    const Forces forces = March({element.k_t, element.mu, element.k_n, element.N_0}, x_t, x_n).run();
    result.states.push_back(forces.state);
    result.friction += forces.work;
    const auto add = [&](const Vector& direction, const std::vector<Complex>& F, Real rounding, Real cancels,
                         const Series& x) {
      if (direction.size() == 0) return;
      preload += cancels * direction.cwiseAbs();
      for (int n = 0; n <= h_.order; ++n) {
        if (!h_.has(n)) continue;
        R.col(n) += F[static_cast<std::size_t>(n)] * direction.cast<Complex>();
        size.col(n) += rounding * direction.cwiseAbs();
        result.energy_rounding += pi * static_cast<Real>(n) * rounding * std::abs(x[n]);
      }
    };
    add(element.tangential, forces.tangential, forces.tangential_rounding, forces.tangential_preload, x_t);
    add(element.normal, forces.normal, forces.normal_rounding, forces.normal_preload, x_n);
  }
  result.residual.resize(u.size());
  result.rounding.resize(u.size());
  result.preload = Eigen::VectorXd::Zero(u.size());
  for (Eigen::Index i = 0; i < unknowns_; ++i)
    for (int n = 0; n <= h_.order; ++n) {
      if (!h_.has(n)) continue;
      const auto put = [&](int index, Real value) {
        result.residual[i * h_.size() + index] = static_cast<double>(value);
        result.rounding[i * h_.size() + index] = static_cast<double>(size(i, n));
      };
      put(h_.cosine_index(n), R(i, n).real());
      if (n > 0) put(h_.sine_index(n), -R(i, n).imag());
      if (n == 0) result.preload[i * h_.size()] = static_cast<double>(preload[i]);
    }
  const Series x = along(response_, y);
  const auto [high, low] = x.range();
  result.amplitude = std::max(high, -low);
  for (int n = 0; n <= h_.order; ++n)
    result.amplitude_rounding += (response_.cwiseAbs().transpose() * y.col(n).cwiseAbs())(0);
  return result;
}

Linear Equations::linear(const Evaluation& at, double omega) const {
  const std::vector<State>& states = at.states;
  const Eigen::Index all = response_.size();
  int order = 0;
  for (const Force& force : forces_) {
    if (force.order == 0 || force.amplitude == Complex(0)) continue;
    if (order != 0 && force.order != order) throw std::invalid_argument("forces in several harmonics");
    order = force.order;
  }
  ComplexVector y = ComplexVector::Zero(all);  // of that order
  Linear result;
  const auto solve = [&](int n, const Vector& constant, const Vector& preload) {
    const Real w = static_cast<Real>(n) * static_cast<Real>(omega) / h_.period;
    ComplexMatrix Z = ComplexMatrix::Zero(all, all);
    Matrix magnitude = Matrix::Zero(all, all);
    const auto add = [&](Complex value, const Vector& d) {
      Z += value * (d * d.transpose()).cast<Complex>();
      magnitude += std::abs(value) * (d.cwiseAbs() * d.cwiseAbs().transpose());
    };
    for (const Part& part : springs_) add(part.value, part.direction);
    for (const Part& part : masses_) add(-w * w * part.value, part.direction);
    for (const Part& part : dampers_) add(Complex(0, w * part.value), part.direction);
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const Element& element = elements_[e];
      const bool touches = states[e] != State::open && states[e] != State::several;
      if (states[e] == State::stick && n > 0) add(element.k_t, element.tangential);
      if (touches && element.normal.size() > 0) add(element.k_n, element.normal);
    }
    ComplexVector f = constant.cast<Complex>();
    for (const Force& force : forces_)
      if (force.order == n) f += force.amplitude * force.direction.cast<Complex>();
    const ComplexMatrix inverse = inverted(Z, magnitude);
    ComplexVector x = inverse * f;
    const Vector error = inverse.cwiseAbs() * (magnitude * x.cwiseAbs() + f.cwiseAbs());
    const Complex x_response = (response_.transpose().cast<Complex>() * x)(0);
    result.amplitude += std::abs(x_response);
    result.rounding += response_.cwiseAbs().dot(error);
    result.preload += response_.cwiseAbs().dot(inverse.cwiseAbs() * preload);
    return x;
  };
  if (order > 0) y = solve(order, Vector::Zero(all), Vector::Zero(all));
  if (!h_.has(0)) return result;
  Vector constant = Vector::Zero(all), preload = Vector::Zero(all);
  for (Eigen::Index i = 0; i < unknowns_; ++i) preload[i] = at.preload[i * h_.size()];
  const auto amplitude = [&](const Vector& d) -> Complex {
    return d.size() == 0 ? Complex(0) : (d.transpose().cast<Complex>() * y)(0);
  };
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Element& element = elements_[e];
    if (states[e] == State::open && element.normal.size() > 0)
      constant += std::max(element.N_0, Real(0)) * element.normal;
    if (states[e] == State::closed && element.N_0 < 0) constant -= element.N_0 * element.normal;
    if (states[e] == State::slip && element.normal.size() > 0 && element.N_0 < 0)
      constant -= element.N_0 * element.normal;
    if (states[e] != State::stick) continue;
    // w - x_t in the mean: its bounds move with x_t - h and x_t + h.
    const Complex moved = element.mu * element.k_n / element.k_t * amplitude(element.normal);
    const Real offset =
        (std::abs(amplitude(element.tangential) - moved) - std::abs(amplitude(element.tangential) + moved)) /
        2;
    constant += element.k_t * offset * element.tangential;
    if (element.N_0 < 0) constant -= element.N_0 * element.normal;
  }
  solve(0, constant, preload);
  return result;
}

}  // namespace extended

#include "lib/analyses/branches/extended_precision.hpp"

#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/memoryless/gap_spring.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace extended {

using namespace arcslip;

namespace {

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
    const Forces forces = extended::forces({element.k_t, element.mu, element.k_n, element.N_0}, x_t, x_n);
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

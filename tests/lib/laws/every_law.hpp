#pragma once
// What every law promises, checked for any law: derivatives against differences, step and stored energy
// against one another, the force at angles against the coefficients.

#include "catch.hpp"

#include <arcslip/laws/law.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace every_law {

using namespace arcslip;
using Eigen::MatrixXd, Eigen::VectorXd;

inline VectorXd random(Eigen::Index size, double scale, std::mt19937& bits) {
  std::uniform_real_distribution<double> number(-scale, scale);
  return VectorXd::NullaryExpr(size, [&] { return number(bits); });
}

/// A motion whose harmonics fall as n^-2, of largest coefficient `amplitude`.
inline VectorXd falling_motion(const elements::Harmonics& h, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  VectorXd u(h.size());
  for (int i = 0; i < h.cosines(); ++i)
    u[i] = number(random) / std::max(1, h.cosine_order(i) * h.cosine_order(i));
  for (int j = 0; j < h.sines(); ++j)
    u[h.cosines() + j] = number(random) / (h.sine_order(j) * h.sine_order(j));
  return amplitude * u / u.cwiseAbs().maxCoeff();
}

/// df/dx of any function, by central differences.
inline MatrixXd differences(const std::function<VectorXd(const VectorXd&)>& f, const VectorXd& x, double h) {
  MatrixXd D(f(x).size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const VectorXd dx = h * VectorXd::Unit(x.size(), i);
    D.col(i) = (f(x + dx) - f(x - dx)) / (2 * h);
  }
  return D;
}

/// A state with the memory as it must be there, and the law's step from it.
struct State {
  const elements::Law& law;
  std::vector<double> fields;
  VectorXd q, z, f;

  State(const elements::Law& l, std::vector<double> values, VectorXd place, VectorXd memory,
        const VectorXd& rate = {})
      : law(l), fields(std::move(values)), q(std::move(place)), z(std::move(memory)) {
    elements::StepEnd at(law.directions(), law.memory());
    if (rate.size() > 0) at.v = rate;
    law.in_time(fields)->begin(q, z, at);
    f = at.f;
  }
  elements::StepEnd step(const VectorXd& dq, const VectorXd& rate = {}) const {
    elements::StepEnd end(law.directions(), law.memory());
    if (rate.size() > 0) end.v = rate;
    const auto in_time = law.in_time(fields);
    in_time->step({q, z, f}, -2 * dq, end);  // of which nothing may be left
    in_time->step({q, z, f}, dq, end);
    return end;
  }
};

/// Derivatives of a step, where it is smooth: `size` is of displacements, h of differences.
inline void check_step(const elements::Law& law, const std::vector<double>& fields, double size, double h,
                       double tolerance, unsigned seed) {
  std::mt19937 bits(seed);
  for (int trial = 0; trial < 50; ++trial) {
    const VectorXd q = random(law.directions(), size, bits), z = random(law.memory(), size, bits);
    const State state(law, fields, q, z);
    const VectorXd dq = random(law.directions(), size, bits);
    const VectorXd v = law.rate_dependent() ? random(law.directions(), size, bits) : VectorXd();
    const elements::StepEnd end = state.step(dq, v);
    const double scale = 1 + end.f_q.cwiseAbs().sum() + end.f.cwiseAbs().sum();
    CAPTURE(trial, q, z, dq);
    const auto by_q = [&](const VectorXd& at) {
      const elements::StepEnd there = state.step(at, v);
      VectorXd all(there.f.size() + there.dz.size());
      all << there.f, there.dz;
      return all;
    };
    MatrixXd expected(end.f.size() + end.dz.size(), law.directions());
    expected << end.f_q, end.z_q;
    CHECK((differences(by_q, dq, h) - expected).cwiseAbs().maxCoeff() < tolerance * scale);
    const auto by_start = [&](const VectorXd& at) {  // its displacement moves, that at the end stays
      const State there(law, fields, at, state.z);
      const elements::StepEnd moved = there.step(q + dq - at, v);
      VectorXd all(moved.f.size() + moved.dz.size());
      all << moved.f, moved.dz;
      return all;
    };
    MatrixXd by_displacement(end.f.size() + end.dz.size(), law.directions());
    by_displacement << end.f_start, end.z_start;
    if (state.z == z)
      CHECK((differences(by_start, q, h) - by_displacement).cwiseAbs().maxCoeff() < tolerance * scale);
    if (law.rate_dependent()) {
      const auto by_v = [&](const VectorXd& at) { return VectorXd(state.step(dq, at).f); };
      CHECK((differences(by_v, v, h) - end.f_v).cwiseAbs().maxCoeff() < tolerance * scale);
    }
    if (law.memory() == 0 || state.z != z) continue;  // drawn: it lies where the law has a kink
    const auto by_z = [&](const VectorXd& memory) {
      const State there(law, fields, q, memory);
      const elements::StepEnd at = there.step(dq);
      VectorXd all(at.f.size() + at.dz.size());
      all << at.f, there.z + at.dz;
      return all;
    };
    MatrixXd by_memory(end.f.size() + end.dz.size(), law.memory());
    by_memory << end.f_z, end.z_z;
    CHECK((differences(by_z, state.z, h) - by_memory).cwiseAbs().maxCoeff() < tolerance * scale);
  }
}

/// The work of a closed path in small steps is what is dissipated: the law stores what it gives back.
inline void check_energy(const elements::Law& law, const std::vector<double>& fields, double size,
                         double tolerance, unsigned seed) {
  std::mt19937 bits(seed);
  const int steps = 4000;
  const VectorXd a = random(law.directions(), size, bits), b = random(law.directions(), size, bits);
  const auto path = [&](int k) -> VectorXd {
    const double theta = 2 * std::acos(-1.0) * k / steps;
    return a * std::sin(theta) + b * std::sin(2 * theta);
  };
  const auto rate = [&](int k) -> VectorXd {
    const double theta = 2 * std::acos(-1.0) * k / steps;
    return a * std::cos(theta) + 2 * b * std::cos(2 * theta);
  };
  VectorXd z = VectorXd::Zero(law.memory());
  const auto in_time = law.in_time(fields);
  const double before = in_time->stored(path(0), z);
  double work = 0, dissipated = 0, most = 0;
  for (int k = 0; k < steps; ++k) {
    State state(law, fields, path(k), z, rate(k));
    const VectorXd dq = path(k + 1) - path(k);
    const elements::StepEnd end = state.step(dq, rate(k + 1));
    work += 0.5 * (state.f + end.f).dot(dq);
    dissipated += end.dissipated;
    z = state.z + end.dz;
    most = std::max(most, in_time->stored(path(k + 1), z));
  }
  CHECK(dissipated >= -tolerance * most);
  CHECK(std::abs(work - dissipated - (in_time->stored(path(steps), z) - before)) <
        tolerance * (most + dissipated));
}

/// Jacobian and derivatives by the fields of the element in the frequency domain, and its coefficients
/// against the force at many angles where the law has no unknowns of its own.
inline void check_element(const elements::Law& law, const std::vector<double>& fields, double size, bool odd,
                          double h, double tolerance, double series_tolerance, unsigned seed) {
  std::mt19937 bits(seed);
  const elements::Harmonics harmonics{5, odd};
  const auto element = law.element(harmonics, {});
  const double frequency = 1.7;
  element->set_frequency(frequency);
  const VectorXd u = random((law.directions() + law.auxiliary()) * harmonics.size(), size, bits);
  element->move_to(u, fields, true);
  const VectorXd F = element->force();
  const MatrixXd J = element->jacobian();
  const double scale = 1 + J.cwiseAbs().maxCoeff();
  const auto force = [&](const VectorXd& at) {
    element->move_to(at, fields, false);
    return VectorXd(element->force());
  };
  CHECK((differences(force, u, h) - J).cwiseAbs().maxCoeff() < tolerance * scale);
  for (std::size_t k = 0; k < fields.size(); ++k) {
    element->move_to(u, fields, true);
    VectorXd by_field(F.size());
    element->field_derivative(static_cast<int>(k), by_field);
    const auto along = [&](const VectorXd& value) {
      std::vector<double> other = fields;
      other[k] = value[0];
      element->move_to(u, other, false);
      return VectorXd(element->force());
    };
    const double step = h * std::max(1.0, std::abs(fields[k]));
    const MatrixXd expected = differences(along, VectorXd::Constant(1, fields[k]), step);
    CAPTURE(k);
    CHECK((expected - by_field).cwiseAbs().maxCoeff() < tolerance * (1 + by_field.cwiseAbs().maxCoeff()));
  }
  if (law.rate_dependent()) {
    element->move_to(u, fields, true);
    VectorXd by_frequency(F.size());
    element->frequency_derivative(by_frequency);
    const auto at = [&](const VectorXd& w) {
      element->set_frequency(w[0]);
      element->move_to(u, fields, false);
      return VectorXd(element->force());
    };
    const MatrixXd expected = differences(at, VectorXd::Constant(1, frequency), h);
    CHECK((expected - by_frequency).cwiseAbs().maxCoeff() < tolerance * (1 + F.cwiseAbs().maxCoeff()));
  }
  const int count = 20000;
  std::vector<double> angles;
  for (int s = 0; s < count; ++s) angles.push_back(2 * std::acos(-1.0) * s / count);
  if (law.has_normal_load()) {  // that along the last direction, with the extremes of the contact
    elements::FrictionState state;
    element->move_to(u, fields, false);
    REQUIRE(element->friction(state));
    const VectorXd normal = u.segment((law.directions() - 1) * harmonics.size(), harmonics.size());
    double most = 0, least = std::numeric_limits<double>::infinity();
    for (const double angle : angles) {
      const double load = law.normal_load_at(fields, elements::series_values(harmonics, normal, angle).x);
      most = std::max(most, load);
      least = std::min(least, load);
    }
    CHECK(std::abs(most - state.load_max) < 1e-6 * (1 + most));
    CHECK(std::abs(least - state.load_min) < 1e-6 * (1 + most));
  }
  const MatrixXd f = law.moving_force_at(harmonics, u, frequency, fields, angles);
  VectorXd phi(harmonics.size());
  MatrixXd projected = MatrixXd::Zero(harmonics.size(), law.directions());
  for (int s = 0; s < count; ++s) {
    elements::series_basis(harmonics, angles[static_cast<std::size_t>(s)], phi);
    projected += 2.0 / count * phi * f.row(s);
  }
  if (!odd) projected.row(0) *= 0.5;
  const VectorXd expected = projected.reshaped();
  CHECK((expected - F.head(expected.size())).cwiseAbs().maxCoeff() <
        series_tolerance * (1 + f.cwiseAbs().maxCoeff()));
}

}  // namespace every_law

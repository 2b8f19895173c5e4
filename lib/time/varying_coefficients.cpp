#include <arcslip/time/varying_coefficients.hpp>

#include <arcslip/time/floquet.hpp>

#include <Eigen/LU>

#include <cmath>

namespace arcslip::time {
namespace {

// Gauss-Legendre nodes on [0, 1].
std::array<double, 4> gauss_nodes() {
  const double a = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(6.0 / 5)),
               b = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(6.0 / 5));
  return {0.5 * (1 - b), 0.5 * (1 - a), 0.5 * (1 + a), 0.5 * (1 + b)};
}

// Row j: the coefficients of s^j by the values at the nodes.
Eigen::Matrix4d interpolation() {
  const auto at = gauss_nodes();
  Eigen::Matrix4d powers;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) powers(i, j) = std::pow(at[static_cast<std::size_t>(i)], j);
  return powers.inverse();
}

const elements::Hysteresis* hysteresis_of(const elements::Law& law) {
  return dynamic_cast<const elements::Hysteresis*>(&law);
}

}  // namespace

VaryingCoefficients::VaryingCoefficients() : at_(gauss_nodes()), along_(interpolation()) {}

bool VaryingCoefficients::takes(const elements::Law& law) {
  return law.memory() == 0 || hysteresis_of(law);
}

void VaryingCoefficients::add(const TimeElement& element, int index, Matrix over_mass) {
  const bool moving = element.law->rate_dependent();
  variables_.emplace_back(over_mass, element.directions, nodes, moving);
  directions_.push_back(element.directions);
  const std::size_t variable = variables_.size() - 1;
  if (const auto* law = hysteresis_of(*element.law)) {
    elements::StepEnd at{1, 1};
    Vector q = Vector::Zero(1), z = q;
    element.law->begin(element.fields, q, z, at);
    variables_.back().by_memory.setZero(1, nodes);
    hystereses_.push_back({&element, index, variable, law, at.f_q(0, 0), at.f_z(0, 0), {}});
    return;
  }
  smooth_.push_back({&element, index, variable, moving, {element.law->directions(), 0}, {}, {}});
}

bool VaryingCoefficients::follow(double omega, const elements::Harmonics& harmonics,
                                 const std::vector<ElementCourse>& elements) {
  omega_ = omega;
  harmonics_ = harmonics;
  elements_ = &elements;
  for (Hysteretic& law : hystereses_)
    if (!law.course.follow(*law.law, law.element->fields, harmonics,
                           elements[static_cast<std::size_t>(law.index)].q.col(0)))
      return false;
  return true;
}

void VaryingCoefficients::pass(std::size_t hysteresis, std::size_t turn, const Matrix& W) {
  const auto& at = hystereses_[hysteresis].course.turns()[turn];
  Vector& y = memory(hysteresis);
  y *= at.phi;
  y.noalias() += (at.before - at.after) * (W * directions_[hystereses_[hysteresis].variable]);
}

VaryingCoefficients::Rates VaryingCoefficients::interpolate(double theta, double h) {
  Rates rates{0, 0};
  for (Smooth& law : smooth_) set(law, theta, h, rates);
  for (Hysteretic& law : hystereses_) set(law, theta, h, rates);
  return rates;
}

void VaryingCoefficients::set(Smooth& law, double theta, double h, Rates& rates) {
  const Matrix& motion = (*elements_)[static_cast<std::size_t>(law.index)].q;
  q_.resize(motion.cols());
  double most_T = 0, most_B = 0;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double angle = theta + h * at_[i];
    const double c = std::cos(angle), s = std::sin(angle);
    for (Eigen::Index k = 0; k < motion.cols(); ++k) {
      const auto values = elements::series_values(harmonics_, motion.col(k), c, s);
      q_[k] = values.x;
      law.at.v[k] = omega_ * values.d1;
    }
    law.element->law->begin(law.element->fields, q_, none_, law.at);
    law.T[i] = law.at.f_q;
    most_T = std::max(most_T, law.T[i].cwiseAbs().sum());
    if (!law.moving) continue;
    law.B[i] = law.at.f_v;
    most_B = std::max(most_B, law.B[i].cwiseAbs().sum());
  }
  Variable& variable = variables_[law.variable];
  for (std::size_t j = 0; j < nodes; ++j) {
    variable.T[j].setZero();
    if (law.moving) variable.B[j].setZero();
    for (std::size_t i = 0; i < nodes; ++i) {
      const double weight = along_(static_cast<int>(j), static_cast<int>(i));
      variable.T[j] += weight / (omega_ * omega_) * law.T[i];
      if (law.moving) variable.B[j] += weight / omega_ * law.B[i];
    }
  }
  rates.stiffness += variable.size * most_T / (omega_ * omega_);
  rates.damping += variable.size * most_B / omega_;
}

void VaryingCoefficients::set(Hysteretic& law, double theta, double h, Rates& rates) {
  Eigen::Vector4d T, by_memory;
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto [r, phi] = law.course.at(theta + h * at_[i]);
    T[static_cast<Eigen::Index>(i)] = law.f_q + law.f_z * r;
    by_memory[static_cast<Eigen::Index>(i)] = law.f_z * phi;
  }
  const double scale = 1 / (omega_ * omega_);
  Variable& variable = variables_[law.variable];
  for (std::size_t j = 0; j < nodes; ++j)
    variable.T[j](0, 0) = scale * along_.row(static_cast<Eigen::Index>(j)).dot(T);
  variable.by_memory.noalias() = scale * (along_ * by_memory).transpose();
  rates.stiffness += variable.size * scale * T.cwiseAbs().maxCoeff();
}

}  // namespace arcslip::time

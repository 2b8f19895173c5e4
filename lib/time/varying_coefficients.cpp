#include <arcslip/time/varying_coefficients.hpp>

#include <arcslip/time/floquet.hpp>

#include <Eigen/LU>

#include <cmath>

namespace arcslip::time {
namespace {

constexpr double beside_end = 1.0 / 1024;  // of a piece
constexpr double negligible = 1e-13;       // coefficient, by the largest one

const elements::Hysteresis* hysteresis_of(const elements::Law& law) {
  return dynamic_cast<const elements::Hysteresis*>(&law);
}

}  // namespace

VaryingCoefficients::VaryingCoefficients()
    : fit_(nodes), by_values_(fit_.by_values), powers_(fit_.powers.transpose()) {}

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
    hystereses_.push_back(
        {&element, index, variable, at.f_q(0, 0), at.f_z(0, 0), HysteresisCourse(*law, element.fields)});
    return;
  }
  smooth_.push_back({&element,
                     index,
                     variable,
                     moving,
                     {element.law->directions(), 0},
                     variables_.back().T,
                     variables_.back().B});
}

bool VaryingCoefficients::follow(double omega, const elements::Harmonics& harmonics,
                                 const std::vector<ElementCourse>& elements) {
  omega_ = omega;
  harmonics_ = harmonics;
  elements_ = &elements;
  for (Hysteretic& law : hystereses_)
    if (!law.course.follow(harmonics, elements[static_cast<std::size_t>(law.index)].q.col(0))) return false;
  return true;
}

void VaryingCoefficients::pass(std::size_t hysteresis, std::size_t turn, const Matrix& W) {
  const auto& at = hystereses_[hysteresis].course.turns()[turn];
  Vector& y = memory(hysteresis);
  y *= at.phi;
  y.noalias() += (at.before - at.after) * (W * directions_[hystereses_[hysteresis].variable]);
}

VaryingCoefficients::Piece VaryingCoefficients::interpolate(double theta, double h) {
  for (int i = 0; i < nodes; ++i) {
    const double angle = theta + h * fit_.nodes[i];
    cos_[i] = std::cos(angle);
    sin_[i] = std::sin(angle);
  }
  Piece piece{{}, {}, 0};
  for (Smooth& law : smooth_) set(law, piece);
  for (Hysteretic& law : hystereses_) set(law, theta, h, piece);
  return piece;
}

// Of matrices side by side, one at each node, to one for each power of s.
void VaryingCoefficients::replace(const Matrix& at_nodes, double scale, Matrix& by_powers) {
  const Eigen::Index size = at_nodes.rows();
  legendre_.setZero(size, nodes * size);
  by_powers.setZero();
  for (int l = 0; l < nodes; ++l) {
    auto of = legendre_.middleCols(l * size, size);
    for (int i = 0; i < nodes; ++i) of += scale * by_values_(l, i) * at_nodes.middleCols(i * size, size);
    for (int j = 0; j <= l; ++j) by_powers.middleCols(j * size, size) += powers_(j, l) * of;
  }
}

void VaryingCoefficients::set(Smooth& law, Piece& piece) {
  const Matrix& motion = (*elements_)[static_cast<std::size_t>(law.index)].q;
  const Eigen::Index size = motion.cols();
  q_.resize(size);
  double most_T = 0, most_B = 0;
  for (int i = 0; i < nodes; ++i) {
    for (Eigen::Index k = 0; k < size; ++k) {
      const auto values = elements::series_values(harmonics_, motion.col(k), cos_[i], sin_[i]);
      q_[k] = values.x;
      law.at.v[k] = omega_ * values.d1;
    }
    law.element->law->begin(law.element->fields, q_, none_, law.at);
    law.T.middleCols(i * size, size) = law.at.f_q;
    most_T = std::max(most_T, law.at.f_q.cwiseAbs().sum());
    if (!law.moving) continue;
    law.B.middleCols(i * size, size) = law.at.f_v;
    most_B = std::max(most_B, law.at.f_v.cwiseAbs().sum());
  }
  Variable& variable = variables_[law.variable];
  piece.largest.stiffness += variable.size * most_T / (omega_ * omega_);
  piece.largest.damping += variable.size * most_B / omega_;
  replace(law.T, 1 / (omega_ * omega_), variable.T);
  piece.sizes.stiffness += variable.size * variable.T.cwiseAbs().sum();
  if (!law.moving) return;
  replace(law.B, 1 / omega_, variable.B);
  piece.sizes.damping += variable.size * variable.B.cwiseAbs().sum();
}

// By the Legendre polynomials up to the last that is not negligible, since powers add to rounding. last:
// grows to the last two.
VaryingCoefficients::Values VaryingCoefficients::coefficients(const Values& at_nodes, double& last) const {
  Values b = by_values_ * at_nodes;
  last = std::max(last, b.tail<2>().cwiseAbs().sum());
  const double least = negligible * b.cwiseAbs().maxCoeff();
  for (int l = nodes - 1; l > 0 && std::abs(b[l]) <= least; --l) b[l] = 0;
  return powers_ * b;
}

void VaryingCoefficients::set(Hysteretic& law, double theta, double h, Piece& piece) {
  const double scale = 1 / (omega_ * omega_);
  Values T, by_memory;
  for (int i = 0; i < nodes; ++i) {
    const auto [r, phi] = law.course.at(theta + h * fit_.nodes[i], cos_[i], sin_[i]);
    T[i] = scale * (law.f_q + law.f_z * r);
    by_memory[i] = scale * law.f_z * phi;
  }
  double last = 0;
  Variable& variable = variables_[law.variable];
  piece.largest.stiffness += variable.size * T.cwiseAbs().maxCoeff();
  variable.T = coefficients(T, last).transpose();
  variable.by_memory = coefficients(by_memory, last).transpose();
  piece.sizes.stiffness += variable.size * variable.T.cwiseAbs().sum();
  piece.last += variable.size * last;
}

double VaryingCoefficients::left_out(double theta, double h) const {
  double largest = 0;
  for (const double s : {beside_end, 1 - beside_end}) {
    const double angle = theta + h * s, c = std::cos(angle), sine = std::sin(angle);
    double sum = 0;
    for (const Hysteretic& law : hystereses_) {
      const Variable& variable = variables_[law.variable];
      double T = 0;
      for (int j = nodes - 1; j >= 0; --j) T = T * s + variable.T(0, j);
      const double r = law.course.at(angle, c, sine).r;
      sum += variable.size * std::abs((law.f_q + law.f_z * r) / (omega_ * omega_) - T);
    }
    largest = std::max(largest, sum);
  }
  return largest;
}

}  // namespace arcslip::time

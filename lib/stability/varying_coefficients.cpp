#include <arcslip/stability/varying_coefficients.hpp>

#include <arcslip/stability/floquet.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace arcslip::time {
namespace {

constexpr double near_end = 1.0 / 1024;       // of a piece
constexpr double negligible_varying = 1e-13;  // coefficient, by the largest one

}  // namespace

VaryingCoefficients::VaryingCoefficients()
    : fit_(nodes), by_values_(fit_.by_values), powers_(fit_.powers.transpose()) {}

bool VaryingCoefficients::takes(const elements::Law& law) {
  return law.memory() == 0 || law.hysteresis() || law.plane_friction();
}

void VaryingCoefficients::add(const TimeElement& element, int index, Matrix over_mass) {
  const bool moving = element.law->rate_dependent();
  variables_.emplace_back(over_mass, element.directions, nodes, moving);
  directions_.push_back(element.directions);
  const std::size_t variable = variables_.size() - 1;
  if (const auto* law = element.law->hysteresis()) {
    elements::StepEnd at{1, 1};
    Vector q = Vector::Zero(1), z = q;
    element.law->in_time(element.fields)->begin(q, z, at);
    variables_.back().by_memory.setZero(1, nodes);
    hystereses_.push_back(
        {&element, index, variable, at.f_q(0, 0), at.f_z(0, 0), HysteresisCourse(*law, element.fields)});
    return;
  }
  if (const auto* law = element.law->plane_friction()) {
    planar_.push_back({index, variable, DiscCourse(law->contact(element.fields))});
    return;
  }
  smooth_.push_back({&element,
                     index,
                     variable,
                     moving,
                     element.law->in_time(element.fields),
                     {element.law->directions(), 0},
                     variables_.back().T,
                     variables_.back().B});
}

bool VaryingCoefficients::follow(double omega, double fastest, const elements::Harmonics& harmonics,
                                 const std::vector<ElementCourse>& elements) {
  omega_ = omega;
  harmonics_ = harmonics;
  elements_ = &elements;
  changes_.clear();
  breaks_.clear();
  for (const Smooth& law : smooth_) {
    const Matrix& q = elements[static_cast<std::size_t>(law.index)].q;
    law.element->law->add_kinks(harmonics, q.reshaped(), omega, law.element->fields, breaks_);
  }
  for (Hysteretic& law : hystereses_) {
    if (!law.course.follow(harmonics, elements[static_cast<std::size_t>(law.index)].q.col(0))) return false;
    const auto& turns = law.course.turns();
    for (std::size_t k = 0; k < turns.size(); ++k)
      for (double theta = turns[k].theta; theta < elements::whole_turn; theta += harmonics.span())
        changes_.push_back({theta, law.variable, k});
    breaks_.insert(breaks_.end(), law.course.breaks().begin(), law.course.breaks().end());
  }
  for (Planar& law : planar_) {
    const Matrix& q = elements[static_cast<std::size_t>(law.index)].q;
    if (!law.course.follow(harmonics, q, fastest / omega)) return false;
    for (std::size_t k = 0; k < law.course.changes().size(); ++k)
      changes_.push_back({law.course.changes()[k], law.variable, k});
    breaks_.insert(breaks_.end(), law.course.breaks().begin(), law.course.breaks().end());
  }
  return true;
}

void VaryingCoefficients::pass(const Change& change, const Matrix& W) {
  Matrix& memory = variables_[change.variable].memory;
  const Matrix dq = W * directions_[change.variable];
  for (const Hysteretic& law : hystereses_)
    if (law.variable == change.variable) {
      const auto& at = law.course.turns()[change.index];
      memory = at.phi * memory + (at.before - at.after) * dq;
    }
  for (const Planar& law : planar_)
    if (law.variable == change.variable) law.course.pass(change.index, dq, memory);
}

int VaryingCoefficients::free_at(double theta) const {
  int count = static_cast<int>(hystereses_.size());
  for (const Planar& law : planar_) count += law.course.free_at(theta);
  return count;
}

int VaryingCoefficients::following_at(double theta) const {
  int count = 0;
  for (const Planar& law : planar_) count += law.course.following_at(theta);
  return count;
}

void VaryingCoefficients::begin(double theta, Eigen::Index starts, Eigen::Index first) {
  for (const Hysteretic& law : hystereses_) variables_[law.variable].memory = Vector::Unit(starts, first++);
  for (const Planar& law : planar_) {
    Matrix& memory = variables_[law.variable].memory;
    memory.setZero(starts, 2);
    for (int i = 0; i < law.course.free_at(theta); ++i) memory(first++, i) = 1;
  }
}

void VaryingCoefficients::end(double theta, Matrix& map, Eigen::Index first) const {
  for (const Hysteretic& law : hystereses_) map.row(first++) = variables_[law.variable].memory.transpose();
  for (const Planar& law : planar_)
    for (int i = 0; i < law.course.free_at(theta); ++i)
      map.row(first++) = variables_[law.variable].memory.col(i);
}

VaryingCoefficients::Piece VaryingCoefficients::interpolate(double theta, double h) {
  for (int i = 0; i < nodes; ++i) {
    angle_[i] = theta + h * fit_.nodes[i];
    cos_[i] = std::cos(angle_[i]);
    sin_[i] = std::sin(angle_[i]);
  }
  Piece piece;
  for (Smooth& law : smooth_) set(law, piece);
  for (Hysteretic& law : hystereses_) set(law, theta, h, piece);
  for (Planar& law : planar_) set(law, theta, h, piece);
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
    law.at.phase = harmonics_.period * angle_[i];
    law.in_time->begin(q_, none_, law.at);
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
  const double least = negligible_varying * b.cwiseAbs().maxCoeff();
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

void VaryingCoefficients::set(Planar& law, double theta, double h, Piece& piece) {
  const double scale = 1 / (omega_ * omega_);
  Variable& variable = variables_[law.variable];
  std::array<DiscCourse::Values, nodes> at;
  law.relaxed = true;
  for (int i = 0; i < nodes; ++i) {
    DiscCourse::Values& values = at[static_cast<std::size_t>(i)];
    law.course.at(theta + h * fit_.nodes[i], values);
    law.relaxed = law.relaxed && values.relaxes;
  }
  // Matrices side by side by the powers, from a matrix at each node.
  const auto set = [&](auto of, double factor, double& last, Matrix& to) {
    const auto rows = (at[0].*of).rows(), columns = (at[0].*of).cols();
    to.resize(rows, columns * nodes);
    for (Eigen::Index k = 0; k < rows * columns; ++k) {
      Values at_nodes;
      for (int i = 0; i < nodes; ++i) at_nodes[i] = factor * (at[static_cast<std::size_t>(i)].*of).data()[k];
      const Values by_powers = coefficients(at_nodes, last);
      for (int j = 0; j < nodes; ++j) to.data()[j * rows * columns + k] = by_powers[j];
    }
  };
  using Of = DiscCourse::Values;
  double last = 0, last_v = 0, last_a = 0, largest = 0;
  if (law.relaxed) {
    set(&Of::relaxed_by_q, scale, last, variable.T);
    set(&Of::by_v, scale, last_v, variable.B);
    set(&Of::by_a, scale, last_a, variable.E);
    for (Matrix* none : {&variable.by_memory, &variable.decay, &variable.rate_by_q}) none->resize(0, 0);
    for (const auto& values : at) {
      largest = std::max(largest, values.relaxed_by_q.cwiseAbs().sum());
      piece.largest.damping =
          std::max(piece.largest.damping, scale * variable.size * values.by_v.cwiseAbs().sum());
    }
    piece.sizes.damping += variable.size * (variable.B.cwiseAbs().sum() + variable.E.cwiseAbs().sum());
    piece.last_memory = std::max(piece.last_memory, variable.size * (last_v + last_a));
  } else {
    set(&Of::by_q, scale, last, variable.T);
    set(&Of::by_memory, scale, last, variable.by_memory);
    for (Matrix* none : {&variable.B, &variable.E}) none->resize(0, 0);
    double last_memory = 0;
    set(&Of::rate_by_memory, 1, last_memory, variable.decay);
    set(&Of::rate_by_q, 1, last_memory, variable.rate_by_q);
    for (const auto& values : at) {
      largest = std::max(largest, values.by_q.cwiseAbs().sum());
      piece.memory = std::max(piece.memory, -values.rate_by_memory(0, 0));
    }
    piece.last_memory = std::max(piece.last_memory, last_memory);
  }
  piece.largest.stiffness += scale * variable.size * largest;
  piece.sizes.stiffness += variable.size * variable.T.cwiseAbs().sum();
  piece.last += variable.size * last;
}

bool VaryingCoefficients::any_relaxed() const {
  return std::any_of(planar_.begin(), planar_.end(), [](const Planar& law) { return law.relaxed; });
}

void VaryingCoefficients::relax(double theta, const Matrix& W, const Matrix& V, const Matrix& A) {
  for (const Planar& law : planar_) {
    const Matrix& D = directions_[law.variable];
    if (law.relaxed) law.course.relax(theta, W * D, V * D, A * D, variables_[law.variable].memory);
  }
}

double VaryingCoefficients::left_out(double theta, double h) const {
  double largest = 0;
  for (const double s : {near_end, 1 - near_end}) {
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

#include <arcslip/time/newmark/newmark.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace arcslip::time {
namespace {

// A mass or damping, relative to those of its degrees of freedom.
constexpr double negligible_inertia = 1e-13;

// An orthonormal basis of S w = 0, S the symmetric part of A and positive semidefinite: where there is no
// mass, damping is symmetric.
Matrix null_space(const Matrix& A) {
  const Matrix S = 0.5 * (A + A.transpose());
  Vector scale = S.diagonal();
  for (double& s : scale) s = s > 0 ? 1 / std::sqrt(s) : 1;
  const auto modes = continuation::symmetric_modes(scale.asDiagonal() * S * scale.asDiagonal());
  if (modes.values.size() == 0) return Matrix(S.rows(), 0);  // overflow: the first step reports
  Eigen::Index count = 0;
  while (count < S.rows() && modes.values[count] <= negligible_inertia * static_cast<double>(S.rows()))
    ++count;
  if (count == 0) return Matrix(S.rows(), 0);
  return continuation::orthonormal_columns(scale.asDiagonal() * modes.V.leftCols(count));
}

}  // namespace

Newmark::Newmark(EquationOfMotion equation, long steps)
    : equation_(std::move(equation)),
      steps_(steps),
      h_(equation_.period() / static_cast<double>(steps)),
      elements_(equation_.elements, equation_.dofs()) {
  if (steps < 1)
    throw std::invalid_argument("steps per period: found " + std::to_string(steps) + ", must be at least 1");
  if (!(equation_.omega > 0) || !std::isfinite(equation_.omega))
    throw std::invalid_argument("frequency: found " + std::to_string(equation_.omega) +
                                " rad/s, must be above 0 and finite");
  inertia_ = 4 / h_ * equation_.M;
  elements_.set_matrix(inertia_ / h_ + 2 / h_ * equation_.C + equation_.K);
  circulatory_ = equation_.circulatory();
  massless_ = null_space(equation_.M);
  undamped_ = massless_.cols() > 0 ? null_space(equation_.M + h_ * equation_.C) : massless_;
  const Matrix I = Matrix::Identity(equation_.dofs(), equation_.dofs()),
               U = undamped_ * undamped_.transpose();
  elements_.set_velocities((2 * I - U) / h_, U - I);
  massless_rate_.resize(massless_.cols());
  undamped_velocity_.resize(undamped_.cols());
  for (Vector* v : {&force_, &new_force_, &rate_, &b_, &y_, &v_}) v->setZero(equation_.dofs());
  state_ = at_rest(equation_);
}

void Newmark::resume(const MotionState& state) {
  state_ = state;
  number_ = 0;
  energy_ = {};
  y_.setZero();
  equation_.force(0, force_);
  elements_.set_phase(0);
  elements_.begin(state_.x, state_.v, state_.z);
  state_.z = elements_.memory();
  set_rate();
  stored_at_begin_ = stored();
}

Solved Newmark::begin(const MotionState& state) {
  resume(state);
  if (massless_.cols() == 0) return Solved::yes;
  const Solved placed = place_massless();
  resume(MotionState(state_));
  return placed;
}

// Along massless_ the forces balance: by the displacement without damping, by the velocity with damping.
Solved Newmark::place_massless() {
  if (undamped_.cols() > 0) {
    std::vector<TimeElement> seen = equation_.elements;
    for (TimeElement& element : seen) element.directions = undamped_.transpose() * element.directions;
    ImplicitElements along(seen, static_cast<int>(undamped_.cols()));
    along.set_matrix(undamped_.transpose() * equation_.K * undamped_);
    const Vector q = elements_.directions().transpose() * state_.x;
    Vector y = Vector::Zero(undamped_.cols());
    along.begin_at(q, elements_.directions().transpose() * state_.v, elements_.memory());
    const Solved solved =
        along.solve(undamped_.transpose() * (force_ - equation_.C * state_.v - equation_.K * state_.x), y);
    if (solved != Solved::yes) return solved;
    along.accept({});
    state_.x += undamped_ * y;
    state_.z = along.memory();
    elements_.begin(state_.x, state_.v, state_.z);
    state_.v -= undamped_ * (undamped_.transpose() * state_.v);
  }
  const Matrix damping = massless_.transpose() * equation_.C * massless_;
  const Vector lacking = massless_.transpose() * (force_ - equation_.C * state_.v - equation_.K * state_.x -
                                                  elements_.directions() * elements_.force());
  state_.v += massless_ * continuation::shortest_least_squares(damping, lacking).X;
  return Solved::yes;
}

void Newmark::set_rate() {
  rate_ = force_;
  rate_.noalias() -= equation_.C * state_.v;
  rate_.noalias() -= equation_.K * state_.x;
  rate_.noalias() -= elements_.directions() * elements_.force();
  if (massless_.cols() == 0) return;
  massless_rate_.noalias() = massless_.transpose() * rate_;
  rate_.noalias() -= massless_ * massless_rate_;
}

double Newmark::stored() const {
  return 0.5 * state_.v.dot(equation_.M.lazyProduct(state_.v)) +
         0.5 * state_.x.dot(equation_.K.lazyProduct(state_.x)) + elements_.energy();
}

EnergyBalance Newmark::energy() const {
  EnergyBalance balance = energy_;
  balance.stored = stored() - stored_at_begin_;
  return balance;
}

Solved Newmark::step() {
  const auto next = static_cast<double>((number_ + 1) % steps_);
  equation_.force(next * h_, new_force_);
  elements_.set_phase(equation_.phase(next / static_cast<double>(steps_)));
  b_ = rate_ + new_force_;
  b_.noalias() += inertia_ * state_.v;
  b_.noalias() += equation_.C * state_.v;
  b_.noalias() -= equation_.K * state_.x;
  const Solved solved = elements_.solve(b_, y_);
  if (solved != Solved::yes) return solved;

  energy_.input += 0.5 * (force_ + new_force_).dot(y_);
  v_.noalias() = equation_.C * y_;
  energy_.viscous += y_.dot(v_) / h_;
  if (circulatory_.size() > 0) energy_.viscous += y_.dot(circulatory_ * state_.x);
  for (std::size_t e = 0; e < elements_.elements().size(); ++e)
    energy_.friction += elements_.end(e).dissipated;

  state_.x += y_;
  v_ = 2 / h_ * y_ - state_.v;
  if (undamped_.cols() > 0) {
    undamped_velocity_.noalias() = undamped_.transpose() * (y_ / h_ - v_);
    v_.noalias() += undamped_ * undamped_velocity_;
  }
  state_.v = v_;
  elements_.accept(state_.v);
  state_.z = elements_.memory();
  force_.swap(new_force_);
  set_rate();
  ++number_;
  return Solved::yes;
}

void Newmark::differentiate(Matrix& columns) {
  const Eigen::Index n = equation_.dofs();
  dx_ = columns.topRows(n);
  dv_ = columns.middleRows(n, n);
  dz_ = columns.bottomRows(columns.rows() - 2 * n);
  elements_.force_change(dx_, dv_, dz_, df_);
  db_.noalias() = equation_.C * dv_;
  db_.noalias() += equation_.K * dx_;
  db_.noalias() += elements_.directions() * df_;
  db_ = -db_;  // of the rate
  if (massless_.cols() > 0) db_ -= massless_ * (massless_.transpose() * db_);
  db_.noalias() += inertia_ * dv_;
  db_.noalias() += equation_.C * dv_;
  db_.noalias() -= equation_.K * dx_;
  elements_.differentiate(dx_, dv_, dz_, db_);
  dv_ = 2 / h_ * db_ - dv_;
  if (undamped_.cols() > 0) dv_ += undamped_ * (undamped_.transpose() * (db_ / h_ - dv_));
  columns.topRows(n) += db_;
  columns.middleRows(n, n) = dv_;
  columns.bottomRows(columns.rows() - 2 * n) = dz_;
}

}  // namespace arcslip::time

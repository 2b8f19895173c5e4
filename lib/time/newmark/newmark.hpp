#pragma once
// Newmark's method with constant average acceleration (beta = 1/4, gamma = 1/2), for any scene:
//
//   x1 = x0 + h (v0 + v1)/2,   M (v1 - v0) = h (r0 + r1)/2,   r = F(t) - C v - K x - sum_e d_e f_e = M a
//
// so that the increment y = x1 - x0 solves, with the forces f_e1 at the end of the step
// (implicit_elements.hpp),
//
//   (4/h^2 M + 2/h C + K) y + sum_e d_e f_e1 = r0 + F(t1) + 4/h M v0 + C v0 - K x0,   v1 = 2/h y - v0
//
// Second-order accurate in h; for a linear oscillator of angular frequency w the energy is conserved and the
// relative period error is (w h)^2/12. Unconditionally stable if only friction elements are nonlinear.
//
// Energy over a step, from x1 - x0 = h (v0 + v1)/2:
//   input    (F0 + F1)/2 . y        viscous   y . C y/h       friction   what the laws dissipate
//   stored   change of v . M v/2 + x . K x/2 + what the laws store
// balances to rounding where these are such that (f_e0 + f_e1)/2 . D_e^T y is dissipated and stored, as of
// sliders, and to the order of the method with others.
//
// Laws that depend on velocities take v1 at the end of the step, so that they are of second order, too.
//
// A massless motion (M w = 0) has r . w = 0 at all times; one without mass and damping has v = (x1 - x0)/h.
// Source: Newmark 1959; docs/theory/10-newmark.md.

#include <arcslip/time/equation/time_history.hpp>
#include <arcslip/time/newmark/implicit_elements.hpp>

namespace arcslip::time {

class Newmark {
 public:
  /// h = period/steps. Throws std::invalid_argument if steps < 1 or the frequency is not positive and finite.
  Newmark(EquationOfMotion equation, long steps);

  /// From a state at t = 0. Massless motions take the place, or the velocity, that the forces there give
  /// them; a slider beyond its limit is drawn after.
  Solved begin(const MotionState& state);
  /// The same from a state that a step has left, as it is.
  void resume(const MotionState& state);

  /// Does not allocate. If the step fails, the state is unchanged.
  Solved step();

  const EquationOfMotion& equation() const { return equation_; }
  long steps_per_period() const { return steps_; }
  long step_number() const { return number_; }  // since begin()
  double time() const { return static_cast<double>(number_) * h_; }
  const MotionState& state() const { return state_; }
  const ImplicitElements& elements() const { return elements_; }
  /// Since begin().
  EnergyBalance energy() const;

  /// Changes of the state, a column each in the order (x, v, z), through the last step. Before the next one.
  void differentiate(Matrix& columns);

 private:
  double stored() const;
  Solved place_massless();
  void set_rate();  // rate_ = r of the present state

  EquationOfMotion equation_;
  long steps_, number_ = 0;
  double h_;
  ImplicitElements elements_;
  MotionState state_;
  Vector force_, new_force_, rate_, b_, y_, v_;
  Matrix inertia_;              // 4/h M
  Matrix circulatory_;          // skew part of K; empty: none
  Matrix massless_, undamped_;  // orthonormal bases of M w = 0, and of M w = C w = 0
  Vector massless_rate_, undamped_velocity_;
  EnergyBalance energy_;
  double stored_at_begin_ = 0;
  Matrix dx_, dv_, dz_, df_, db_;
};

}  // namespace arcslip::time

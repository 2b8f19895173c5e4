#pragma once
// A model in the time domain, at given parameters:
//
//   M x'' + C x' + K x + sum_e d_e f_e(d_e . x) = sum_k d_k (c_k cos n_k omega t + s_k sin n_k omega t)
//
// Force laws on q = d . x:
//   cubic spring    f = k3 q^3
//   Jenkins         f = kd (q - z), |f| <= mu Fn; the slider z rests, or follows q at |f| = mu Fn
//
// The state is (x, x', z): a friction element remembers where its slider is.

#include <arcslip/model/model.hpp>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace arcslip::time {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// One nonlinear element with its numbers.
struct Element {
  std::string name;
  model::Law law = model::Law::jenkins;
  Vector direction;       // d, dofs
  double stiffness = 0;   // kd (N/m), or k3 (N/m^3)
  double slip_limit = 0;  // mu Fn, N; Jenkins only
  int slider = -1;        // index in State::z; -1: no memory
};

/// (cosine cos n omega t + sine sin n omega t) d.
struct HarmonicForce {
  Vector direction;
  int harmonic = 1;
  double cosine = 0, sine = 0;  // N
};

struct EquationOfMotion {
  double omega = 0;  // rad/s
  Matrix M, C, K;    // dofs x dofs; kg, N s/m, N/m
  std::vector<Element> elements;
  std::vector<HarmonicForce> forces;
  Vector response;  // direction whose motion is observed
  int sliders = 0;
  std::vector<std::string> dof_names;  // for messages; may be empty

  int dofs() const { return static_cast<int>(M.rows()); }
  /// Of the excitation, 2 pi/omega, s.
  double period() const;
  /// The excitation at time t (s), N.
  void force(double t, Vector& f) const;
  /// True where the motion between two events is that of a linear system: no cubic spring.
  bool is_piecewise_linear() const;
};

struct State {
  Vector x, v, z;  // m, m/s, m; z: sliders
};

/// p: as model.parameters, "frequency" included (rad/s).
EquationOfMotion equation_of_motion(const model::Model& model, const continuation::Vector& p);

/// Everything at rest, sliders without force.
State at_rest(const EquationOfMotion& equation);

}  // namespace arcslip::time

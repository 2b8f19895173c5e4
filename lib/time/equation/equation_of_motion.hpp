#pragma once
// A model in the time domain, at given parameters:
//
//   M x'' + C x' + K x + sum_e d_e f_e(d_e . x) = sum_k d_k (c_k cos n_k omega t + s_k sin n_k omega t)
//
// q = d . x, with a sum over the directions of each element. Laws may remember: the state is (x, x', z), and
// the slider of a friction element is where its z is (laws/law.hpp).

#include <arcslip/control/error.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/results/time_reasons.hpp>

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace arcslip::time {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// A degree of freedom without mass: its motion has no state of its own.
class SingularMass : public Error {
  using Error::Error;
};

/// One nonlinear element with its numbers.
struct TimeElement {
  std::string name;
  std::shared_ptr<const elements::Law> law;
  std::vector<double> fields;
  Matrix directions;  // dofs x directions, d in each column
  int memory = 0;     // where its own begins in MotionState::z
};

/// (cosine cos n omega t + sine sin n omega t) d.
struct HarmonicForce {
  Vector direction;
  int harmonic = 1;
  double cosine = 0, sine = 0;  // N
};

/// cosine cos n omega t + sine sin n omega t: of the ground, along the response.
struct BaseMotion {
  int harmonic = 1;
  double cosine = 0, sine = 0;  // m
};

struct EquationOfMotion {
  double omega = 0;  // base frequency, rad/s: n is an order of it
  int periods = 1;   // of the excitation in one of the motion
  Matrix M, C, K;    // dofs x dofs; kg, N s/m, N/m
  std::vector<TimeElement> elements;
  std::vector<HarmonicForce> forces;
  Vector response;                     // direction whose motion is observed
  std::vector<BaseMotion> base;        // added to it
  int memory = 0;                      // numbers in MotionState::z
  std::vector<std::string> dof_names;  // for messages; may be empty

  int dofs() const { return static_cast<int>(M.rows()); }
  /// The skew-symmetric part of K, whose forces are those of no potential; empty where K is symmetric.
  Matrix circulatory() const;
  /// 2 pi/omega, s: that of the motion sought, one or several of the excitation.
  double period() const;
  /// The phase of the excitation, rad, at a share of the period.
  double phase(double share) const;
  /// The excitation at time t (s), N.
  void force(double t, Vector& f) const;
  /// The observed displacement and velocity.
  struct Observed {
    double x, v;
  };
  Observed observed(double t, const Vector& x, const Vector& v) const;
  /// With its memory after that of the elements before.
  void add(std::string name, std::shared_ptr<const elements::Law> law, std::vector<double> fields,
           Matrix directions);
};

struct MotionState {
  Vector x, v, z;  // m, m/s; z: the memory of all elements, m for sliders
};

/// A model that has no equation of motion: a law whose force at rest is set-valued (Law::set_valued()), or a
/// loss factor, or one sector of a ring; or none with one response.
class NotInTime : public Error {
 public:
  NotInTime(results::Reason reason, const std::string& message) : Error(message), reason_(reason) {}
  results::Reason reason() const { return reason_; }

 private:
  results::Reason reason_;
};

/// Throws NotInTime where the response is the largest of several places.
void check_response(const model::Model& model);

/// p: as model.parameters, "frequency" included (rad/s). With several places of the response, that is the
/// first one. Throws NotInTime.
EquationOfMotion equation_of_motion(const model::Model& model, const continuation::Vector& p);

/// Everything at rest, without memory of force.
MotionState at_rest(const EquationOfMotion& equation);

}  // namespace arcslip::time

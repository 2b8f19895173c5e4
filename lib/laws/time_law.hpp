#pragma once
// A law of force in time, at given fields: the force at a state, and over a step in which each displacement
// is monotonic. The state is q, the displacements (m), and z, the memory of the law.

#include <arcslip/fourier/series.hpp>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace arcslip::elements {

struct Automaton;  // laws/automaton.hpp

/// The start of a step in time: q, z and the force f.
struct StepStart {
  In q, z, f;
};
/// The end of the step, or a state. A law sets everything that may differ from its previous values here.
struct StepEnd {
  StepEnd(int directions, int memory);

  Eigen::VectorXd f, dz;  // the force, N, and the change of the memory
  Eigen::VectorXd v;      // the velocities there, m/s: given to laws that are rate-dependent
  double phase = 0;       // of the excitation there, rad: given to laws that depend on it
  // Their derivatives, of f and of z + dz: by the displacement at the end, by the memory at the start, and by
  // the displacement at the start, with the others fixed.
  Eigen::MatrixXd f_q, f_z, f_start;
  Eigen::MatrixXd f_v;  // by v, with all of these fixed
  Eigen::MatrixXd z_q, z_z, z_start;
  double dissipated = 0;   // in the step, J
  double stick_share = 1;  // of the step, where there is a contact
  double open_share = 0;   // of the step, in separation
};

/// Made by Law::in_time(). It may own buffers: for one thread.
class TimeLaw {
 public:
  virtual ~TimeLaw() = default;

  /// The memory for which the force at q is f, as closely as possible.
  virtual void memory_at(In q, In f, Out z) {
    static_cast<void>(q), static_cast<void>(f), static_cast<void>(z);
  }
  /// The force at a state (f, f_q and f_z), with admissible z: a slider beyond its limit is moved to it.
  virtual void begin(In q, Out z, StepEnd& at) = 0;
  /// A step to q + dq, with each q monotonic.
  virtual void step(const StepStart& start, In dq, StepEnd& end) = 0;
  /// Elastic energy at q and z, J.
  virtual double stored(In q, In z) = 0;
};

/// Of automata that act in parallel. Steps go from guard to guard and are exact.
std::unique_ptr<TimeLaw> time_law(const std::vector<Automaton>& automata);

}  // namespace arcslip::elements

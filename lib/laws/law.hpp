#pragma once
// A law of force: the interface of nonlinear elements. Those of scene files have a type, too
// (laws/law_type.hpp).
//
// A law acts on the displacements q_1 ... q_d along its directions, q_i = d_i . x, with the force f(q), N,
// against the motion: M x'' + C x' + K x + sum_i d_i f_i = excitation. It may have internal variables z, its
// memory, or depend on the velocities v = q' (m/s). Fields are the values of its parameters, in the order of
// its type's fields.
//
// A smooth law of one's own is its force (laws/sampled_law.hpp); a piecewise linear one, with or without
// memory, its automata (laws/automaton.hpp). But for its facts(), all else has a default that follows from
// them.
//
// Laws are immutable and may be shared by threads. Mutable state is in what a law creates: an Element for
// harmonic balance, a TimeLaw for motions in time.

#include <arcslip/laws/automaton.hpp>
#include <arcslip/laws/element.hpp>
#include <arcslip/laws/grazing_condition.hpp>
#include <arcslip/laws/hysteresis.hpp>
#include <arcslip/laws/planar_friction.hpp>
#include <arcslip/laws/time_law.hpp>

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace arcslip::elements {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
using Fields = std::span<const double>;
using Angles = std::span<const double>;  // rad

/// How an element is sampled in time, if its law may be.
struct Sampling {
  bool exact = true;  // by integrals in closed form, where the law has them
  int samples = 512;  // in a period, else
};

/// Properties of a law along one of its directions, at given fields; not used within residuals.
struct Traits {
  double stiffness = 0;            // N/m: the maximum of |df/dq| over all motions; infinity if unbounded
  int stiffness_field = -1;        // the field that is this stiffness; -1: none
  bool holds_mean = false;         // a constant displacement causes a restoring force
  bool holds_in_stick = false;     // it does so while the contact sticks throughout the period
  bool several_responses = false;  // periodic responses may coexist
  double far_power = 0;            // the elastic force grows as amplitude^far_power where that is large
  double far_work = 0;  // N: dissipated there in an oscillation, over its amplitude; infinity if that grows
  double limit = infinity;  // N: the largest force of friction
};

/// What is known of a law whatever its fields.
struct Facts {
  bool antisymmetric = false;    // f(-q) = -f(q) for every motion, so that one of these has such a force
  bool contact = false;          // it sticks and slips: Element::friction()
  bool reports_contact = false;  // it says what its contact does: Element::contact()
  bool normal_load = false;      // it has one that varies, and may open
  bool dissipative = false;      // it dissipates energy in a periodic motion
  bool rate_dependent =
      false;  // the force has velocities: Element::set_frequency(), StepEnd::v; no memory has
  bool phase_dependent = false;  // it has the phase of the excitation: StepEnd::phase. Such a law has no free
                                 // vibration, and no symmetry in time
  bool may_jump = false;         // without memory: along a smooth motion, and no multipliers are known
  bool approximates =
      false;  // coefficients are those of samples that leave an error, which falls with the order
  bool set_valued = false;     // at rest the force may be any within its limits, as of friction without a
                               // stiffness: motions that stop are reported (Element::jump_over_bend()), and
                               // it is refused in time
  bool symmetric_step = true;  // StepEnd::f_q is symmetric in every state
  int auxiliary = 0;  // unknowns of the element's own, each with as many coefficients as a displacement,
                      // and as many equations: the rows of its force after those of the directions
  int memory = 0;     // internal variables, in time
};

class Law {
 public:
  virtual ~Law() = default;

  virtual int directions() const { return 1; }

  virtual Facts facts() const { return {}; }
  bool antisymmetric() const { return facts().antisymmetric; }
  bool has_contact() const { return facts().contact; }
  bool reports_contact() const { return facts().reports_contact; }
  bool has_normal_load() const { return facts().normal_load; }
  bool dissipative() const { return facts().dissipative; }
  bool rate_dependent() const { return facts().rate_dependent; }
  bool phase_dependent() const { return facts().phase_dependent; }
  bool may_jump() const { return facts().may_jump; }
  bool approximates() const { return facts().approximates; }
  bool set_valued() const { return facts().set_valued; }
  bool symmetric_step() const { return facts().symmetric_step; }
  int auxiliary() const { return facts().auxiliary; }
  int memory() const { return facts().memory; }

  /// The normal load, N, at a displacement along the last direction, where there is one; monotonic.
  virtual double normal_load_at(Fields fields, double displacement) const {
    static_cast<void>(fields), static_cast<void>(displacement);
    return 0;
  }
  /// Adds the angles in one span of the harmonics at which the force of a law without memory has kinks, u as
  /// in Element::move_to, at a base frequency (rad/s).
  virtual void add_kinks(const Harmonics& harmonics, In u, double base_frequency, Fields fields,
                         std::vector<double>& angles) const {
    static_cast<void>(harmonics), static_cast<void>(u), static_cast<void>(base_frequency);
    static_cast<void>(fields), static_cast<void>(angles);
  }
  virtual Traits traits(Fields fields, int direction) const;
  /// The largest |df/dq| while |q| stays within `reach`, N/m; finite.
  virtual double stiffness(Fields fields, int direction, double reach) const;
  /// Whether Traits::limit changes with a field.
  virtual bool limited_by(int field) const {
    static_cast<void>(field);
    return false;
  }

  // In the frequency domain.

  /// The typical size of its auxiliary unknowns. Norms of solutions weight all unknowns equally: choose units
  /// in which they are about as large as displacements.
  virtual double auxiliary_scale(Fields fields) const {
    static_cast<void>(fields);
    return 1;
  }
  virtual std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling& sampling) const;
  /// The corners of branches of responses; null: none known.
  virtual std::unique_ptr<Corners> corners(const Harmonics& harmonics) const {
    static_cast<void>(harmonics);
    return nullptr;
  }
  /// The exact force, or that of the default element, at some angles of the motion u (as in
  /// Element::move_to): angles x directions, N.
  virtual Eigen::MatrixXd force_at(const Harmonics& harmonics, In u, Fields fields, Angles angles) const;
  /// The same at a base frequency, rad/s, of laws that are rate-dependent.
  virtual Eigen::MatrixXd moving_force_at(const Harmonics& harmonics, In u, double base_frequency,
                                          Fields fields, Angles angles) const {
    static_cast<void>(base_frequency);
    return force_at(harmonics, u, fields, angles);
  }

  // In time.

  /// The law as automata, if it is piecewise linear. Several act in parallel. Its motion in time, multipliers
  /// and sliders follow from them.
  virtual std::optional<std::vector<Automaton>> automata(Fields fields) const {
    static_cast<void>(fields);
    return {};
  }
  /// Throws std::logic_error where a law has neither this function nor automata.
  virtual std::unique_ptr<TimeLaw> in_time(Fields fields) const;
  /// Its memories that are the positions of sliders.
  virtual std::vector<Slider> sliders(Fields fields) const;

  // Optional parts, of laws with a memory that are not piecewise linear: with them their multipliers are
  // known. Null: none.
  virtual const Hysteresis* hysteresis() const { return nullptr; }
  virtual const PlaneFriction* plane_friction() const { return nullptr; }
};

/// Those of a law. Throws std::logic_error where it has none, or where they do not fit its directions and its
/// memory.
std::vector<Automaton> automata_of(const Law& law, Fields fields);

/// The symmetric part of df/dq at rest (directions x directions, N/m); of a law with a memory its largest
/// stiffnesses.
Eigen::MatrixXd tangent_at_rest(const Law& law, Fields fields);

}  // namespace arcslip::elements

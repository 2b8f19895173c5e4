#pragma once
// A law of force: the interface of nonlinear elements. A law is one class in one pair of files.
//
//   class Hardening final : public elements::PlainLaw { ... };
//   scene::Catalogue catalogue = studies::catalogue();
//   catalogue.elements.push_back(std::make_shared<Hardening>());
//   const auto scene = scene::read_file("scene.json", catalogue);
//
// A law acts on the displacements q_1 ... q_d along its directions, q_i = d_i . x, with the force f(q), N,
// against the motion: M x'' + C x' + K x + sum_i d_i f_i = excitation. It may have internal variables z, its
// memory, or depend on the velocities v = q' (m/s). Fields are the values of its parameters, in the order of
// its type's fields.
//
// Laws are immutable and may be shared by threads. Mutable state is in the Element that a law creates for
// harmonic balance, and in the arguments of step().

#include <arcslip/laws/automaton.hpp>
#include <arcslip/laws/element.hpp>
#include <arcslip/laws/grazing_condition.hpp>
#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace arcslip::elements {

using scene::infinity;
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
  double limit = std::numeric_limits<double>::infinity();  // N: the largest force of friction
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

/// What a law keeps between its calls with the same SampledForce.
struct Scratch {
  virtual ~Scratch() = default;
};

/// The force of a law without memory at several q at once: a row for each. A law sets everything that may
/// differ from its previous values here.
struct SampledForce {
  SampledForce() = default;
  SampledForce(Eigen::Index rows, Eigen::Index directions, Eigen::Index fields);

  Eigen::MatrixXd f;                 // a column for each direction, N
  Eigen::MatrixXd f_q;               // df_i/dq_j in column j * directions + i
  Eigen::MatrixXd f_v;               // df_i/dv_j likewise, where the law is rate-dependent
  Eigen::MatrixXd f_field;           // df_i/d(fields[k]) in column k * directions + i
  std::uint64_t piece = 0;           // another number where many samples go over a kink of f together
  std::unique_ptr<Scratch> scratch;  // the law's own; none at first
};

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

  SampledForce sample;  // for the law's own use, kept for the next step
  Eigen::MatrixXd sample_q, sample_v;
  Eigen::VectorXd sample_phase;
};

class Law;

/// The type of a law in a scene file.
class LawType : public scene::PartType {
 public:
  /// The law with these options.
  virtual std::shared_ptr<const Law> law(const scene::Settings& options) const = 0;
  bool has_wear(const scene::Settings& options) const override;
};

class Law {
 public:
  virtual ~Law() = default;

  virtual int directions() const { return 1; }

  virtual Facts facts() const = 0;
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
  virtual Traits traits(Fields fields, int direction) const = 0;
  /// The largest |df/dq| while |q| stays within `reach`, N/m; finite.
  virtual double stiffness(Fields fields, int direction, double reach) const = 0;
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
  virtual std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling& sampling) const = 0;
  /// The corners of branches of responses; null: none known.
  virtual std::unique_ptr<Corners> corners(const Harmonics& harmonics) const {
    static_cast<void>(harmonics);
    return nullptr;
  }
  /// The exact force at some angles of the motion u (as in Element::move_to): angles x directions, N.
  virtual Eigen::MatrixXd force_at(const Harmonics& harmonics, In u, Fields fields, Angles angles) const = 0;
  /// The same at a base frequency, rad/s, of laws that are rate-dependent.
  virtual Eigen::MatrixXd moving_force_at(const Harmonics& harmonics, In u, double base_frequency,
                                          Fields fields, Angles angles) const {
    static_cast<void>(base_frequency);
    return force_at(harmonics, u, fields, angles);
  }

  // In time.

  /// The direction whose slider position memory k is, so that its offset is arbitrary while it rests;
  /// -1: none.
  virtual int slider_direction(int k) const {
    static_cast<void>(k);
    return -1;
  }
  /// Memory k, a slider in the one direction of all, rests between two bounds that move: the derivative by q
  /// of the lower one (side -1) or of the upper one (1). Their centre at q = 0 is 0.
  virtual Eigen::RowVectorXd slider_bound(Fields fields, int k, int side) const;
  /// Half the distance of these bounds at q = 0, of a slider with a static offset (slider_offset.hpp); none:
  /// it is centred.
  virtual std::optional<double> slider_room(Fields fields, int k) const {
    static_cast<void>(fields), static_cast<void>(k);
    return {};
  }
  /// The memory for which the force at q is f, as closely as possible.
  virtual void memory_at(Fields fields, In q, In f, Out z) const {
    static_cast<void>(fields), static_cast<void>(q), static_cast<void>(f), static_cast<void>(z);
  }
  /// The force at a state (f, f_q and f_z), with admissible z: a slider beyond its limit is moved to it.
  virtual void begin(Fields fields, In q, Out z, StepEnd& at) const = 0;
  /// A step to q + dq, with each q monotonic.
  virtual void step(Fields fields, const StepStart& start, In dq, StepEnd& end) const = 0;
  /// Elastic energy at q and z, J.
  virtual double stored(Fields fields, In q, In z) const = 0;
  /// The law as automata, if it is piecewise linear. Several act in parallel.
  virtual std::optional<std::vector<Automaton>> automata(Fields fields) const;
};

/// A law without options is its own type, and so is one whose options have their defaults. It must outlive
/// all scenes and models that use it.
class PlainLaw : public LawType, public Law {
 public:
  int directions() const final { return static_cast<int>(direction_count()); }
  std::shared_ptr<const Law> law(const scene::Settings&) const override {
    return {std::shared_ptr<const void>(), this};
  }
};

/// The symmetric part of df/dq at rest (directions x directions, N/m); of a law with a memory its largest
/// stiffnesses.
Eigen::MatrixXd tangent_at_rest(const Law& law, Fields fields);

/// The law of an element of a scene. Throws std::invalid_argument if its type is not a law.
std::shared_ptr<const Law> law_of(const scene::Part& part);

}  // namespace arcslip::elements

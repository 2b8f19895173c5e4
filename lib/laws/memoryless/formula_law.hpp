#pragma once
// A law without memory from formulas of its force (formula/formula.hpp):
//
//   f_i = f_i(q, v, phase, fields)
//
// with the displacement q (m) and the velocity v (m/s) along one direction, or q1, q2 ... and v1, v2 ...
// along several, the phase of the excitation (rad) and the fields by name. Sampled; coefficients and Jacobian
// are exact for the harmonics kept where f is a polynomial in q and v with coefficients that are sums of
// cosines and sines of whole multiples of the phase. Other smooth formulas have 32 N + 64 samples in a
// period: their error falls as fast as the harmonics of f do. With kinks or jumps (abs, sign, min, max,
// comparisons, if) each piece between them is integrated by itself (kinked_element.hpp).
//
// A force along one direction that does not depend on the phase stores the energy of f(q, v = 0); the rest of
// its work is dissipated, which may be negative. Others store nothing, but for those with Work::stored.

#include <arcslip/formula/evaluator.hpp>
#include <arcslip/formula/facts.hpp>
#include <arcslip/laws/sampled_law.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::elements {

/// The numbers of the inputs of a law's formulas.
struct FormulaInputs {
  int directions, fields;

  int count() const { return 2 * directions + 1 + fields; }
  int displacement(int i) const { return i; }
  int velocity(int i) const { return directions + i; }
  int phase() const { return 2 * directions; }
  int field(int k) const { return 2 * directions + 1 + k; }
  /// Of a name; fields come after the names of the motion, and pi.
  formula::InputOf names(std::vector<std::string> fields) const;
};

/// The names of displacements, velocities and of the phase; no field may have one of them.
std::vector<std::string> motion_names(int directions);

class FormulaLaw : public SampledLaw {
 public:
  /// Of forces along several directions, which may have a potential.
  enum class Work { dissipated, stored };

  /// name, help and fields must outlive the law; a formula for each direction. names: of the fields in the
  /// formulas, where they have others there. Throws formula::FormulaError.
  FormulaLaw(std::string_view name, std::string_view help, const std::vector<std::string>& forces,
             std::span<const scene::Field> fields, Work work = Work::dissipated,
             const std::vector<std::string>& names = {});

  std::string_view name() const override { return name_; }
  std::string_view help() const override { return help_; }
  std::span<const std::string_view> slots() const override { return slots_; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return fields_; }

  Facts facts() const override {
    return {.antisymmetric = antisymmetric_,
            .dissipative = !potential_,
            .rate_dependent = rate_dependent_,
            .phase_dependent = phase_dependent_,
            .may_jump = may_jump_,
            .approximates = !degree_of_pieces_,
            .symmetric_step = inputs_.directions == 1 || potential_};
  }
  void add_kinks(const Harmonics& harmonics, In u, double base_frequency, Fields fields,
                 std::vector<double>& angles) const override;
  std::unique_ptr<Element> element(const Harmonics& harmonics, const Sampling& sampling) const override;
  Traits traits(Fields fields, int direction) const override;
  std::optional<std::vector<Automaton>> automata(Fields fields) const override;

  int samples(const Harmonics& harmonics) const override;
  void sample(Fields fields, const Eigen::MatrixXd& q, SampledForce& at) const override;  // at rest
  void sample_motion(Fields fields, const SampledMotion& motion, Wanted wanted,
                     SampledForce& at) const override;

  const FormulaInputs& inputs() const { return inputs_; }
  const formula::Formula& formula() const { return formula_; }
  /// What changes its sign at its kinks: formula::switches().
  const formula::Formula& switches() const { return switches_; }
  bool has_kinks() const { return !switches_.results().empty(); }
  /// Of the pieces between them; none: they are no polynomials.
  const std::optional<formula::Degree>& degree_of_pieces() const { return degree_of_pieces_; }

 protected:
  Shape shape(Fields fields, int direction) const override;

 private:
  /// The coefficients of f(q), v = 0, of a law along one direction, where it is a polynomial of q alone.
  std::optional<std::vector<double>> polynomial(Fields fields) const;
  int stiffness_field(Fields fields) const;

  std::string_view name_, help_;
  std::span<const scene::Field> fields_;
  FormulaInputs inputs_;
  formula::Formula formula_, switches_;
  std::vector<std::string_view> slots_;
  std::vector<std::string> slot_names_;
  // The highest of all forces, and of their pieces between kinks; none: of some it is not known.
  std::optional<formula::Degree> degree_, degree_of_pieces_;
  bool antisymmetric_ = true, rate_dependent_ = false, phase_dependent_ = false, potential_ = false,
       may_jump_ = false;
};

}  // namespace arcslip::elements

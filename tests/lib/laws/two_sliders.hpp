#pragma once
// Two sliders with springs side by side in one element: two numbers of memory, two automata.

#include <arcslip/laws/hysteresis/jenkins.hpp>

#include <limits>

namespace own_laws {

using namespace arcslip;
using elements::Fields, elements::In, elements::Out;

class TwoSlidersElement final : public elements::Element {
 public:
  explicit TwoSlidersElement(const elements::Harmonics& h)
      : first_(elements::make_jenkins(h)), second_(elements::make_jenkins(h)) {}
  void move_to(In u, Fields fields, bool jacobian) override {
    first_->move_to(u, fields.first(3), jacobian);
    second_->move_to(u, fields.subspan(3), jacobian);
    F_ = first_->force() + second_->force();
    if (jacobian) J_ = first_->jacobian() + second_->jacobian();
  }
  const Eigen::VectorXd& force() const override { return F_; }
  const Eigen::MatrixXd& jacobian() const override { return J_; }
  void field_derivative(int field, Out dF) const override {
    (field < 3 ? first_ : second_)->field_derivative(field % 3, dF);
  }
  std::uint64_t piece() const override { return first_->piece() * 31 + second_->piece(); }
  bool friction(elements::FrictionState& state) const override {
    elements::FrictionState other;
    first_->friction(state);
    second_->friction(other);
    state.stick_share = 0.5 * (state.stick_share + other.stick_share);
    return true;
  }

 private:
  std::unique_ptr<Element> first_, second_;
  Eigen::VectorXd F_;
  Eigen::MatrixXd J_;
};

constexpr scene::Field positive_field(std::string_view name) {
  return {.name = name,
          .unit = "-",
          .lower = 0,
          .upper = std::numeric_limits<double>::infinity(),
          .lower_open = true,
          .help = "of one slider"};
}

class TwoSliders : public elements::PlainLaw {
 public:
  std::string_view name() const override { return "two_sliders"; }
  std::string_view help() const override { return "two sliders side by side"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return fields_; }

  elements::Facts facts() const override {
    return {.antisymmetric = true, .contact = true, .dissipative = true, .memory = 2};
  }
  elements::Traits traits(Fields fields, int) const override {
    elements::Traits sum = one().traits(fields.first(3), 0);
    const elements::Traits other = one().traits(fields.subspan(3), 0);
    sum.stiffness += other.stiffness;
    sum.stiffness_field = -1;
    sum.far_work += other.far_work;
    sum.limit += other.limit;
    return sum;
  }
  double stiffness(Fields fields, int direction, double) const override {
    return traits(fields, direction).stiffness;
  }
  std::unique_ptr<elements::Element> element(const elements::Harmonics& harmonics,
                                             const elements::Sampling&) const override {
    return std::make_unique<TwoSlidersElement>(harmonics);
  }
  Eigen::MatrixXd force_at(const elements::Harmonics& harmonics, In u, Fields fields,
                           elements::Angles angles) const override {
    return one().force_at(harmonics, u, fields.first(3), angles) +
           one().force_at(harmonics, u, fields.subspan(3), angles);
  }

  std::optional<std::vector<elements::Automaton>> automata(Fields fields) const override {
    auto both = *one().automata(part(fields, 0));
    both.push_back(one().automata(part(fields, 1))->front());
    both.back().memory = 1;
    return both;
  }

 private:
  static const elements::PlainLaw& one() { return elements::jenkins(); }
  static Fields part(Fields fields, int i) { return fields.subspan(static_cast<std::size_t>(3 * i), 3); }

  static constexpr scene::Field fields_[] = {positive_field("k1"),    positive_field("mu1"),
                                             positive_field("load1"), positive_field("k2"),
                                             positive_field("mu2"),   positive_field("load2")};
};

}  // namespace own_laws

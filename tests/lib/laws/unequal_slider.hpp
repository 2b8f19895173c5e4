#pragma once
// A law that is its automaton alone: a spring of stiffness k to a slider with another slip limit each way,
// -p_2 <= f <= p_1.

#include "lib/laws/two_sliders.hpp"

#include <arcslip/laws/law_type.hpp>

namespace own_laws {

using namespace arcslip;

class UnequalSlider final : public elements::PlainLaw {
 public:
  std::string_view name() const override { return "unequal_slider"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return fields_; }
  elements::Facts facts() const override { return {.contact = true, .dissipative = true, .memory = 1}; }

  std::optional<std::vector<elements::Automaton>> automata(elements::Fields fields) const override {
    const double k = fields[0], up = fields[1], down = fields[2];
    elements::Automaton slider(0);
    elements::Mode& stick = slider.add("stick", k, -k, 0);
    stick.leaves_where(-k, 0, k, up, 1);
    stick.leaves_where(k, 0, -k, down, 2);
    slider.add("slip+", 0, 0, up).follows(1, -up / k, 1).leaves_where(0, 1, 0, 0, 0);
    slider.add("slip-", 0, 0, -down).follows(1, down / k, -1).leaves_where(0, -1, 0, 0, 0);
    return std::vector{slider};
  }

 private:
  static constexpr scene::Field fields_[] = {positive_field("stiffness"), positive_field("up"),
                                             positive_field("down")};
};

}  // namespace own_laws

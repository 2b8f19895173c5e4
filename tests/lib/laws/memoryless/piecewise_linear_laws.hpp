#pragma once
// The piecewise linear springs with their options.

#include <arcslip/laws/memoryless/bilinear_spring.hpp>
#include <arcslip/laws/memoryless/gap_spring.hpp>
#include <arcslip/laws/memoryless/piecewise_linear_spring.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace piecewise_linear_laws {

using namespace arcslip;
using LawPointer = std::shared_ptr<const elements::Law>;

inline LawPointer gap(bool two_sided) {
  return elements::gap_spring().law(scene::Settings::of(elements::GapSpringOptions{two_sided}));
}
inline LawPointer bilinear(bool one_sided) {
  return elements::bilinear_spring().law(scene::Settings::of(elements::BilinearSpringOptions{one_sided}));
}
inline LawPointer table(std::vector<std::pair<double, double>> points) {
  return elements::piecewise_linear_spring().law(
      scene::Settings::of(elements::PiecewiseLinearTable{std::move(points)}));
}

}  // namespace piecewise_linear_laws

#pragma once
// The parallel-series model of Iwan: springs, each in series with a slider, side by side. The distribution of
// their slip limits is an option:
//
//   "uniform"         fields stiffness K_T, N/m, and slip_force F_S, N: iwan_power_law.hpp
//   "four-parameter"  besides exponent chi and beta: iwan_power_law.hpp
//   "table"           sliders [stiffness, slip limit]; fields stiffness_factor and slip_factor
//
// In the frequency domain no distribution is divided into sliders (masing_element.hpp). The sliders of a
// table are integrated in closed form; power laws by Gauss quadrature between the ends of the parts of
// branches, with a substitution where |t|^(2 chi + 2) begins.
//
// In time the sliders are the memory, as those of jenkins.hpp: those of the table, or as many as the option
// "sliders" says, of which each has the stiffness and the slip force of a range of slip limits: the error
// falls as sliders^-2. FrictionState: the stick share is that of the stiffness of the sliders that stick,
// averaged over the period; slip of single sliders is not told.

#include <arcslip/elements/law.hpp>

#include <utility>
#include <vector>

namespace arcslip::elements {

/// "iwan".
const LawType& iwan();

/// Stiffness, N/m, and slip limit, N, both above 0.
using Slider = std::pair<double, double>;

class MasingElement;

/// fields: stiffness, slip_force and, of four, exponent and beta.
std::unique_ptr<MasingElement> make_iwan_power_law(const Harmonics& harmonics, bool uniform);
/// fields: stiffness_factor, slip_factor. In the order of their slip displacements.
std::unique_ptr<MasingElement> make_iwan_table(const Harmonics& harmonics, std::vector<Slider> sliders);

}  // namespace arcslip::elements

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
// averaged over the period; slip of single sliders is not reported.

#include <arcslip/laws/law_type.hpp>

#include <functional>
#include <utility>
#include <vector>

namespace arcslip::elements {

/// "iwan".
const LawType& iwan();

/// Stiffness, N/m, and slip limit, N, both above 0.
using IwanSlider = std::pair<double, double>;

class MasingElement;

/// fields: stiffness, slip_force and, of four, exponent and beta.
std::unique_ptr<MasingElement> make_iwan_power_law(const Harmonics& harmonics, bool uniform);
/// fields: stiffness_factor, slip_factor. Sliders in any order.
std::unique_ptr<MasingElement> make_iwan_table(const Harmonics& harmonics, std::vector<IwanSlider> sliders);

/// The sliders that begin to slip at a corner, in the order of their slip displacements.
struct IwanOnsets {
  int count;  // guards 2 j and 2 j + 1: slider j
  int fields;
  bool microslip;                                            // others slip in any motion
  std::function<double(std::span<const double>)> stiffness;  // K, N/m
  /// K times the slip displacement of one, N, and its derivatives by the fields; 0: no corner.
  std::function<double(std::span<const double>, int, Eigen::VectorXd&)> force;
};

/// Angles theta_a, theta_r, both reversals of w. Slider j, stuck since theta_a, begins to slip in the
/// direction s just at theta_r; or the two are equally high (s = 1) or low (s = -1) and another of them is
/// the anchor of what follows, after the sliders in the order of guards:
///
///   h = s K (w(theta_r) - w(theta_a))/2 - K s_j,   h = s K (w(theta_r) - w(theta_a))/2,  N
std::unique_ptr<Corners> make_iwan_corners(const Harmonics& harmonics, IwanOnsets onsets);

}  // namespace arcslip::elements

#pragma once
#include <arcslip/laws/contact/planar_slider.hpp>

namespace arcslip::elements {

/// The first angle in [begin, end) at which a slider that rests at w meets the edge of the disc, where
/// |x - w|^2 - h^2 becomes positive; infinite if there is none. It is approached in steps over which a
/// polynomial from the derivatives up to the second, and bounds of the third, excludes that, so that no onset
/// is missed. at_edge: w is at the edge at `begin`, where its slip has ended.
double slip_onset(const Disc& disc, const Eigen::Vector2d& w, bool at_edge, double begin, double end);

}  // namespace arcslip::elements

#pragma once
// How far a response depends on the offsets of sliders that stick throughout the period.
//
// Each slider may rest anywhere between its bounds, w = (1 - s) a + s b with 0 <= s <= 1
// (laws/slider_offset.hpp), so that the periodic motions with the same contacts in stick are a family over a
// box of s, one for each slider that may stick. A contact that slips has no s. Where no contact slips and the
// rest is linear, the offsets are forces that shift the mean, x(theta) + m, with m linear in the offsets and
// these between parallel planes: A = max |x + m| is convex in m, its maximum at a corner of the box and its
// minimum at min |m + (max x + min x)/2|. With slip elsewhere neither is certain.
//
// Both are searched for with the derivatives from one adjoint solve,
//
//   J^T l = dA/du,   dA/ds_e = r_e l.e_e,   r_e = k (b - a): the range of the mean force of the contact e,
//
// e_e its mean along the first direction: from the corners at which the mean of the response is largest and
// least, to the corner that the derivatives point to, as long as that is better (the maximum), and by line
// searches on the way there (the minimum).

#include <arcslip/hbm/problem.hpp>
#include <arcslip/results/response.hpp>

#include <memory>
#include <string>

namespace arcslip::observables {

struct OffsetRange {
  double amplitude_min = no_value, amplitude_max = no_value;  // m
  int sliders = 0;      // that stick throughout the period in the response itself, and may rest elsewhere
  std::string failure;  // why there is no range, or a part of it only; empty: all is known
};

/// u: a solution of the problem at p.
OffsetRange offset_range(const hbm::HbmProblem& problem, continuation::In u, const continuation::Vector& p);

}  // namespace arcslip::observables

#pragma once
// The totals of patches of contacts over a period, and the extremes over their contacts.

#include <arcslip/hbm/problem.hpp>
#include <arcslip/results/response.hpp>

#include <cmath>
#include <cstddef>
#include <span>

namespace arcslip::observables {

/// Adds a contact of this area to the extremes. Each: ElementResponse or ElementMotion.
template <class Each>
void add_contact(const Each& each, double area, ContactExtremes& to) {
  to.stick_percent_min = std::fmin(to.stick_percent_min, each.stick_percent);
  to.energy_per_area_max = std::fmax(to.energy_per_area_max, each.energy / area);
  to.wear_depth_rate_max = std::fmax(to.wear_depth_rate_max, each.wear_rate / area);
  if (each.has_normal_load) to.pressure_max = std::fmax(to.pressure_max, each.normal_load_max / area);
}

/// Energy and wear rate: the sums over the elements. Stick and open shares: their means weighted by the area.
/// The normal load is not known by this. Each: ElementResponse or ElementMotion.
template <class Each>
Each total(const model::Patch& patch, std::span<const Each> elements) {
  Each sum;
  sum.name = patch.name;
  double area = 0;
  sum.wear_rate = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Each& each = elements[i];
    sum.has_normal_load = each.has_normal_load;
    sum.energy += each.energy;
    sum.wear_rate += each.wear_rate;
    sum.stick_percent += patch.areas[i] * each.stick_percent;
    sum.open_percent += patch.areas[i] * each.open_percent;
    area += patch.areas[i];
    add_contact(each, patch.areas[i], sum.extremes);
  }
  sum.stick_percent /= area;
  sum.open_percent /= area;
  return sum;
}

/// Adds the totals of every patch to a response with all of its elements. The extremes of the total normal
/// load are sought between many angles of the period and refined.
void add_patches(const hbm::HbmProblem& problem, const hbm::HbmEvaluator& at, elements::In p,
                 ResponsePoint& point);

}  // namespace arcslip::observables

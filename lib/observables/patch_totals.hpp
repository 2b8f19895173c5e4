#pragma once
// The totals of patches of contacts over a period.

#include <arcslip/hbm/problem.hpp>
#include <arcslip/results/response.hpp>

#include <span>

namespace arcslip::observables {

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

#pragma once
// Optima for each combination of lists of values.

#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <vector>

namespace optima {

inline std::vector<arcslip::optimize::OptimumResult> of(const arcslip::scene::Scene& scene,
                                                        const arcslip::optimize::OptimumSettings& settings,
                                                        const arcslip::scene::ValueLists& lists) {
  using namespace arcslip;
  const auto compute = [&](const studies::Case& at, const control::Control& control) {
    return std::vector{optimize::optimum_study(at.scene, settings, control, {.alone = at.alone})};
  };
  return studies::for_each<optimize::OptimumResult>(scene, lists, compute);
}

}  // namespace optima

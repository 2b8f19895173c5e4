#pragma once
// The circumstances that a study of kind "optimum" is to serve. Private to scene/.

#include <arcslip/scene/study_parameters.hpp>

namespace arcslip::scene::detail {

/// Values of parameters, whose product is the cases, or a list of cases; place: it, or nothing.
void read_cases(const Place& place, const Parameters& all, const Dofs& dofs, Study& study, Faults& faults);

/// Pairs [lower, upper] by the names of parameters; place: the object, or nothing.
void read_scatter(const Place& place, const Parameters& all, Study& study, Faults& faults);

/// What counts of the cases, which are read already, and what scatters.
void read_criterion(const Keys& keys, Study& study, Faults& faults);

}  // namespace arcslip::scene::detail

#pragma once
// What studies of kind "optimum" vary, and within which limits. Private to scene/.

#include <arcslip/scene/study_parameters.hpp>

namespace arcslip::scene::detail {

/// The parameters of a design in "over", and as many pairs in "bounds".
void read_design(const Keys& keys, const Parameters& all, Study& study, Faults& faults);

/// Limits on observables and on sums of parameters of the design; place: the list, or nothing.
void read_constraints(const Place& place, Study& study, Faults& faults);

}  // namespace arcslip::scene::detail

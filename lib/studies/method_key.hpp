#pragma once
// The key "method" of studies whose branches may be exact motions in time.

#include <arcslip/analyses/responses/frequency_response.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <array>

namespace arcslip::studies {

inline constexpr std::array<scene::file::Word<observables::ResponseMethod>, 2> method_words = {
    {{"harmonic_balance", observables::ResponseMethod::harmonic_balance},
     {"shooting", observables::ResponseMethod::shooting}}};

/// Of a Range with a member `method`, which check_method() then checks.
template <class Range>
void add_method_key(scene::file::KeysOf<Range>& keys) {
  keys.add(scene::file::word("method", &Range::method, method_words,
                             "harmonic balance, or shooting: exact motions in time, for piecewise linear "
                             "scenes with a mass at every degree of freedom"));
}

/// The multipliers of shooting are those of its own map.
template <class Range>
void check_method(const scene::file::Reading& reading, Range& range) {
  if (range.method == observables::ResponseMethod::shooting && range.stability.by_hill)
    reading.faults.add(reading.keys.find("stability").pointer,
                       "found \"hill\" next to the method \"shooting\", whose multipliers are exact: must be "
                       "true or false");
}

}  // namespace arcslip::studies

#pragma once
// How the numbers of a law's automata change with its fields.

#include <arcslip/laws/law.hpp>

#include <optional>
#include <span>
#include <vector>

namespace arcslip::elements {

/// Their derivatives along `rates` of the fields, by central differences: modes, guards and sliders
/// (slider_of()) whose numbers are derivatives, exactly 0 where nothing changes. Of a field that is 0, a
/// limit of most laws, from the side on which it is positive. None where modes differ next to these fields,
/// as at a normal load of 0. The law must have automata.
std::optional<std::vector<Automaton>> automata_rates(const Law& law, Fields fields,
                                                     std::span<const double> rates);

}  // namespace arcslip::elements

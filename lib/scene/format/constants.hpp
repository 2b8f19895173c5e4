#pragma once
// Constants of a scene, and its numbers that are given by formulas.

#include <arcslip/scene/keys/parameter_names.hpp>

#include <vector>

namespace arcslip::scene::file {

/// Reads "constants": a number each, or an object with "value", "unit", "bounds" and "help". The values of
/// formulas are NaN until resolve_formulas().
std::vector<Constant> read_constants(const Location& place, Names& names, Faults& faults);

/// Reads "ties" of format 1: a tie is a constant with the common value of its members, which are given by it.
void read_ties(const Location& place, Names& names, Scene& scene, Faults& faults);

/// Makes the fields of several parts, of the same unit and value, follow a new constant.
void tie_to_constant(Scene& scene, const std::string& name, const std::vector<std::string>& fields);

/// Computes all numbers that formulas give, in the order in which they follow each other. Without faults
/// those that are wrong, or follow what is not there yet, are left for the next call.
void resolve_formulas(Scene& scene, const Names& names, Faults* faults);

}  // namespace arcslip::scene::file

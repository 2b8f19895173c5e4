#pragma once
// Rows of bad_scenes.hpp of their own files: faults in studies and in repeated entries.

#include "bad_scenes.hpp"

namespace arcslip::scene::test {

void add_bad_studies(std::vector<BadScene>& rows);
void add_bad_designs(std::vector<BadScene>& rows);  // of kind "optimum"
void add_bad_repeats(std::vector<BadScene>& rows);

}  // namespace arcslip::scene::test

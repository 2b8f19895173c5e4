#pragma once
// The rows of bad_scenes.hpp of one topic each.

#include "bad_scenes.hpp"

namespace arcslip::scene::test {

void add_bad_files(std::vector<BadScene>& rows);       // what is no JSON
void add_bad_structures(std::vector<BadScene>& rows);  // degrees of freedom, places, parts and elements
void add_bad_repeats(std::vector<BadScene>& rows);     // repeated entries
void add_bad_studies(std::vector<BadScene>& rows);
void add_bad_designs(std::vector<BadScene>& rows);  // studies of kind "optimum"

}  // namespace arcslip::scene::test

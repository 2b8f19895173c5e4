#pragma once
// The rows of bad_scenes.hpp whose fault is in a study.

#include "bad_scenes.hpp"

namespace arcslip::scene::test {

void add_bad_studies(std::vector<BadScene>& rows);
void add_bad_designs(std::vector<BadScene>& rows);  // of kind "optimum"

}  // namespace arcslip::scene::test

#pragma once
// Every kind of study that there is, for scenes that hold any of them.

#include <arcslip/optimize/studies.hpp>
#include <arcslip/studies/catalogue.hpp>

namespace test_catalogue {

inline arcslip::scene::Catalogue whole() {
  arcslip::scene::Catalogue all = arcslip::studies::catalogue();
  arcslip::optimize::add_studies(all);
  return all;
}

}  // namespace test_catalogue

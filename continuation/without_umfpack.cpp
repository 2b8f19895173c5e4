// In place of umfpack.cpp in builds without UMFPACK.

#include <arcslip/continuation/linear_solver.hpp>

#include <stdexcept>

namespace arcslip::continuation {

std::unique_ptr<LinearSolver> umfpack() {
  throw std::runtime_error(
      "this build of Arcslip is without UMFPACK: use klu(), or build with -D ARCSLIP_WITH_UMFPACK=ON where "
      "SuiteSparse has UMFPACK (GPL)");
}

bool has_umfpack() {
  return false;
}

}  // namespace arcslip::continuation

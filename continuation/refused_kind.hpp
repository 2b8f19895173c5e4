#pragma once
// What a linear solver says of a Jacobian of another kind than its own.

#include <stdexcept>
#include <string>

namespace arcslip::continuation {

/// solver: its name; kind: "sparse", "dense".
[[noreturn]] inline void refuse_kind(const std::string& solver, const std::string& kind) {
  throw std::invalid_argument(solver + " takes " + kind +
                              " Jacobians, and that of this problem is none: name no linear solver, and one "
                              "that suits is chosen");
}

}  // namespace arcslip::continuation

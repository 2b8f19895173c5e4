#pragma once

#include <stdexcept>

namespace arcslip {

/// The base of all exceptions of Arcslip but those for misuse of a function (std::invalid_argument and the
/// like).
class Error : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace arcslip

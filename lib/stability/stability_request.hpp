#pragma once
// What a study asks about the stability of its responses.

namespace arcslip::observables {

struct StabilityRequest {
  StabilityRequest(bool is_wanted = false) : wanted(is_wanted) {}

  bool wanted;
  bool by_hill =
      false;            // multipliers by Hill's method (stability/hill.hpp), else by the variational equation
  int multipliers = 0;  // how many of them the results have, by falling modulus; 0: all

  operator bool() const { return wanted; }
  friend bool operator==(const StabilityRequest&, const StabilityRequest&) = default;
};

}  // namespace arcslip::observables

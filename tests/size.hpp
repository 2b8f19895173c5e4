#pragma once
// The size of sweeps that find nothing more under the sanitizers, which multiply their work by ten.

namespace test_size {

constexpr bool sanitized = ARCSLIP_SANITIZED;

template <class Number>
constexpr Number sized(Number whole, Number under_sanitizers) {
  return sanitized ? under_sanitizers : whole;
}

}  // namespace test_size

#pragma once
// How many cases a test over many goes through.

#include <cstdint>
#include <cstdlib>

/// The environment's number where it gives one under this name, else `full` with ARCSLIP_FULL=1, else
/// `reduced`.
struct Volume {
  const char* variable;
  std::uint64_t reduced, full;

  std::uint64_t count() const {
    if (const char* number = std::getenv(variable)) return std::strtoull(number, nullptr, 10);
    return std::getenv("ARCSLIP_FULL") ? full : reduced;
  }
};

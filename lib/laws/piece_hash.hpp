#pragma once
// The hash of the choices that make a piece of a law, or of an evaluator.

#include <cstdint>

namespace arcslip::elements {

inline constexpr std::uint64_t empty_hash = 14695981039346656037ull;  // the basis of FNV-1a

/// Returns the hash of what `hash` is of and of one more choice.
constexpr std::uint64_t hashed(std::uint64_t hash, std::uint64_t choice) {
  return (hash ^ choice) * 1099511628211ull;
}

}  // namespace arcslip::elements

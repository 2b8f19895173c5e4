#pragma once
// Mutants of a scene: changes of its structure and of its words rather than of its bytes, which seldom leave
// JSON. The same seed gives the same mutant on every machine.

#include "volume.hpp"

#include <cstdint>
#include <string>

namespace fuzz {

/// Of the test.
inline constexpr Volume mutants{"ARCSLIP_MUTANTS", 3000, 100'000};
inline constexpr Volume first_mutant{"ARCSLIP_FIRST_MUTANT", 1, 1};

/// A mutant of the text, of at most `most` bytes. About half of them are sound JSON with another number, name
/// or part here and there; the others have huge lists, deep nesting, words and bytes that no scene should
/// have. What is no JSON is changed byte by byte.
std::string mutate(const std::string& text, std::uint64_t seed, std::size_t most);

}  // namespace fuzz

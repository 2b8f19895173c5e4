#pragma once

#include "volume.hpp"

/// Mutants of MATLAB files, of each of four kinds: version 5 and 7.3, each also compressed.
inline constexpr Volume mat_mutants{"ARCSLIP_MAT_MUTANTS", 60, 7000};

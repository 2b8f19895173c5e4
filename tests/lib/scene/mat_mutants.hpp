#pragma once

#include "volume.hpp"

/// Mutants of MATLAB files, of each of three kinds: version 5, the same compressed, and 7.3.
inline constexpr Volume mat_mutants{"ARCSLIP_MAT_MUTANTS", 60, 7000};

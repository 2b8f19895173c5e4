#pragma once
// How a structure from matrices is reduced to the rows that a scene uses and to coordinates of all others.

#include <string_view>

namespace arcslip::scene {

class SettingsKeys;

enum class ReductionMethod { krylov, craig_bampton, rubin };

struct Reduction {
  ReductionMethod method = ReductionMethod::krylov;
  double accuracy = 1e-8;  // of the dynamic stiffness, by Krylov spaces
  int modes = -1;          // of the other methods; -1: those up to the cutoff
  double cutoff = 0;       // in the scene's unit; 0: cutoff_of_highest times the highest frequency
  friend bool operator==(const Reduction&, const Reduction&) = default;
};

inline constexpr double cutoff_of_highest = 4;

/// As in a scene file.
std::string_view name(ReductionMethod method);

/// The keys of a Reduction in a scene file.
const SettingsKeys& reduction_keys();

}  // namespace arcslip::scene

#pragma once
// Springs and dampers of one degree of freedom given by what they do to the mass on it: a natural frequency
// f, k = (2 pi f)^2 m, and a damping ratio zeta, c = 2 zeta sqrt(k m).

#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/read_values.hpp>

namespace arcslip::scene::file {

inline constexpr std::string_view frequency_key = "frequency", damping_ratio_key = "damping_ratio";

/// What is on the degrees of freedom.
struct Structure {
  const Dofs& dofs;
  int rows;  // the first degrees of freedom: they are rows of matrices, which hold mass and stiffness as well
  const std::vector<Part>&masses, &springs;
  bool sound;  // false: faults have been reported, and what is missing is not reported again
};

/// The section of springs with a "value" (N/m) next to each "frequency" (above 0, in the unit of the
/// scene). m: the sum of the masses on that degree of freedom alone. A fault where there is none, or where
/// another also moves something else.
Node with_stiffnesses(const Location& springs, const Structure& structure, FrequencyUnit unit,
                      Faults& faults);

/// The section of dampers with a "value" (N s/m) next to each "damping_ratio" (at least 0). k: the sum of
/// the springs on that degree of freedom alone; those to other degrees of freedom do not count. m: as above.
Node with_dampings(const Location& dampers, const Structure& structure, Faults& faults);

}  // namespace arcslip::scene::file

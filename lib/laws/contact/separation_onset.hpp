#pragma once
// Corners of a unilateral normal load N = N_0 + k_n x_n, where x_n is the last direction of an element: where
// its minimum touches zero a phase of separation is born, where its maximum does one of contact. h = -N at a
// minimum and N at a maximum, with the equation x_n'(theta) = 0 of its angle.

#include <arcslip/laws/grazing_condition.hpp>

namespace arcslip::elements {

/// The guards of these corners, the first of a law.
namespace load_guard {
enum { separation, closing, count };
}

struct NormalSpring {
  double k_n, N_0;                     // N/m, N
  int stiffness_field, preload_field;  // of the law
};

/// maximum: of N. The other displacements, and other fields, have no part in it.
void set_load_corner(const Harmonics& harmonics, const Corner& corner, bool maximum, In u_n,
                     const NormalSpring& spring, Corners::Equations& at);

}  // namespace arcslip::elements

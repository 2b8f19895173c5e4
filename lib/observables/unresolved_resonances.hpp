#pragma once
// Natural modes of a structure with its elements as springs. At their maximum stiffness: which resonances the
// harmonics of a motion may excite, and how far. At rest: where resonances lie. Of a sector of a ring, in the
// waves of all harmonics.

#include <arcslip/model/model.hpp>

#include <optional>
#include <vector>

namespace arcslip::observables {

/// Highest natural frequency (rad/s) of M x'' + (K + sum of element stiffnesses) x = 0 at p; massless motions
/// have none. 0 where there is none at all. motions: largest |d_e . x| of each element (m), at which
/// nonlinear springs have their stiffness 3 k3 |d_e . x|^2; without them they have none.
double highest_natural_frequency(const model::Model& model, const continuation::Vector& p,
                                 const std::vector<double>& motions = {});

/// From below, at little cost: the largest quotient sqrt(k_ii/m_ii) of a structure of lumped masses. 0 of
/// other structures.
double bound_of_highest_natural_frequency(const model::Model& model, const continuation::Vector& p);

/// A natural mode phi at its resonance.
struct ResonantMode {
  double omega;  // rad/s
  double gain;   // m/N: of the largest response to a force of 1 N of an element, |r . phi| max |d_e . phi|
                 // over omega phi^T C phi + loss factor phi^T K phi; infinite without damping
};

/// All modes with a natural frequency, in increasing order. Nothing for gyroscopic structures, whose modes
/// are others, and for those of more than 200 degrees of freedom.
std::optional<std::vector<ResonantMode>> resonant_modes(const model::Model& model,
                                                        const continuation::Vector& p);

/// Contacts as springs: free ones carry no force, stuck ones have their largest stiffness.
enum class Contacts { free, stuck };

/// Whether its elements may stick and slip, or open.
bool is_contact(const elements::Law& law);

/// A natural mode of the structure at rest, computed without damping.
struct ModeAtRest {
  double omega;              // rad/s
  bool responds = true;      // the response moves in it; of equal frequencies (1e-6), in what is driven
  bool driven = true;        // the lowest harmonic of the excitation drives it
  double damping_ratio = 0;  // of its own motion, by the dampers and the damping of the structure
};

/// Of modes_at_rest(): 200 degrees of freedom take some 10 ms, 1000 a second.
inline constexpr int few_dofs = 200, many_dofs = 1000;

/// In increasing order, without rigid-body motions and without those of an unstable rest. Elements that are
/// no contacts have their tangent at rest, those with a memory their largest stiffness. Of a sector of a ring
/// in the wave of the lowest harmonic of the excitation, where all respond and are driven. Nothing for
/// gyroscopic structures, for directions of one element that are coupled in a sector, and for more than
/// most_dofs degrees of freedom, counted twice in a sector.
std::optional<std::vector<ModeAtRest>> modes_at_rest(const model::Model& model, const continuation::Vector& p,
                                                     Contacts contacts, int most_dofs = few_dofs);

/// The symmetric part of K with the elements at rest, as in modes_at_rest(). Nothing for a sector of a ring.
std::optional<Eigen::MatrixXd> stiffness_at_rest(const model::Model& model, const continuation::Vector& p,
                                                 Contacts contacts);

}  // namespace arcslip::observables

#pragma once
// One sector of a ring in its waves. Complex matrices and vectors are real ones of twice the size: real parts
// first, then imaginary ones.

#include <arcslip/model/model.hpp>

#include <complex>
#include <vector>

namespace arcslip::observables {

/// Nodal diameters of the waves that harmonics of any order have, without those above half of the sectors:
/// the same waves the other way round.
std::vector<int> diameters(const model::Sector& sector);

/// exp(-2 pi i diameter/count)
std::complex<double> turn(const model::Sector& sector, int diameter);

/// sum += factor A
void add_complex(double factor, const Eigen::MatrixXcd& A, Eigen::MatrixXd& sum);

/// The sum of masses, dampers or springs and of the matrices of this kind, in the wave of a diameter.
Eigen::MatrixXd sum_in_wave(const model::Model& model, model::LinearKind kind, const continuation::Vector& p,
                            int diameter);

}  // namespace arcslip::observables

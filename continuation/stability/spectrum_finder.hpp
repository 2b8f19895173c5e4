#pragma once
// Spectra along one branch (problem/stability.hpp). Not installed.
//
// Large J: shifts i w_k cover the imaginary axis from 0 upwards. Each finds what is nearest to it, and with
// that a range of the axis near which nothing is missing. The next shift stands
// in the middle of the lowest gap between ranges, or at twice the end of the last one: real eigenvalues that
// crowd at 0 leave a small first range, and ranges grow with the distance from them. Shifts and spaces of one
// point serve the next.

#include <arcslip/continuation/problem/stability.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include <vector>

namespace arcslip::continuation {

class ShiftedInverse;

class SpectrumFinder {
 public:
  explicit SpectrumFinder(StabilityOptions options) : options_(std::move(options)) {}

  /// Throws std::invalid_argument for an operator without a solver of the user's, std::runtime_error where
  /// eigenvalues do not converge.
  Spectrum at(const Jacobian& J);

 private:
  struct Shift {
    double w = 0;
    Eigen::VectorXd start;
  };

  Spectrum by_all(const Matrix& J);
  std::optional<Spectrum> by_inertia(const SparseMatrix& J);
  Spectrum by_shifts(const SparseMatrix& J);
  void look_near_zero(const Eigen::SimplicialLDLT<SparseMatrix>& factors, Spectrum& found);
  void look_near(ShiftedInverse& inverse, Shift& shift, Spectrum& found);
  void look_at_any_frequency(const SparseMatrix& J, ShiftedInverse& inverse, Spectrum& found);
  std::optional<double> next_shift(const std::vector<AxisRange>& ranges) const;
  void sort(Spectrum& found) const;

  StabilityOptions options_;
  std::vector<Shift> shifts_;
  Shift missed_;  // next to what they missed at the last point where they did
  Eigen::VectorXcd nearest_vector_;
  Spectrum before_;
  bool has_before_ = false;
};

}  // namespace arcslip::continuation

#pragma once
// Errors of forms on their way into a coefficient. Not installed.

#include <arcslip/continuation/linear/shifted_solver.hpp>
#include <arcslip/continuation/normal_forms/directional_derivatives.hpp>

namespace arcslip::continuation {

/// The sum of <w, form> with weights, and of its errors: those of the forms row by row, those that a form has
/// by its arguments, and 1e-10 of their size for the place of the point and its vectors.
class PropagatedError {
 public:
  explicit PropagatedError(const ComplexVector& w) : w_(w), sizes_(w.cwiseAbs()) {}

  void add(double weight, const ComplexForm& form, double relative_error = 0);

  Complex value() const { return value_; }
  double error() const { return error_; }

 private:
  ComplexVector w_;
  Vector sizes_;
  Complex value_ = 0;
  double error_ = 0;
};

/// x = A^-1 b of the last factors, with the errors that those of b and of J make of it.
ComplexForm solved(const ShiftedSolver& factors, const ComplexForm& b);

/// The largest error of a row, relative to the largest row.
double relative_error(const ComplexForm& form);

}  // namespace arcslip::continuation

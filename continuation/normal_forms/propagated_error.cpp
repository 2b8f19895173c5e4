#include <arcslip/continuation/normal_forms/propagated_error.hpp>

#include <cmath>
#include <limits>

namespace arcslip::continuation {
namespace {

constexpr double error_of_place = 1e-10;  // relative, of a form by that of the point and of its vectors
constexpr double worse_than_generic = 3;  // errors of a solution, over those of a generic right-hand side

}  // namespace

void PropagatedError::add(double weight, const ComplexForm& form, double relative_error) {
  const double size = sizes_.dot(form.value.cwiseAbs());
  value_ += weight * w_.dot(form.value);
  error_ += std::abs(weight) * (sizes_.dot(form.error) + (relative_error + error_of_place) * size);
}

ComplexForm solved(const ShiftedSolver& factors, const ComplexForm& b) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  ComplexForm x{b.value, Vector::Constant(b.error.size(), unknown)};
  if (!factors.solve(x.value)) return x;
  ComplexVector errors = b.error.cast<Complex>();
  errors.head(factors.size()) += factors.error_of_apply(x.value.head(factors.size())).cast<Complex>();
  for (Eigen::Index i = 0; i < errors.size(); ++i) errors[i] *= std::polar(1.0, static_cast<double>(i * i));
  if (factors.solve(errors)) x.error = worse_than_generic * errors.cwiseAbs();
  return x;
}

double relative_error(const ComplexForm& form) {
  const double size = form.value.cwiseAbs().maxCoeff(), error = form.error.maxCoeff();
  return size > 0 ? error / size : error;
}

}  // namespace arcslip::continuation

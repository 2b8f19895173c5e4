#include <arcslip/continuation/normal_forms/steady_form.hpp>

#include <arcslip/continuation/linear/shifted_solver.hpp>
#include <arcslip/continuation/normal_forms/propagated_error.hpp>

#include <cmath>
#include <exception>

namespace arcslip::continuation {
namespace {

constexpr double least_null_overlap = 1e-6;  // w . q of unit vectors: smaller, the eigenvalue 0 is double
constexpr double upright = 1e-6;             // dp of a tangent in scales: smaller, the branch turns there

ComplexForm complex_form(const RealForm& form, double weight = 1) {
  return {(weight * form.value).cast<Complex>(), std::abs(weight) * form.error};
}

Coefficient coefficient(const PropagatedError& sum) {
  return {sum.value().real(), sum.error()};
}

}  // namespace

SteadyForm::SteadyForm(Evaluator& at, const PlaceOfForms& place, const Vector& right, const Vector& left)
    : forms_(at, place), n_(place.u.size()) {
  if (right.size() != n_ || left.size() != n_) return;
  q_ = right.normalized();
  w_ = left.normalized();
  const double overlap = w_.dot(q_);
  usable_ = std::abs(overlap) > least_null_overlap;
  w_ /= overlap;
}

const RealForm& SteadyForm::B() {
  if (B_.value.size() == 0) {
    Vector q = Vector::Zero(n_ + 1);
    q.head(n_) = q_;
    B_ = forms_.along(2, q);
  }
  return B_;
}

Coefficient SteadyForm::quadratic() {
  if (!usable_) return {};
  PropagatedError sum(w_);
  sum.add(0.5, complex_form(B()));
  return coefficient(sum);
}

Coefficient SteadyForm::unfolding() {
  if (!usable_) return {};
  PropagatedError sum(w_);
  sum.add(1, complex_form(forms_.parameter_derivative()));
  return coefficient(sum);
}

Coefficient SteadyForm::cubic() {
  const auto J = usable_ ? forms_.jacobian() : std::nullopt;
  if (!J) return {};
  ShiftedSolver solver(*J, forms_.errors_of_jacobian());
  if (!solver.factorize(Complex(0), q_.cast<Complex>(), w_.cast<Complex>())) return {};
  ComplexForm rhs{ComplexVector::Zero(n_ + 1), Vector::Zero(n_ + 1)};
  rhs.value.head(n_) = -B().value.cast<Complex>();
  rhs.error.head(n_) = B().error;
  const ComplexForm h = solved(solver, rhs);
  if (!h.value.allFinite()) return {};
  Vector q = Vector::Zero(n_ + 1), of_h = q;
  q.head(n_) = q_;
  of_h.head(n_) = h.value.head(n_).real();
  PropagatedError sum(w_);
  sum.add(1.0 / 6, complex_form(forms_.along(3, q)));
  sum.add(0.5, complex_form(forms_.second(q, of_h)), relative_error(h));
  return coefficient(sum);
}

Coefficient SteadyForm::crossing(const Vector& tangent) {
  if (!usable_ || tangent[n_] == 0) return {};
  Vector q = Vector::Zero(n_ + 1);
  q.head(n_) = q_;
  PropagatedError sum(w_);
  sum.add(1 / tangent[n_], complex_form(forms_.second(q, tangent)));
  return coefficient(sum);
}

void add_normal_form(Evaluator& at, const PlaceOfForms& place, Fold& fold) try {
  SteadyForm form(at, place, fold.right_null, fold.left_null);
  fold.quadratic = form.quadratic();
  fold.unfolding = form.unfolding();
} catch (const std::exception&) {  // no derivatives, as it says
}

void add_normal_form(Evaluator& at, const PlaceOfForms& place, BranchPoint& point) try {
  if (point.type == BranchPoint::Type::multiple || point.tangents.size() < 2 || point.left_null.size() == 0)
    return;
  const Eigen::Index n = place.u.size();
  const Vector &t1 = point.tangents[0], &t2 = point.tangents[1];
  const Vector right = t2[n] * t1.head(n) - t1[n] * t2.head(n);
  SteadyForm form(at, place, right, point.left_null);
  if (!form.usable()) return;
  const double scale = place.scales[n];
  point.crossing = form.crossing(std::abs(t1[n]) > upright * scale ? t1 : t2);
  point.quadratic = form.quadratic();
  point.cubic = form.cubic();
  if (point.type == BranchPoint::Type::pitchfork && point.cubic.signed_by_value())
    point.criticality = point.cubic.value < 0 ? Criticality::supercritical : Criticality::subcritical;
} catch (const std::exception&) {
}

}  // namespace arcslip::continuation

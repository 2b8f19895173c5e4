#include <arcslip/continuation/normal_forms/codimension_two.hpp>

#include <arcslip/continuation/linear/shifted_solver.hpp>
#include <arcslip/continuation/normal_forms/hopf_form.hpp>
#include <arcslip/continuation/normal_forms/propagated_error.hpp>
#include <arcslip/continuation/normal_forms/steady_form.hpp>

#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <utility>

namespace arcslip::continuation {
namespace {

// J as a dense matrix. Nothing where it is an operator or not known.
std::optional<Matrix> dense_jacobian(DirectionalDerivatives& forms) {
  const auto J = forms.jacobian();
  if (!J) return {};
  if (const auto* sparse = std::get_if<SparseMatrix>(&*J)) return Matrix(*sparse);
  return std::get<Matrix>(*J);
}

// The eigenvalue nearest to a value, with its vectors.
std::optional<Eigenpair> nearest_eigenpair(const Matrix& J, ShiftedSolver& solver, Complex value) {
  const Modes all = modes(J);
  Eigen::Index nearest = 0;
  if (all.values.size() == 0) return {};
  (all.values.array() - value).abs().minCoeff(&nearest);
  return refined_eigenpair(solver, all.values[nearest], all.V.col(nearest));
}

// Solutions of shifted systems, and forms of vectors of n, of one place.
class HomologicalEquations {
 public:
  HomologicalEquations(Evaluator& at, const PlaceOfForms& place) : forms_(at, place), n_(place.u.size()) {
    J_ = dense_jacobian(forms_);
    if (J_) solver_.emplace(*J_, forms_.errors_of_jacobian());
  }

  std::optional<Eigenpair> pair_near(Complex value) {
    return solver_ ? nearest_eigenpair(*J_, *solver_, value) : std::nullopt;
  }

  ComplexForm B(const ComplexVector& a, const ComplexVector& b) {
    return forms_.second(extended(a), extended(b));
  }
  ComplexForm C(const ComplexVector& a, const ComplexVector& b, const ComplexVector& c) {
    return forms_.third(extended(a), extended(b), extended(c));
  }

  /// (shift - J)^-1 b.
  ComplexForm inverse(Complex shift, const ComplexForm& b) {
    if (!solver_->factorize(shift)) return unknown();
    return solved(*solver_, {-b.value, b.error});
  }

  /// (mu - J)^inv (b - <p, b> q) of an eigenvalue mu.
  ComplexForm inverse(const Eigenpair& of, const ComplexForm& b) {
    if (!solver_->factorize(of.value, of.right, of.left)) return unknown();
    ComplexForm rhs{ComplexVector::Zero(n_ + 1), Vector::Zero(n_ + 1)};
    rhs.value.head(n_) = -(b.value - of.left.dot(b.value) * of.right);
    rhs.error.head(n_) = b.error;
    const ComplexForm x = solved(*solver_, rhs);
    return {x.value.head(n_), x.error.head(n_)};
  }

  bool usable() const { return J_.has_value(); }
  ShiftedSolver& solver() { return *solver_; }
  const Matrix& J() const { return *J_; }
  const Matrix& errors_of_jacobian() const { return forms_.errors_of_jacobian(); }

 private:
  ComplexVector extended(const ComplexVector& v) const {
    ComplexVector d(n_ + 1);
    d << v, Complex(0);
    return d;
  }
  ComplexForm unknown() const {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {ComplexVector::Constant(n_, nan), Vector::Constant(n_, nan)};
  }

  DirectionalDerivatives forms_;
  Eigen::Index n_;
  std::optional<Matrix> J_;
  std::optional<ShiftedSolver> solver_;
};

ComplexForm conjugate(const ComplexForm& form) {
  return {form.value.conjugate(), form.error};
}

Coefficient real_part(const PropagatedError& sum) {
  return {sum.value().real(), sum.error()};
}
Coefficient imaginary_part(const PropagatedError& sum) {
  return {sum.value().imag(), sum.error()};
}

// <p, cubic form> + sum of weights times <p, B(a, h)>.
class CubicSum {
 public:
  CubicSum(HomologicalEquations& of, const ComplexVector& p) : of_(of), sum_(p) {}
  CubicSum& form(const ComplexForm& form) {
    sum_.add(1, form);
    return *this;
  }
  CubicSum& with(double weight, const ComplexVector& a, const ComplexForm& h) {
    sum_.add(weight, of_.B(a, h.value), relative_error(h));
    return *this;
  }
  const PropagatedError& operator*() const { return sum_; }

 private:
  HomologicalEquations& of_;
  PropagatedError sum_;
};

}  // namespace

Cusp cusp_form(Evaluator& at, const PlaceOfForms& place, const Vector& right, const Vector& left) try {
  return {SteadyForm(at, place, right, left).cubic()};
} catch (const std::exception&) {  // no derivatives, as it says
  return {};
}

namespace {

struct HopfWithPair {
  Hopf hopf;
  std::optional<Eigenpair> pair;
};

HopfWithPair hopf_with_pair(Evaluator& at, const PlaceOfForms& place, double frequency) try {
  HomologicalEquations equations(at, place);
  const auto pair = equations.pair_near(Complex(0, frequency));
  if (!pair) return {};
  Hopf hopf;
  hopf.frequency = pair->value.imag();
  hopf.real = pair->right.real();
  hopf.imaginary = pair->right.imag();
  const KnownJacobian J{equations.J(), equations.errors_of_jacobian()};
  add_normal_form(at, place, hopf, &J);
  return {std::move(hopf), pair};
} catch (const std::exception&) {
  return {};
}

}  // namespace

Hopf hopf_form_near(Evaluator& at, const PlaceOfForms& place, double frequency) {
  return hopf_with_pair(at, place, frequency).hopf;
}

GeneralizedHopf generalized_hopf_form(Evaluator& at, const PlaceOfForms& place, double frequency) {
  const auto [hopf, pair] = hopf_with_pair(at, place, frequency);
  GeneralizedHopf form{frequency, hopf.lyapunov, hopf.detuning};
  if (hopf.lyapunov.known()) form.second_lyapunov = second_lyapunov(at, place, *pair);
  return form;
}

// q_1 and p_0 from J bordered by the null vectors.
BogdanovTakens bogdanov_takens_form(Evaluator& at, const PlaceOfForms& place) try {
  HomologicalEquations equations(at, place);
  const Eigen::Index n = place.u.size();
  if (n < 2 || !equations.usable()) return {};
  NullSpaces spaces;
  spaces.compute(equations.J(), 1);
  const ComplexVector q0 = spaces.right().col(0).normalized().cast<Complex>();
  ComplexVector p1 = spaces.left().col(0).cast<Complex>();
  if (!equations.solver().factorize(Complex(0), p1, q0)) return {};
  ComplexVector q1(n + 1), p0(n + 1);
  q1 << q0, Complex(0);
  p0 << p1, Complex(0);
  if (!equations.solver().solve(q1) || !equations.solver().solve_adjoint(p0)) return {};
  q1.conservativeResize(n);
  p0.conservativeResize(n);
  const Complex size = p1.dot(q1);
  p0 /= std::conj(p0.dot(q0));
  p1 /= std::conj(size);
  p0 -= std::conj(p0.dot(q1)) * p1;
  const ComplexForm B00 = equations.B(q0, q0), B01 = equations.B(q0, q1);
  PropagatedError a(p1), b_first(p0), b_second(p1);
  a.add(0.5, B00);
  b_first.add(1, B00);
  b_second.add(1, B01);
  BogdanovTakens form;
  form.a = real_part(a);
  form.b = {b_first.value().real() + b_second.value().real(), b_first.error() + b_second.error()};
  if (form.a.signed_by_value() && form.b.signed_by_value())
    form.criticality =
        form.a.value * form.b.value < 0 ? Criticality::supercritical : Criticality::subcritical;
  return form;
} catch (const std::exception&) {
  return {};
}

ZeroHopf zero_hopf_form(Evaluator& at, const PlaceOfForms& place, double frequency) try {
  ZeroHopf form;
  form.frequency = frequency;
  HomologicalEquations equations(at, place);
  const auto zero = equations.pair_near(0), pair = equations.pair_near(Complex(0, frequency));
  if (!zero || !pair) return form;
  const ComplexVector &q0 = zero->right, &p0 = zero->left, &q1 = pair->right, &p1 = pair->left;
  const ComplexVector q1c = q1.conjugate();
  const ComplexForm B00 = equations.B(q0, q0), B01 = equations.B(q0, q1), B11 = equations.B(q1, q1c);
  const ComplexForm h200 = equations.inverse(*zero, B00), h011 = equations.inverse(*zero, B11),
                    h110 = equations.inverse(*pair, B01),
                    h020 = equations.inverse(Complex(0, 2 * frequency), equations.B(q1, q1));
  CubicSum g200(equations, p0), g011(equations, p0), g110(equations, p1);
  form.g200 = real_part(*g200.form(B00));
  form.g011 = real_part(*g011.form(B11));
  g110.form(B01);
  form.g110_real = real_part(*g110);
  form.g110_imaginary = imaginary_part(*g110);
  CubicSum g300(equations, p0), g111(equations, p0), g210(equations, p1), g021(equations, p1);
  form.g300 = real_part(*g300.form(equations.C(q0, q0, q0)).with(3, q0, h200));
  form.g111 = real_part(
      *g111.form(equations.C(q0, q1, q1c)).with(1, q0, h011).with(1, q1, conjugate(h110)).with(1, q1c, h110));
  g210.form(equations.C(q0, q0, q1)).with(2, q0, h110).with(1, q1, h200);
  form.g210_real = real_part(*g210);
  form.g210_imaginary = imaginary_part(*g210);
  g021.form(equations.C(q1, q1, q1c)).with(2, q1, h011).with(1, q1c, h020);
  form.g021_real = real_part(*g021);
  form.g021_imaginary = imaginary_part(*g021);
  return form;
} catch (const std::exception&) {
  ZeroHopf unknown;
  unknown.frequency = frequency;
  return unknown;
}

DoubleHopf double_hopf_form(Evaluator& at, const PlaceOfForms& place, double w1, double w2) try {
  DoubleHopf form;
  form.frequency = w1;
  form.other_frequency = w2;
  HomologicalEquations equations(at, place);
  const auto first = equations.pair_near(Complex(0, w1)), second = equations.pair_near(Complex(0, w2));
  if (!first || !second) return form;
  const ComplexVector &q1 = first->right, &p1 = first->left, &q2 = second->right, &p2 = second->left;
  const ComplexVector q1c = q1.conjugate(), q2c = q2.conjugate();
  const ComplexForm h1100 = equations.inverse(0, equations.B(q1, q1c)),
                    h0011 = equations.inverse(0, equations.B(q2, q2c)),
                    h2000 = equations.inverse(Complex(0, 2 * w1), equations.B(q1, q1)),
                    h0020 = equations.inverse(Complex(0, 2 * w2), equations.B(q2, q2)),
                    h1010 = equations.inverse(Complex(0, w1 + w2), equations.B(q1, q2)),
                    h1001 = equations.inverse(Complex(0, w1 - w2), equations.B(q1, q2c));
  CubicSum g2100(equations, p1), g1011(equations, p1), g1110(equations, p2), g0021(equations, p2);
  form.g2100 = real_part(*g2100.form(equations.C(q1, q1, q1c)).with(2, q1, h1100).with(1, q1c, h2000));
  form.g1011 = real_part(
      *g1011.form(equations.C(q1, q2, q2c)).with(1, q1, h0011).with(1, q2, h1001).with(1, q2c, h1010));
  form.g1110 = real_part(*g1110.form(equations.C(q1, q1c, q2))
                              .with(1, q2, h1100)
                              .with(1, q1, conjugate(h1001))
                              .with(1, q1c, h1010));
  form.g0021 = real_part(*g0021.form(equations.C(q2, q2, q2c)).with(2, q2, h0011).with(1, q2c, h0020));
  return form;
} catch (const std::exception&) {
  DoubleHopf unknown;
  unknown.frequency = w1;
  unknown.other_frequency = w2;
  return unknown;
}

}  // namespace arcslip::continuation

#include <arcslip/continuation/normal_forms/directional_derivatives.hpp>

#include <arcslip/continuation/normal_forms/central_quotient.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <span>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double first_share = 1.0 / 32;  // of the size of x: the first step of a difference
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<std::complex<double>, 4> powers_of_i{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

RealForm unknown_form(Eigen::Index n) {
  return {Vector::Constant(n, not_known), Vector::Constant(n, not_known)};
}

void add(RealForm& sum, double weight, const RealForm& form) {
  sum.value += weight * form.value;
  sum.error += std::abs(weight) * form.error;
}

}  // namespace

DirectionalDerivatives::DirectionalDerivatives(Evaluator& at, PlaceOfForms place)
    : at_(at), place_(std::move(place)), n_(place_.u.size()), sizes_(n_ + 1), u_(n_), p_(place_.p), dF_(n_) {
  sizes_ << place_.u, place_.p[place_.free];
  sizes_ = sizes_.cwiseAbs().cwiseMax(place_.scales);
  try {
    usable_ = at_.move_to(place_.u, place_.p, Needs::residual) == Evaluated::ok && at_.residual().allFinite();
    piece_ = at_.piece();
  } catch (const std::exception&) {  // outside the domain, as it says
    usable_ = false;
  }
}

double DirectionalDerivatives::size_of(const Vector& d) const {
  return d.cwiseAbs().cwiseQuotient(sizes_).maxCoeff();
}

// By the problem itself. False: not provided.
bool DirectionalDerivatives::given(int order, const Vector& d, RealForm& form) {
  if (order < 2) return false;
  Vector q = Vector::Zero(place_.p.size());
  q[place_.free] = d[n_];
  try {
    if (at_.move_to(place_.u, place_.p, Needs::residual) != Evaluated::ok) return false;
    form.value.resize(n_);
    if (!at_.directional_derivative(order, d.head(n_), q, form.value)) return false;
  } catch (const std::exception&) {
    form = unknown_form(n_);
    return true;
  }
  form.error = std::numeric_limits<double>::epsilon() * form.value.cwiseAbs();
  return true;
}

// g at x + distance d: F, or J d + F_p d_p. False: outside the domain or the piece.
bool DirectionalDerivatives::value_at(double distance, const Vector& d, bool of_jacobian, Vector& g) try {
  u_ = place_.u + distance * d.head(n_);
  p_[place_.free] = place_.p[place_.free] + distance * d[n_];
  const Needs needs = of_jacobian ? Needs::jacobian : Needs::residual;
  if (at_.move_to(u_, p_, needs) != Evaluated::ok || at_.piece() != piece_) return false;
  if (!of_jacobian) {
    g = at_.residual();
    return true;
  }
  apply(at_.jacobian(), d.head(n_), g);
  if (d[n_] == 0) return true;
  at_.parameter_derivative(place_.free, dF_);
  g += d[n_] * dF_;
  return true;
} catch (const std::exception&) {
  return false;
}

std::optional<ExtrapolatedDifference> DirectionalDerivatives::difference(int order, const Vector& d,
                                                                         bool of_jacobian) {
  const CentralQuotient stencil = central_quotient(order);
  Vector g(n_), middle(n_);
  if (order == 2 && !value_at(0, d, of_jacobian, middle)) return {};
  return extrapolate(n_, first_share, [&](double h, Vector& quotient) {
    quotient.setZero();
    for (std::size_t i = 0; i < stencil.places; ++i) {
      const bool here = stencil.distance[i] == 0;
      if (!here && !value_at(stencil.distance[i] * h, d, of_jacobian, g)) return false;
      quotient += stencil.weight[i] * (here ? middle : g);
    }
    quotient /= std::pow(h, order);
    return true;
  });
}

RealForm DirectionalDerivatives::along(int order, const Vector& d) {
  const double size = size_of(d);
  if (size == 0) return {Vector::Zero(n_), Vector::Zero(n_)};
  RealForm form;
  if (!usable_ || !std::isfinite(size)) return unknown_form(n_);
  if (given(order, d, form)) return form;
  const ByDifferences by = at_.by_differences();
  const bool of_jacobian = order > 1 && !by.jacobian && (d[n_] == 0 || !by.parameters);
  const auto found = difference(of_jacobian ? order - 1 : order, d / size, of_jacobian);
  if (!found) return unknown_form(n_);
  const double scale = std::pow(size, order);
  return {scale * found->value, scale * found->error};
}

RealForm DirectionalDerivatives::second(const Vector& a, const Vector& b) {
  const double of_a = size_of(a), of_b = size_of(b);
  RealForm sum{Vector::Zero(n_), Vector::Zero(n_)};
  if (of_a == 0 || of_b == 0) return sum;
  const Vector x = a / of_a, y = b / of_b;
  add(sum, of_a * of_b / 4, along(2, x + y));
  add(sum, -of_a * of_b / 4, along(2, x - y));
  return sum;
}

RealForm DirectionalDerivatives::third(const Vector& a, const Vector& b, const Vector& c) {
  const double of_a = size_of(a), of_b = size_of(b), of_c = size_of(c), all = of_a * of_b * of_c / 24;
  RealForm sum{Vector::Zero(n_), Vector::Zero(n_)};
  if (all == 0) return sum;
  const Vector x = a / of_a, y = b / of_b, z = c / of_c;
  add(sum, all, along(3, x + y + z));
  add(sum, -all, along(3, x + y - z));
  add(sum, -all, along(3, x - y + z));
  add(sum, all, along(3, x - y - z));
  return sum;
}

ComplexForm DirectionalDerivatives::second(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  const std::array<Vector, 2> x{a.real(), a.imag()}, y{b.real(), b.imag()};
  if (b == a || b == a.conjugate()) {  // (x + i y)^2 = x^2 - y^2 + 2 i x y, |x + i y|^2 = x^2 + y^2
    const RealForm xx = along(2, x[0]), yy = along(2, x[1]);
    ComplexForm square{(xx.value + yy.value).cast<std::complex<double>>(), xx.error + yy.error};
    if (b != a) return square;
    const RealForm xy = second(x[0], x[1]);
    square.value = (xx.value - yy.value).cast<std::complex<double>>() + 2.0 * powers_of_i[1] * xy.value;
    square.error += 2 * xy.error;
    return square;
  }
  ComplexForm sum{Eigen::VectorXcd::Zero(n_), Vector::Zero(n_)};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const RealForm form = second(x[i], y[j]);
      sum.value += powers_of_i[i + j] * form.value;
      sum.error += form.error;
    }
  return sum;
}

ComplexForm DirectionalDerivatives::third(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b,
                                          const Eigen::VectorXcd& c) {
  if (b == a && c == a.conjugate()) return cube_of_size(a.real(), a.imag());
  const std::array<Vector, 2> x{a.real(), a.imag()}, y{b.real(), b.imag()}, z{c.real(), c.imag()};
  ComplexForm sum{Eigen::VectorXcd::Zero(n_), Vector::Zero(n_)};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t k = 0; k < 2; ++k) {
        const RealForm form = third(x[i], y[j], z[k]);
        sum.value += powers_of_i[i + j + k] * form.value;
        sum.error += form.error;
      }
  return sum;
}

// D^3 a a a* of a = x + i y, a |a|^2 = x^3 + x y^2 + i (x^2 y + y^3), where the sum and the difference of D^3
// (x + y)^3 and D^3 (x - y)^3 have 6 x y^2 and 6 x^2 y.
ComplexForm DirectionalDerivatives::cube_of_size(const Vector& x, const Vector& y) {
  const RealForm X = along(3, x), Y = along(3, y), plus = along(3, x + y), minus = along(3, x - y);
  const Vector xyy = (plus.value + minus.value - 2 * X.value) / 6,
               xxy = (plus.value - minus.value - 2 * Y.value) / 6;
  ComplexForm cube;
  cube.value = (X.value + xyy).cast<std::complex<double>>() + powers_of_i[1] * (Y.value + xxy);
  cube.error = X.error + Y.error + plus.error + minus.error;
  return cube;
}

RealForm DirectionalDerivatives::parameter_derivative() {
  const Vector d = Vector::Unit(n_ + 1, n_);
  if (at_.by_differences().parameters) return along(1, d);
  RealForm form = unknown_form(n_);
  if (!usable_ || !value_at(0, Vector::Zero(n_ + 1), false, dF_)) return form;
  at_.parameter_derivative(place_.free, form.value);
  form.error = std::numeric_limits<double>::epsilon() * form.value.cwiseAbs();
  return form;
}

std::optional<Jacobian> DirectionalDerivatives::jacobian() {
  if (!usable_) return {};
  if (!at_.by_differences().jacobian) {
    const bool known = value_at(0, Vector::Zero(n_ + 1), true, dF_) &&
                       !std::holds_alternative<const Operator*>(at_.jacobian());
    return known ? std::optional(at_.jacobian()) : std::nullopt;
  }
  Matrix J(n_, n_);
  errors_of_jacobian_.resize(n_, n_);
  for (Eigen::Index i = 0; i < n_; ++i) {
    const RealForm column = along(1, Vector::Unit(n_ + 1, i));
    if (!column.value.allFinite()) return {};
    J.col(i) = column.value;
    errors_of_jacobian_.col(i) = column.error;
  }
  return J;
}

}  // namespace arcslip::continuation

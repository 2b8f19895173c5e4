// The second Lyapunov coefficient of u' = F(u, p) at a generalized Hopf point. On the centre manifold
//
//   u = u_0 + H(z, z*),   H = sum a_jk z^j z*^k,   a_10 = q,   z' = i omega z + c1 z |z|^2 + c2 z |z|^4 + ...
//
// and F(u_0 + H) = H_z z' + H_z* z*'. With f_jk the coefficient of z^j z*^k in F(u_0 + H) of an H of the
// orders below j + k, J q = i omega q, J^T w = -i omega w and <q, q> = <w, q> = 1,
//
//   (i omega (j - k) - J) a_jk = f_jk - ((j - 1) c1 + (k - 1) c1*) a_(j-1)(k-1)
//   c1 = <w, f_21>,   c2 = <w, f_32>,   <w, a_21> = 0,   l2 = Re c2 / omega
//
// (Kuznetsov 2004, section 8.7, where c2 is one form of 15 terms over 12; Re c2 is the same where Re c1 = 0.)
// Each order m = j + k follows from the derivative of order m - 1 at r = 0 of
//
//   d/dr F(u_0 + H(r e^(i phi))) = J dH/dr,
//
// m! times the sum of f_jk e^(i (j-k) phi), at eight angles of half a turn: the other half has (-1)^m times
// that.

#include <arcslip/continuation/normal_forms/central_quotient.hpp>
#include <arcslip/continuation/normal_forms/codimension_two.hpp>
#include <arcslip/continuation/normal_forms/propagated_error.hpp>
#include <arcslip/continuation/problem/extrapolation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <numbers>

namespace arcslip::continuation {
namespace {

constexpr int highest_order = 5;          // order
constexpr Eigen::Index angles = 8;        // of half a turn; six would do
constexpr double spread_of_noise = 10;    // one error over another
constexpr double first_radius = 1.0 / 4;  // of that at which H changes an unknown by its size

double factorial(int m) {
  return m < 2 ? 1 : m * factorial(m - 1);
}

class CentreManifold {
 public:
  CentreManifold(Evaluator& at, const PlaceOfForms& place, const Eigenpair& pair, const Jacobian& J)
      : at_(at), place_(place), n_(place.u.size()), pair_(pair), solver_(J), piece_(at.piece()) {
    const Vector sizes = place.u.cwiseAbs().cwiseMax(place.scales.head(n_));
    unit_ = 1 / (2 * pair.right.cwiseAbs().cwiseQuotient(sizes).maxCoeff());
    for (auto& row : a_)
      for (Term& term : row) term.value = ComplexVector::Zero(n_), term.error = Vector::Zero(n_);
    a_[1][0].value = unit_ * pair.right;
  }

  // c2 of z in units of unit_. False: not known.
  bool compute(PropagatedError& c2) {
    for (int m = 2; m <= highest_order; ++m) {
      if (!derivatives(m)) return false;
      if (m == highest_order) {
        Term f = coefficient(3, 2);
        f.error.array() += lower_errors_ * derivatives_.value.cwiseAbs().maxCoeff() / factorial(m);
        // Where Re c1 is not quite zero, c2 depends on the choice of the terms before it.
        f.error.array() += std::abs(c1_.real()) * sizes_ * sizes_ * a_[1][0].value.cwiseAbs().maxCoeff();
        c2.add(1 / unit_, f);
        return true;
      }
      for (int k = 0; 2 * k <= m; ++k)
        if (!add_term(m - k, k)) return false;
    }
    return false;
  }
  double unit() const { return unit_; }

 private:
  using Term = ComplexForm;

  static Complex turn(double angle) { return std::polar(1.0, angle); }

  // H and dH/dr at r e^(i phi), up to the highest_order order that is known.
  void place_at(double r, double phi, Vector& H, Vector& by_r) const {
    H = place_.u;
    by_r.setZero();
    for (int m = 1; m < highest_order; ++m)
      for (int k = 0; 2 * k <= m; ++k) {
        const int j = m - k;
        const double share = j == k ? 1 : 2;  // the conjugate term is that of (k, j)
        const Vector term = share * (turn((j - k) * phi) * a_[index(j)][index(k)].value).real();
        H += std::pow(r, m) * term;
        by_r += m * std::pow(r, m - 1) * term;
      }
  }
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  bool value_at(double r, double phi, Eigen::Ref<Vector> g) {
    Vector H(n_), by_r(n_), product(n_);
    place_at(r, phi, H, by_r);
    if (at_.move_to(H, place_.p, Needs::jacobian) != Evaluated::ok || at_.piece() != piece_) return false;
    apply(at_.jacobian(), by_r, product);
    g = product;
    return true;
  }

  // derivatives_: of J dH/dr of order m - 1 by r, at 0, one angle after another.
  bool derivatives(int m) {
    const CentralQuotient stencil = central_quotient(m - 1);
    Vector g(n_);
    const auto found = extrapolate(angles * n_, first_radius, [&](double h, Vector& quotient) {
      quotient.setZero();
      for (Eigen::Index l = 0; l < angles; ++l)
        for (std::size_t i = 0; i < stencil.places; ++i) {
          const double phi = std::numbers::pi * static_cast<double>(l) / angles;
          if (!value_at(stencil.distance[i] * h, phi, g)) return false;
          quotient.segment(l * n_, n_) += stencil.weight[i] * g;
        }
      quotient /= std::pow(h, m - 1);
      return true;
    });
    if (!found) return false;
    derivatives_ = *found;
    return true;
  }

  // Of derivatives_, of the order m, over m!.
  ComplexVector harmonic(int k, int m) const {
    ComplexVector sum = ComplexVector::Zero(n_);
    for (Eigen::Index l = 0; l < angles; ++l) {
      const double phi = std::numbers::pi * static_cast<double>(l) / angles;
      sum += turn(-k * phi) * derivatives_.value.segment(l * n_, n_);
    }
    return sum / (angles * factorial(m));
  }

  // f_jk of the order of derivatives_. The harmonic m + 2 is 0 but for errors, of which it is a sample.
  Term coefficient(int j, int k) const {
    const int m = j + k;
    const double noise = spread_of_noise * harmonic(m + 2, m).cwiseAbs().maxCoeff();
    Term f{harmonic(j - k, m), Vector::Constant(n_, noise)};
    for (Eigen::Index l = 0; l < angles; ++l)
      f.error += derivatives_.error.segment(l * n_, n_) / (angles * factorial(m));
    return f;
  }

  bool add_term(int j, int k) {
    Term f = coefficient(j, k);
    Term& a = a_[index(j)][index(k)];
    if (j == 2 && k == 1) {
      c1_ = pair_.left.dot(f.value) / unit_;  // f - c1 a_10
      if (!solver_.factorize(pair_.value, pair_.right, pair_.left)) return false;
      Term right{ComplexVector::Zero(n_ + 1), Vector::Zero(n_ + 1)};
      right.value.head(n_) = c1_ * a_[1][0].value - f.value;
      right.error.head(n_) = f.error;
      const Term solution = solved(solver_, right);
      a = {solution.value.head(n_), solution.error.head(n_)};
    } else {
      if (k > 0 && j + k > 2)
        f.value -= ((j - 1.0) * c1_ + (k - 1.0) * std::conj(c1_)) * a_[index(j - 1)][index(k - 1)].value;
      if (!solver_.factorize(Complex(0, (j - k) * pair_.value.imag()))) return false;
      a = solved(solver_, {-f.value, f.error});
    }
    const double size = std::max(a.value.cwiseAbs().maxCoeff(), a_[1][0].value.cwiseAbs().maxCoeff());
    lower_errors_ += a.error.maxCoeff() / size;
    sizes_ += a.value.cwiseAbs().maxCoeff() / a_[1][0].value.cwiseAbs().maxCoeff();
    return a.value.allFinite();
  }

  Evaluator& at_;
  const PlaceOfForms& place_;
  const Eigen::Index n_;
  const Eigenpair& pair_;
  ShiftedSolver solver_;
  const std::uint64_t piece_;
  double unit_ = 1, lower_errors_ = 0;
  double sizes_ = 1;  // of all terms, that of q is 1
  Complex c1_ = 0;    // of z in units of unit_
  std::array<std::array<Term, highest_order>, highest_order> a_;
  ExtrapolatedDifference derivatives_;
};

}  // namespace

Coefficient second_lyapunov(Evaluator& at, const PlaceOfForms& place, const Eigenpair& pair) try {
  if (at.by_differences().jacobian) return {};
  if (at.move_to(place.u, place.p, Needs::jacobian) != Evaluated::ok) return {};
  if (std::holds_alternative<const Operator*>(at.jacobian())) return {};
  const Jacobian J = at.jacobian();
  CentreManifold manifold(at, place, pair, J);
  PropagatedError c2(pair.left);
  if (!manifold.compute(c2)) return {};
  const double scale = std::pow(manifold.unit(), 4) * pair.value.imag();
  return {c2.value().real() / scale, c2.error() / scale};
} catch (const std::exception&) {  // no derivatives, as it says
  return {};
}

}  // namespace arcslip::continuation

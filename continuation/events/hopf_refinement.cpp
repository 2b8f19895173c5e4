#include <arcslip/continuation/events/hopf_refinement.hpp>

#include <arcslip/continuation/events/hopf.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/problem/difference.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

namespace arcslip::continuation {
namespace {

using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;

constexpr int refining_steps = 8;
constexpr double still_shrinking = 0.5;         // of |Re mu|, from step to step: more is rounding
constexpr double refined_enough = 1e-9;         // |Re mu|, relative to omega
constexpr double farthest_refined = 1e-3;       // from the first place, relative to 1 + |u|, and of omega
constexpr double least_overlap = 1e-10;         // w^H v, |v| = |w| = 1: below, the pair is not separate
constexpr double longest_difference = 1. / 64;  // relative to u, or to its scales
constexpr int difference_halvings = 10;         // of it
constexpr double getting_worse = 4;             // of an extrapolation's error, as rounding takes over

// w . d/dh F(u + h d) by central differences, extrapolated to h = 0 (Ridders, Adv. Eng. Softw. 4, 1982): the
// value of the least estimated error.
class ExtrapolatedDifference {
 public:
  ExtrapolatedDifference(Evaluator& at, const Vector& u, const Vector& p)
      : at_(at), u_(u), p_(p), F_(u.size()) {}

  std::optional<Complex> operator()(const ComplexVector& w, const Vector& d, std::uint64_t piece) {
    std::array<Complex, difference_halvings> row{}, before{};
    Complex best = 0;
    double error = std::numeric_limits<double>::infinity();
    int columns = 0;
    for (int k = 0; k < difference_halvings; ++k) {
      const double h = std::ldexp(longest_difference, -k);
      if (!difference(d, h, piece)) {
        columns = 0;
        error = std::numeric_limits<double>::infinity();
        continue;
      }
      row[0] = w.dot(F_.cast<Complex>()) / (2 * h);
      double least = std::numeric_limits<double>::infinity();
      double power = 1;
      for (int j = 1; j <= columns; ++j) {
        power *= 4;
        const auto i = static_cast<std::size_t>(j);
        row[i] = row[i - 1] + (row[i - 1] - before[i - 1]) / (power - 1);
        const double now = std::max(std::abs(row[i] - row[i - 1]), std::abs(row[i] - before[i - 1]));
        least = std::min(least, now);
        if (!(now < error)) continue;
        error = now;
        best = row[i];
      }
      if (columns > 1 && least > getting_worse * error) break;
      before = row;
      columns = std::min(columns + 1, difference_halvings - 1);
    }
    return std::isfinite(error) ? std::optional(best) : std::nullopt;
  }

 private:
  // F_ = F(u + h d) - F(u - h d), both in the piece of u.
  bool difference(const Vector& d, double h, std::uint64_t piece) {
    const auto look = [&](double distance) {
      return at_.move_to(u_ + distance * d, p_, Needs::residual) == Evaluated::ok && at_.piece() == piece;
    };
    if (!look(h)) return false;
    F_ = at_.residual();
    if (!look(-h)) return false;
    F_ -= at_.residual();
    return F_.allFinite();
  }

  Evaluator& at_;
  const Vector &u_, &p_;
  Vector F_;
};

class HopfRefinement {
 public:
  HopfRefinement(const Accepted& now, double frequency, const ComplexVector& z, const Vector& scales)
      : now_(now),
        scales_(scales),
        n_(now.u.size()),
        x_(n_ + 1),
        p_(now.p),
        J_(n_, n_),
        balanced_(n_, n_),
        C_(n_ + 1, n_ + 1),
        dx_(n_ + 1),
        frequency_(frequency),
        v_(n_ + 1),
        w_(n_ + 1) {
    x_ << now.u, now.parameter;
    to_dense(now.at.jacobian(), balanced_);
    balance(balanced_, D_);
    c_ = z.cwiseQuotient(D_.cast<Complex>()).normalized();
    b_ = c_;
  }

  std::optional<RefinedHopf> find() {
    const Vector first = x_;
    const double given = frequency_;
    Vector best;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < refining_steps; ++k) {
      if (!evaluate()) return {};
      const double miss = std::abs(mu_.real());
      if (miss >= still_shrinking * least) {
        if (miss < least) best = x_, least = miss;
        break;
      }
      least = miss;
      best = x_;
      if (k == 0 && !differentiate()) return {};
      if (mu_rate_.real() == 0) return {};
      const double ds = -mu_.real() / mu_rate_.real();
      x_ += dx_ + ds * now_.tangent;
      frequency_ = mu_.imag() + ds * mu_rate_.imag();
      if (!near(first, given)) return {};
    }
    if (!(least <= refined_enough * given)) return {};
    x_ = best;
    if (!evaluate() || !near(first, given)) return {};
    return RefinedHopf{x_, mu_.imag(), right_};
  }

 private:
  bool near(const Vector& first, double given) const {
    const Vector change = (x_ - first).head(n_).cwiseQuotient(scales_);
    const double size = 1 + first.head(n_).cwiseQuotient(scales_).norm();
    return change.norm() <= farthest_refined * size &&
           std::abs(frequency_ - given) <= farthest_refined * given;
  }

  bool move_to(const Vector& x, Needs needs) {
    u_ = x.head(n_);
    p_[now_.free] = x[n_];
    return now_.at.move_to(u_, p_, needs) == Evaluated::ok;
  }

  // mu_, with the vectors and the correction dx_ to F = 0 at x_.
  bool evaluate() {
    if (!move_to(x_, Needs::jacobian)) return false;
    piece_ = now_.at.piece();
    dx_ << -now_.at.residual(), 0;
    now_.bordered.solve(dx_);
    to_dense(now_.at.jacobian(), J_);
    for (int k = 0; k < 2; ++k)
      if (!dx_.allFinite() || !vectors()) return false;
    const auto Jv = product();
    if (!Jv) return false;
    mu_ = *Jv / overlap_;
    return std::isfinite(std::abs(mu_));
  }

  // v and w with borders, which then are v and w; and both for J as it is, w^H v = overlap_.
  bool vectors() {
    balanced_ = D_.cwiseInverse().asDiagonal() * J_ * D_.asDiagonal();
    C_.topLeftCorner(n_, n_) = balanced_.cast<Complex>();
    C_.topLeftCorner(n_, n_).diagonal().array() -= Complex(0, frequency_);
    C_.col(n_).head(n_) = b_;
    C_.row(n_).head(n_) = c_.adjoint();
    C_(n_, n_) = 0;
    lu_.factorize(C_);
    const ComplexVector unit = ComplexVector::Unit(n_ + 1, n_);
    lu_.solve(unit, v_);
    lu_.solve_transposed(unit, w_);
    if (!v_.allFinite() || !w_.allFinite()) return false;
    c_ = v_.head(n_).normalized();
    b_ = w_.head(n_).conjugate().normalized();
    right_ = D_.cast<Complex>().cwiseProduct(c_);
    left_ = b_.cwiseQuotient(D_.cast<Complex>());
    overlap_ = b_.dot(c_);
    return std::abs(overlap_) > least_overlap;
  }

  // w^H J v: by J, or by differences where J itself consists of them.
  std::optional<Complex> product() {
    if (!now_.at.by_differences().jacobian) return b_.dot(balanced_.cast<Complex>() * c_);
    // of a length at which no unknown changes by more than its size
    const Vector sizes = u_.cwiseAbs().cwiseMax(scales_);
    const double length = 1 / right_.cwiseAbs().cwiseQuotient(sizes).maxCoeff();
    const Vector u = u_, p = p_;
    ExtrapolatedDifference difference(now_.at, u, p);
    const auto real = difference(left_, length * right_.real(), piece_);
    const auto imaginary = difference(left_, length * right_.imag(), piece_);
    if (!real || !imaginary) return {};
    return (*real + Complex(0, 1) * *imaginary) / length;
  }

  // d mu / ds along the tangent, by differences of J.
  bool differentiate() {
    const Vector t = now_.tangent;
    const double length = t.head(n_).cwiseQuotient(scales_).norm();
    const double size = 1 + x_.head(n_).cwiseQuotient(scales_).norm();
    const double h = std::sqrt(difference_step) * size / std::max(length, 1.0);
    std::array<Complex, 2> nearby;
    const auto found = difference_within_piece(h, [&](std::size_t i, double distance) {
      if (!move_to(x_ + distance * t, Needs::jacobian) || now_.at.piece() != piece_) return false;
      to_dense(now_.at.jacobian(), J_);
      nearby[i] = left_.dot(J_.cast<Complex>() * right_);
      return true;
    });
    if (!found) return false;
    mu_rate_ = (found->here * mu_ * overlap_ + found->weight[0] * nearby[0] + found->weight[1] * nearby[1]) /
               overlap_;
    return std::isfinite(std::abs(mu_rate_));
  }

  const Accepted& now_;
  const Vector& scales_;
  Eigen::Index n_;
  Vector x_, u_, p_;
  Matrix J_, balanced_;
  Vector D_;
  Eigen::MatrixXcd C_;
  LU<Complex> lu_;
  Vector dx_;
  double frequency_;
  ComplexVector b_, c_, v_, w_, right_, left_;
  Complex overlap_, mu_, mu_rate_;
  std::uint64_t piece_ = 0;
};

}  // namespace

std::optional<RefinedHopf> refine_hopf(const Accepted& now, double frequency, const Eigen::VectorXcd& z,
                                       const Vector& scales) try {
  return HopfRefinement(now, frequency, z, scales).find();
} catch (const std::exception&) {  // outside the domain, as it says
  return {};
}

}  // namespace arcslip::continuation

#include <arcslip/continuation/events/hopf_refinement.hpp>

#include <arcslip/continuation/linear/shifted_solver.hpp>
#include <arcslip/continuation/problem/difference.hpp>
#include <arcslip/continuation/problem/extrapolation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr int refining_steps = 8;
constexpr double still_shrinking = 0.5;         // of |Re mu|, from step to step: more is rounding
constexpr double refined_enough = 1e-9;         // |Re mu|, relative to omega
constexpr double farthest_refined = 1e-3;       // from the first place, relative to 1 + |u|, and of omega
constexpr double longest_difference = 1. / 64;  // relative to u, or to its scales

class HopfRefinement {
 public:
  HopfRefinement(const Accepted& now, double frequency, const ComplexVector& z, const Vector& scales)
      : now_(now),
        scales_(scales),
        n_(now.u.size()),
        x_(n_ + 1),
        p_(now.p),
        dx_(n_ + 1),
        frequency_(frequency),
        z_(z) {
    x_ << now.u, now.parameter;
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
    return RefinedHopf{x_, mu_.imag(), z_};
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
    if (!dx_.allFinite()) return false;
    ShiftedSolver solver(now_.at.jacobian());
    auto pair = refined_eigenpair(solver, Complex(0, frequency_), z_);
    if (!pair) return false;
    z_ = std::move(pair->right);
    left_ = std::move(pair->left);
    const auto value = now_.at.by_differences().jacobian ? product() : std::optional(pair->value);
    if (!value) return false;
    mu_ = *value;
    return std::isfinite(std::abs(mu_));
  }

  // w^H J v by differences of F, where J itself consists of them.
  std::optional<Complex> product() {
    // of a length at which no unknown changes by more than its size
    const Vector sizes = u_.cwiseAbs().cwiseMax(scales_);
    const double length = 1 / z_.cwiseAbs().cwiseQuotient(sizes).maxCoeff();
    const Vector u = u_, p = p_;
    Vector F(n_);
    const auto along = [&](const Vector& d) {
      return extrapolate(2, longest_difference, [&](double h, Vector& quotient) {
        const auto look = [&](double distance) {
          return now_.at.move_to(u + distance * d, p, Needs::residual) == Evaluated::ok &&
                 now_.at.piece() == piece_;
        };
        if (!look(h)) return false;
        F = now_.at.residual();
        if (!look(-h)) return false;
        const Complex change = left_.dot((F - now_.at.residual()).cast<Complex>()) / (2 * h);
        quotient << change.real(), change.imag();
        return true;
      });
    };
    const auto real = along(length * z_.real()), imaginary = along(length * z_.imag());
    if (!real || !imaginary) return {};
    return (Complex(real->value[0], real->value[1]) +
            Complex(0, 1) * Complex(imaginary->value[0], imaginary->value[1])) /
           length;
  }

  // d mu / ds along the tangent, by differences of J.
  bool differentiate() {
    const Vector t = now_.tangent;
    const double length = t.head(n_).cwiseQuotient(scales_).norm();
    const double size = 1 + x_.head(n_).cwiseQuotient(scales_).norm();
    const double h = std::sqrt(difference_step) * size / std::max(length, 1.0);
    const Vector real = z_.real(), imaginary = z_.imag();
    Vector J_real(n_), J_imaginary(n_);
    std::array<Complex, 2> nearby;
    const auto found = difference_within_piece(h, [&](std::size_t i, double distance) {
      if (!move_to(x_ + distance * t, Needs::jacobian) || now_.at.piece() != piece_) return false;
      apply(now_.at.jacobian(), real, J_real);
      apply(now_.at.jacobian(), imaginary, J_imaginary);
      nearby[i] = left_.dot(J_real.cast<Complex>() + Complex(0, 1) * J_imaginary.cast<Complex>());
      return true;
    });
    if (!found) return false;
    mu_rate_ = found->here * mu_ + found->weight[0] * nearby[0] + found->weight[1] * nearby[1];
    return std::isfinite(std::abs(mu_rate_));
  }

  const Accepted& now_;
  const Vector& scales_;
  Eigen::Index n_;
  Vector x_, u_, p_;
  Vector dx_;
  double frequency_;
  ComplexVector z_, left_;
  Complex mu_, mu_rate_;
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

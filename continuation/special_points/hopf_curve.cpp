#include <arcslip/continuation/special_points/hopf_curve.hpp>

#include <arcslip/continuation/events/hopf.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/normal_forms/codimension_two.hpp>
#include <arcslip/continuation/special_points/augmented_evaluator.hpp>
#include <arcslip/continuation/special_points/curve_place.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace arcslip::continuation {
namespace {

using Complex = std::complex<double>;

// The distance of two eigenvalues from +- i sqrt(kappa).
double miss(Complex x, Complex y, Complex root) {
  return std::min(std::abs(x - root) + std::abs(y + root), std::abs(x + root) + std::abs(y - root));
}

// A pair of eigenvalues of J, complex conjugates or both real, and its invariant subspaces.
class Pair {
 public:
  // The pair nearest to +- i sqrt(kappa). False if the eigenvalues cannot be computed.
  bool find(const Matrix& J, double kappa) {
    if (!eigenvalues_.compute(J)) return false;
    const Eigen::VectorXcd& mu = eigenvalues_.values();
    const Complex root = std::sqrt(Complex(-kappa));
    double nearest = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < mu.size(); ++i)
      for (Eigen::Index j = i + 1; j < mu.size(); ++j) {
        if (mu[i].imag() != -mu[j].imag() || (mu[i].imag() != 0 && mu[i].real() != mu[j].real())) continue;
        const double distance = miss(mu[i], mu[j], root);
        if (!(distance < nearest)) continue;
        nearest = distance;
        sum = (mu[i] + mu[j]).real();
        product = (mu[i] * mu[j]).real();
      }
    return std::isfinite(nearest);
  }

  // V, W and adj(R) of the pair: the null spaces of P.
  bool span(const Matrix& J) {
    P_.noalias() = J * J;
    P_ -= sum * J;
    P_.diagonal().array() += product;
    of_P_.compute(P_, 2);
    V = of_P_.right();
    const Eigen::Matrix2d to_unit = Eigen::Matrix2d(V.transpose() * of_P_.left()).inverse();
    W.noalias() = of_P_.left() * to_unit;
    JV_.noalias() = J * V;
    adjugate = sum * Eigen::Matrix2d::Identity();
    adjugate.noalias() -= W.transpose() * JV_;
    return V.allFinite() && W.allFinite();
  }

  double sum = 0, product = 0;
  Matrix V, W;
  Eigen::Matrix2d adjugate;

 private:
  Matrix P_, JV_;
  NullSpaces of_P_;
  Eigenvalues eigenvalues_;
};

class HopfEvaluator final : public AugmentedEvaluator {
 public:
  explicit HopfEvaluator(std::shared_ptr<const InnerProblem> inner)
      : AugmentedEvaluator(std::move(inner), 2),
        parameters_(static_cast<Eigen::Index>(inner_->problem->parameters().size())),
        v_(Vector::Zero(n_ + 1)),
        dx_(n_ + 1),
        dp_(parameters_),
        by_x_(2, n_ + 1),
        by_p_(2, parameters_) {
    jacobian_ = Matrix::Zero(n_ + 2, n_ + 2);
  }

  Evaluated move_to(In x, In p, Needs needs) override {
    const Evaluated result = here_.move_to(x.head(n_ + 1), p);
    if (result != Evaluated::ok) return result;
    to_dense(here_.at().jacobian(), J_);
    if (!pair_.find(J_, x[n_ + 1])) return Evaluated::failed;
    R_ << here_.at().residual(), pair_.sum, pair_.product - x[n_ + 1];
    if (needs == Needs::residual) return Evaluated::ok;
    if (!pair_.span(J_) || !differentiate()) return Evaluated::failed;
    Matrix& J = std::get<Matrix>(jacobian_);
    J.topLeftCorner(n_, n_) = J_;
    J.col(n_).head(n_) = here_.F_pa();
    J.bottomLeftCorner(2, n_ + 1) = by_x_;
    J(n_ + 1, n_ + 1) = -1;
    return J.allFinite() ? Evaluated::ok : Evaluated::failed;
  }

  ByDifferences by_differences() const override { return {!given_, !given_}; }

 private:
  void further_derivative(int k, Out dG) const override { dG = by_p_.col(k); }

  // The derivatives of sigma and pi with respect to x and p: sums of those of w_j . J v_i, weighted by I
  // and adj(R).
  bool differentiate() {
    by_x_.setZero();
    by_p_.setZero();
    given_ = true;
    for (Eigen::Index i = 0; i < 2; ++i) {
      v_.head(n_) = pair_.V.col(i);
      bool moved = false;
      for (Eigen::Index j = 0; j < 2; ++j) {
        if (!here_.second_derivative(pair_.W.col(j), v_, dx_, dp_)) {
          given_ = false;
          if (!moved && !nearby_.along(here_, v_)) return false;
          moved = true;
          nearby_.transposed_derivative(pair_.W.col(j), dx_);
          for (Eigen::Index k = 0; k < parameters_; ++k)
            dp_[k] = nearby_.parameter_derivative(pair_.W.col(j), static_cast<int>(k));
        }
        if (i == j) {
          by_x_.row(0) += dx_.transpose();
          by_p_.row(0) += dp_.transpose();
        }
        by_x_.row(1) += pair_.adjugate(i, j) * dx_.transpose();
        by_p_.row(1) += pair_.adjugate(i, j) * dp_.transpose();
      }
    }
    return true;
  }

  Eigen::Index parameters_;
  Vector v_, dx_, dp_;
  Matrix by_x_, by_p_;  // derivatives of sigma and pi
  Matrix J_;
  Pair pair_;
  bool given_ = false;  // second derivatives, by the problem
};

}  // namespace

std::shared_ptr<const Problem> hopf_points(std::shared_ptr<const Problem> problem, int along,
                                           double frequency) {
  auto inner = std::make_shared<const InnerProblem>(problem, along, MakeLinearSolver{});
  if (problem->size() < 2 || problem->size() > largest_spectrum)
    throw std::invalid_argument("a curve of Hopf points needs 2 to " + std::to_string(largest_spectrum) +
                                " unknowns, not " + std::to_string(problem->size()));
  if (!(frequency > 0 && std::isfinite(frequency)))
    throw std::invalid_argument("the typical frequency is " + std::to_string(frequency) +
                                ", must be positive");
  Matrix dense;
  to_dense(problem->evaluator()->jacobian(), dense);
  return augmented(inner, Vector::Constant(1, frequency * frequency),
                   [inner] { return std::make_unique<HopfEvaluator>(inner); }, {});
}

Vector with_frequency(const Event& event) {
  const auto* hopf = std::get_if<Hopf>(&event.data);
  if (!hopf) throw std::invalid_argument("the event \"" + event.monitor + "\" has no data of a Hopf point");
  Vector x(event.point.u.size() + 2);
  x << event.point.u, event.point.parameter, hopf->frequency * hopf->frequency;
  return x;
}

Monitor zero_frequency_monitor() {
  Monitor monitor;
  monitor.name = "bogdanov_takens";
  monitor.value = [](const Accepted& now) { return now.u[now.u.size() - 1]; };
  monitor.describe = [](const Accepted& now) -> EventData {
    const PlaceOnCurve place(now);
    return bogdanov_takens_form(place.at(), place.place());
  };
  return monitor;
}

}  // namespace arcslip::continuation

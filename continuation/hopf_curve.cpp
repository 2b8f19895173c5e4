#include <arcslip/continuation/hopf_curve.hpp>

#include <arcslip/continuation/hopf.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

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

constexpr double difference = 6e-6;         // of central differences, relative
constexpr double smaller_difference = 0.1;  // where a kink lies within
constexpr int smaller_differences = 4;

struct Definition {
  std::shared_ptr<const Problem> problem;
  int along;
  double frequency;
};

// How far two eigenvalues are from +- i sqrt(kappa).
double miss(Complex x, Complex y, Complex root) {
  return std::min(std::abs(x - root) + std::abs(y + root), std::abs(x + root) + std::abs(y - root));
}

// A pair of eigenvalues of J, complex conjugates or both real, and its invariant subspaces.
class Pair {
 public:
  // The nearest to +- i sqrt(kappa). False where the eigenvalues cannot be computed.
  bool find(const Matrix& J, double kappa) {
    eigen_.compute(J, false);
    if (eigen_.info() != Eigen::Success) return false;
    const auto& mu = eigen_.eigenvalues();
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

  // V, W and adj(R) of the pair that was found. With Q P = H T, H orthogonal, T upper triangular with rows of
  // zeros last: these rows of H^T span W, and V solves T P^T V = 0.
  bool span(const Matrix& J) {
    const Eigen::Index n = J.rows();
    Q_ = J * J - sum * J;
    Q_.diagonal().array() += product;
    qr_.compute(Q_);
    V.resize(n, 2);
    V.bottomRows(2).setIdentity();
    if (n > 2)
      V.topRows(n - 2) = -qr_.matrixQR()
                              .topLeftCorner(n - 2, n - 2)
                              .triangularView<Eigen::Upper>()
                              .solve(qr_.matrixQR().topRightCorner(n - 2, 2));
    V = (qr_.colsPermutation() * V).eval();
    W = Matrix::Zero(n, 2);
    W.bottomRows(2).setIdentity();
    W.applyOnTheLeft(qr_.householderQ());
    W = (W * (V.transpose() * W).inverse()).eval();
    adjugate = sum * Eigen::Matrix2d::Identity() - W.transpose() * J * V;
    return V.allFinite() && W.allFinite();
  }

  double sum = 0, product = 0;
  Matrix V, W;
  Eigen::Matrix2d adjugate;

 private:
  Eigen::EigenSolver<Matrix> eigen_;
  Eigen::ColPivHouseholderQR<Matrix> qr_;
  Matrix Q_;
};

class HopfEvaluator final : public Evaluator {
 public:
  explicit HopfEvaluator(std::shared_ptr<const Definition> definition)
      : definition_(std::move(definition)),
        n_(definition_->problem->size()),
        here_(definition_->problem->evaluator()),
        ahead_(definition_->problem->evaluator()),
        behind_(definition_->problem->evaluator()),
        scale_(definition_->problem->scales()),
        parameters_(static_cast<Eigen::Index>(definition_->problem->parameters().size())),
        R_(n_ + 2),
        gradient_(2, n_ + parameters_),
        work_(n_),
        jacobian_(Matrix::Zero(n_ + 2, n_ + 2)) {}

  Evaluated move_to(In x, In p, Needs needs) override {
    u_ = x.head(n_);
    p_ = p;
    p_[definition_->along] = x[n_];
    const Evaluated result = here_->move_to(u_, p_, Needs::jacobian);
    if (result != Evaluated::ok) return result;
    to_dense(here_->jacobian(), J_);
    if (!pair_.find(J_, x[n_ + 1])) return Evaluated::failed;
    R_ << here_->residual(), pair_.sum, pair_.product - x[n_ + 1];
    if (needs == Needs::residual) return Evaluated::ok;
    if (!pair_.span(J_) || !differentiate()) return Evaluated::failed;
    Matrix& J = std::get<Matrix>(jacobian_);
    J.topLeftCorner(n_, n_) = J_;
    here_->parameter_derivative(definition_->along, work_);
    J.col(n_).head(n_) = work_;
    J.bottomLeftCorner(2, n_) = gradient_.leftCols(n_);
    J.block(n_, n_, 2, 1) = gradient_.col(n_ + definition_->along);
    J(n_ + 1, n_ + 1) = -1;
    return J.allFinite() ? Evaluated::ok : Evaluated::failed;
  }

  const Vector& residual() const override { return R_; }
  const Jacobian& jacobian() const override { return jacobian_; }

  void parameter_derivative(int k, Out dR) const override {
    if (k == definition_->along) {
      dR.setZero();
      return;
    }
    here_->parameter_derivative(k, dR.head(n_));
    dR.tail(2) = gradient_.col(n_ + k);
  }

  std::uint64_t piece() const override { return here_->piece(); }

 private:
  // The derivatives of sigma and pi by u and p: sums of those of w_j . J v_i with the weights I and adj(R).
  bool differentiate() {
    gradient_.setZero();
    Vector change(n_ + parameters_);
    for (Eigen::Index i = 0; i < 2; ++i) {
      bool moved = false;
      for (Eigen::Index j = 0; j < 2; ++j) {
        if (!second(pair_.W.col(j), pair_.V.col(i), moved, change)) return false;
        if (i == j) gradient_.row(0) += change.transpose();
        gradient_.row(1) += pair_.adjugate(i, j) * change.transpose();
      }
    }
    return true;
  }

  // The gradient of w . J v. moved: ahead_ and behind_ are already beside u along v.
  bool second(const Vector& w, const Vector& v, bool& moved, Vector& change) {
    if (here_->second_derivative(w, v, Vector::Zero(parameters_), change.head(n_), change.tail(parameters_)))
      return true;
    if (!moved && !move_beside(v)) return false;
    moved = true;
    apply_transposed(ahead_->jacobian(), w, change.head(n_));
    apply_transposed(behind_->jacobian(), w, work_);
    change.head(n_) -= work_;
    for (Eigen::Index k = 0; k < parameters_; ++k) {
      ahead_->parameter_derivative(static_cast<int>(k), work_);
      change[n_ + k] = w.dot(work_);
      behind_->parameter_derivative(static_cast<int>(k), work_);
      change[n_ + k] -= w.dot(work_);
    }
    change /= 2 * h_;
    return true;
  }

  // Moves ahead_ and behind_ to u + h v and u - h v, within the smooth piece of u if there is room.
  bool move_beside(const Vector& v) {
    h_ = difference * std::max(1.0, u_.cwiseQuotient(scale_).norm()) / v.cwiseQuotient(scale_).norm();
    for (int k = 0;; ++k, h_ *= smaller_difference) {
      if (ahead_->move_to(u_ + h_ * v, p_, Needs::jacobian) != Evaluated::ok ||
          behind_->move_to(u_ - h_ * v, p_, Needs::jacobian) != Evaluated::ok)
        return false;
      const std::uint64_t piece = here_->piece();
      if (k == smaller_differences || (ahead_->piece() == piece && behind_->piece() == piece)) return true;
    }
  }

  std::shared_ptr<const Definition> definition_;
  Eigen::Index n_;
  std::unique_ptr<Evaluator> here_, ahead_, behind_;
  Vector scale_;
  Eigen::Index parameters_;
  Vector R_;
  Matrix gradient_;  // of sigma and pi, by u and all parameters
  Vector u_, p_, work_;
  Matrix J_;
  Pair pair_;
  double h_ = 1;
  Jacobian jacobian_;
};

class HopfProblem final : public Problem {
 public:
  explicit HopfProblem(Definition definition)
      : definition_(std::make_shared<const Definition>(std::move(definition))) {}

  int size() const override { return definition_->problem->size() + 2; }
  std::span<const Parameter> parameters() const override { return definition_->problem->parameters(); }
  Vector scales() const override {
    Vector scale(size());
    scale << definition_->problem->scales(), along().scale, scale_of_kappa();
    return scale;
  }
  bool metric(In v, Out Mv) const override {
    const Eigen::Index n = v.size() - 2;
    Mv[n] = v[n] / (along().scale * along().scale);
    Mv[n + 1] = v[n + 1] / (scale_of_kappa() * scale_of_kappa());
    return definition_->problem->metric(v.head(n), Mv.head(n));
  }
  std::unique_ptr<Evaluator> evaluator() const override {
    return std::make_unique<HopfEvaluator>(definition_);
  }
  bool cheap_residual() const override { return false; }

 private:
  const Parameter& along() const {
    return definition_->problem->parameters()[static_cast<std::size_t>(definition_->along)];
  }
  double scale_of_kappa() const { return definition_->frequency * definition_->frequency; }

  std::shared_ptr<const Definition> definition_;
};

}  // namespace

std::shared_ptr<const Problem> hopf_points(std::shared_ptr<const Problem> problem, int along,
                                           double frequency) {
  const auto count = problem->parameters().size();
  if (along < 0 || static_cast<std::size_t>(along) >= count)
    throw std::out_of_range("there is no parameter " + std::to_string(along) + " among " +
                            std::to_string(count));
  if (problem->size() < 2 || problem->size() > largest_spectrum)
    throw std::invalid_argument("a curve of Hopf points needs 2 to " + std::to_string(largest_spectrum) +
                                " unknowns, not " + std::to_string(problem->size()));
  if (!(frequency > 0 && std::isfinite(frequency)))
    throw std::invalid_argument("a typical frequency is positive, not " + std::to_string(frequency));
  Matrix dense;
  to_dense(problem->evaluator()->jacobian(), dense);
  return std::make_shared<HopfProblem>(Definition{std::move(problem), along, frequency});
}

Vector with_frequency(const Event& event) {
  const auto* hopf = std::get_if<Hopf>(&event.data);
  if (!hopf) throw std::invalid_argument("the event \"" + event.monitor + "\" has no data of a Hopf point");
  Vector x(event.point.u.size() + 2);
  x << event.point.u, event.point.parameter, hopf->frequency * hopf->frequency;
  return x;
}

Monitor zero_frequency_monitor() {
  return {"bogdanov_takens", [](const Accepted& now) { return now.u[now.u.size() - 1]; }};
}

}  // namespace arcslip::continuation

#pragma once
// The force of a law sampled in time, and its Jacobian: what the exact integrals replace.

#include <arcslip/laws/law.hpp>

#include <memory>
#include <numbers>
#include <vector>

namespace arcslip::bench {

/// Steps of a law through two periods of a motion, and the projection of the forces in the second. Their
/// derivatives by the coefficients are carried along in the same steps and projected by a product of
/// matrices.
class Sampled {
 public:
  Sampled(const elements::Law& law, const std::vector<double>& fields, const elements::Harmonics& h,
          int samples)
      : law_(law.in_time(fields)),
        odd_(h.odd),
        basis_(samples, h.size()),
        q_(samples, law.directions()),
        f_(samples, law.directions()),
        end_(law.directions(), law.memory()),
        z_(Eigen::VectorXd::Zero(law.memory())),
        z_u_(law.memory(), h.size() * law.directions()),
        J_(h.size() * law.directions(), h.size() * law.directions()) {
    for (int i = 0; i < law.directions(); ++i) by_u_.emplace_back(samples, h.size() * law.directions());
    Eigen::VectorXd phi(h.size());
    for (int s = 0; s < samples; ++s) {
      elements::series_basis(h, 2 * std::numbers::pi * s / samples, phi);
      basis_.row(s) = phi.transpose();
    }
  }

  const Eigen::MatrixXd& coefficients(elements::In u, bool jacobian = false) {
    q_.noalias() = basis_ * u.reshaped(basis_.cols(), q_.cols());
    z_.setZero();
    z_u_.setZero();
    at_ = q_.row(0).transpose();
    law_->begin(at_, z_, end_);
    force_ = end_.f;
    for (Eigen::Index k = 1; k <= 2 * q_.rows(); ++k) {
      const Eigen::Index s = k % q_.rows();
      dq_ = q_.row(s).transpose() - at_;
      law_->step({at_, z_, force_}, dq_, end_);
      z_ += end_.dz;
      at_ = q_.row(s).transpose();
      force_ = end_.f;
      f_.row(s) = force_.transpose();
      if (jacobian) differentiate(k);
    }
    F_.noalias() = basis_.transpose() * f_;
    F_ *= 2.0 / static_cast<double>(q_.rows());
    if (!odd_) F_.row(0) *= 0.5;
    if (jacobian) project();
    return F_;
  }
  const Eigen::MatrixXd& jacobian() const { return J_; }

 private:
  // Of the k-th step. Rows of z by u do not change where the memory rests.
  void differentiate(Eigen::Index k) {
    const Eigen::Index s = k % q_.rows(), before = (k - 1) % q_.rows(), c = basis_.cols();
    if (k >= q_.rows())
      for (Eigen::Index i = 0; i < q_.cols(); ++i) {
        auto row = by_u_[static_cast<std::size_t>(i)].row(s);
        row.setZero();
        for (Eigen::Index j = 0; j < q_.cols(); ++j) {
          if (end_.f_q(i, j) != 0) row.segment(j * c, c) += end_.f_q(i, j) * basis_.row(s);
          if (end_.f_start(i, j) != 0) row.segment(j * c, c) += end_.f_start(i, j) * basis_.row(before);
        }
        for (Eigen::Index m = 0; m < z_.size(); ++m)
          if (end_.f_z(i, m) != 0) row += end_.f_z(i, m) * z_u_.row(m);
      }
    if (z_.size() == 0 || (end_.z_z.isIdentity(0) && end_.z_q.isZero(0) && end_.z_start.isZero(0))) return;
    next_.noalias() = end_.z_z.lazyProduct(z_u_);
    for (Eigen::Index j = 0; j < q_.cols(); ++j) {
      next_.middleCols(j * c, c) += end_.z_q.col(j).lazyProduct(basis_.row(s));
      if (!end_.z_start.col(j).isZero(0))
        next_.middleCols(j * c, c) += end_.z_start.col(j).lazyProduct(basis_.row(before));
    }
    z_u_.swap(next_);
  }

  void project() {
    const Eigen::Index c = basis_.cols();
    for (Eigen::Index i = 0; i < q_.cols(); ++i) {
      auto rows = J_.middleRows(i * c, c);
      rows.noalias() = basis_.transpose() * by_u_[static_cast<std::size_t>(i)];
      rows *= 2.0 / static_cast<double>(q_.rows());
      if (!odd_) rows.row(0) *= 0.5;
    }
  }

  std::unique_ptr<elements::TimeLaw> law_;
  bool odd_;                           // without a mean
  Eigen::MatrixXd basis_, q_, f_, F_;  // basis_: samples x coefficients
  elements::StepEnd end_;
  Eigen::VectorXd z_, at_, dq_, force_;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Rows z_u_, next_;
  std::vector<Rows> by_u_;  // of each direction: samples x unknowns
  Eigen::MatrixXd J_;
};

}  // namespace arcslip::bench

#pragma once
// The force of a law sampled in time: what the exact integrals replace.

#include <arcslip/elements/law.hpp>

#include <numbers>
#include <vector>

namespace arcslip::bench {

/// Steps of a law through two periods of a motion, and the projection of the forces in the second.
class Sampled {
 public:
  Sampled(const elements::Law& law, std::vector<double> fields, const elements::Harmonics& h, int samples)
      : law_(law),
        fields_(std::move(fields)),
        odd_(h.odd),
        basis_(samples, h.size()),
        q_(samples, law_.directions()),
        f_(samples, law_.directions()),
        end_(law_.directions(), law_.memory()),
        z_(Eigen::VectorXd::Zero(law_.memory())) {
    Eigen::VectorXd phi(h.size());
    for (int s = 0; s < samples; ++s) {
      elements::series_basis(h, 2 * std::numbers::pi * s / samples, phi);
      basis_.row(s) = phi.transpose();
    }
  }

  const Eigen::MatrixXd& coefficients(elements::In u) {
    q_.noalias() = basis_ * u.reshaped(basis_.cols(), q_.cols());
    z_.setZero();
    at_ = q_.row(0).transpose();
    law_.begin(fields_, at_, z_, end_);
    force_ = end_.f;
    for (Eigen::Index k = 1; k <= 2 * q_.rows(); ++k) {
      const Eigen::Index s = k % q_.rows();
      dq_ = q_.row(s).transpose() - at_;
      law_.step(fields_, {at_, z_, force_}, dq_, end_);
      z_ += end_.dz;
      at_ = q_.row(s).transpose();
      force_ = end_.f;
      f_.row(s) = force_.transpose();
    }
    F_.noalias() = basis_.transpose() * f_;
    F_ *= 2.0 / static_cast<double>(q_.rows());
    if (!odd_) F_.row(0) *= 0.5;
    return F_;
  }

 private:
  const elements::Law& law_;
  std::vector<double> fields_;
  bool odd_;  // without a mean
  Eigen::MatrixXd basis_, q_, f_, F_;
  elements::StepEnd end_;
  Eigen::VectorXd z_, at_, dq_, force_;
};

}  // namespace arcslip::bench

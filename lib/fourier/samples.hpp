#pragma once
// One span of the harmonics at equal intervals, for laws that are sampled in time.

#include <arcslip/fourier/moments.hpp>

namespace arcslip::elements {

class Samples {
 public:
  /// count: samples in one span.
  Samples(const Harmonics& harmonics, int count);

  int count() const { return count_; }
  double weight() const { return harmonics_.span() / count_; }
  double angle(int s) const { return s * weight(); }

  /// x at the samples.
  void values(In u, Out x) const { x.noalias() = basis_ * u; }
  /// phi at sample s, as a row.
  auto basis(int s) const { return basis_.row(s); }
  /// F = the Fourier coefficients of the samples f.
  void coefficients(In f, Out F) const {
    F.noalias() = basis_.transpose() * f;
    F *= factor();
    if (!harmonics_.odd) F[0] *= 0.5;
  }
  /// What sums over the samples are multiplied with: the weight over a half of the span, or of the turn.
  double factor() const { return (harmonics_.odd ? 2 : 1) / std::numbers::pi * weight(); }
  /// Moments of the weights w at the samples: sum_s w_s phi phi^T.
  void moments(In w, Moments& result) const;

 private:
  Harmonics harmonics_;
  int count_;
  Eigen::MatrixXd basis_;      // count x size
  Eigen::MatrixXd cos_, sin_;  // moments x count: of k theta_s, k = q * stride
  mutable Eigen::VectorXd c_, s_;
};

}  // namespace arcslip::elements

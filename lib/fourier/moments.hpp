#pragma once
// Weighted integrals of products of harmonics: G = integral of w(theta) phi phi^T over a set of angles.
//
// With C_k = integral of w cos k theta and S_k likewise with sin, k = 0 .. 2N, G is Toeplitz plus Hankel:
//   G_cc(n, m) = (C_|n-m| + C_n+m)/2,  G_ss = (C_|n-m| - C_n+m)/2,  G_cs(n, m) = (S_n+m - sgn(n-m)
//   S_|n-m|)/2.
// So O(N) integrals determine G for any w.

#include <arcslip/fourier/series.hpp>

namespace arcslip::elements {

class Moments {
 public:
  explicit Moments(const Harmonics& harmonics);

  /// How many C_q, S_q there are: q = 0 .. count() - 1 stands for k = q * stride.
  int count() const { return count_; }
  void clear();
  void add(int q, double c, double s);
  /// Adds the integral over [begin, end] with a constant w. z_sum = exp(i k s), z_half = exp(i k d), k = 0 ..
  /// 2N, at the middle s and the half length d: C_k = 2 w sin(k d) cos(k s)/k, which loses no digits on short
  /// pieces.
  void add_interval(double length, const std::complex<double>* z_sum, const std::complex<double>* z_half,
                    double weight = 1);
  /// Call after the last add: sets the entries of negative index.
  void close();

  void integral(Out l) const;                                       // of w phi
  void times(In u, double factor, Out y) const;                     // y += factor G u
  void add_to(Eigen::Ref<Eigen::MatrixXd> J, double factor) const;  // J += factor G

 private:
  Harmonics harmonics_;
  int count_;
  Eigen::VectorXd c_, s_;    // index count_ - 1 + q, q = -(count_-1) .. count_-1; even and odd in q
  Eigen::VectorXd inverse_;  // 1 / k
};

}  // namespace arcslip::elements

#pragma once
// A unilateral normal spring under a preload, N = max(N_0 + k_n x_n, 0), over one period of x_n: the
// intervals in contact, and the coefficients of N - max(N_0, 0), exact.

#include <arcslip/fourier/crossings.hpp>
#include <arcslip/fourier/moments.hpp>
#include <arcslip/fourier/reversals.hpp>
#include <arcslip/laws/element.hpp>

#include <span>
#include <utility>

namespace arcslip::elements {

/// The fields of contacts with such a load, contact_2d and contact_3d.
namespace contact_field {
enum { tangential_stiffness, normal_stiffness, friction_coefficient, normal_load, count };
}

/// Owns its buffers.
class NormalContact {
 public:
  explicit NormalContact(const Harmonics& harmonics);

  void move_to(In u_n, double k_n, double N_0);

  /// Begin and end; the whole period where it never opens.
  std::span<const std::pair<double, double>> closed() const { return closed_; }
  bool opens() const { return opens_; }
  const Eigen::VectorXd& load() const { return n_; }  // coefficients of N_0 + k_n x_n
  /// Of the load N_0 + k_n x_n. The reference holds until the next call.
  const std::vector<Reversal>& reversals() const { return reversals_.find(n_); }
  void tell(FrictionState& state) const;  // load_max, load_min

  // Of N - max(N_0, 0).
  const Eigen::VectorXd& force() const { return F_; }
  const Eigen::VectorXd& by_stiffness() const { return by_stiffness_; }
  const Eigen::VectorXd& by_load() const { return by_load_; }
  void jacobian(Eigen::Ref<Eigen::MatrixXd> J) const;  // J = dF/du_n

 private:
  void find_closed(In u_n);

  Harmonics harmonics_;
  double k_n_ = 0, N_0_ = 0;
  mutable Reversals reversals_;
  Crossings crossings_;
  std::vector<std::pair<double, double>> closed_;
  bool opens_ = false;
  Moments moments_;
  Eigen::VectorXd n_, F_, by_stiffness_, by_load_;
  std::vector<std::complex<double>> middle_, half_;
};

}  // namespace arcslip::elements

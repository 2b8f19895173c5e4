#pragma once
// The stretch y = x - w of the spring of a slider w in a disc that moves (planar_phases.hpp), as Fourier
// coefficients S, with their derivatives by those of x_1, x_2 and the radius h. Integrals over stick are
// closed, those over slip sums over the nodes of its panels.

#include <arcslip/fourier/moments.hpp>
#include <arcslip/laws/contact/planar_phases.hpp>

#include <complex>
#include <vector>

namespace arcslip::elements {

/// Owns its buffers.
class DiscStretch {
 public:
  explicit DiscStretch(const Harmonics& harmonics);

  /// closed, opens: as DiscPhases::find has them. The disc stays where it is until the derivatives are taken.
  void move_to(const Disc& disc, std::span<const std::pair<double, double>> closed, bool opens);

  const Eigen::VectorXd& coefficients() const { return S_; }  // of y_1 and y_2
  const DiscPhases& phases() const { return phases_; }

  void differentiate();
  /// dS after differentiate(): 2 size x 3 size.
  auto derivative() const { return by_.leftCols(3 * c_); }
  /// dw of the stick phase of this index in the list: 2 x 3 size. Takes the derivatives anew.
  void rest_derivative(std::size_t phase, Eigen::Ref<Eigen::MatrixXd> dw);

 private:
  static constexpr std::size_t nothing = static_cast<std::size_t>(-1);

  void integrate();
  void differentiate_full_stick();
  void begin(const DiscPhase& phase);
  void stick(const DiscPhase& phase);
  void slip(const DiscPhase& phase);
  void add_moments(const SlipPanel& panel, const SlipPanel::Nodes& weights);
  void add_nodes();
  void close_period();

  void turn_basis();
  void integrate_basis(double begin, double end);
  void set_bases(const SlipPanel& panel);

  Harmonics h_;
  Eigen::Index c_;
  DiscPhases phases_;
  const Disc* disc_ = nullptr;
  Moments stick_;
  Moments slipping_[2];  // weighted with n
  Eigen::VectorXd S_;
  // By the coefficients, and by the two coordinates of w at the beginning.
  Eigen::MatrixXd by_, dw_, kept_;
  std::size_t keep_ = nothing;
  Eigen::RowVectorXd dpsi_;
  Eigen::MatrixXd first_, phi_, slope_;
  Eigen::MatrixXd rows_, weighted_;  // dpsi and its weights at nodes of slip, until add_nodes()
  Eigen::Index filled_ = 0;
  Eigen::VectorXd g_, basis_;
  std::vector<std::complex<double>> middle_, half_;
};

}  // namespace arcslip::elements

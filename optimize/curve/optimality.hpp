#pragma once
// Optimality conditions of the design as equations with a further parameter s. Not installed.
//
// The peaks A_i(p, s) of the active set are equally high, and design parameters p may be fixed at their
// bounds. With y = ln p (p over its larger bound if the bounds include zero), sigma likewise for s, and f_i =
// ln A_i, the unknowns z = (y_k of the free parameters, lambda_2 .. lambda_a, tau) and lambda_1 = 1 -
// lambda_2 - ... - lambda_a satisfy
//
//   sum_i lambda_i df_i/dy_k = 0   for each free parameter,
//   f_i - tau = 0                  for each active peak,
//
// as many equations as unknowns: the Karush-Kuhn-Tucker conditions of min tau, f_i <= tau. The point is a
// minimum if lambda_i >= 0, if nu_k = -side sum_i lambda_i df_i/dy_k >= 0 for each parameter fixed at its
// side (-1 lower, 1 upper), and if sum_i lambda_i d2f_i/dy2 is positive definite on the null space of the
// active constraint gradients.
//
// Each peak is tracked by a follower with the equations of its kind, so that the unknowns are few and
// resonances, corners and ends of the window are treated alike; the Jacobian is exact, from second
// derivatives (analyses/curves/sensitivity.hpp).

#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/optimize/evaluation/scaled_parameter.hpp>
#include <arcslip/optimize/peaks/peak_amplitude.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace arcslip::optimize {

struct ActiveSet {
  std::vector<std::size_t> peaks;  // indices of PeakState::peaks
  std::vector<int> held;           // of each parameter of the design: -1, 1: at that bound, 0: free

  Eigen::Index free() const;
  Eigen::Index unknowns() const { return free() + static_cast<Eigen::Index>(peaks.size()); }
};

/// An inequality that is active or may become so.
struct Inequality {
  enum class Kind { peak, bound } kind = Kind::peak;
  std::size_t index = 0;  // of PeakState::peaks, or of the parameter
  int side = 0;           // of a bound
  friend bool operator==(const Inequality&, const Inequality&) = default;
};

/// The data of the equations. The parameters of the peaks are those of the design and, last, s.
struct OptimalityData {
  PeakAmplitude& peaks;
  std::vector<ScaledParameter> scaled;  // of all
  ActiveSet active;
  double reference;  // m, of tau = ln(A / reference)
};

class OptimalityEvaluator final : public continuation::Evaluator {
 public:
  explicit OptimalityEvaluator(std::shared_ptr<const OptimalityData> data);

  /// p: sigma. outside_domain if an active peak cannot be tracked.
  continuation::Evaluated move_to(continuation::In z, continuation::In p, continuation::Needs needs) override;
  const continuation::Vector& residual() const override { return E_; }
  const continuation::Jacobian& jacobian() const override { return jacobian_; }
  void parameter_derivative(int, continuation::Out dE) const override { dE = E_sigma_; }
  std::uint64_t piece() const override { return piece_; }

  // At the last point.
  const std::vector<double>& design() const { return design_; }  // p and s
  const std::vector<Peak>& active_peaks() const { return peaks_; }
  const continuation::Vector& weights() const { return lambda_; }
  double level() const { return tau_; }

  /// >= 0 if it holds: the multiplier of an active inequality, the distance from an inactive one.
  double slack(const Inequality& of) const;
  /// The index of the highest tracked peak that is not active, or none.
  std::optional<std::size_t> highest_other() const { return other_; }
  /// Its distance below tau; 1 without such a peak.
  double distance_of_others() const { return other_ ? tau_ - levels_[*other_] : 1; }
  /// d tau / dsigma of the optimum, by the envelope theorem.
  double slope_along() const { return gradients_.row(gradients_.rows() - 1).dot(lambda_); }
  /// df_i/dy of any tracked peak, for the design parameters only.
  continuation::Vector gradient(std::size_t peak) const;
  /// Whether the second-order condition holds, by the last Jacobian.
  bool is_minimum() const;

 private:
  bool move_design(continuation::In z, double sigma);
  void look_at_peaks();
  continuation::Vector scaled_gradient(const Peak& peak, std::size_t parameters) const;
  bool add_second_derivatives();
  void differentiate();

  std::shared_ptr<const OptimalityData> data_;
  Eigen::Index free_, active_;
  std::vector<Eigen::Index> free_parameters_;
  std::vector<double> design_, levels_;
  std::vector<Peak> all_, peaks_;
  continuation::Vector lambda_, E_, E_sigma_, y_;
  continuation::Matrix gradients_, second_;  // df_i/d(y, sigma), columns; sum lambda_i d2f_i
  continuation::Jacobian jacobian_;
  std::optional<std::size_t> other_;
  double tau_ = 0;
  std::uint64_t piece_ = 0;
};

/// The equations as a problem in z with the one parameter sigma.
std::shared_ptr<const continuation::Problem> optimality(std::shared_ptr<const OptimalityData> data);

}  // namespace arcslip::optimize

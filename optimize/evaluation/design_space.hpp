#pragma once
// The design parameters of a search, and the scaled variables y seen by NLopt (scaled_parameter.hpp).
// Not installed.

#include <arcslip/optimize/evaluation/evaluation.hpp>
#include <arcslip/optimize/evaluation/optimum_problem.hpp>
#include <arcslip/optimize/evaluation/scaled_parameter.hpp>
#include <arcslip/optimize/nlopt/minimize.hpp>
#include <arcslip/optimize/peaks/peak_amplitude.hpp>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace arcslip::optimize {

inline constexpr double limit_tolerance = 1e-8;  // of limits, relative
inline constexpr double as_active = 1e-6;        // relative: a limit that is nearer is active

class DesignSpace {
 public:
  /// Throws as optimum() does.
  DesignSpace(const scene::Scene& scene, const OptimumProblem& problem);

  std::shared_ptr<const model::Model> model() const { return model_; }
  const std::vector<int>& parameters() const { return parameters_; }
  std::span<const double> lower() const { return lower_; }
  std::span<const double> upper() const { return upper_; }

  const std::vector<ScaledParameter>& scales() const { return scales_; }

  /// The model's own values, projected onto the bounds, with a note if they were outside.
  std::vector<double> start(std::vector<std::string>& notes) const;

  /// Further starts, along the diagonal of the bounds.
  int attempts() const;
  std::vector<double> attempt(int k) const;

  /// A low-discrepancy sequence of designs in the box of the variables.
  int samples() const;
  std::vector<double> sample(int k) const;

  /// The largest difference of a variable, relative to its range.
  double distance(std::span<const double> a, std::span<const double> b) const;

  std::vector<double> scaled(std::span<const double> design) const;  // y
  std::vector<double> design(std::span<const double> y) const;
  double slope(std::size_t k, double value) const;  // dp_k/dy_k

  /// The quantity named by a limit.
  PeakAmplitude::Observable observable(const std::string& name) const;

  /// The linear limits as constraints, and the largest of their values, above 0 if one is exceeded; -infinity
  /// without linear limits.
  void add_linear(NonlinearProgram& problem) const;
  double margin(std::span<const double> design) const;
  std::vector<ActiveLimit> active(std::span<const double> design) const;

  std::string text(std::span<const double> design) const;  // "d.normal_load = 3, c.value = 0.1"
  std::string names() const;

 private:
  struct Linear {
    std::vector<double> weights;  // of the parameters
    double bound, scale;          // sum <= bound
  };
  void add(const DesignVariable& v, const scene::Scene& scene);
  void add(const LinearLimit& limit);
  double value(const Linear& limit, std::span<const double> design) const;

  std::shared_ptr<const model::Model> model_;
  std::vector<std::string> names_;
  std::vector<int> parameters_;
  std::vector<double> lower_, upper_;
  std::vector<ScaledParameter> scales_;
  std::vector<Linear> linear_;
  double to_unit_;  // from rad/s to the scene's unit of frequency
};

}  // namespace arcslip::optimize

#pragma once
// Scenarios: the cases of a problem with values of the uncertain parameters. Not installed.

#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/evaluation/design_space.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::optimize {

/// A case with values of the uncertain parameters.
struct Scenario {
  std::size_t of = 0;  // index of the problem's case
  std::vector<double> scatter{};
};

class Scenarios {
 public:
  /// Throws as optimum() does. Refers to its arguments.
  Scenarios(const scene::Scene& scene, const OptimumProblem& problem, const DesignSpace& space);

  /// The initial scenarios: every case at the corners of the box of the scatter, or, above three parameters,
  /// at its centre and at the ends of each parameter.
  std::vector<Scenario> first() const;

  /// Number of the problem's cases, at least 1.
  std::size_t size() const { return cases_.size(); }
  double weight(const Scenario& scenario) const { return cases_[scenario.of].weight; }
  std::unique_ptr<PeakAmplitude> peaks(const Scenario& scenario, control::Control control) const;
  LoadCaseResult result(const Scenario& scenario) const;

  /// "in case 2 with k.value = 3: ", or nothing for one case without scatter.
  std::string text(const Scenario& scenario) const;

  bool scatter() const { return box_.has_value(); }

  struct Worst {
    std::vector<double> scatter;
    double amplitude = 0;  // m; infinity if unbounded
  };

  /// The highest amplitude in the box of a case, by local searches from each of `known` and from the centre.
  /// If none exceeds `level`, by another one from the highest of up to 64 corners. report: called after each
  /// evaluation; false ends the searches. within: called throughout; false throws Interrupted. Throws
  /// std::runtime_error if a search fails.
  Worst worst(std::shared_ptr<const model::Model> model, const std::vector<std::vector<double>>& known,
              double level, const std::function<void()>& report, const control::Control& control,
              const control::Control& within) const;

 private:
  std::vector<double> centre() const;
  std::vector<std::vector<double>> corners() const;

  const scene::Scene& scene_;
  const OptimumProblem& problem_;
  const DesignSpace& space_;
  std::vector<LoadCase> cases_;  // at least one
  std::optional<DesignSpace> box_;
  observables::FrequencyWindow window_;
};

}  // namespace arcslip::optimize

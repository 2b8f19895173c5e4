#pragma once
// The cases of a problem, and the values in them of what scatters: its scenarios. Not installed.

#include <arcslip/optimize/search/design_space.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace arcslip::optimize {

/// A case, and what scatters in it.
struct Scenario {
  std::size_t of = 0;  // of the problem's cases
  std::vector<double> scatter{};
};

class Scenarios {
 public:
  /// Throws as optimum() does. Refers to its arguments.
  Scenarios(const scene::Scene& scene, const OptimumProblem& problem, const DesignSpace& space);

  /// To begin with: every case at the corners of the box of what scatters, or, above three parameters, at its
  /// centre and at the ends of each parameter.
  std::vector<Scenario> first() const;

  /// Number of the problem's cases, at least 1.
  std::size_t size() const { return cases_.size(); }
  double weight(const Scenario& scenario) const { return cases_[scenario.of].weight; }
  std::unique_ptr<PeakAmplitude> peaks(const Scenario& scenario, observables::GoOn go_on) const;
  CaseResult result(const Scenario& scenario) const;

  /// "in case 2 with k.value = 3: ", or nothing where there is one case and nothing scatters.
  std::string text(const Scenario& scenario) const;

  bool scatter() const { return box_.has_value(); }

  struct Worst {
    std::vector<double> scatter;
    double amplitude = 0;  // m; infinity where it is unbounded
  };

  /// The highest amplitude in the box of a case, with the parameters of a model: local searches, from each of
  /// `known` and from the centre. Where none is above `level`, one more from the highest of the corners, at
  /// most 64 of them. go_on: asked after each evaluation; false ends them. within: asked all the time; false
  /// throws Interrupted. Throws std::runtime_error where one fails.
  Worst worst(std::shared_ptr<const model::Model> model, const std::vector<std::vector<double>>& known,
              double level, const std::function<bool()>& go_on, const observables::GoOn& within) const;

 private:
  std::vector<double> centre() const;
  std::vector<std::vector<double>> corners() const;

  const scene::Scene& scene_;
  const OptimumProblem& problem_;
  const DesignSpace& space_;
  std::vector<DesignCase> cases_;  // at least one
  std::optional<DesignSpace> box_;
  observables::FrequencyWindow window_;
};

}  // namespace arcslip::optimize

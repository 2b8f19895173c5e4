#pragma once
// What an optimization is over: design parameters, limits, load cases, uncertain parameters.

#include <arcslip/scene/scene.hpp>

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::optimize {

/// A design parameter with its bounds.
struct DesignVariable {
  std::string name;
  double lower = 0, upper = 0;
  friend bool operator==(const DesignVariable&, const DesignVariable&) = default;
};

/// at_least <= observable <= at_most, at each resonance peak of at least three quarters of the highest.
/// Observables: the quantities of every response (observables/quantities.hpp), such as "frequency" (in the
/// scene's unit) and "energy_friction" (J per period); for an element NAME "NAME.equivalent_stiffness" and
/// "NAME.equivalent_damping", with friction "NAME.stick_percent" and "NAME.energy", with a normal direction
/// "NAME.open_percent", "NAME.normal_load_max" and "NAME.normal_load_min", where it is reported
/// "NAME.mean_force_min" and "NAME.mean_force_max", with a wear coefficient "NAME.wear_rate"; likewise the
/// totals of a patch NAME.
struct ObservableLimit {
  std::string observable;
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  friend bool operator==(const ObservableLimit&, const ObservableLimit&) = default;
};

/// at_least <= sum of weight * parameter <= at_most, over design parameters.
struct LinearLimit {
  std::vector<std::pair<std::string, double>> weights;
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  friend bool operator==(const LinearLimit&, const LinearLimit&) = default;
};

/// A load case of the design: an excitation level, a sample of uncertain parameters, a response location.
struct LoadCase {
  std::vector<std::pair<std::string, double>> set;  // parameters and their values
  double weight = 1;                                // of its amplitude, > 0
  std::optional<scene::Direction> response{};       // none: the scene's
  friend bool operator==(const LoadCase&, const LoadCase&) = default;
};

/// The criterion to minimize: the largest weighted amplitude of all cases, or their weighted mean.
enum class Criterion { worst, mean };

/// "worst", as in a scene file.
std::string_view name(Criterion criterion);

struct OptimumProblem {
  std::vector<DesignVariable> over;
  double frequency_from = 0, frequency_to = 0;  // window, in the scene's unit
  std::vector<ObservableLimit> limits{};
  std::vector<LinearLimit> linear_limits{};
  std::vector<LoadCase> cases{};  // none: one case, the scene itself
  Criterion criterion = Criterion::worst;
  std::vector<DesignVariable> scatter{};  // uncertain parameters; the worst case within these bounds counts
  friend bool operator==(const OptimumProblem&, const OptimumProblem&) = default;
};

/// Whether there are several load cases, by cases or by scatter.
inline bool has_cases(const OptimumProblem& problem) {
  return !problem.cases.empty() || !problem.scatter.empty();
}

}  // namespace arcslip::optimize

#pragma once
// What is chosen in a design, between which limits, and what it is to serve.

#include <arcslip/scene/scene.hpp>

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::optimize {

/// A parameter of a design, and the values it may take.
struct DesignVariable {
  std::string name;
  double lower = 0, upper = 0;
  friend bool operator==(const DesignVariable&, const DesignVariable&) = default;
};

/// at_least <= observable <= at_most, at each resonance peak that is watched, those of at least three
/// quarters of the highest. Observables: the numbers of observables/quantities.hpp that each response has, as
/// "frequency" (in the scene's unit) and "energy_friction" (J per period); for an element NAME
/// "NAME.equivalent_stiffness" and "NAME.equivalent_damping", with friction "NAME.stick_percent",
/// "NAME.energy".
struct ObservableLimit {
  std::string observable;
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  friend bool operator==(const ObservableLimit&, const ObservableLimit&) = default;
};

/// at_least <= sum of weight * parameter <= at_most; the parameters are those of a design.
struct LinearLimit {
  std::vector<std::pair<std::string, double>> weights;
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  friend bool operator==(const LinearLimit&, const LinearLimit&) = default;
};

/// One of several circumstances that a design is to serve: a level of the excitation, a sample of what
/// scatters, a place where the amplitude is read.
struct DesignCase {
  std::vector<std::pair<std::string, double>> set;  // parameters and their values
  double weight = 1;                                // of its amplitude, > 0
  std::optional<scene::Direction> response{};       // none: the scene's
  friend bool operator==(const DesignCase&, const DesignCase&) = default;
};

/// What is to be least: the largest weighted amplitude of all cases, or their weighted mean.
enum class Criterion { worst, mean };

/// "worst", as a scene file writes it.
std::string_view name(Criterion criterion);

}  // namespace arcslip::optimize

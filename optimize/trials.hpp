#pragma once
// The designs that a search tries: what V (cases.hpp) is at each, which is the best so far, who is told, and
// whether to go on. Not installed.

#include <arcslip/optimize/cases.hpp>
#include <arcslip/optimize/formulation.hpp>
#include <arcslip/optimize/scenarios.hpp>

#include <chrono>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace arcslip::optimize {

/// Of the designs that exceed the limits least, that of least V.
struct Best {
  std::vector<double> design;
  double value = 0;                                         // V, m
  double excess = std::numeric_limits<double>::infinity();  // of the limits, relative; 0 where all hold
};

class Trials {
 public:
  /// With the scenarios to begin with. far_apart: so lie the designs of a global search, that no best one may
  /// owe that to a peak that was not seen: its responses are traced. Throws as optimum() does. Refers to its
  /// arguments.
  Trials(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options,
         bool far_apart);

  /// Adds a case; what was best without it is no longer.
  void add(const Scenario& scenario);

  /// Takes the cases to a design, unless they stand there; trace: by responses, in any case.
  void evaluate(std::span<const double> design, bool trace = false);
  /// The same for the variables of a search. Throws std::runtime_error where a case has no response.
  void move_to(std::span<const double> y);

  /// The cases' highest amplitudes over what scatters at the design where they stand, where one is higher
  /// than V: as cases to be added.
  std::vector<Scenario> worse_scatter();

  const Best& best() const { return best_; }
  /// Where the cases stand, when rounding has made another design look better.
  void call_best();
  /// V at the best design, as new responses have it.
  void correct_best(double value) { best_.value = value; }

  /// Why the search is to end before its time; empty: it is not.
  observables::Stop interruption() const;
  bool user_stopped() const { return user_stopped_; }
  double seconds() const;

  const DesignSpace& space() const { return space_; }
  const Scenarios& scenarios() const { return scenarios_; }
  const Scenario& scenario(std::size_t c) const { return all_[c]; }
  std::string where(std::size_t c) const { return scenarios_.text(all_[c]); }  // "in case 2: "
  Cases& cases() { return cases_; }
  Formulation& formulation() { return formulation_; }
  std::vector<Evaluation>& evaluations() { return evaluations_; }

 private:
  Trials(const Trials&) = delete;
  void tell();

  const OptimumOptions& options_;
  DesignSpace space_;
  Scenarios scenarios_;
  Cases cases_;
  std::vector<Scenario> all_;  // of the cases
  Formulation formulation_;
  std::vector<Evaluation> evaluations_;
  Best best_;
  bool far_apart_, user_stopped_ = false;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace arcslip::optimize

#pragma once
// The designs that a search tries: what V (cases.hpp) is at each, which is the best so far, who is told, and
// whether to go on. Not installed.

#include <arcslip/optimize/search/cases.hpp>
#include <arcslip/optimize/search/formulation.hpp>
#include <arcslip/optimize/search/scenarios.hpp>
#include <arcslip/optimize/search/watch.hpp>

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

  /// As each case was there: so the best design is known even where a search is interrupted at another.
  struct Seen {
    PeakState state;
    std::shared_ptr<const hbm::HbmProblem> problem;
  };
  std::vector<Seen> cases{};
};

class Trials {
 public:
  /// With the scenarios to begin with. far_apart: so lie the designs of a global search, that no best one may
  /// owe that to a peak that was not seen: its responses are traced. Throws as optimum() does. Refers to its
  /// arguments. What takes the cases to a design throws Interrupted where the watch ends it.
  Trials(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options,
         Watch& watch, bool far_apart);

  /// Adds a case; what was best without it is no longer.
  void add(const Scenario& scenario);

  /// Takes the cases to a design, unless they stand there; trace: by responses, in any case.
  void evaluate(std::span<const double> design, bool trace = false);
  /// From here on by responses in any case, those that studies of them compute.
  void trace_all() { trace_all_ = true; }
  /// The same for the variables of a search. Throws std::runtime_error where a case has no response.
  void move_to(std::span<const double> y);

  /// The cases' highest amplitudes over what scatters at the design where they stand, where one is higher
  /// than V: as cases to be added.
  std::vector<Scenario> worse_scatter();

  const Best& best() const { return best_; }
  /// Where the cases stand, when rounding has made another design look better, or new responses have another
  /// V there, or a peak at which a limit is exceeded.
  void call_best();
  /// The best design of those of which responses are known, when a search has come to no such one from where
  /// new responses had called it.
  void recall_best();

  Watch& watch() { return watch_; }
  /// Another phase, which is told.
  void begin(const char* phase);

  const DesignSpace& space() const { return space_; }
  const Scenarios& scenarios() const { return scenarios_; }
  const Scenario& scenario(std::size_t c) const { return all_[c]; }
  std::string where(std::size_t c) const { return scenarios_.text(all_[c]); }  // "in case 2: "
  Cases& cases() { return cases_; }
  Formulation& formulation() { return formulation_; }
  std::vector<Evaluation>& evaluations() { return evaluations_; }
  /// By how much a limit was exceeded in each of them; infinity where there was no response.
  const std::vector<double>& excesses() const { return excesses_; }
  /// Others of the same search, which are told of as well.
  std::vector<Evaluation>& elsewhere() { return elsewhere_; }

 private:
  Trials(const Trials&) = delete;
  void tell();
  Best here();

  const OptimumOptions& options_;
  Watch& watch_;
  DesignSpace space_;
  Scenarios scenarios_;
  Cases cases_;
  std::vector<Scenario> all_;  // of the cases
  Formulation formulation_;
  std::vector<Evaluation> evaluations_, elsewhere_;
  std::vector<double> excesses_;
  Best best_, best_traced_;
  bool far_apart_, trace_all_ = false;
};

}  // namespace arcslip::optimize

#pragma once
// The design evaluations of a search: V (load_cases.hpp) at each, the best so far, progress and interruption.
// Not installed.

#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/evaluation/formulation.hpp>
#include <arcslip/optimize/evaluation/load_cases.hpp>
#include <arcslip/optimize/evaluation/scenarios.hpp>

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace arcslip::optimize {

/// The design with the smallest violation of the limits, and of these the lowest V.
struct Best {
  std::vector<double> design;
  double value = 0;                                         // V, m
  double excess = std::numeric_limits<double>::infinity();  // of the limits, relative; 0 where all hold

  /// The state of each case there, so that the best design is available even if a search is interrupted at
  /// another one.
  struct Seen {
    PeakState state;
    std::shared_ptr<const hbm::HbmProblem> problem;
  };
  std::vector<Seen> cases{};
};

class DesignEvaluations {
 public:
  /// Starts with the initial scenarios. far_apart: for a global search, whose distant designs may miss a new
  /// peak: the responses of a new best design are traced. threads: load cases evaluated at the same time.
  /// progress: called after each evaluation and at the start of each phase. Throws as optimum() does. Refers
  /// to its other arguments. Functions that move the cases throw Interrupted at the end of `control`, half a
  /// second later.
  DesignEvaluations(const scene::Scene& scene, const OptimumProblem& problem, const control::Control& control,
                    bool far_apart, int threads = 1,
                    std::function<void(const OptimumProgress&)> progress = {});

  /// Adds a case and resets the best design.
  void add(const Scenario& scenario);

  /// Moves the cases to a design, unless they are there; trace: always by new responses.
  void evaluate(std::span<const double> design, bool trace = false);
  /// From now on always by new responses, with the steps of a study.
  void trace_all() { trace_all_ = true; }
  /// The same for the variables of a search. Throws std::runtime_error if a case has no response.
  void move_to(std::span<const double> y);

  /// The worst scatter of the cases at the current design with an amplitude above V, as cases to add.
  std::vector<Scenario> worse_scatter();

  const Best& best() const { return best_; }
  /// Makes the current design the best: after rounding has favoured another one, or new responses have
  /// changed V there, or show a peak at which a limit is exceeded.
  void call_best();
  /// Returns to the best design with traced responses, if a search from a design set by call_best() found no
  /// better one.
  void recall_best();

  const control::Control& control() const { return control_; }
  /// Starts another phase, and reports it.
  void begin(const char* phase);
  /// In messages: "the search".
  const char* phase() const { return phase_; }

  const DesignSpace& space() const { return space_; }
  const Scenarios& scenarios() const { return scenarios_; }
  const Scenario& scenario(std::size_t c) const { return all_[c]; }
  std::string where(std::size_t c) const { return scenarios_.text(all_[c]); }  // "in case 2: "
  LoadCases& cases() { return cases_; }
  Formulation& formulation() { return formulation_; }
  std::vector<Evaluation>& evaluations() { return evaluations_; }
  /// The violation of the limits in each of them; infinity without a response.
  const std::vector<double>& excesses() const { return excesses_; }
  /// Others of the same search, reported as well.
  std::vector<Evaluation>& elsewhere() { return elsewhere_; }

 private:
  DesignEvaluations(const DesignEvaluations&) = delete;
  void tell();
  Best here();

  std::function<void(const OptimumProgress&)> progress_;
  const control::Control control_, within_;  // within_: of an evaluation
  const char* phase_ = "the search";
  DesignSpace space_;
  Scenarios scenarios_;
  LoadCases cases_;
  std::vector<Scenario> all_;  // of the cases
  Formulation formulation_;
  std::vector<Evaluation> evaluations_, elsewhere_;
  std::vector<double> excesses_;
  Best best_, best_traced_;
  bool far_apart_, trace_all_ = false;
};

}  // namespace arcslip::optimize

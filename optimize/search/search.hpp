#pragma once
// The search of optimum(): rounds of an algorithm, each followed by new responses at its best design, until
// the first-order conditions of a minimum hold there. Not installed.

#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/certificate/multipliers.hpp>
#include <arcslip/optimize/evaluation/design_evaluations.hpp>
#include <arcslip/optimize/nlopt/minimize.hpp>
#include <arcslip/optimize/search/convergence.hpp>
#include <arcslip/optimize/search/optimum.hpp>

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::optimize {

inline void add(const PeakWork& more, PeakWork& to) {
  to.responses += more.responses;
  to.followed += more.followed;
  to.factorizations += more.factorizations;
}

/// What a search changes on its way, but for the designs that it has evaluated.
struct SearchState {
  static constexpr double none = std::numeric_limits<double>::infinity();

  Algorithm algorithm;          // the current one
  Optimum result{};             // so far
  std::vector<double> start{};  // of the next round
  double reference = 1;         // V at the first start
  bool ended = false;           // no round follows
  struct Round {
    int number = 0;                      // since a start was found
    int responses = 0;                   // traced before it
    double value = none, excess = none;  // the best before it
    bool new_peak = false;               // in its last response
  } round{};
  int new_peaks = 0;             // rounds that ended with one
  double stuck_value = none;     // the lowest V at which stuck dampers were released
  double refined = 0;            // V at the last refinement
  std::size_t refinements = 0;   // by other algorithms
  int restarts = 0;              // from lower designs next to a minimum
  bool sought_feasible = false;  // by designs sampled over the bounds
  struct Minimum {
    double value;
    observables::Status status;
    observables::Stop stop;
  };

  // Of the searches from several designs.
  bool sought_elsewhere = false;
  std::optional<Minimum> minimum_left{};  // the minimum from which they led elsewhere
  PeakWork work_elsewhere{};
  std::vector<Evaluation> minima{};        // where they led, in their order
  int to_no_minimum = 0;                   // of them
  bool led_on_from_none = false;           // the search went on from where one of these ended
  std::optional<Evaluation> ended_near{};  // the one of them next to which the current search was ended
};

class Search {
 public:
  Search(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options);
  Optimum run();

 private:
  LoadCases& cases() { return designs_.cases(); }
  const DesignSpace& space() const { return designs_.space(); }
  const Best& best() const { return designs_.best(); }
  std::size_t count() { return designs_.evaluations().size(); }
  std::string after();  // " after 12 evaluations"
  void note(std::string sentence);

  // After a start come rounds of an algorithm, each with new responses at its best design; then the worst
  // case of the scatter at the design found, which may become a case of the search from there; at the end the
  // judgement whether that is a minimum. Each phase is carried out and chooses the next.
  enum class Phase { start, round, verification, scatter, judgement, end };
  Phase carry_out(Phase phase);
  Optimum finish();

  void begin();
  bool interrupted();
  void minimize_round();
  void minimize_once();
  MinimizeOptions options_of_round();
  void take(MinimizeResult found, Convergence::Ends by, double stationarity);
  std::string sentence(const MinimizeResult& found);
  // Traces the responses at the best design. True if the search is to continue: with a new higher peak, or
  // because peaks appeared and vanished during a round with progress.
  bool verify();
  void retreat();
  // In round after round the response at the best design has a peak that tracking loses.
  void stop_at_higher_peak();
  // Continues with dampers slipping that stick at the optimum, once for each improvement. A global search
  // finds such designs itself.
  bool release();
  // True if the search is to continue with it, from the design found.
  bool add_worst_scatter();

  // Continuation of the search (search_continued.cpp).

  // True if the search is to continue, from another start or by another algorithm. Otherwise certifies
  // the optimum.
  bool goes_on();
  void return_to_minimum();
  bool leave_infeasible();
  bool certify_best();
  bool move_to_best();
  // An algorithm may report convergence at no minimum: coming from outside the limits it may have moved to
  // a lower infeasible design, and its best is then only the last feasible one. Other algorithms continue
  // from it.
  bool refine(const Balance& left);
  // A discontinuity: the gradient predicts a decrease, but slightly beyond the amplitude jumps up, or a new
  // peak exceeds a limit by much: no conditions hold there. Or a kink: the amplitude rises, as at an end of
  // the window with two equally high extrema of the motion, or a limit is exceeded, as where the peak reaches
  // a corner: it may be a minimum, but not all gradients are known. Empty: neither.
  std::string jump(const Balance& left);
  // Other starts, once, if the search reached no feasible design.
  bool find_feasible();
  // Over several parameters or with limits there may be several local minima: further searches from the
  // lowest of sampled designs, with limits also by LN_COBYLA, and by other algorithms from the start.
  bool look_elsewhere(bool at_minimum);  // whether this search led to one
  struct Beginning {
    std::vector<double> design;
    std::string algorithm;
  };
  std::vector<Beginning> beginnings(bool from_minimum);
  Optimum search_from(const Beginning& beginning);
  bool has_several_starts() const;
  // The known minimum that a search next to it leads to, with a margin; none: it may lead to another one.
  std::optional<Evaluation> known_minimum(std::span<const double> design, double value) const;
  // Adds where a search led, and ends the account with the optimum of the whole search.
  void count_start(const Optimum& found);
  void count_starts();
  // A lower design found while computing a tolerance range.
  bool passed_lower();
  void go_from(const std::vector<double>& design);
  // The lowest feasible ones of designs sampled over the bounds that are apart, also in amplitude: where
  // nothing slips at the peak, all searches are the same.
  std::vector<std::vector<double>> lowest_elsewhere();
  // A highest value at an end of the window is no resonance peak: it ends the search where there is one
  // beyond.
  void check_window();
  // Sets the result of the best design. A certificate of another one is dropped.
  void describe();

  const scene::Scene& scene_;
  const OptimumProblem& problem_;
  const OptimumOptions& options_;
  const bool limited_;
  const Algorithm asked_;  // requested
  const control::Control control_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  DesignEvaluations designs_;
  SearchState s_;
  bool is_part_ = false;  // of another search, which checks the window itself
};

}  // namespace arcslip::optimize

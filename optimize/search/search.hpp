#pragma once
// The search of optimum(): rounds of an algorithm, each followed by new responses at its best design, until
// the conditions of a minimum hold there. Not installed.

#include <arcslip/optimize/nlopt/minimize.hpp>
#include <arcslip/optimize/search/multipliers.hpp>
#include <arcslip/optimize/search/trials.hpp>

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

class Search {
 public:
  Search(const scene::Scene& scene, const OptimumProblem& problem, const OptimumOptions& options);
  Optimum run();

 private:
  /// Why a run of an algorithm was ended from here: the gradient vanishes; the conditions of a minimum hold;
  /// it calls for designs that are known again and again, or, with limits, for many without a gain.
  enum class Ends { no, vanishes, settles, idles };

  Cases& cases() { return trials_.cases(); }
  const DesignSpace& space() const { return trials_.space(); }
  const Best& best() const { return trials_.best(); }
  std::size_t count() { return trials_.evaluations().size(); }
  std::string after();  // " after 12 evaluations"
  void note(std::string sentence);

  void search();
  void begin();
  bool interrupted();
  void minimize_once();
  Ends ends(bool smooth);
  std::string sentence(const Result& found);
  // At the best design so far: a flat place that is worse is none.
  bool gradient_vanishes();
  // Of limits and epigraphs: keeps the design that is nearest to a minimum by its conditions, among those as
  // good as the best but for what the tolerance of a limit gains. Whether it is one.
  bool is_settled();
  void take_candidate();
  // The responses at the best design. True where the search is to go on: with a higher peak than was seen, or
  // because others came up and went during a round that was not in vain.
  bool verify();
  void retreat();
  // Round after round a response at the best design has a peak that is lost on the way to it.
  void stop_at_higher_peak();
  // Goes on with the dampers slipping that stick at the optimum; after that, once for each gain. A global
  // search looks for such designs itself.
  bool release();
  // True where the search is to go on with it, from the design found.
  bool add_worst_scatter();

  // How it goes on (search_continued.cpp).

  // True where the search is to go on, from another start or by another algorithm. Certifies the optimum
  // where it is not.
  bool goes_on();
  Balance balance_here();
  bool stand_at_best();
  // What an algorithm calls converged may be no minimum: one that came from outside the limits may have gone
  // to a lower design there, and its best is then only the last that kept them. Others go on from it.
  bool refine(const Balance& left);
  // Where the amplitude would fall farther, but a little beyond it is much higher, or a peak is there at
  // which a limit is exceeded by much: no conditions hold there. Or it has risen, as beside an end of the
  // window where two extremes of the motion are equally high, or a limit is exceeded, as where the peak comes
  // to a corner: it is a minimum perhaps, but of gradients that are not all known. Empty: none of these.
  std::string jump(const Balance& left);
  // Other starts, once, where the search came to no design that keeps the limits.
  bool find_feasible();
  // With limits a minimum is often one of several. From the lowest of designs over all the bounds, too, also
  // by LN_COBYLA, and by other algorithms from where it began.
  bool look_elsewhere();
  // A lower design on the way to the end of a tolerance range.
  bool passed_lower();
  void go_from(const std::vector<double>& design);
  // The lowest of some designs over all the bounds that keep the limits, and are apart, also in amplitude:
  // where nothing slips at the peak, all searches are the same.
  std::vector<std::vector<double>> lowest_elsewhere();
  // What is known of the best design. A certificate of another one is dropped.
  void describe();

  const scene::Scene& scene_;
  const OptimumProblem& problem_;
  const OptimumOptions& options_;
  const bool limited_;
  const Algorithm asked_;  // for
  Algorithm algorithm_;    // at work
  Watch watch_;
  Trials trials_;
  Optimum result_;
  std::vector<double> start_;
  double reference_ = 1;                                          // V at the start
  int round_responses_ = 0;                                       // traced before the round
  double round_value_ = std::numeric_limits<double>::infinity();  // least before it
  double round_excess_ = std::numeric_limits<double>::infinity();
  double stuck_value_ = std::numeric_limits<double>::infinity();  // least one from which stuck dampers were
                                                                  // released
  int times_came_up_ = 0;
  bool came_up_ = false;           // a higher peak, in the last response
  bool looked_elsewhere_ = false;  // for a design that keeps the limits
  struct Candidate {
    std::vector<double> design;
    Balance left;
  } candidate_;             // of this round, for a minimum
  std::size_t known_ = 0;   // evaluations at the last call of an algorithm
  int idle_ = 0;            // calls since there was another
  std::size_t gained_ = 0;  // evaluations at the last gain of this run, and what it came to
  double gained_value_ = 0, gained_excess_ = 0;
  double refined_ = 0;           // V that no other algorithm made a minimum of
  std::size_t refinements_ = 0;  // by other algorithms
  int restarts_ = 0;             // from lower designs beside a minimum
  bool was_elsewhere_ = false;
  // V of a minimum by its conditions from which the search went elsewhere, and its end.
  std::optional<std::pair<double, std::pair<observables::Status, observables::Stop>>> stood_{};
  PeakWork work_elsewhere_{};
  bool ended_ = false;
};

}  // namespace arcslip::optimize

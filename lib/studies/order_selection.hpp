#pragma once
// The order N of the harmonics by the accuracy e that a scene asks for, "harmonics": {"accuracy": e}.
//
// A study is computed with rising orders until what its results leave out is at most e:
//
//   max |dA| <= e max A     over the points and events of all its branches
//
// with the estimates dA of the truncation error (observables/truncation.hpp). Where one of them is flagged as
// perhaps far too low, or there is none, as of modes, the order M before counts as well: with the largest
// relative change c of landmarks, which are the ends of branches, the events without an estimate, and of
// modes fifteen amplitudes in between (with damping ratios relative to the largest), the error is taken as
// c/((N/M)^2 - 1), as if it fell as N^-2, or as c where that is less.
//
// Where responses were searched for, two orders have to find as many: too few harmonics may have none of
// another one.
//
// The next order is the one at which the error, as N^-p, is e: p from the last two orders, and 3 at first,
// which is that of friction. Samples, where a force is sampled, grow as N^(3/2), so that their error falls as
// N^-3.

#include <arcslip/results/response.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/scene.hpp>

#include <span>
#include <string>
#include <vector>

namespace arcslip::studies {

/// A value that the results of every order have; it may change by the accuracy times its size.
struct Landmark {
  double value = 0, size = 0;
};

/// What the results of one order tell of the harmonics left out.
struct Truncation {
  bool ended = false;                       // the user ended them
  bool failed = false;                      // there are none
  double amplitude = 0;                     // the largest, m
  double estimate = observables::no_value;  // the largest change of an amplitude, m; no_value: not known
  bool flagged = false;                     // the estimate may be far too low
  std::vector<Landmark> landmarks{};
  double change = observables::no_value;  // of an amplitude where only parts were computed anew, relative
  int responses = 0;                      // that a search found; 0: none was made
};

/// Of all branches of one combination. estimated: their points have estimates.
Truncation truncation_of(std::span<const observables::ResponseBranch> branches, bool estimated = true);

/// Of a response, of those that were searched in vain, and of how a computation ended.
void add(const observables::Solution& point, Truncation& to);
void add(const observables::LookedAt& responses, Truncation& to);
void add(observables::Status status, const observables::Stop& stop, Truncation& to);

/// In place of the accuracy, an order for responses at which computations in time begin.
void set_order_of_starts(scene::Scene& scene);

/// The orders of one combination of a study.
class OrderSelection {
 public:
  /// With the accuracy, the highest order and the period of the scene.
  explicit OrderSelection(const scene::Scene& scene);

  /// Sets the order, and the samples, that are to be computed next, in place of the accuracy.
  void set_order(scene::Scene& scene) const;

  /// Takes the results of that order. True: a higher order is to be computed.
  bool rises(const Truncation& found);

  /// The order that rises() asked for is not computed to its end: the results are those of the one before.
  void give_up();

  int order() const { return order_; }     // the last one
  double error() const { return error_; }  // relative; no_value: not known
  bool is_reached() const { return error_ <= wanted_; }

  /// Adds the fact `accuracy`, a remark for people, and the doubt where the accuracy is not reached.
  void tell(results::End& end) const;

 private:
  double error_by_change(const Truncation& found) const;
  bool is_confirmed(const Truncation& found) const;
  double reported_error() const;
  int next() const;

  double wanted_;
  int highest_, period_, order_, samples_;
  bool ended_ = false, given_up_ = false;
  double error_ = observables::no_value;
  bool confirmed_ = true;      // the number of responses
  std::vector<int> orders_{};  // computed, with their errors
  std::vector<double> errors_{};
  Truncation last_{};
};

}  // namespace arcslip::studies

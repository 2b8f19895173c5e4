#pragma once
// Of which points of a branch the error of the multipliers is estimated, which takes twice as long as the
// multipliers do: of every fifth one, and of more where the moduli of the multipliers do not follow straight
// lines over the arclength. There a small change of the motion changes them most. The others have the larger
// one of the nearest two (complete_stability()).

#include <arcslip/observables/multipliers.hpp>

#include <vector>

namespace arcslip::observables {

class SampledErrors {
 public:
  /// Whether the next point of the branch has an estimate of its own. To be called at each.
  bool wants(const Multipliers& multipliers, double arclength);
  /// That estimate; NaN: not known, 0: nothing is left out.
  void take(double error);

 private:
  struct Moduli {
    std::vector<double> of;
    double arclength = 0;
  };
  Moduli last_, before_;
  double bent_ = 0, error_ = 0;  // since the last estimate; that estimate
  int since_ = 0;                // points; 0: there is none
};

}  // namespace arcslip::observables

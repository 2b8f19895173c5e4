#pragma once
// What the automata of a law do along a given periodic motion: which mode they are in at each angle.

#include <arcslip/elements/automaton.hpp>
#include <arcslip/elements/contact_interval.hpp>
#include <arcslip/elements/series.hpp>

#include <vector>

namespace arcslip::time {

/// A change of the mode at an angle. by: the guard of the mode `from` that fell.
struct ModeChange {
  double theta = 0;  // rad, in [0, 2 pi)
  int from = 0, to = 0;
  const elements::Guard* by = nullptr;
};

/// first: the mode before the first change and after the last one; changes: by ascending angles, those of one
/// instant in their order. Holds addresses of the automaton's guards.
struct Course {
  int first = 0;
  std::vector<ModeChange> changes;
};

/// From the intervals that an element tells (Element::contact()), put in order. Where neighbours have no
/// guard between them, the modes on the shortest way are passed at that instant. False: a state that is no
/// mode.
bool course_of(const elements::Automaton& automaton, const std::vector<elements::ContactInterval>& intervals,
               Course& course);

/// By the guards along the motion q: columns of coefficients, one for each direction. A few periods are
/// followed until the mode and the memory repeat; false: they do not.
bool course_along(const elements::Automaton& automaton, const elements::Harmonics& harmonics,
                  const Eigen::MatrixXd& q, Course& course);

}  // namespace arcslip::time

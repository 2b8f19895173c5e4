#pragma once

#include <arcslip/control/run_control.hpp>

#include <string>
#include <vector>

namespace arcslip::studies {

/// Options for the extent of the results.
struct RunOptions {
  bool points = true;  // false: only events and facts, no rows of points and histories
  // Without points: branches are traced in steps as long as their events allow, where no accuracy is asked of
  // all points.
  bool events_only = false;
  // Of branches of responses: the columns of their points and of their events that are read, with or without
  // "elements"; empty: all. What only others need is not computed, and their columns are not to be written.
  std::vector<std::string> point_columns{}, event_columns{};
  bool coefficients = false;  // points and events with the Fourier coefficients a_n, b_n of the response
  bool motions = false;       // results::End::motion, which keeps the unknowns of points and events
  bool figures = false;
  bool receptance = false;     // a figure of it for each of amplitudes (results::add_receptance)
  control::Control control{};  // at its end the results so far are kept
  // For combinations of for_each, or load cases of one optimum, that are computed at the same time; where
  // there are fewer of these, for the elements of each response. Results are those of one thread. control
  // then reports from several threads, one at a time.
  int threads = 1;
};

}  // namespace arcslip::studies

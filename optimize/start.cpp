#include <arcslip/optimize/start.hpp>

#include <arcslip/optimize/reasons.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::optimize {
namespace {

constexpr double no_influence = 1e-12;  // d ln A / d ln p of less is none

bool is_flat(const Cases& cases, std::size_t c) {
  const PeakState& state = cases.state(c);
  const Peak& highest = state.peaks[state.highest];
  for (std::size_t k = 0; k < state.design.size(); ++k)
    if (std::abs(highest.gradient[static_cast<Eigen::Index>(k)] * state.design[k]) >
        no_influence * highest.amplitude)
      return false;
  const auto point = cases.peaks(c).observe(highest);
  return std::all_of(point.elements.begin(), point.elements.end(),
                     [](const auto& element) { return !element.has_stick || element.slip_angles.empty(); });
}

// Where the cases stand.
Fault fault(Trials& trials) {
  const Cases& cases = trials.cases();
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const PeakState& state = cases.state(c);
    if (state.unbounded) return {reasons::unbounded, trials.where(c) + state.message};
    if (state.peaks.empty())
      return {reasons::no_response, trials.where(c) + "no response was found there: " + state.message};
  }
  for (std::size_t g = 0; g < cases.groups(); ++g)
    if (!is_flat(cases, cases.highest_of(g))) return {};
  return {reasons::flat, "no friction element slips there, so that the amplitude stays as it is"};
}

}  // namespace

Start find_start(Trials& trials, const std::vector<double>& given, std::vector<std::string>& notes) {
  const DesignSpace& space = trials.space();
  Start start;
  for (int attempt = -1; attempt < space.attempts(); ++attempt) {
    start.design = attempt < 0 ? given : space.attempt(attempt);
    trials.evaluate(start.design, attempt >= 0);
    const Fault here = fault(trials);
    if (attempt < 0) start.fault = here;
    if (here.reason.code.empty()) {
      if (attempt >= 0)
        notes.push_back("the start " + space.text(given) + " was moved to " + space.text(start.design) +
                        ": " + start.fault.message);
      start.found = true;
      return start;
    }
    if (!trials.watch().go_on()) break;
  }
  start.design = given;
  return start;
}

}  // namespace arcslip::optimize

#include <arcslip/optimize/search/start.hpp>

#include <arcslip/optimize/certificate/multipliers.hpp>
#include <arcslip/optimize/evaluation/reasons.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::optimize {
namespace {

constexpr double no_sensitivity = 1e-12;  // d ln A / d ln p of less is none
constexpr observables::Observed motion_alone{.estimates = false};

bool is_flat(const LoadCases& cases, std::size_t c) {
  const PeakState& state = cases.state(c);
  const Peak& highest = state.peaks[state.highest];
  for (std::size_t k = 0; k < state.design.size(); ++k)
    if (std::abs(highest.gradient[static_cast<Eigen::Index>(k)] * state.design[k]) >
        no_sensitivity * highest.amplitude)
      return false;
  const auto point = cases.peaks(c).observe(highest, motion_alone);
  return std::all_of(point.elements.begin(), point.elements.end(),
                     [](const auto& element) { return !element.has_stick || element.stick_percent == 100; });
}

// At the current design of the cases.
StartFault fault(DesignEvaluations& designs) {
  const LoadCases& cases = designs.cases();
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const PeakState& state = cases.state(c);
    if (state.unbounded) return {reasons::unbounded, designs.where(c) + state.message};
    if (state.peaks.empty())
      return {reasons::no_response, designs.where(c) + "no response was found there: " + state.message};
  }
  for (std::size_t g = 0; g < cases.groups(); ++g)
    if (!is_flat(cases, cases.highest_of(g))) return {};
  return {reasons::flat, "no friction element slips there, so that the amplitude is constant"};
}

}  // namespace

SearchStart find_start(DesignEvaluations& designs, const std::vector<double>& given,
                       std::vector<std::string>& notes) {
  const DesignSpace& space = designs.space();
  SearchStart start;
  for (int attempt = -1; attempt < space.attempts(); ++attempt) {
    start.design = attempt < 0 ? given : space.attempt(attempt);
    designs.evaluate(start.design, attempt >= 0);
    const StartFault here = fault(designs);
    if (attempt < 0) start.fault = here;
    if (here.reason.code.empty()) {
      if (attempt >= 0)
        notes.push_back("the start " + space.text(given) + " was moved to " + space.text(start.design) +
                        ": " + start.fault.message);
      start.found = true;
      return start;
    }
    if (!designs.control().keep_going()) break;
  }
  start.design = given;
  return start;
}

namespace {

bool moves_highest(const PeakState& state, std::size_t k) {
  return std::any_of(state.peaks.begin(), state.peaks.end(), [&](const Peak& peak) {
    return peak.amplitude >= (1 - as_high) * state.amplitude() &&
           std::abs(peak.gradient[static_cast<Eigen::Index>(k)] * state.design[k]) >
               no_sensitivity * peak.amplitude;
  });
}

// The largest ratio of the force to its limit among the elements that stick at a peak and whose limit depends
// on parameter k.
double closest_to_slip(PeakAmplitude& peaks, const observables::ResponsePoint& point, int parameter) {
  double most = 0;
  const Vector p = peaks.parameters(peaks.state().design);
  for (std::size_t e = 0; e < point.elements.size(); ++e) {
    const auto& part = peaks.problem()->model().elements[e];
    const auto& element = point.elements[e];
    bool limits = false;
    for (const model::Share& share : part.shares)
      limits = limits || (share.number.depends_on(parameter) && part.law->limited_by(share.field));
    if (limits && element.has_stick && element.stick_percent == 100 && element.fundamental.in_phase > 0)
      most = std::max(most, element.fundamental.in_phase / part.law->traits(part.fields(p), 0).limit);
  }
  return most;
}

}  // namespace

std::optional<std::vector<double>> released(const LoadCases& cases, std::span<const int> over,
                                            std::span<const double> lower, double share) {
  std::optional<std::vector<double>> design;
  for (std::size_t k = 0; k < over.size(); ++k) {
    bool moves = false;
    double most = 0;
    for (std::size_t g = 0; g < cases.groups() && !moves; ++g) {
      PeakAmplitude& peaks = cases.peaks(cases.highest_of(g));
      const PeakState& state = peaks.state();
      moves = moves_highest(state, k);
      if (!moves)
        most = std::max(
            most, closest_to_slip(peaks, peaks.observe(state.peaks[state.highest], motion_alone), over[k]));
    }
    if (moves || most == 0) continue;
    const std::vector<double>& at = cases.state(0).design;
    const double value = std::max(lower[k], share * most * at[k]);
    if (!(value < at[k])) continue;
    if (!design) design = at;
    (*design)[k] = value;
  }
  return design;
}

}  // namespace arcslip::optimize

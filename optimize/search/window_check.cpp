#include <arcslip/optimize/search/window_check.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/resonances.hpp>
#include <arcslip/optimize/peaks/peak_unknowns.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace arcslip::optimize {

using observables::FrequencyWindow;
namespace {

constexpr double nearly_highest = 1e-6;      // relative
constexpr std::size_t most_for_corners = 3;  // design parameters whose bounds are combined
constexpr int most_dofs_at_corners = 200;
constexpr double past_mode = 1.1;  // of the outermost natural frequency: the end of a wider window
constexpr double wider = 1.3;      // of its other end, where the amplitude is largest there
constexpr double far_beyond = 10;  // of its end, where no natural frequency is left beyond
constexpr int most_windows = 5;
constexpr int end_digits = 3;       // of the ends of a window
constexpr int reported_digits = 5;  // of other numbers
constexpr double rounding = 1e-9;

/// The best design, and the corners of the bounds: of many parameters the two where all are at the same end,
/// and none of a large structure, whose modes take seconds.
std::vector<std::vector<double>> designs_over_bounds(const DesignSpace& space,
                                                     const std::vector<double>& best) {
  const std::size_t n = best.size();
  std::vector<std::vector<double>> all{best};
  if (space.model()->dofs > most_dofs_at_corners) return all;
  const std::size_t corners = n <= most_for_corners ? std::size_t{1} << n : 2;
  for (std::size_t corner = 0; corner < corners; ++corner) {
    std::vector<double> design(n);
    for (std::size_t k = 0; k < n; ++k) {
      const bool upper = n <= most_for_corners ? (corner >> k & 1U) != 0 : corner == 1;
      design[k] = upper ? space.upper()[k] : space.lower()[k];
    }
    all.push_back(std::move(design));
  }
  return all;
}

/// Where the resonance of a mode may lie, from free to stuck contacts, rad/s; from 0 on where no spring holds
/// it while they are free.
struct Span {
  double lower, upper;
};

struct Spans {
  std::vector<Span> modes;
  bool contacts = false;
};

Spans resonances_over_bounds(DesignEvaluations& designs, std::size_t in_case) {
  const PeakAmplitude& peaks = designs.cases().peaks(in_case);
  Spans spans;
  for (const std::vector<double>& design : designs_over_bounds(designs.space(), designs.best().design)) {
    const auto model = peaks.model_at(design);
    const observables::Resonances found =
        observables::resonances(*model, model::defaults(*model), observables::many_dofs);
    const auto& stuck = found.stuck.empty() ? found.free : found.stuck;
    spans.contacts = spans.contacts || !found.stuck.empty();
    // By number from the highest: what no spring holds is missing below.
    const std::size_t count = std::max({found.free.size(), stuck.size(), spans.modes.size()});
    const auto at = [count](const std::vector<observables::ModeAtRest>& modes, std::size_t j) {
      return j + modes.size() < count ? 0 : modes[j + modes.size() - count].omega;
    };
    spans.modes.insert(spans.modes.begin(), count - spans.modes.size(), Span{HUGE_VAL, 0});
    for (std::size_t j = 0; j < count; ++j) {
      Span& mode = spans.modes[j];
      mode = {std::min(mode.lower, at(found.free, j)), std::max(mode.upper, at(stuck, j))};
    }
  }
  return spans;
}

/// Rounded outwards, but by no digit that is rounding itself.
double rounded(double value, bool up) {
  const double unit = std::pow(10, std::floor(std::log10(value)) + 1 - end_digits), count = value / unit;
  return (up ? std::ceil(count - rounding) : std::floor(count + rounding)) * unit;
}

/// The nearest mode whose resonance may lie beyond that end; null: none.
const Span* nearest_beyond(const FrequencyWindow& window, const std::vector<Span>& spans, bool upper) {
  const Span* nearest = nullptr;
  for (const Span& each : spans) {
    const bool beyond = upper ? each.upper > window.upper : each.lower < window.lower;
    if (!beyond) continue;
    if (!nearest || (upper ? each.upper < nearest->upper : each.lower > nearest->lower)) nearest = &each;
  }
  return nearest;
}

std::string frequency(double omega, scene::FrequencyUnit unit) {
  return observables::to_digits(omega / scene::to_rad_per_s(unit), reported_digits);
}

/// "42.7 to 54.8 Hz", or "42.7 Hz" where both are the same.
std::string between(double lower, double upper, scene::FrequencyUnit unit) {
  const std::string from = frequency(lower, unit), to = frequency(upper, unit);
  return from + (from == to ? "" : " to " + to) + " " + std::string(scene::unit_name(unit));
}

FrequencyWindow widened(const FrequencyWindow& window, bool upper, double factor, double unit) {
  if (upper) return {window.lower, rounded(window.upper * factor / unit, true) * unit};
  return {rounded(window.lower / factor / unit, false) * unit, window.upper};
}

FrequencyWindow window_around(const FrequencyWindow& window, const Span& mode, double unit) {
  const double lower = mode.lower > 0 ? rounded(mode.lower / past_mode / unit, false) * unit : window.lower;
  return {std::min(window.lower, lower),
          std::max(window.upper, rounded(mode.upper * past_mode / unit, true) * unit)};
}

/// The highest peak of a design in a window; nothing where it has no finite one.
std::optional<Peak> highest_in(const PeakAmplitude& peaks, const std::vector<double>& design,
                               const FrequencyWindow& window) {
  PeakAmplitude over(peaks.over_window(window));
  const PeakState& state = over.trace(design, observables::Steps::curve);
  if (state.unbounded || !state.complete || state.peaks.empty()) return {};
  return state.peaks[state.highest];
}

/// "; over the bounds resonances may lie, from free to stuck contacts, at 40.1 to 47 Hz", up to the first one
/// above the window.
std::string text_of(const Spans& spans, const FrequencyWindow& window, scene::FrequencyUnit unit) {
  std::string said;
  for (const Span& each : spans.modes) {
    if (each.upper == 0) continue;
    const std::string beginning =
        spans.contacts ? "; over the bounds resonances may lie, from free to stuck contacts, at "
                       : "; over the bounds natural frequencies lie at ";
    said += said.empty() ? beginning : ", ";
    said += between(each.lower, each.upper, unit);
    if (each.lower > window.upper) break;
  }
  return said;
}

}  // namespace

std::optional<ValueAtEnd> value_at_end(DesignEvaluations& designs) {
  const LoadCases& cases = designs.cases();
  const auto& seen = designs.best().cases;
  const auto height = [&](std::size_t c, double amplitude) { return cases.weight(c) * amplitude; };
  std::vector<double> highest(cases.groups(), 0.0);
  for (std::size_t c = 0; c < seen.size(); ++c) {
    double& most = highest[cases.group(c)];
    most = std::max(most, height(c, seen[c].state.amplitude()));
  }
  for (std::size_t c = 0; c < seen.size(); ++c)
    for (const Peak& peak : seen[c].state.peaks)
      if (is_end(peak.kind) && peak.amplitude > 0 &&
          height(c, peak.amplitude) >= (1 - nearly_highest) * highest[cases.group(c)])
        return ValueAtEnd{c, peak.kind == PeakKind::upper_end, peak.omega()};
  return {};
}

BeyondEnd look_beyond(DesignEvaluations& designs, const ValueAtEnd& value, scene::FrequencyUnit unit) {
  const PeakAmplitude& peaks = designs.cases().peaks(value.in_case);
  const std::vector<double>& design = designs.best().design;
  const double per_unit = scene::to_rad_per_s(unit);
  const Spans spans = resonances_over_bounds(designs, value.in_case);
  BeyondEnd found{true, text_of(spans, peaks.window(), unit)};
  const Span* mode = nearest_beyond(peaks.window(), spans.modes, value.upper);
  bool is_far = !mode;  // the window reaches far beyond that end
  FrequencyWindow window = mode ? window_around(peaks.window(), *mode, per_unit)
                                : widened(peaks.window(), value.upper, far_beyond, per_unit);
  for (int k = 0; k < most_windows; ++k) {
    const auto highest = highest_in(peaks, design, window);
    if (!highest) break;
    const std::string there = observables::to_digits(highest->amplitude, reported_digits) + " m at " +
                              between(highest->omega(), highest->omega(), unit);
    if (!is_end(highest->kind)) {
      found.text += "; from " + between(window.lower, window.upper, unit) + " this design has a peak of " +
                    there + ": take that window";
      return found;
    }
    const bool upper = highest->kind == PeakKind::upper_end;
    if (is_far && upper == value.upper) {
      if (spans.modes.empty()) break;  // natural frequencies are not known
      found.resonance = false;
      found.text += "; this design has no resonance beyond: the amplitude rises on, to " + there;
      return found;
    }
    window = widened(window, upper, upper == value.upper ? far_beyond : wider, per_unit);
    is_far = is_far || upper == value.upper;
  }
  found.text += "; take a window that contains the resonance";
  return found;
}

}  // namespace arcslip::optimize

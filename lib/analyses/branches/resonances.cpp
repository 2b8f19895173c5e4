#include <arcslip/analyses/branches/resonances.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/results/event_kinds.hpp>

#include <algorithm>
#include <cstddef>

namespace arcslip::observables {
namespace {

constexpr int most_shown = 4;  // around a window
constexpr int digits = 5;
constexpr double far_below = 1e-2;  // of the lower end of a window

std::string value_of(const ModeAtRest& mode, scene::FrequencyUnit unit) {
  std::string text = to_digits(mode.omega / scene::to_rad_per_s(unit), digits);
  if (!mode.responds) return text + " (the response is at its node)";
  return mode.driven ? text : text + " (the excitation does not drive it)";
}

using Modes = std::vector<ModeAtRest>;

/// "47, 52.3 and 60.1 Hz", of many the first ones and the last one: "47, 52.3, 60.1 ... 940 Hz"
std::string list(Modes::const_iterator first, Modes::const_iterator last, scene::FrequencyUnit unit,
                 int most = most_shown) {
  const bool all = last - first <= most;
  std::string text;
  for (auto each = first; each != (all ? last : first + most - 1); ++each)
    text += (each == first ? "" : each + 1 == last ? " and " : ", ") + value_of(*each, unit);
  if (!all) text += " ... " + value_of(*(last - 1), unit);
  return text + " " + std::string(scene::unit_name(unit));
}

/// "16.71 Hz below, 47 and 52.3 Hz within, 104.7 Hz above"
std::string around(const Modes& modes, const FrequencyWindow& window, scene::FrequencyUnit unit) {
  const auto below = [](const ModeAtRest& mode, double omega) { return mode.omega < omega; };
  const auto first = std::lower_bound(modes.begin(), modes.end(), window.lower, below);
  const auto last = std::lower_bound(first, modes.end(), window.upper, below);
  std::string text;
  const auto add = [&](auto from, auto to, const char* where) {
    if (from != to) text += (text.empty() ? "" : ", ") + list(from, to, unit) + where;
  };
  add(first == modes.begin() ? first : first - 1, first, " below");
  add(first, last, " within");
  add(last, last == modes.end() ? last : last + 1, " above");
  return text;
}

Modes at_excitation(Modes modes, int harmonic) {
  for (ModeAtRest& mode : modes) mode.omega /= harmonic;
  return modes;
}

bool has_contacts(const model::Model& model) {
  return std::any_of(model.elements.begin(), model.elements.end(),
                     [](const model::NonlinearPart& element) { return is_contact(*element.law); });
}

}  // namespace

Resonances resonances(const model::Model& model, const continuation::Vector& p, int most_dofs) {
  Resonances all;
  all.harmonic = model.force_harmonic;
  const auto free = modes_at_rest(model, p, Contacts::free, most_dofs);
  if (!free) return all;
  all.free = at_excitation(*free, all.harmonic);
  if (has_contacts(model))
    all.stuck = at_excitation(*modes_at_rest(model, p, Contacts::stuck, most_dofs), all.harmonic);
  return all;
}

namespace {

/// reported: the text of some modes.
template <class Reported>
std::string sentence(const Resonances& all, Reported reported) {
  if (all.free.empty() && all.stuck.empty()) return "";
  std::string text = "natural frequencies";
  if (all.harmonic > 1)
    text += " over " + std::to_string(all.harmonic) + " (the lowest harmonic of the excitation)";
  if (all.stuck.empty()) return text + ": " + reported(all.free);
  return text + " with all contacts free: " + (all.free.empty() ? "none" : reported(all.free)) +
         "; stuck: " + reported(all.stuck);
}

}  // namespace

// Of masses and stiffnesses taken for each other the frequencies in rad/s are the reciprocals.
std::string question_of_swapped(const Modes& modes, const FrequencyWindow& window,
                                scene::FrequencyUnit unit) {
  if (modes.empty() || !(modes.back().omega < far_below * window.lower)) return "";
  Modes swapped;
  for (auto each = modes.rbegin(); each != modes.rend(); ++each) swapped.push_back({1 / each->omega});
  const bool plausible = std::any_of(swapped.begin(), swapped.end(), [&](const ModeAtRest& mode) {
    return mode.omega >= window.lower && mode.omega <= window.upper;
  });
  if (!plausible) return "";
  return "are mass and stiffness taken for each other? Then they would be " +
         list(swapped.begin(), swapped.end(), unit);
}

std::string text_of(const Resonances& all, scene::FrequencyUnit unit, int most) {
  return sentence(all, [&](const Modes& modes) { return list(modes.begin(), modes.end(), unit, most); });
}

std::string text_of(const Resonances& all, const FrequencyWindow& window, scene::FrequencyUnit unit) {
  const std::string text = sentence(all, [&](const Modes& modes) { return around(modes, window, unit); });
  const std::string question = all.harmonic > 1 ? "" : question_of_swapped(all.free, window, unit);
  return question.empty() ? text : text + "; " + question;
}

void tell_missing_peak(const model::Model& model, const FrequencyWindow& window, scene::FrequencyUnit unit,
                       std::vector<ResponseBranch>& branches) {
  if (branches.empty()) return;
  branches.front().no_peak.clear();
  const auto is_peak = [](const ResponseEvent& event) { return event.kind == event_kinds::peak; };
  for (const ResponseBranch& branch : branches)
    if (branch.status != Status::complete || branch.points.empty() ||
        std::any_of(branch.events.begin(), branch.events.end(), is_peak))
      return;
  const std::string where = text_of(resonances(model, model::defaults(model)), window, unit);
  branches.front().no_peak = "no peak between " + frequency_text(window.lower, unit) + " and " +
                             frequency_text(window.upper, unit) + (where.empty() ? "" : "; " + where);
}

}  // namespace arcslip::observables

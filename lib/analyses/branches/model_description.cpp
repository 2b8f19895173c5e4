#include <arcslip/analyses/branches/model_description.hpp>

#include <arcslip/analyses/branches/branch_description.hpp>
#include <arcslip/analyses/branches/resonances.hpp>
#include <arcslip/results/text.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace arcslip::observables {
namespace {

using continuation::Vector;
using Modes = std::vector<ModeAtRest>;

constexpr int modes_reported = 10;
constexpr std::size_t masses_reported = 10;
constexpr double hertz = 2 * std::numbers::pi;
constexpr double highest_usual = 1e5 * hertz, lowest_usual = 1e-3 * hertz;  // rad/s
constexpr double no_spring = 1e-12;  // of the largest pivot: nothing holds the structure

/// The direction at the end of a name such as "n12.x", "n12_x" or "n12:ux"; "" if there is none.
std::string direction_of(const std::string& name) {
  const auto mark = name.find_last_of("._:");
  if (mark == std::string::npos) return "";
  std::string end = name.substr(mark + 1);
  if (end.size() == 2 && end.front() == 'u') end.erase(0, 1);
  return end == "x" || end == "y" || end == "z" ? end : "";
}

std::string listed(const std::vector<std::string>& texts) {
  std::string all;
  for (std::size_t i = 0; i < texts.size(); ++i)
    all.append(i == 0 ? "" : i + 1 == texts.size() ? " and " : ", ").append(texts[i]);
  return all;
}

/// Along x, y and z, with all coordinates of a direction moving alike.
std::vector<std::string> masses_by_direction(const model::Model& model, const Eigen::MatrixXd& M) {
  std::map<std::string, Vector> alike;
  for (int i = 0; i < model.dofs; ++i) {
    const std::string direction = i >= model.unnamed_from && i < model.unnamed_to
                                      ? ""
                                      : direction_of(model.dof_names[static_cast<std::size_t>(i)]);
    if (direction.empty()) return {};
    alike.try_emplace(direction, Vector::Zero(model.dofs)).first->second[i] = 1;
  }
  std::vector<std::string> texts;
  for (const auto& [direction, r] : alike)
    texts.push_back(results::readable(r.dot(M * r), "kg") + " along " + direction);
  return texts;
}

std::string masses(const model::Model& model, const Eigen::MatrixXd& M) {
  std::vector<std::string> texts = masses_by_direction(model, M);
  if (!texts.empty()) return "mass: " + listed(texts);
  std::size_t named = 0;
  bool are_equal = true;
  for (int i = 0; i < model.dofs; ++i) {
    if (i >= model.unnamed_from && i < model.unnamed_to) continue;
    const bool turns = model.dof_names[static_cast<std::size_t>(i)].ends_with(".slope");
    are_equal = are_equal && !turns && M(i, i) == M(0, 0);
    if (++named <= masses_reported)
      texts.push_back(results::readable(M(i, i), turns ? "kg m^2" : "kg") + " at " +
                      coordinate_name(model, i));
  }
  if (are_equal && named > 1)
    return "mass of each of the " + std::to_string(named) +
           " coordinates: " + results::readable(M(0, 0), "kg");
  if (named > masses_reported)
    texts.push_back("those of " + std::to_string(named - masses_reported) + " more");
  if (named == 1) return "mass: " + texts.front();
  return texts.empty() ? "" : "mass of each coordinate, where the others are held: " + listed(texts);
}

std::string ratios(const Modes& modes) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < modes.size() && i < modes_reported; ++i)
    texts.push_back(results::to_digits(100 * modes[i].damping_ratio, 3) + " %");
  return texts.empty() ? "none" : listed(texts);
}

std::string damping_ratios(const Resonances& all) {
  if (all.free.empty() && all.stuck.empty()) return "";
  const std::string which = "damping ratios of these modes, without friction";
  if (all.stuck.empty()) return which + ": " + ratios(all.free);
  return which + ", free: " + ratios(all.free) + "; stuck: " + ratios(all.stuck);
}

/// Of the response along its direction under the forces of the lowest harmonic, as if they were constant.
/// Nothing where the structure can move freely.
std::optional<double> deflection(const model::Model& model, const Vector& p, Contacts contacts) {
  const auto K = stiffness_at_rest(model, p, contacts);
  if (!K) return {};
  const Eigen::LDLT<Eigen::MatrixXd> factors(*K);
  const Vector pivots = factors.vectorD();
  if (factors.info() != Eigen::Success || !(pivots.minCoeff() > no_spring * pivots.maxCoeff())) return {};
  std::complex<double> sum = 0;
  for (const model::Excitation& each : model.excitation)
    if (each.harmonic == model.force_harmonic && each.kind == model::Excitation::Kind::force)
      sum += each.amplitude(p) * model.response.dot(factors.solve(model::shape(model, each, p)));
  return std::abs(sum);
}

std::string deflections(const model::Model& model, const Vector& p, bool has_contacts) {
  const bool any = std::any_of(model.excitation.begin(), model.excitation.end(), [&](const auto& each) {
    return each.kind == model::Excitation::Kind::force && each.harmonic == model.force_harmonic;
  });
  if (!any || model.sector) return "";
  const auto reported = [&](Contacts contacts) {
    const auto value = deflection(model, p, contacts);
    return value ? results::readable(*value, "m") : std::string("none, since no spring holds the structure");
  };
  const std::string what = "static deflection of the response under the amplitude of the forces: ";
  if (!has_contacts) return what + reported(Contacts::free);
  return what + reported(Contacts::free) + " with all contacts free, " + reported(Contacts::stuck) + " stuck";
}

std::string hertz_text(double omega) {
  return results::to_digits(omega / hertz, 4) + " Hz";
}

std::string doubt_of_units(const Modes& modes, scene::FrequencyUnit unit) {
  if (modes.empty()) return "";
  if (const std::string swapped = question_of_swapped(modes, {100 * lowest_usual, highest_usual}, unit);
      !swapped.empty())
    return "the highest natural frequency is " + hertz_text(modes.back().omega) + "; " + swapped;
  const std::string what_to_do =
      ", which is rare: check the units. A scene has kg, m, s and N: 1 t = 1000 kg, 1 N/mm = 1000 N/m, and "
      "for a model in t, mm and s both factors are the same";
  if (modes.front().omega > highest_usual)
    return "the lowest natural frequency is " + hertz_text(modes.front().omega) + what_to_do;
  if (modes.back().omega < lowest_usual)
    return "the highest natural frequency is " + hertz_text(modes.back().omega) + what_to_do;
  return "";
}

std::ptrdiff_t count_below(const Modes& modes, double omega) {
  return std::count_if(modes.begin(), modes.end(), [&](const auto& mode) { return mode.omega < omega; });
}

/// Whether a resonance lies in the window with contacts free or stuck, or passes it between both. Modes are
/// counted from below; motions that only contacts hold are the first ones.
bool has_resonance(const Resonances& all, const FrequencyWindow& window) {
  const Modes& stuck = all.stuck.empty() ? all.free : all.stuck;
  const auto held = static_cast<std::ptrdiff_t>(stuck.size()) - static_cast<std::ptrdiff_t>(all.free.size());
  return count_below(all.free, window.upper) + held > count_below(stuck, window.lower);
}

std::string doubt_of_window(const Resonances& all, const WindowOfStudy& of, scene::FrequencyUnit unit) {
  if ((all.free.empty() && all.stuck.empty()) || has_resonance(all, of.window)) return "";
  return "the window of the study \"" + of.study + "\", " + frequency_text(of.window.lower, unit) + " to " +
         frequency_text(of.window.upper, unit) +
         ", has no resonance of small motions: " + text_of(all, of.window, unit) +
         ". Choose another window, or leave it out to have one proposed";
}

}  // namespace

ModelDescription describe_model(const scene::Scene& scene, std::span<const WindowOfStudy> windows,
                                const control::Control& control) {
  const model::Model model = model::build(scene, control);
  const Vector p = model::defaults(model);
  const scene::FrequencyUnit unit = scene.frequency_unit;
  ModelDescription all;
  const auto add = [](std::string text, std::vector<std::string>& to) {
    if (!text.empty()) to.push_back(std::move(text));
  };
  if (model.dofs <= many_dofs) add(masses(model, model::mass_matrix(model, p)), all.facts);
  const Resonances resonant = resonances(model, p, many_dofs);
  add(text_of(resonant, unit, modes_reported), all.facts);
  add(damping_ratios(resonant), all.facts);
  if (!resonant.free.empty() || !resonant.stuck.empty())
    add(deflections(model, p, !resonant.stuck.empty()), all.facts);
  if (resonant.harmonic == 1)
    add(doubt_of_units(resonant.free.empty() ? resonant.stuck : resonant.free, unit), all.doubts);
  for (const WindowOfStudy& of : windows) add(doubt_of_window(resonant, of, unit), all.doubts);
  return all;
}

}  // namespace arcslip::observables

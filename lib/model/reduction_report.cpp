#include <arcslip/model/reduction_report.hpp>

#include <arcslip/control/run_control.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/structure/reduction.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace arcslip::observables {
namespace {

double to_two_digits(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.1e", value);
  return std::strtod(digits, nullptr);
}

// Of the matrices as they are given: up to the first frequency that is not below.
std::optional<scene::ErrorOfReduction> given_error(const scene::Matrices& of, double frequency) {
  if (of.errors.empty()) return {};
  const auto first = std::find_if(of.errors.begin(), of.errors.end(), [&](const auto& each) {
    return frequency > 0 && each.frequency >= frequency;
  });
  return first == of.errors.end() ? of.errors.back() : *first;
}

// With as many modes as up to the highest frequency of the scene. Nothing where rounding leaves none.
std::optional<double> error_of_modes(const scene::Scene& scene, double frequency,
                                     const control::Control& control) {
  scene::Scene lower = scene;
  scene::Reduction& how = lower.matrices->reduction;
  if (how.cutoff == 0) how.cutoff = scene::cutoff_of_highest * scene.matrices->highest_frequency;
  lower.matrices->highest_frequency = frequency;
  try {
    return reduction(lower, control)->error;
  } catch (const scene::SceneError&) {
    return {};
  }
}

const char* coordinates_of(scene::ReductionMethod method) {
  switch (method) {
    case scene::ReductionMethod::krylov:
      return " coordinates";
    case scene::ReductionMethod::craig_bampton:
      return " coordinates of fixed-interface modes";
    case scene::ReductionMethod::rubin:
      return " coordinates of free-interface modes";
  }
  return "";
}

}  // namespace

std::optional<model::Reduction> reduction(const scene::Scene& scene, const control::Control& control) {
  if (!scene.matrices || scene.matrices->highest_frequency == 0) return {};
  try {
    auto found = model::build(scene, control).reduction;
    found->error = to_two_digits(found->error);
    return found;
  } catch (const structure::ReductionError& error) {
    const auto& bar = scene.matrices->bar;
    throw scene::SceneError(std::vector<scene::Fault>{{std::string("/structure/") + (!bar         ? "matrices"
                                                                                     : bar->bends ? "beam"
                                                                                                  : "rod"),
                                                       error.what()}});
  }
}

std::optional<scene::ErrorOfReduction> error_of_reduction(const scene::Scene& scene, double frequency,
                                                          const control::Control& control) {
  if (!scene.matrices) return {};
  const auto given = given_error(*scene.matrices, frequency);
  const auto whole = reduction(scene, control);
  if (!whole) return given;
  const double highest = scene.matrices->highest_frequency;
  scene::ErrorOfReduction found{highest, whole->error};
  const bool by_modes = scene.matrices->reduction.method != scene::ReductionMethod::krylov;
  if (by_modes && frequency > 0 && frequency < highest)
    if (const auto error = error_of_modes(scene, frequency, control)) found = {frequency, *error};
  if (given) found = {std::min(found.frequency, given->frequency), found.error + given->error};
  return found;
}

std::string prepare(const scene::Scene& scene, const control::Control& control) {
  const auto done = reduction(scene, control);
  if (!done) return {};
  // A closed ring is reduced as one.
  const int copies = scene.matrices->faces.empty() ? scene.matrices->copies : 1;
  const auto frequency = [&](double omega) {
    return results::quantity(omega / scene::to_rad_per_s(scene.frequency_unit),
                             scene::unit_name(scene.frequency_unit));
  };
  return "the structure of " + std::to_string(done->rows) + " rows was reduced to " +
         std::to_string(done->kept) + " of them and " + std::to_string(done->coordinates) +
         coordinates_of(scene.matrices->reduction.method) +
         (copies > 1 ? " in each of " + std::to_string(copies) + " copies" : "") +
         "; error of its dynamic stiffness " + results::quantity(done->error, "-") + " up to " +
         frequency(done->highest_frequency) +
         (done->highest_speed > 0 ? " and speeds up to " + results::quantity(done->highest_speed, "rad/s")
                                  : "") +
         (done->free_below > 0 ? "; natural frequencies below " + frequency(to_two_digits(done->free_below)) +
                                     " are not distinguished from 0, that of motions as a rigid body"
                               : "");
}

}  // namespace arcslip::observables

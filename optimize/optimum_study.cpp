#include <arcslip/optimize/optimum_study.hpp>

#include <arcslip/observables/study_branches.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::optimize {
namespace {

constexpr double around[] = {0.5, 1, 2};  // times the optimum: where responses are shown, to four digits

// To four digits, as a label of a figure shows it.
double rounded(double value) {
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 3);
  return value == 0 ? 0
         : unit < 1 ? std::round(value * std::round(1 / unit)) / std::round(1 / unit)
                    : std::round(value / unit) * unit;
}

// The frequency responses there, of the values that the parameters may take.
std::vector<observables::ResponseBranch> responses(const scene::Scene& scene, const scene::Study& study,
                                                   const Optimum& optimum) {
  std::vector<observables::ResponseBranch> all;
  for (const double factor : around) {
    scene::Scene at = scene;
    observables::Setting set;
    try {
      for (std::size_t k = 0; k < study.design.size(); ++k) {
        const double value = rounded(factor * optimum.design[k]);
        scene::set(at, study.design[k].name, value);
        set.emplace_back(study.design[k].name, value);
      }
    } catch (const scene::ParameterError&) {
      continue;  // beyond what the parameter may be
    }
    scene::Study frf;
    frf.from = study.frequency_from;
    frf.to = study.frequency_to;
    for (auto& branch : observables::frequency_response(at, frf)) {
      branch.set = set;
      all.push_back(std::move(branch));
    }
  }
  return all;
}

OptimumOptions options_of(const scene::SearchSettings& search) {
  OptimumOptions options;
  options.algorithm = search.algorithm;
  options.evaluations = search.evaluations;
  options.seconds = search.seconds;
  if (!search.local.empty()) options.local = LocalOptions{search.local, options.tolerances};
  options.population = search.population;
  options.seed = static_cast<unsigned long>(search.seed);
  return options;
}

}  // namespace

double OptimumResult::difference_of_design() const {
  if (!direct.found || optimum.design.size() != 1) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(optimum.design[0] / direct.point.over - 1);
}

double OptimumResult::difference_of_amplitude() const {
  if (!direct.found || optimum.design.size() != 1) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(optimum.amplitude / direct.point.amplitude - 1);
}

std::vector<OptimumResult> optimum_study(const scene::Scene& scene, const scene::Study& study,
                                         const observables::ProgressCallback& progress) {
  const auto all = observables::combinations(study);
  const double unit = scene::to_rad_per_s(scene.frequency_unit);
  std::vector<OptimumResult> results;
  for (std::size_t k = 0; k < all.size(); ++k) {
    scene::Scene with = scene;
    for (const auto& [name, value] : all[k]) scene::set(with, name, value);
    if (!results.empty() && results.back().status == observables::Status::complete)
      for (std::size_t i = 0; i < study.design.size(); ++i)
        scene::set(with, study.design[i].name, results.back().optimum.design[i]);
    OptimumResult result;
    result.set = all[k];
    result.problem = {study.design, study.frequency_from, study.frequency_to, study.constraints,
                      study.linear_constraints};
    OptimumOptions options = options_of(study.search);
    bool go_on = true;
    options.progress = [&](const OptimumProgress& now) {
      observables::Progress told;
      told.branch = static_cast<int>(k);
      told.branches = static_cast<int>(all.size());
      told.points = now.evaluations;
      told.frequency = now.omega / unit;
      go_on = !progress || progress(told);
      return go_on;
    };
    result.optimum = optimum(with, result.problem, options);
    result.status = result.optimum.status;
    result.stop = result.optimum.stop;
    if (go_on && !result.optimum.design.empty()) {
      if (study.design.size() == 1 && study.constraints.empty() && study.linear_constraints.empty())
        result.direct = direct_optimum(with, result.problem);
      if (std::isfinite(result.optimum.amplitude)) result.responses = responses(with, study, result.optimum);
    }
    results.push_back(std::move(result));
    if (!go_on) break;
  }
  return results;
}

}  // namespace arcslip::optimize

#include "study_result.hpp"

#include "optimum_table.hpp"
#include "table.hpp"

#include <arcslip/observables/curves.hpp>
#include <arcslip/observables/time_study.hpp>
#include <arcslip/optimize/optimum_figures.hpp>
#include <arcslip/optimize/optimum_results.hpp>
#include <arcslip/studies/units.hpp>
#include <arcslip/studies/branches.hpp>
#include <arcslip/studies/figures.hpp>
#include <arcslip/studies/motions.hpp>

#include <algorithm>
#include <iterator>
#include <type_traits>
#include <utility>

namespace arcslip::app {
namespace {

using observables::Motion;
using observables::ResponseBranch;
using optimize::OptimumCurveResult;
using optimize::OptimumResult;

const char* noun(const ResponseBranch& /*of*/) {
  return "branch";
}

const char* noun(const Motion& /*of*/) {
  return "motion";
}

const char* noun(const OptimumResult& /*of*/) {
  return "search";
}

const char* noun(const OptimumCurveResult& /*of*/) {
  return "curve";
}

/// What has the status and the stop.
template <class Item>
const Item& end(const Item& item) {
  return item;
}

const optimize::OptimumCurve& end(const OptimumCurveResult& item) {
  return item.curve;
}

/// Of what is complete.
std::string doubt(const ResponseBranch& branch) {
  return branch.doubt;
}

std::string doubt(const OptimumResult& result) {
  const auto doubtful = std::find_if(result.responses.begin(), result.responses.end(),
                                     [](const ResponseBranch& branch) { return !branch.doubt.empty(); });
  return doubtful == result.responses.end() || end(result).status != observables::Status::complete
             ? ""
             : doubtful->doubt;
}

template <class Item>
std::string doubt(const Item& /*item*/) {
  return {};
}

template <class Item>
std::string part_and_status(const scene::Scene& scene, const Item& item, std::size_t index) {
  const std::string set = studies::assignment(scene, item.set);
  return std::string(noun(item)) + " " + std::to_string(index + 1) + (set.empty() ? "" : " (" + set + ")") +
         " " + observables::name(end(item).status);
}

StudyResult computed(const scene::Scene& scene, const scene::Study& study,
                     const observables::ProgressCallback& progress) {
  switch (study.kind) {
    case scene::StudyKind::trace:
      return observables::parameter_response(scene, study, progress);
    case scene::StudyKind::peaks:
      return observables::resonance_peaks(scene, study, progress);
    case scene::StudyKind::folds:
      return observables::fold_curves(scene, study, progress);
    case scene::StudyKind::time:
      return observables::motions_in_time(scene, study, progress);
    case scene::StudyKind::optimum:
      if (study.along) {
        return optimize::optimum_curve_study(scene, study, progress);
      }
      return optimize::optimum_study(scene, study, progress);
    case scene::StudyKind::frf:
      break;
  }
  return observables::frequency_response(scene, study, progress);
}

}  // namespace

StudyResult no_result(const scene::Study& study) {
  switch (study.kind) {
    case scene::StudyKind::frf:
    case scene::StudyKind::trace:
    case scene::StudyKind::peaks:
    case scene::StudyKind::folds:
      break;
    case scene::StudyKind::time:
      return std::vector<Motion>();
    case scene::StudyKind::optimum:
      if (study.along) {
        return std::vector<OptimumCurveResult>();
      }
      return std::vector<OptimumResult>();
  }
  return std::vector<ResponseBranch>();
}

StudyResult compute(const scene::Scene& scene, const scene::Study& study,
                    const observables::ProgressCallback& progress) {
  StudyResult result = computed(scene, study, progress);
  std::visit(
      [&](auto& items) {
        for (auto& item : items) {
          item.study = study.name;
          item.kind = scene::kind_name(study.kind);
        }
      },
      result);
  return result;
}

std::vector<std::string> early_ends(const scene::Scene& scene, const StudyResult& result) {
  std::vector<std::string> sentences;
  const auto add = [&](const auto& items) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (end(items[i]).status != observables::Status::complete) {
        sentences.push_back(part_and_status(scene, items[i], i) + ": " + end(items[i]).stop.message);
      }
    }
  };
  std::visit(add, result);
  return sentences;
}

std::vector<std::string> doubts(const scene::Scene& scene, const StudyResult& result) {
  std::vector<std::string> sentences;
  const auto add = [&](const auto& items) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (const std::string why = doubt(items[i]); !why.empty()) {
        sentences.push_back(part_and_status(scene, items[i], i) +
                            ", but followed in its rounding, which takes digits of what it tells: " + why);
      }
    }
  };
  std::visit(add, result);
  return sentences;
}

void write_table(std::ostream& out, const scene::Scene& scene, const StudyResult& result) {
  std::visit([&](const auto& items) { write_table(out, scene, std::span(items)); }, result);
}

results::Results results_of(const scene::Scene& scene, const StudyResult& result, bool coefficients) {
  return std::visit(
      [&](const auto& items) {
        using Item = typename std::decay_t<decltype(items)>::value_type;
        if constexpr (std::is_same_v<Item, ResponseBranch>)
          return studies::results_of(scene, items, {coefficients});
        else if constexpr (std::is_same_v<Item, Motion>)
          return studies::results_of(scene, items);
        else
          return optimize::results_of(scene, items);
      },
      result);
}

std::vector<results::FigureData> figures_of(const scene::Scene& scene, scene::StudyKind kind,
                                            const StudyResult& result) {
  return std::visit(
      [&](const auto& items) -> std::vector<results::FigureData> {
        using Item = typename std::decay_t<decltype(items)>::value_type;
        if constexpr (std::is_same_v<Item, ResponseBranch>)
          return {studies::figures_of(scene, kind, items)};
        else if constexpr (std::is_same_v<Item, Motion>)
          return {studies::figures_of(scene, items)};
        else if constexpr (std::is_same_v<Item, OptimumCurveResult>)
          return {optimize::figures_of(scene, std::span(items))};
        else
          return optimize::figures_of(scene, std::span(items));
      },
      result);
}

}  // namespace arcslip::app

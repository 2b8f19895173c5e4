#pragma once
// A kind of study from a few functions of its settings S and of the items that it computes (branches,
// motions, optima), and the loop over the combinations of for_each around it.

#include <arcslip/results/progress.hpp>
#include <arcslip/scene/combinations.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/study_keys.hpp>
#include <arcslip/scene/study_type.hpp>
#include <arcslip/studies/units.hpp>

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::studies {

/// One combination of a study's lists.
struct Case {
  const scene::Scene& scene;  // with its values
  bool alone = true;          // there is no other
};

/// What compute(Case, progress) gives for each combination of the lists, each item with what was set for it.
/// After a stop by the callback no further combination is begun.
template <class Item, class Compute>
std::vector<Item> for_each(const scene::Scene& scene, const scene::ValueLists& lists, const Compute& compute,
                           const results::ProgressCallback& progress = {}) {
  const scene::Combinations all(lists);
  std::vector<Item> items;
  bool go_on = true;
  for (std::size_t k = 0; k < all.size() && go_on; ++k) {
    const scene::Setting set = all[k];
    scene::Scene with = scene;
    for (const auto& [name, value] : set) scene::set(with, name, value);
    const results::ProgressCallback tell = [&](results::Progress now) {
      now.branch = static_cast<int>(k);
      now.branches = static_cast<int>(all.size());
      go_on = go_on && (!progress || progress(now));
      return go_on;
    };
    std::vector<Item> found = compute(Case{with, all.size() == 1}, tell);
    for (Item& item : found) {
      item.set = set;
      if constexpr (requires { item.parameters; })
        std::erase_if(item.parameters, [&](const auto& parameter) {
          return std::any_of(set.begin(), set.end(),
                             [&](const auto& each) { return each.first == parameter.first; });
        });
      items.push_back(std::move(item));
    }
  }
  return items;
}

/// All of a study by functions: compute() as for for_each(); results(items) and figures(items).
template <class Item, class Compute, class ResultsOf, class FiguresOf>
scene::Outcome run_items(const scene::Scene& scene, const scene::Study& study,
                         const scene::RunOptions& options, const Compute& compute,
                         const ResultsOf& results_of, const FiguresOf& figures_of) {
  std::vector<Item> items = for_each<Item>(scene, study.for_each, compute, options.progress);
  for (Item& item : items) {
    item.study = study.name;
    item.kind = study.type->name();
  }
  const std::span<const Item> all = items;
  scene::Outcome outcome{results_of(all), {}};
  if (options.figures) outcome.figures = figures_of(all);
  return outcome;
}

/// A kind that computes items of one type.
template <class S, class Item>
struct KindOf {
  std::string_view name, list, help;
  scene::file::KeysOf<S> keys;
  std::vector<Item> (*compute)(const Case& at, const S& settings, const results::ProgressCallback& progress);
  results::Results (*results)(const scene::Scene& scene, std::span<const Item> items,
                              const scene::RunOptions& options);
  std::vector<results::FigureData> (*figures)(const scene::Scene& scene, std::span<const Item> items);
  bool harmonics = true;  // results can hold those of responses
};

template <class S, class Item>
class StudyOf : public scene::file::KeyedStudy<S> {
 public:
  explicit StudyOf(KindOf<S, Item> kind) : scene::file::KeyedStudy<S>(kind.keys), kind_(std::move(kind)) {}
  std::string_view name() const override { return kind_.name; }
  std::string_view help() const override { return kind_.help; }
  std::string_view list(const scene::Settings& /*settings*/) const override { return kind_.list; }
  bool has_harmonics() const override { return kind_.harmonics; }
  scene::Outcome run(const scene::Scene& scene, const scene::Study& study,
                     const scene::RunOptions& options) const override {
    const auto compute = [&](const Case& at, const results::ProgressCallback& progress) {
      return kind_.compute(at, study.settings.as<S>(), progress);
    };
    return run_items<Item>(
        scene, study, options, compute,
        [&](std::span<const Item> items) { return kind_.results(scene, items, options); },
        [&](std::span<const Item> items) { return kind_.figures(scene, items); });
  }

 private:
  KindOf<S, Item> kind_;
};

}  // namespace arcslip::studies

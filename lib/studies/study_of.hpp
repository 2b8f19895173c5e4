#pragma once
// A kind of study defined by a few functions of its settings S and of the items it computes (branches,
// motions, optima), and the loop over the combinations of for_each.

#include <arcslip/results/progress.hpp>
#include <arcslip/scene/combinations.hpp>
#include <arcslip/scene/highest_harmonic.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/study_keys.hpp>
#include <arcslip/scene/study_type.hpp>
#include <arcslip/studies/columns.hpp>
#include <arcslip/studies/described.hpp>
#include <arcslip/studies/order_selection.hpp>
#include <arcslip/studies/units.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace arcslip::studies {

/// One combination of a study's lists.
struct Case {
  const scene::Scene& scene;  // with its values
  bool alone = true;          // it is the only one
};

/// Calls each(item) with the items of compute(Case, progress) for each of the combinations, each item
/// with its set parameters. After a stop by the callback no further combination is started.
template <class Compute, class Each>
void for_each(const scene::Scene& scene, const scene::Combinations& all, const Compute& compute,
              const results::ProgressCallback& progress, const Each& each) {
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
    auto found = compute(Case{with, all.size() == 1}, tell);
    for (auto& item : found) {
      item.set = set;
      if constexpr (requires { item.parameters; })
        std::erase_if(item.parameters, [&](const auto& parameter) {
          return std::any_of(set.begin(), set.end(),
                             [&](const auto& value) { return value.first == parameter.first; });
        });
      each(std::move(item));
    }
  }
}

/// All items together.
template <class Item, class Compute>
std::vector<Item> for_each(const scene::Scene& scene, const scene::Combinations& all, const Compute& compute,
                           const results::ProgressCallback& progress = {}) {
  std::vector<Item> items;
  for_each(scene, all, compute, progress, [&](Item&& item) { items.push_back(std::move(item)); });
  return items;
}

/// Adds the columns of the parameters set by for_each.
inline results::Schema with_set(const scene::Scene& scene, const scene::Study& study,
                                results::Schema schema) {
  NamedValues set;
  for (const auto& [parameter, values] : study.for_each) set.emplace_back(parameter, 0);
  add_columns(scene, set, schema.set);
  return schema;
}

/// What harmonics left out do to the items of a combination. Nothing, also without items, where the accuracy
/// of the results does not depend on the harmonics.
template <class Item>
using TruncationOf = std::function<std::optional<Truncation>(std::span<const Item> items)>;

/// StudyType::run() by functions: compute() as for for_each(), truncation_of(items) where the scene asks for
/// an accuracy, figures(items). Items are kept only if figures are requested.
template <class Item, class Compute, class FiguresOf>
std::vector<results::FigureData> run_items(const scene::Scene& scene, const scene::Study& study,
                                           const scene::RunOptions& options, const Described<Item>& described,
                                           std::size_t schema, results::Sink& sink, const Compute& compute,
                                           const std::type_identity_t<TruncationOf<Item>>& truncation_of,
                                           const FiguresOf& figures_of) {
  std::vector<Item> kept;
  std::optional<OrderSelection> selection;  // of the present combination
  scene::Scene with_order = scene;
  const bool depends = truncation_of && truncation_of(std::span<const Item>());
  const auto compute_accurately = [&](const Case& at, const results::ProgressCallback& progress) {
    if (at.scene.harmonics.accuracy == 0) return compute(at, progress);
    scene::Scene with = at.scene;
    if (!depends) {
      set_order_of_starts(with);
      return compute(Case{with, at.alone}, progress);
    }
    selection.emplace(at.scene);
    for (;;) {
      selection->set_order(with);
      auto items = compute(Case{with, at.alone}, [&](results::Progress now) {
        now.order = with.harmonics.order;
        return !progress || progress(now);
      });
      if (selection->rises(truncation_of(items).value())) continue;
      with_order.harmonics = with.harmonics;
      return items;
    }
  };
  for_each(scene, scene::Combinations(study), compute_accurately, options.progress, [&](Item&& item) {
    item.study = study.name;
    item.kind = study.type->name();
    results::Result result = described.result(item);
    if (selection) selection->tell(result.end);
    const std::string beyond = scene::beyond_reduction(with_order, study);
    if (!beyond.empty()) result.end.doubt += (result.end.doubt.empty() ? "" : "; ") + beyond;
    results::hand(result, schema, sink);
    if (options.figures) kept.push_back(std::move(item));
  });
  return options.figures ? figures_of(std::span<const Item>(kept)) : std::vector<results::FigureData>();
}

/// A kind of study with items of one type.
template <class S, class Item>
struct KindOf {
  std::string_view name, help;
  scene::file::KeysOf<S> keys;
  std::vector<Item> (*compute)(const Case& at, const S& settings, const results::ProgressCallback& progress);
  Described<Item> (*results)(const scene::Scene& scene, const S& settings, const scene::RunOptions& options);
  std::vector<results::FigureData> (*figures)(const scene::Scene& scene, std::span<const Item> items);
  bool coefficients = true;  // whether the option of that name changes the results
  std::optional<Truncation> (*truncation)(const S& settings, std::span<const Item> items) = nullptr;
};

template <class S, class Item>
class StudyOf : public scene::file::KeyedStudy<S> {
 public:
  explicit StudyOf(KindOf<S, Item> kind) : scene::file::KeyedStudy<S>(kind.keys), kind_(std::move(kind)) {}
  std::string_view name() const override { return kind_.name; }
  std::string_view help() const override { return kind_.help; }
  bool takes_coefficients() const override { return kind_.coefficients; }
  results::Schema schema(const scene::Scene& scene, const scene::Study& study,
                         const scene::RunOptions& options) const override {
    return with_set(scene, study, kind_.results(scene, study.settings.as<S>(), options).schema);
  }
  std::vector<results::FigureData> run(const scene::Scene& scene, const scene::Study& study,
                                       const scene::RunOptions& options, std::size_t schema,
                                       results::Sink& sink) const override {
    const S& settings = study.settings.as<S>();
    return run_items(
        scene, study, options, kind_.results(scene, settings, options), schema, sink,
        [&](const Case& at, const results::ProgressCallback& progress) {
          return kind_.compute(at, settings, progress);
        },
        kind_.truncation == nullptr
            ? TruncationOf<Item>()
            : [&](std::span<const Item> items) { return kind_.truncation(settings, items); },
        [&](std::span<const Item> items) { return kind_.figures(scene, items); });
  }

 private:
  KindOf<S, Item> kind_;
};

}  // namespace arcslip::studies

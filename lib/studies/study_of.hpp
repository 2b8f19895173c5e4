#pragma once
// A kind of study defined by a few functions of its settings S and of the items it computes (branches,
// motions, optima).

#include <arcslip/scene/keys/study_keys.hpp>
#include <arcslip/studies/computation.hpp>
#include <arcslip/studies/presentation/columns.hpp>
#include <arcslip/studies/presentation/result_description.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace arcslip::studies {

inline constexpr int most_steps = 10'000'000;     // per period, and of a history in all
inline constexpr int most_periods = 100'000'000;  // of a transient

template <class Item>
struct ItemsOf final : Items {
  explicit ItemsOf(std::vector<Item> items) : all(std::move(items)) {}
  std::size_t size() const override { return all.size(); }
  void put_set(std::size_t i, const scene::Setting& set) override {
    Item& item = all[i];
    item.set = set;
    if constexpr (requires { item.parameters; })
      std::erase_if(item.parameters, [&](const auto& parameter) {
        return std::any_of(set.begin(), set.end(),
                           [&](const auto& value) { return value.first == parameter.first; });
      });
  }
  void put_study(std::size_t i, const scene::Study& study) override {
    all[i].study = study.name;
    all[i].kind = study.type->name();
  }
  std::vector<Item> all;
};

template <class Item>
std::vector<Item> joined(const std::vector<std::unique_ptr<Items>>& of) {
  std::vector<Item> items;
  for (const auto& some : of) {
    auto& more = static_cast<ItemsOf<Item>&>(*some).all;
    std::move(more.begin(), more.end(), std::back_inserter(items));
  }
  return items;
}

/// The items of all combinations together, in one thread; compute(at, progress) gives those of one.
template <class Item, class Compute>
std::vector<Item> for_each(const scene::Scene& scene, const scene::Combinations& all, const Compute& compute,
                           const results::ProgressCallback& progress = {}) {
  return joined<Item>(items_of_each(
      scene, all,
      [&](const Case& at, const results::ProgressCallback& tell) {
        return std::make_unique<ItemsOf<Item>>(compute(at, tell));
      },
      progress));
}

/// Adds the columns of the parameters set by for_each.
inline results::Schema with_set(const scene::Scene& scene, const scene::Study& study,
                                results::Schema schema) {
  NamedValues set;
  for (const auto& [parameter, values] : study.for_each) set.emplace_back(parameter, 0);
  add_columns(scene, set, schema.set);
  return schema;
}

/// Items of more harmonics, where only parts of them had to be computed anew.
template <class Item>
struct Refined {
  std::vector<Item> items;
  double change = 0;  // Truncation::change
};

/// A Computation by functions of its items. Without truncation() the accuracy of the results does not depend
/// on the harmonics; without refine() each order is computed anew.
template <class Item>
class ComputationOf final : public Computation {
 public:
  using All = std::span<const Item>;
  using Progress = results::ProgressCallback;

  Described<Item> described;
  std::function<std::vector<Item>(const Case& at, const Progress& progress)> compute_items;
  std::function<std::vector<results::FigureData>(All items)> figures_of_items;
  std::function<Truncation(All items)> truncation_of_items{};
  std::function<std::optional<Refined<Item>>(const Case& at, All coarse, double accuracy,
                                             const Progress& progress)>
      refine_items{};

  ComputationOf(Described<Item> results, decltype(compute_items) compute, decltype(figures_of_items) figures)
      : described(std::move(results)),
        compute_items(std::move(compute)),
        figures_of_items(std::move(figures)) {}

  std::unique_ptr<Items> compute(const Case& at, const Progress& progress) const override {
    return std::make_unique<ItemsOf<Item>>(compute_items(at, progress));
  }
  bool has_truncation() const override { return truncation_of_items != nullptr; }
  Truncation truncation(const Items& items) const override { return truncation_of_items(all(items)); }
  std::optional<RefinedItems> refine(const Case& at, const Items& coarse, double accuracy,
                                     const Progress& progress) const override {
    if (!refine_items) return {};
    auto refined = refine_items(at, all(coarse), accuracy, progress);
    if (!refined) return {};
    return RefinedItems{std::make_unique<ItemsOf<Item>>(std::move(refined->items)), refined->change};
  }
  results::Result result(const Items& items, std::size_t i) const override {
    return described.result(all(items)[i]);
  }
  std::vector<results::FigureData> figures(std::vector<std::unique_ptr<Items>> of) const override {
    return figures_of_items(joined<Item>(of));
  }

 private:
  static All all(const Items& items) { return static_cast<const ItemsOf<Item>&>(items).all; }
};

/// A kind of study with items of one type.
template <class S, class Item>
struct KindOf {
  std::string_view name, help;
  scene::file::KeysOf<S> keys;
  std::vector<Item> (*compute)(const Case& at, const S& settings, const results::ProgressCallback& progress);
  Described<Item> (*results)(const scene::Scene& scene, const S& settings, const scene::RunOptions& options);
  std::vector<results::FigureData> (*figures)(const scene::Scene& scene, std::span<const Item> items);
  bool coefficients = true;  // whether the option of that name changes the results
  bool timed = false;        // its results are times: one combination after the other
  // Nothing, also without items, where the accuracy of the results does not depend on the harmonics.
  std::optional<Truncation> (*truncation)(const S& settings, std::span<const Item> items) = nullptr;
  std::optional<Refined<Item>> (*refine)(const Case& at, const S& settings, std::span<const Item> coarse,
                                         double accuracy,
                                         const results::ProgressCallback& progress) = nullptr;
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
    using All = std::span<const Item>;
    using Progress = results::ProgressCallback;
    const S& settings = study.settings.as<S>();
    scene::RunOptions how = options;
    if (kind_.timed) how.threads = 1;
    ComputationOf<Item> of(
        kind_.results(scene, settings, options),
        [&](const Case& at, const Progress& progress) { return kind_.compute(at, settings, progress); },
        [&](All items) { return kind_.figures(scene, items); });
    if (kind_.truncation && kind_.truncation(settings, {}))
      of.truncation_of_items = [&](All items) { return kind_.truncation(settings, items).value(); };
    if (kind_.refine)
      of.refine_items = [&](const Case& at, All coarse, double accuracy, const Progress& progress) {
        return kind_.refine(at, settings, coarse, accuracy, progress);
      };
    return run_computation(scene, study, how, schema, sink, of);
  }

 private:
  KindOf<S, Item> kind_;
};

}  // namespace arcslip::studies

#pragma once
// A kind of study: its keys (scene/study_type.hpp), and its computation, which a few functions of the items
// that it computes define (branches, motions, optima).

#include <arcslip/control/run_control.hpp>
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

/// The items of all combinations together, in one thread; compute(at, control) gives those of one.
template <class Item, class Compute>
std::vector<Item> for_each(const scene::Scene& scene, const scene::Combinations& all, const Compute& compute,
                           const control::Control& control = {}) {
  return joined<Item>(items_of_each(
      scene, all,
      [&](const Case& at, const control::Control& of_case) {
        return std::make_unique<ItemsOf<Item>>(compute(at, of_case));
      },
      control));
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

  Described<Item> described;
  std::function<std::vector<Item>(const Case& at, const control::Control& control)> compute_items;
  std::function<std::vector<results::FigureData>(All items)> figures_of_items;
  std::function<Truncation(All items)> truncation_of_items{};
  std::function<std::optional<Refined<Item>>(const Case& at, All coarse, double accuracy,
                                             const control::Control& control)>
      refine_items{};

  ComputationOf(Described<Item> results, decltype(compute_items) compute, decltype(figures_of_items) figures)
      : described(std::move(results)),
        compute_items(std::move(compute)),
        figures_of_items(std::move(figures)) {}

  std::unique_ptr<Items> compute(const Case& at, const control::Control& control) const override {
    return std::make_unique<ItemsOf<Item>>(compute_items(at, control));
  }
  const results::Schema& schema() const override { return described.schema; }
  bool has_truncation() const override { return truncation_of_items != nullptr; }
  Truncation truncation(const Items& items) const override { return truncation_of_items(all(items)); }
  std::optional<RefinedItems> refine(const Case& at, const Items& coarse, double accuracy,
                                     const control::Control& control) const override {
    if (!refine_items) return {};
    auto refined = refine_items(at, all(coarse), accuracy, control);
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

/// A kind of study with what it computes.
///
///   static const StudyKind kind({.name = "sweep", .help = "..."}, keys_of_sweep(), sweeps);
class StudyKind : public scene::StudyType {
 public:
  struct Description {
    std::string_view name, help;
    std::string_view verb{};   // of the command; empty: the name
    bool coefficients = true;  // whether the option of that name changes the results
    bool timed = false;        // its results are times: one combination after the other
  };

  /// compute: the computation of a study with settings S, which may refer to its arguments.
  template <class S>
  StudyKind(const Description& of, scene::file::KeysOf<S> keys,
            std::unique_ptr<Computation> (*compute)(const scene::Scene& scene, const S& settings,
                                                    const RunOptions& options))
      : StudyType(of.name, of.verb, of.help, std::make_shared<const scene::file::KeysOf<S>>(std::move(keys))),
        coefficients_(of.coefficients),
        timed_(of.timed),
        compute_([compute](const scene::Scene& scene, const scene::Study& study, const RunOptions& options) {
          return compute(scene, study.settings.as<S>(), options);
        }) {}

  bool takes_coefficients() const { return coefficients_; }
  /// The structure of all results of the study.
  results::Schema schema(const scene::Scene& scene, const scene::Study& study,
                         const RunOptions& options) const;
  /// What the study computes, of one combination at a time. Refers to the scene and the study.
  std::unique_ptr<Computation> computation(const scene::Scene& scene, const scene::Study& study,
                                           const RunOptions& options) const {
    return compute_(scene, study, options);
  }
  /// Passes the results to the sink as they are computed, with the index of their schema in the sink: one
  /// after the other for each combination of the study's for_each lists, each independent of the others.
  /// Returns the requested figures, each with a unique name; a figure may be empty.
  std::vector<results::FigureData> run(const scene::Scene& scene, const scene::Study& study,
                                       const RunOptions& options, std::size_t schema,
                                       results::Sink& sink) const;

 private:
  bool coefficients_, timed_;
  std::function<std::unique_ptr<Computation>(const scene::Scene&, const scene::Study&, const RunOptions&)>
      compute_;
};

/// Returns the kind with these keys. Throws std::invalid_argument if there are only the keys.
const StudyKind& kind_of(const scene::StudyType& type);

}  // namespace arcslip::studies

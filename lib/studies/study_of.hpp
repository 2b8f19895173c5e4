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
#include <arcslip/studies/in_order.hpp>
#include <arcslip/studies/order_selection.hpp>
#include <arcslip/studies/units.hpp>

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace arcslip::studies {

inline constexpr int most_steps = 10'000'000;     // per period, and of a history in all
inline constexpr int most_periods = 100'000'000;  // of a transient

/// One combination of a study's lists.
struct Case {
  const scene::Scene& scene;  // with its values
  bool alone = true;          // it is the only one
};

/// Calls take(computed, set) with the result of compute(Case, progress) for each of the combinations, in
/// their order and in this thread, with the parameters set; up to `threads` of them are computed at the same
/// time, with the threads that are left for their elements. After a stop by the callback no further
/// combination is started. progress is called by one thread at a time, and told of the first combination that
/// is being computed.
template <class Compute, class Take>
void for_each(const scene::Scene& scene, const scene::Combinations& all, int threads, const Compute& compute,
              const results::ProgressCallback& progress, const Take& take) {
  std::atomic<bool> goes_on = true;
  std::mutex telling;
  std::map<std::size_t, results::Progress> last;  // report of each that is not computed to its end
  std::size_t first = 0;                          // of them; all before it are computed
  std::set<std::size_t> ended;                    // after it
  const auto make = [&](std::size_t k) {
    scene::Setting set = all[k];
    scene::Scene with = scene;
    with.threads.count = threads_for_each(threads, all.size());
    for (const auto& [name, value] : set) scene::set(with, name, value);
    auto computed = compute(Case{with, all.size() == 1}, [&](results::Progress now) {
      const std::lock_guard lock(telling);
      last[k] = now;
      results::Progress& of_first = last[first];  // also before its own first report
      of_first.branch = static_cast<int>(first);
      of_first.branches = static_cast<int>(all.size());
      if (progress && !progress(of_first)) goes_on = false;
      return goes_on.load();
    });
    const std::lock_guard lock(telling);
    last.erase(k);
    ended.insert(k);
    while (ended.erase(first) == 1) ++first;
    return std::pair(std::move(computed), std::move(set));
  };
  in_order(all.size(), threads, goes_on, make,
           [&](auto&& made) { take(std::move(made.first), made.second); });
}

/// Tells the item which parameters are set, which it then does not list among its own.
template <class Item>
void put_set(const scene::Setting& set, Item& item) {
  item.set = set;
  if constexpr (requires { item.parameters; })
    std::erase_if(item.parameters, [&](const auto& parameter) {
      return std::any_of(set.begin(), set.end(),
                         [&](const auto& value) { return value.first == parameter.first; });
    });
}

/// All items together, in one thread; compute() gives those of a combination.
template <class Item, class Compute>
std::vector<Item> for_each(const scene::Scene& scene, const scene::Combinations& all, const Compute& compute,
                           const results::ProgressCallback& progress = {}) {
  std::vector<Item> items;
  for_each(scene, all, 1, compute, progress, [&](auto&& computed, const scene::Setting& set) {
    for (Item& item : computed) {
      put_set(set, item);
      items.push_back(std::move(item));
    }
  });
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

/// Items of more harmonics, where only parts of them had to be computed anew.
template <class Item>
struct Refined {
  std::vector<Item> items;
  double change = 0;  // Truncation::change
};

/// From the items of fewer harmonics, those of the scene of a case; nothing: compute() has to do it.
template <class Item>
using Refine =
    std::function<std::optional<Refined<Item>>(const Case& at, std::span<const Item> coarse, double accuracy,
                                               const results::ProgressCallback& progress)>;

/// StudyType::run() by functions: compute() of one combination, which other threads may call as well,
/// truncation_of(items) and refine() where the scene asks for an accuracy, figures(items). Items are kept
/// only if figures are requested.
template <class Item, class Compute, class FiguresOf>
std::vector<results::FigureData> run_items(const scene::Scene& scene, const scene::Study& study,
                                           const scene::RunOptions& options, const Described<Item>& described,
                                           std::size_t schema, results::Sink& sink, const Compute& compute,
                                           const std::type_identity_t<TruncationOf<Item>>& truncation_of,
                                           const FiguresOf& figures_of,
                                           const std::type_identity_t<Refine<Item>>& refine = {}) {
  struct Computed {
    std::vector<Item> items;
    std::optional<OrderSelection> selection;
    scene::Harmonics harmonics;
  };
  const bool depends = truncation_of && truncation_of(std::span<const Item>());
  const auto compute_accurately = [&](const Case& at, const results::ProgressCallback& progress) -> Computed {
    if (at.scene.harmonics.accuracy == 0) return {compute(at, progress), {}, at.scene.harmonics};
    scene::Scene with = at.scene;
    if (!depends) {
      set_order_of_starts(with);
      return {compute(Case{with, at.alone}, progress), {}, at.scene.harmonics};
    }
    Computed found{{}, OrderSelection(at.scene), {}};
    for (bool first = true;; first = false) {
      found.selection->set_order(with);
      bool goes_on = true;
      const auto tell = [&](results::Progress now) {
        now.order = with.harmonics.order;
        goes_on = !progress || progress(now);
        return goes_on;
      };
      const Case higher{with, at.alone};
      std::optional<Refined<Item>> refined;
      if (refine && !first) refined = refine(higher, found.items, at.scene.harmonics.accuracy, tell);
      std::vector<Item> items;
      if (refined)
        items = std::move(refined->items);
      else if (goes_on)
        items = compute(higher, tell);
      if (!goes_on && !first) {
        found.selection->give_up();
        return found;
      }
      found.items = std::move(items);
      found.harmonics = with.harmonics;
      Truncation truncation = truncation_of(found.items).value();
      if (refined) truncation.change = refined->change;
      if (!found.selection->rises(truncation)) return found;
    }
  };
  std::vector<Item> kept;
  scene::Scene with_order = scene;
  for_each(scene, scene::Combinations(study), options.threads, compute_accurately, options.progress,
           [&](Computed&& computed, const scene::Setting& set) {
             with_order.harmonics = computed.harmonics;
             const std::string beyond = scene::beyond_reduction(with_order, study);
             for (Item& item : computed.items) {
               put_set(set, item);
               item.study = study.name;
               item.kind = study.type->name();
               results::Result result = described.result(item);
               if (computed.selection) computed.selection->tell(result.end);
               if (!beyond.empty()) result.end.doubt += (result.end.doubt.empty() ? "" : "; ") + beyond;
               results::hand(result, schema, sink);
               if (options.figures) kept.push_back(std::move(item));
             }
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
  bool timed = false;        // its results are times: one combination after the other
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
    const S& settings = study.settings.as<S>();
    scene::RunOptions how = options;
    if (kind_.timed) how.threads = 1;
    return run_items(
        scene, study, how, kind_.results(scene, settings, options), schema, sink,
        [&](const Case& at, const results::ProgressCallback& progress) {
          return kind_.compute(at, settings, progress);
        },
        kind_.truncation == nullptr
            ? TruncationOf<Item>()
            : [&](std::span<const Item> items) { return kind_.truncation(settings, items); },
        [&](std::span<const Item> items) { return kind_.figures(scene, items); },
        kind_.refine == nullptr
            ? Refine<Item>()
            : [&](const Case& at, std::span<const Item> coarse, double accuracy,
                  const results::ProgressCallback&
                      progress) { return kind_.refine(at, settings, coarse, accuracy, progress); });
  }

 private:
  KindOf<S, Item> kind_;
};

}  // namespace arcslip::studies

#include <arcslip/studies/computation.hpp>

#include <arcslip/control/ordered_parallel_for.hpp>
#include <arcslip/studies/highest_harmonic.hpp>
#include <arcslip/studies/presentation/columns.hpp>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>

namespace arcslip::studies {
namespace {

/// The first combination that is being computed, and how far it is.
class FirstOfSeveral {
 public:
  FirstOfSeveral(std::size_t count, const control::Control& control) : count_(count), control_(control) {}

  void report(std::size_t k, const control::Progress& now) {
    const std::lock_guard lock(mutex_);
    last_[k] = now;
    control::Progress& of_first = last_[first_];  // also before its own first report
    of_first.branch = static_cast<int>(first_);
    of_first.branches = static_cast<int>(count_);
    control_.report(of_first);
  }

  void end(std::size_t k) {
    const std::lock_guard lock(mutex_);
    last_.erase(k);
    ended_.insert(k);
    while (ended_.erase(first_) == 1) ++first_;
  }

 private:
  std::size_t count_;
  const control::Control& control_;
  std::mutex mutex_;
  std::map<std::size_t, control::Progress> last_;  // report of each that is not computed to its end
  std::size_t first_ = 0;                          // of them; all before it are computed
  std::set<std::size_t> ended_;                    // after it
};

struct Computed {
  std::unique_ptr<Items> items;
  std::optional<OrderSelection> selection;
  scene::Harmonics harmonics;
};

/// With rising orders until one has the accuracy.
void compute_by_orders(const Computation& of, const Case& at, const control::Control& control,
                       Computed& found) {
  scene::Scene with = at.scene;
  OrderSelection& selection = found.selection.emplace(at.scene);
  const auto report = [&](control::Progress now) {
    now.order = with.harmonics.order;
    control.report(now);
  };
  const control::Control of_order = control.child({.report = report});
  for (bool first = true;; first = false) {
    selection.set_order(with);
    const Case higher{with, at.alone};
    std::optional<RefinedItems> refined;
    if (!first) refined = of.refine(higher, *found.items, at.scene.harmonics.accuracy, of_order);
    std::unique_ptr<Items> items;
    if (refined)
      items = std::move(refined->items);
    else if (first || of_order.keep_going())
      items = of.compute(higher, of_order);
    if (!first && of_order.ending().reason != control::EndReason::none) {
      selection.give_up();
      return;
    }
    found.items = std::move(items);
    found.harmonics = with.harmonics;
    Truncation truncation = of.truncation(*found.items);
    if (refined) truncation.change = refined->change;
    if (!selection.rises(truncation)) return;
  }
}

Computed compute(const Computation& of, const Case& at, const control::Control& control) {
  Computed found{{}, {}, at.scene.harmonics};
  if (at.scene.harmonics.accuracy == 0) {
    found.items = of.compute(at, control);
  } else if (!of.has_truncation()) {
    scene::Scene with = at.scene;
    set_order_of_starts(with);
    found.items = of.compute({with, at.alone}, control);
  } else {
    compute_by_orders(of, at, control, found);
  }
  return found;
}

using Compute = std::function<Computed(const Case& at, const control::Control& control)>;
/// Returns false where a result says that it was stopped.
using Take = std::function<bool(Computed computed)>;

/// Computes one combination with its values set.
Computed compute_at(const scene::Scene& scene, const scene::Setting& set, int threads, bool alone,
                    const Compute& compute_one, const control::Control& control) {
  scene::Scene with = scene;
  with.threads.count = threads;
  for (const auto& [name, value] : set) scene::set(with, name, value);
  Computed computed = compute_one({with, alone}, control);
  for (std::size_t i = 0; i < computed.items->size(); ++i) computed.items->put_set(i, set);
  return computed;
}

/// Returns the results of the items of one combination. with_order: the scene, whose harmonics become those
/// of the items.
std::vector<results::Result> results_of(const Computation& computation, Computed& computed,
                                        const scene::Study& study, scene::Scene& with_order) {
  with_order.harmonics = computed.harmonics;
  const std::string beyond = scene::beyond_reduction(with_order, study),
                    rough = doubt_of_reduction(with_order, scene::highest_harmonic(with_order, study));
  std::vector<results::Result> all;
  for (std::size_t i = 0; i < computed.items->size(); ++i) {
    computed.items->put_study(i, study);
    results::Result& result = all.emplace_back(computation.result(*computed.items, i));
    if (computed.selection) computed.selection->tell(result.end);
    for (const std::string& doubt : {beyond, rough})
      if (!doubt.empty()) result.end.doubt += (result.end.doubt.empty() ? "" : "; ") + doubt;
  }
  return all;
}

void for_each_combination(const scene::Scene& scene, const scene::Combinations& all, int threads,
                          const Compute& compute_one, const control::Control& control, const Take& take) {
  FirstOfSeveral first(all.size(), control);
  const control::Control of_all = control.child();
  const auto make = [&](std::size_t k) {
    const auto report = [&, k](const control::Progress& now) { first.report(k, now); };
    Computed computed = compute_at(scene, all[k], control::threads_for_each(threads, all.size()),
                                   all.size() == 1, compute_one, of_all.child({.report = report}));
    first.end(k);
    return computed;
  };
  std::size_t taken = 0;
  bool whole = true;
  control::in_order(all.size(), threads, of_all, make, [&](Computed computed) {
    ++taken;
    whole = take(std::move(computed));
  });
  // A stop that is heard at the last point of a combination leaves it complete: the next one then says that
  // it was stopped.
  if (whole && taken < all.size()) take(make(taken));
}

}  // namespace

std::vector<std::unique_ptr<Items>> items_of_each(
    const scene::Scene& scene, const scene::Combinations& all,
    const std::function<std::unique_ptr<Items>(const Case&, const control::Control&)>& compute,
    const control::Control& control) {
  std::vector<std::unique_ptr<Items>> items;
  for_each_combination(
      scene, all, 1,
      [&](const Case& at, const control::Control& of_case) { return Computed{compute(at, of_case), {}, {}}; },
      control,
      [&](Computed computed) {
        items.push_back(std::move(computed.items));
        return false;
      });
  return items;
}

std::vector<results::Result> results_at(const scene::Scene& scene, const scene::Study& study,
                                        const Computation& computation, const scene::Setting& set,
                                        const control::Control& control) {
  Computed computed = compute_at(
      scene, set, 1, false,
      [&](const Case& at, const control::Control& of_case) { return compute(computation, at, of_case); },
      control);
  scene::Scene with_order = scene;
  return results_of(computation, computed, study, with_order);
}

std::vector<results::FigureData> run_computation(const scene::Scene& scene, const scene::Study& study,
                                                 const RunOptions& options, std::size_t schema,
                                                 results::Sink& sink, const Computation& computation) {
  std::vector<std::unique_ptr<Items>> kept;
  int taken = 0;
  scene::Scene with_order = scene;
  const auto take = [&](Computed computed) {
    bool whole = true;
    for (const results::Result& result : results_of(computation, computed, study, with_order)) {
      whole = whole && result.end.status != results::Status::stopped;
      results::hand(result, schema, sink);
    }
    if (++taken > scene::most_drawn)
      kept.clear();
    else if (options.figures)
      kept.push_back(std::move(computed.items));
    return whole;
  };
  for_each_combination(
      scene, scene::Combinations(study), options.threads,
      [&](const Case& at, const control::Control& of_case) { return compute(computation, at, of_case); },
      options.control, take);
  if (!options.figures || taken > scene::most_drawn) return {};
  std::vector<results::FigureData> figures = computation.figures(std::move(kept));
  if (options.receptance) std::for_each(figures.begin(), figures.end(), results::add_receptance);
  return figures;
}

}  // namespace arcslip::studies

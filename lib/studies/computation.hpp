#pragma once
// A study over the combinations of its for_each lists, and over the orders of the harmonics of each.

#include <arcslip/control/run_control.hpp>
#include <arcslip/results/figure_data.hpp>
#include <arcslip/results/result.hpp>
#include <arcslip/scene/combinations.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/order_selection.hpp>
#include <arcslip/studies/presentation/run_options.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace arcslip::studies {

/// One combination of a study's lists.
struct Case {
  const scene::Scene& scene;  // with its values
  bool alone = true;          // it is the only one
};

/// What a study computes for one combination: branches, motions or optima, of a type that only the study
/// knows.
class Items {
 public:
  virtual ~Items() = default;
  virtual std::size_t size() const = 0;
  /// Reports item i which parameters are set, which it then does not list among its own.
  virtual void put_set(std::size_t i, const scene::Setting& set) = 0;
  /// Reports item i of which study it is.
  virtual void put_study(std::size_t i, const scene::Study& study) = 0;
};

/// Items of more harmonics, where only parts of them had to be computed anew.
struct RefinedItems {
  std::unique_ptr<Items> items;
  double change = 0;  // Truncation::change
};

/// A study of a scene, with its settings. Items that are passed are those of its own compute() or refine().
class Computation {
 public:
  virtual ~Computation() = default;
  /// Of one combination. Several threads may call it at the same time.
  virtual std::unique_ptr<Items> compute(const Case& at, const control::Control& control) const = 0;
  /// The structure of the results, without the parameters that are set.
  virtual const results::Schema& schema() const = 0;
  /// Whether the accuracy of the results depends on the harmonics.
  virtual bool has_truncation() const = 0;
  /// What harmonics left out do to the items of a combination, where has_truncation().
  virtual Truncation truncation(const Items& items) const = 0;
  /// From the items of fewer harmonics, those of the scene of a case; nothing: compute() has to do it.
  virtual std::optional<RefinedItems> refine(const Case& at, const Items& coarse, double accuracy,
                                             const control::Control& control) const = 0;
  virtual results::Result result(const Items& items, std::size_t i) const = 0;
  /// Of the items of all combinations.
  virtual std::vector<results::FigureData> figures(std::vector<std::unique_ptr<Items>> all) const = 0;
};

/// The items of one combination after the other, with the parameters set. After the end of `control` no
/// further combination is started.
std::vector<std::unique_ptr<Items>> items_of_each(
    const scene::Scene& scene, const scene::Combinations& all,
    const std::function<std::unique_ptr<Items>(const Case&, const control::Control&)>& compute,
    const control::Control& control);

/// The results of one combination, in the order of its items, in one thread. set: its values. Several threads
/// may share the computation. Throws scene::ParameterError for a value out of bounds.
std::vector<results::Result> results_at(const scene::Scene& scene, const scene::Study& study,
                                        const Computation& computation, const scene::Setting& set,
                                        const control::Control& control);

/// StudyKind::run(): up to options.threads combinations are computed at the same time, with the threads that
/// are left for their elements, and results are handed to the sink in the order of the combinations, by this
/// thread. After the end of options.control no further combination is started, unless all that were are
/// complete: then the next one is, whose result says that it was stopped. Reports come from one
/// thread at a time, and are those of the first combination that is being computed. Items are kept only if
/// figures are requested, of up to scene::most_drawn combinations; of more, there is none.
std::vector<results::FigureData> run_computation(const scene::Scene& scene, const scene::Study& study,
                                                 const RunOptions& options, std::size_t schema,
                                                 results::Sink& sink, const Computation& computation);

}  // namespace arcslip::studies

#include <arcslip/ensemble/ensemble.hpp>

#include <arcslip/control/ordered_parallel_for.hpp>
#include <arcslip/ensemble/ensemble_file.hpp>
#include <arcslip/ensemble/kept.hpp>
#include <arcslip/results/shown.hpp>
#include <arcslip/results/version.hpp>
#include <arcslip/scene/combinations.hpp>
#include <arcslip/scene/format/scene_file.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <algorithm>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>

namespace arcslip::ensemble {
namespace {

const char* sql_type(results::Type type) {
  switch (type) {
    case results::Type::number:
      return "REAL";
    case results::Type::whole:
    case results::Type::flag:
      return "INTEGER";
    default:
      return "TEXT";
  }
}

/// The samples of a study with what is kept of them.
class Samples {
 public:
  Samples(const scene::Scene& scene, const scene::Study& study, const Settings& settings)
      : scene_(without_studies(scene)),
        study_(study),
        settings_(settings),
        kind_(studies::kind_of(*study.type)),
        combinations_(study_),
        schema_(kind_.schema(scene_, study_, {.points = true})),
        kept_(read_kept(settings.keep, schema_)),
        computation_(kind_.computation(scene_, study_,
                                       {.points = keeps_points(),
                                        .events_only = !keeps_points(),
                                        .event_columns = kept_.tables.empty() ? event_columns() : Names()})),
        with_units_(kept_) {
    const double count = combinations_.count();
    if (count > sampling::largest_sample_count)
      throw std::invalid_argument("found more than " + std::to_string(sampling::largest_sample_count) +
                                  " combinations in for_each, must be fewer");
    const Part part = settings.part;
    if (part.number < 1 || part.count < part.number)
      throw std::invalid_argument("found the part " + std::to_string(part.number) + "/" +
                                  std::to_string(part.count) + ", must be one of 1/1 to N/N");
    const auto boundary = [&](int i) {
      return static_cast<long>(count) / part.count * i +
             static_cast<long>(count) % part.count * i / part.count;
    };
    range_ = settings.samples.value_or(Range{boundary(part.number - 1), boundary(part.number)});
    range_.begin = std::clamp(range_.begin, 0L, static_cast<long>(count));
    range_.end = std::clamp(range_.end, range_.begin, static_cast<long>(count));
  }

  Range range() const { return range_; }

  Contents contents(const scene::Scene& scene) const {
    scene::Scene described = scene;
    described.studies = {study_};
    std::string keep;
    for (const Quantity& quantity : kept_.quantities) keep += (keep.empty() ? "" : ",") + quantity.name;
    for (const std::size_t table : kept_.tables)
      keep += (keep.empty() ? "" : ",") + schema_.tables[table].key;
    Contents contents{.facts = {{"format", std::string(file_format)},
                                {"program", "arcslip " + std::string(results::version())},
                                {"title", scene.title},
                                {"study", study_.name},
                                {"kind", std::string(study_.type->name())},
                                {"frequency_unit", std::string(scene::unit_name(scene.frequency_unit))},
                                {"keep", keep},
                                {"count", std::to_string(static_cast<long>(combinations_.count()))},
                                {"scene", scene::write(described)},
                                {"scene_hash", scene::hash(described)}},
                      .samples = range_,
                      .columns = {},
                      .tables = {}};
    for (const results::Column& column : schema_.set)
      contents.columns.push_back({name(column), "REAL", column.unit, column.help});
    const auto own = sample_columns();
    contents.columns.insert(contents.columns.end(), own.begin(), own.end());
    for (const Quantity& quantity : kept_.quantities) add_quantity(quantity, contents.columns);
    for (const std::size_t table : kept_.tables) {
      std::vector<TableColumn> columns;
      for (const results::Column& column : schema_.tables[table].columns)
        columns.push_back({name(column), sql_type(column.type), column.unit, column.help});
      contents.tables.emplace_back(schema_.tables[table].key, std::move(columns));
    }
    return contents;
  }

  /// Returns a sample; nothing where the control has ended it.
  std::optional<Sample> compute(long index, const control::Control& control) {
    Sample sample{.index = index, .set = combinations_[static_cast<std::size_t>(index)]};
    std::vector<results::Result> all;
    try {
      all = studies::results_at(scene_, study_, *computation_, sample.set, control);
    } catch (const control::Interrupted&) {
      return std::nullopt;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      sample.status = "failed";
      sample.reason = error.what();
      sample.quantities.resize(kept_.quantities.size());
      return sample;
    }
    if (!control.keep_going()) return std::nullopt;  // what was left out is seen in no status
    put_status(all, sample);
    if (sample.status == "complete" && !all.empty())
      std::call_once(checked_, [&] { check_facts(with_units_, all.front()); });
    sample.results = static_cast<long>(all.size());
    sample.quantities = quantities_of(kept_, schema_, all);
    for (std::size_t i = 0; i < all.size(); ++i) add_rows(all[i], static_cast<long>(i) + 1, sample);
    return sample;
  }

  /// Returns the quantities with the units that results have, once all are computed.
  const std::vector<Quantity>& quantities() const { return with_units_.quantities; }

 private:
  using Names = std::vector<std::string>;

  static scene::Scene without_studies(scene::Scene scene) {
    scene.studies.clear();  // of which each sample would have a copy
    return scene;
  }

  bool keeps_points() const {
    return std::any_of(kept_.tables.begin(), kept_.tables.end(),
                       [&](std::size_t table) { return schema_.tables[table].key != schema_.shown_table; });
  }

  Names event_columns() const {
    Names columns;
    for (const Quantity& quantity : kept_.quantities) columns.push_back(results::name({quantity.path}));
    return columns;
  }

  void add_quantity(const Quantity& quantity, std::vector<TableColumn>& columns) const {
    for (const TableColumn& other : columns)
      if (other.name == quantity.name)
        throw UnknownQuantity("found the quantity \"" + quantity.name +
                              "\", which is also a column of each sample: give its full name, as "
                              "\"peak.amplitude\" or \"elements.damper.energy\"");
    const auto* table = quantity.column ? &events() : nullptr;
    const char* type = table != nullptr ? sql_type(table->columns[*quantity.column].type) : "";
    columns.push_back({quantity.name, type, quantity.unit, quantity.help});
  }

  const results::Table& events() const {
    return *std::find_if(schema_.tables.begin(), schema_.tables.end(),
                         [&](const results::Table& table) { return table.key == schema_.shown_table; });
  }

  static void put_status(const std::vector<results::Result>& all, Sample& sample) {
    auto worst = results::Status::complete;
    for (const results::Result& result : all) {
      const results::End& end = result.end;
      if (!end.doubt.empty() && sample.doubt.find(end.doubt) == std::string::npos)
        sample.doubt += (sample.doubt.empty() ? "" : "; ") + end.doubt;
      if (end.status == results::Status::complete || worst == results::Status::failed) continue;
      worst = end.status;
      sample.reason = results::text_in(end.stop, "message");
    }
    sample.status = results::name(worst);
  }

  void add_rows(const results::Result& result, long number, Sample& sample) const {
    for (std::size_t i = 0; i < kept_.tables.size(); ++i) {
      if (result.tables.size() <= kept_.tables[i]) continue;
      const results::Rows& rows = result.tables[kept_.tables[i]];
      for (std::size_t row = 0; row < rows.count; ++row) {
        std::vector<Cell>& cells = sample.rows.emplace_back();
        cells.emplace_back(static_cast<long>(i));
        cells.emplace_back(number);
        for (const results::Cells& column : rows.columns) cells.push_back(cell_of(column, row));
      }
    }
  }

  const scene::Scene scene_;
  const scene::Study& study_;
  const Settings& settings_;
  const studies::StudyKind& kind_;
  const scene::Combinations combinations_;
  const results::Schema schema_;
  const Kept kept_;
  const std::unique_ptr<studies::Computation> computation_;
  std::once_flag checked_;
  Kept with_units_;
  Range range_;
};

}  // namespace

bool is_available() {
  return true;
}

std::vector<Range> prepare_file(const scene::Scene& scene, const scene::Study& study,
                                const Settings& settings) {
  const Samples samples(scene, study, settings);
  EnsembleFile file(settings.path, samples.contents(scene));
  std::vector<Range> missing = file.missing();
  file.finish();
  return missing;
}

Outcome run(const scene::Scene& scene, const scene::Study& study, const Settings& settings) {
  Samples samples(scene, study, settings);
  EnsembleFile file(settings.path, samples.contents(scene));
  Outcome outcome;
  Progress& progress = outcome.progress;
  progress.all = samples.range().end - samples.range().begin;
  progress.done = progress.before = file.count();
  progress.failed = file.failed();
  const control::Control control = settings.control.child();
  constexpr long measured_every = 100;
  for (const Range& gap : file.missing()) {
    const auto make = [&](std::size_t k) {
      return samples.compute(gap.begin + static_cast<long>(k), control);
    };
    const auto take = [&](std::optional<Sample> sample) {
      if (!sample) return;
      file.add(*sample);
      ++progress.done;
      progress.failed += sample->status != "complete";
      if (progress.done % measured_every == 0) progress.bytes = file.bytes();
      if (settings.report) settings.report(progress);
    };
    control::in_order(static_cast<std::size_t>(gap.end - gap.begin), settings.threads, control, make, take);
    if (!control.keep_going()) break;
  }
  file.commit();
  if (progress.done > progress.before) file.set_units(samples.quantities());
  file.finish();
  outcome.stopped = progress.done < progress.all;
  return outcome;
}

}  // namespace arcslip::ensemble

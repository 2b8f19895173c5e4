// Running studies, and their results.

#include "bindings.hpp"
#include "supervised.hpp"
#include "values.hpp"

#include <arcslip/model/reduction_report.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/table_writer.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/presentation/columns.hpp>
#include <arcslip/studies/presentation/selection.hpp>
#include <arcslip/studies/study_kind.hpp>
#include <arcslip/studies/windows.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace nb = nanobind;

namespace arcslip::python {
namespace {

using results::Results;

nb::dict described(const results::Column& column) {
  static constexpr const char* types[] = {"number", "whole", "flag", "text", "value"};
  nb::dict all;
  all["path"] = nb::tuple(nb::cast(column.path));
  all["type"] = types[static_cast<std::size_t>(column.type)];
  all["unit"] = column.unit;
  all["help"] = column.help;
  return all;
}

nb::dict described(const results::Table& table) {
  nb::list columns;
  for (const results::Column& column : table.columns) columns.append(described(column));
  nb::dict all;
  all["key"] = table.key;
  all["columns"] = columns;
  return all;
}

nb::dict described(const results::Schema& schema) {
  nb::list tables;
  for (const results::Table& table : schema.tables) tables.append(described(table));
  nb::dict all;
  all["format"] = schema.format;
  all["list"] = schema.list;
  all["noun"] = schema.noun;
  all["tables"] = tables;
  return all;
}

nb::dict header(const Results& results) {
  nb::dict all;
  all["program"] = results.header.program;
  all["scene_hash"] = results.header.scene_hash;
  all["title"] = results.header.title;
  all["frequency_unit"] = results.header.frequency_unit;
  all["notes"] = results.header.notes;
  all["reduction"] = as_dict(results.header.reduction);
  return all;
}

nb::list schemas(const Results& results) {
  nb::list all;
  for (const results::Schema& schema : results.schemas) all.append(described(schema));
  return all;
}

/// What a result has besides its tables.
nb::dict facts(const Results& results, std::size_t i) {
  const results::Result& result = results.results.at(i);
  nb::dict units, all;
  for (const results::Member& member : result.head.set) units[member.key.c_str()] = member.unit;
  all["schema"] = result.schema;
  all["study"] = result.head.study;
  all["kind"] = result.head.kind;
  all["parent"] = result.head.parent;
  all["set"] = as_dict(result.head.set);
  all["set_units"] = units;
  all["status"] = results::name(result.end.status);
  all["stop"] = as_dict(result.end.stop);
  all["doubt"] = result.end.doubt;
  all["text"] = result.end.text;
  nb::dict of_head = as_dict(result.head.facts);
  of_head.update(as_dict(result.end.facts));
  all["facts"] = of_head;
  return all;
}

std::vector<std::size_t> counts(const Results& results, std::size_t i) {
  std::vector<std::size_t> all;
  for (const results::Rows& rows : results.results.at(i).tables) all.push_back(rows.count);
  return all;
}

nb::object column(nb::handle_t<Results> self, std::size_t i, std::size_t table, std::size_t column) {
  const results::Rows& rows = nb::cast<const Results&>(self).results.at(i).tables.at(table);
  // A table without rows may have no columns.
  return rows.columns.empty() ? nb::none() : as_column(rows.columns.at(column), self);
}

/// The motion at a row of a table of a branch; None where it was not kept.
nb::object motion(const Results& results, std::size_t i, std::size_t table, std::size_t row, int steps) {
  const results::MotionAt& at = results.results.at(i).end.motion;
  if (!at) return nb::none();
  std::optional<results::TableRows> found;
  {
    const nb::gil_scoped_release released;
    found = at(table, row, steps);
  }
  return nb::cast(*std::move(found));
}

std::string json(const Results& results) {
  std::ostringstream text;
  results::write_json(text, results);
  return text.str();
}

/// What the command says about results: which ended early, and which are in doubt.
std::pair<std::vector<std::string>, std::vector<std::string>> remarks(const Results& results) {
  results::Remarks all;
  results::replay(results, all);
  return {all.early_ends, all.doubts};
}

/// Returns how many of the studies were begun.
std::size_t compute(scene::Scene scene, const std::vector<std::size_t>& which,
                    const control::Control& control, studies::RunOptions options, results::Sink& sink) {
  options.control = control;
  observables::prepare(scene, control);
  std::vector<std::string> notes;
  for (const std::size_t i : which)
    if (std::string note = studies::propose_window(scene, i, control); !note.empty())
      notes.push_back(std::move(note));
  std::vector<results::Schema> schemas;
  for (const std::size_t i : which)
    schemas.push_back(studies::kind_of(*scene.studies[i].type).schema(scene, scene.studies[i], options));
  studies::check_selection({options.point_columns, {}}, schemas);
  results::Header header = studies::header(scene);
  header.notes = std::move(notes);
  sink.begin(header, schemas);
  std::size_t begun = 0;
  for (; begun < which.size() && control.keep_going(); ++begun) {
    const scene::Study& study = scene.studies[which[begun]];
    studies::kind_of(*study.type).run(scene, study, options, begun, sink);
  }
  sink.finish();
  return begun;
}

/// The results of these studies of a scene, of branches with these columns, how many of them were begun, and
/// the exception that ended them early, or None.
nb::tuple run(const scene::Scene& scene, const std::vector<std::size_t>& which, bool coefficients,
              std::optional<std::vector<std::string>> columns, int threads, const nb::object& report) {
  for (const std::size_t i : which) static_cast<void>(scene.studies.at(i));
  auto kept = std::make_unique<results::Collector>();
  results::Collector& collector = *kept;
  std::unique_ptr<results::Sink> sink = std::move(kept);
  studies::RunOptions options;
  options.coefficients = coefficients;
  if (columns) {
    columns->push_back("kind");  // by which events are found
    if (coefficients) columns->push_back("coefficients");
    options.point_columns = options.event_columns = *columns;
    sink = std::make_unique<studies::Selected>(std::move(sink), studies::Selection{*std::move(columns), {}},
                                               true);
  }
  options.motions = true;
  options.threads = threads;
  std::size_t begun = 0;
  const auto ended_by = supervised(report, [&](const control::Control& control) {
    begun = compute(scene, which, control, options, *sink);
  });
  for (results::Result& result : collector.results.results)
    for (results::Rows& rows : result.tables) mark_missing(rows);
  nb::object error = ended_by ? nb::borrow(ended_by->value()) : nb::none();
  return nb::make_tuple(std::move(collector.results), begun, error);
}

}  // namespace

void bind_results(nb::module_& core) {
  nb::class_<results::TableRows>(core, "TableRows")
      .def("schema", [](const results::TableRows& record) { return described(record.table); })
      .def("__len__", [](const results::TableRows& record) { return record.rows.count; })
      .def("column", [](nb::handle_t<results::TableRows> self, std::size_t column) {
        return as_column(nb::cast<const results::TableRows&>(self).rows.columns.at(column), self);
      });
  nb::class_<Results>(core, "Results")
      .def("header", header)
      .def("schemas", schemas)
      .def("__len__", [](const Results& results) { return results.results.size(); })
      .def("facts", facts)
      .def("counts", counts)
      .def("column", column)
      .def("motion", motion, nb::arg("result"), nb::arg("table"), nb::arg("row"), nb::arg("steps"))
      .def("json", json)
      .def("remarks", [](const Results& results) {
        const auto [early_ends, doubts] = remarks(results);
        return nb::make_tuple(nb::cast(early_ends), nb::cast(doubts));
      });
  core.def("run", run, nb::arg("scene"), nb::arg("which"), nb::arg("coefficients"), nb::arg("columns").none(),
           nb::arg("threads"), nb::arg("report").none());
}

}  // namespace arcslip::python

// The study "point": the responses at one frequency, with everything that is known of them.
#include <arcslip/analyses/modes_and_time/time_results.hpp>
#include <arcslip/analyses/responses/responses_at.hpp>
#include <arcslip/control/run_control.hpp>
#include <arcslip/observables/quantities.hpp>
#include <arcslip/results/table_of.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/studies/branch_kind.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/studies/presentation/columns.hpp>
#include <arcslip/studies/presentation/figures.hpp>
#include <arcslip/studies/presentation/histories.hpp>
#include <arcslip/studies/stability_keys.hpp>

#include <array>
#include <memory>

namespace arcslip::studies {
namespace {

using observables::Offsets;
using observables::PointResponse;
using observables::PointSettings;

constexpr std::array<scene::file::Word<Offsets>, 2> offset_words = {
    {{"chosen", Offsets::chosen}, {"range", Offsets::range}}};

scene::file::KeysOf<PointSettings> keys_of_point() {
  scene::file::KeysOf<PointSettings> keys;
  keys.add(scene::file::one_frequency(&PointSettings::frequency, "the excitation frequency"));
  keys.add(
      scene::file::whole("steps", &PointSettings::steps, 1, most_steps, "number of instants of the history"));
  keys.add(scene::file::word("offsets", &PointSettings::offsets, offset_words,
                             "where sliders that never slip rest: as their elements choose, or also the "
                             "range of the amplitude over all possible positions"));
  add_stability_keys(keys, stability_of_points_help);
  return keys;
}

std::string point_doubt(const PointResponse& response) {
  return response.doubt.empty() ? doubt_of_stops(response.point.stops) : response.doubt;
}

results::Object offset_range(const observables::OffsetRange& range) {
  results::Object object{{"amplitude_min", range.amplitude_min, "m"},
                         {"amplitude_max", range.amplitude_max, "m"},
                         {"sliders", range.sliders}};
  if (!range.failure.empty()) object.push_back({"message", range.failure});
  return object;
}

results::Object point_facts(const scene::Scene& scene, const PointResponse& response, bool stability) {
  results::Object all;
  if (response.status == observables::Status::complete) {
    const auto table = responses(scene, {.maxima = true, .coefficients = true, .stability = stability});
    all = results::object(table.columns(), table.rows(std::vector{response.point}), 0);
  }
  all.push_back({"period", scene.harmonics.period});
  all.push_back({"harmonics", results::Value::List(response.harmonics.begin(), response.harmonics.end())});
  if (response.offset_range) all.push_back({"offset_range", offset_range(*response.offset_range)});
  all.push_back({"solver", solver(response.solver)});
  return all;
}

Described<PointResponse> described_point(const scene::Scene& scene, const PointSettings& settings,
                                         const RunOptions& options) {
  const auto table = std::make_shared<const results::TableOf<Instant>>(history_table(scene));
  std::vector<results::Shown> shown{
      {results::with_unit("frequency", scene::unit_name(scene.frequency_unit)), {"frequency"}, "%.8f"},
      {.title = "A_max",
       .path = {"amplitude"},
       .format = "%.8e",
       .error = {"truncation_estimate"},
       .doubtful = {"truncation_flagged"},
       .unit = "m"},
      {"phase (rad)", {"phase"}, "%.6f"}};
  add_stick(scene, shown);
  if (settings.stability) shown.push_back({"stable", {"stable"}});
  shown.insert(shown.end(),
               {{.title = "E_friction", .path = {"energy_friction"}, .format = "%.6e", .unit = "J"},
                {.title = "E_viscous", .path = {"energy_viscous"}, .format = "%.6e", .unit = "J"},
                {.title = "truncation", .path = {"truncation_estimate"}, .format = "%.1e", .unit = "m"}});
  results::Schema schema{.format = "arcslip-responses-1",
                         .list = "responses",
                         .noun = "response",
                         .tables = {{"history", table->columns(), {"elements"}, true}},
                         .shown = std::move(shown)};
  return {std::move(schema),
          [&scene, table, options, stability = settings.stability](const PointResponse& response) {
            return results::Result{
                .schema = 0,
                .head = {response.study,
                         response.kind,
                         named(scene, response.set),
                         {{"parameters", named(scene, response.parameters)}}},
                .tables = {table->rows(options.points ? instants(response.history) : std::vector<Instant>())},
                .end = {response.status, stop(response.stop), point_facts(scene, response, stability),
                        point_doubt(response)}};
          }};
}

/// As a motion in time, whose figures show the same.
observables::Motion motion_of(const scene::Scene& scene, const PointResponse& response) {
  observables::Motion motion;
  motion.set = response.set;
  motion.history.displacement = response.history.displacement;
  motion.history.velocity = response.history.velocity;
  for (const double angle : response.history.angle)
    motion.history.time.push_back(angle / response.history.base_frequency);
  for (const observables::ElementHistory& element : response.history.elements)
    motion.history.elements.push_back({element.name, element.displacement, element.force, {}, {}});
  const std::vector<scene::Part> elements = scene::all_elements(scene);
  for (std::size_t e = 0; e < response.history.elements.size(); ++e) {
    const observables::ElementHistory& element = response.history.elements[e];
    if (!elements[e].detailed || !observables::is_friction_part(elements[e])) continue;
    const auto names = direction_names(elements[e]);
    for (std::size_t i = 1; i < names.size() && i <= element.further.size(); ++i)
      motion.history.elements.push_back({element.name + "." + std::string(names[i]),
                                         element.further[i - 1].displacement,
                                         element.further[i - 1].force,
                                         {},
                                         {}});
  }
  return motion;
}

Truncation truncation_of(std::span<const PointResponse> all) {
  Truncation found;
  for (const PointResponse& each : all) add(each.status, each.stop, found), add(each.point, found);
  if (!all.empty()) found.responses = all.front().found;
  return found;
}

std::unique_ptr<Computation> computed_points(const scene::Scene& scene, const PointSettings& settings,
                                             const RunOptions& options) {
  using All = std::span<const PointResponse>;
  auto of = std::make_unique<ComputationOf<PointResponse>>(
      described_point(scene, settings, options),
      [&settings](const Case& at, const control::Control& control) {
        return observables::point_responses(at.scene, settings, control);
      },
      [&scene](All all) {
        std::vector<observables::Motion> motions;
        for (const PointResponse& each : all) motions.push_back(motion_of(scene, each));
        return std::vector{figures_of(scene, motions)};
      });
  of->truncation_of_items = [](All all) { return truncation_of(all); };
  of->refine_items = [&settings](const Case& at, All coarse, double /*accuracy*/,
                                 const control::Control& control) {
    return std::optional(Refined<PointResponse>{
        observables::point_responses(at.scene, settings, control, coarse), observables::no_value});
  };
  return of;
}

}  // namespace

const StudyKind& point() {
  static const StudyKind kind(
      {.name = "point",
       .help = "the responses at one frequency, with all of their quantities and hysteresis loops",
       .coefficients = false},
      keys_of_point(), computed_points);
  return kind;
}

}  // namespace arcslip::studies

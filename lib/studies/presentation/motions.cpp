#include <arcslip/studies/presentation/motions.hpp>

#include <arcslip/laws/law_type.hpp>
#include <arcslip/observables/quantities.hpp>
#include <arcslip/results/table_of.hpp>
#include <arcslip/results/text.hpp>

#include <cmath>
#include <complex>
#include <memory>
#include <set>
#include <string>
#include <utility>

namespace arcslip::studies {
namespace {

using observables::Motion;

/// One instant of a history.
struct MotionInstant {
  const time::TimeHistory* history;
  std::size_t i;
};

results::TableOf<MotionInstant> motion_history(const scene::Scene& scene) {
  results::TableOf<MotionInstant> table;
  const auto add = [&](std::vector<std::string> path, const char* unit, const char* help, auto list_of) {
    table.add(std::move(path), unit, help, [list_of](const MotionInstant& at) {
      const std::vector<double>* list = list_of(*at.history);
      return list && at.i < list->size() ? std::optional((*list)[at.i]) : std::nullopt;
    });
  };
  add({"time"}, "s", "from the start of the recorded periods", [](const auto& of) { return &of.time; });
  add({"displacement"}, "m", "of the response", [](const auto& of) { return &of.displacement; });
  add({"velocity"}, "m/s", "of the response", [](const auto& of) { return &of.velocity; });
  const std::vector<scene::Part> elements = scene::all_elements(scene);
  const auto add_element = [&](std::size_t e) {
    if (!elements[e].detailed) return;
    const std::string& name = elements[e].name;
    const auto of_element = [&](const char* key, const char* unit, const char* help,
                                std::vector<double> time::ElementTimeHistory::* member) {
      add({"elements", name, key}, unit, help, [e, member](const time::TimeHistory& of) {
        return e < of.elements.size() ? &(of.elements[e].*member) : nullptr;
      });
    };
    of_element("displacement", "m", "of the element", &time::ElementTimeHistory::displacement);
    of_element("force", "N", "against the motion", &time::ElementTimeHistory::force);
    if (observables::is_friction_part(elements[e]))
      of_element("slider", "m", "friction elements: position of the slider",
                 &time::ElementTimeHistory::slider);
    if (elements::law_of(elements[e])->has_normal_load())
      of_element("normal_load", "N", "contacts with a normal direction",
                 &time::ElementTimeHistory::normal_load);
  };
  for (std::size_t e = 0; e < scene.elements.size(); ++e) add_element(e);
  const std::size_t of_patches = table.columns().size();
  for (std::size_t e = scene.elements.size(); e < elements.size(); ++e) add_element(e);
  table.set_details(of_patches);
  return table;
}

// Of a patch; of an element there are none.
void add_extremes(const observables::ContactExtremes& extremes, results::Object& to) {
  const auto add = [&](const char* key, double value, const char* unit) {
    if (!std::isnan(value)) to.push_back({key, value, unit});
  };
  add("stick_percent_min", extremes.stick_percent_min, "%");
  add("pressure_max", extremes.pressure_max, "Pa");
  add("energy_per_area_max", extremes.energy_per_area_max, "J/m^2");
  add("wear_depth_rate_max", extremes.wear_depth_rate_max, "m/s");
}

results::Object contacts(const std::vector<observables::ElementMotion>& list,
                         const std::set<std::string>& hidden) {
  results::Object all;
  for (const observables::ElementMotion& element : list) {
    if (hidden.contains(element.name)) continue;
    results::Object of{{"stick_percent", element.stick_percent, "%"}, {"energy", element.energy, "J"}};
    if (element.has_normal_load)
      of.insert(of.end(), {{"open_percent", element.open_percent, "%"},
                           {"normal_load_max", element.normal_load_max, "N"},
                           {"normal_load_min", element.normal_load_min, "N"}});
    if (!std::isnan(element.wear_rate)) of.push_back({"wear_rate", element.wear_rate, "m^3/s"});
    add_extremes(element.extremes, of);
    all.push_back({element.name, std::move(of)});
  }
  return all;
}

results::Object start(const observables::MotionDeparture& departure) {
  results::Object object{{"amplitude", departure.response_amplitude, "m"}};
  if (!std::isnan(departure.largest_multiplier))
    object.insert(object.end(), {{"largest_multiplier", departure.largest_multiplier},
                                 {"multiplier_error", departure.multiplier_error},
                                 {"unstable_multipliers", departure.unstable}});
  object.insert(
      object.end(),
      {{"growth", departure.growth}, {"returned", departure.returned}, {"distance", departure.distance}});
  if (departure.motion_period > 0) object.push_back({"motion_period", departure.motion_period});
  return object;
}

// Where it went, a sentence.
std::string motion_remark(const Motion& motion) {
  if (!motion.departure) return {};
  const observables::MotionDeparture& of = *motion.departure;
  std::string text = motion.stop.message + "; in a period the disturbance changed by the factor " +
                     results::to_digits(of.growth, 6);
  if (!std::isnan(of.largest_multiplier))
    text += ", compared with a largest multiplier of modulus " + results::to_digits(of.largest_multiplier, 6);
  return text;
}

results::Object motion_facts(const scene::Scene& scene, const Motion& motion) {
  results::Value::List multipliers;
  for (const std::complex<double>& multiplier : motion.multipliers)
    multipliers.emplace_back(std::vector<double>{multiplier.real(), multiplier.imag()});
  results::Object all{{"method", name(motion.method)},
                      {"integrator", motion.integrator},
                      {"frequency", motion.omega / scene::to_rad_per_s(scene.frequency_unit),
                       std::string(scene::unit_name(scene.frequency_unit))},
                      {"omega", motion.omega, "rad/s"},
                      {"period", scene.harmonics.period},
                      {"steps", motion.steps},
                      {"periods", motion.periods},
                      {"period_change", motion.change},
                      {"amplitude", motion.amplitude, "m"},
                      {"energy_input", motion.energy.input, "J"},
                      {"energy_friction", motion.energy.friction, "J"},
                      {"energy_viscous", motion.energy.viscous, "J"},
                      {"energy_stored", motion.energy.stored, "J"},
                      {"energy_defect", motion.energy.defect(), "J"},
                      {"multipliers", std::move(multipliers)}};
  if (!motion.multipliers.empty())
    all.push_back({"largest_multiplier", std::abs(motion.multipliers.front())});
  if (motion.stable) all.push_back({"stable", *motion.stable});
  if (motion.departure) all.push_back({"start", start(*motion.departure)});
  if (motion.elements.size() == 1)
    all.push_back({"stick_percent", motion.elements.front().stick_percent, "%"});
  std::set<std::string> hidden;
  for (const scene::Part& element : scene::all_elements(scene))
    if (!element.detailed) hidden.insert(element.name);
  all.push_back({"elements", contacts(motion.elements, hidden)});
  if (!motion.patches.empty()) all.push_back({"patches", contacts(motion.patches, {})});
  return all;
}

constexpr double neutral =
    1e-6;  // |multiplier| above 1 by less, as without damping, is no growth to speak of

// A motion that no structure shows.
std::string doubt(const Motion& motion) {
  if (motion.multipliers.empty() || !(std::abs(motion.multipliers.front()) > 1 + neutral)) return {};
  return "unstable, with a multiplier of modulus " +
         results::to_digits(std::abs(motion.multipliers.front()), 4) +
         ": the structure leaves it after the least disturbance";
}

}  // namespace

Described<Motion> motions(const scene::Scene& scene, const RunOptions& options) {
  const auto table = std::make_shared<const results::TableOf<MotionInstant>>(motion_history(scene));
  std::vector<results::Shown> shown{
      {"method", {"method"}},
      {results::with_unit("frequency", scene::unit_name(scene.frequency_unit)), {"frequency"}, "%.8f"},
      {.title = "A_max", .path = {"amplitude"}, .format = "%.8e", .unit = "m"}};
  add_stick(scene, shown);
  shown.insert(shown.end(),
               {{.title = "E_friction", .path = {"energy_friction"}, .format = "%.6e", .unit = "J"},
                {.title = "E_viscous", .path = {"energy_viscous"}, .format = "%.6e", .unit = "J"},
                {"multiplier", {"largest_multiplier"}, "%.6f"},
                {"periods", {"periods"}}});
  results::Schema schema{.format = "arcslip-time-1",
                         .list = "motions",
                         .noun = "motion",
                         .tables = {{"history", table->columns(), {"elements"}, true}},
                         .shown = std::move(shown)};
  return {std::move(schema), [&scene, table, points = options.points](const Motion& motion) {
            std::vector<MotionInstant> instants;
            for (std::size_t i = 0; points && i < motion.history.time.size(); ++i)
              instants.push_back({&motion.history, i});
            return results::Result{.schema = 0,
                                   .head = {motion.study,
                                            motion.kind,
                                            named(scene, motion.set),
                                            {{"parameters", named(scene, motion.parameters)}}},
                                   .tables = {table->rows(instants)},
                                   .end = {motion.status,
                                           stop(motion.stop),
                                           motion_facts(scene, motion),
                                           doubt(motion),
                                           {},
                                           motion_remark(motion)}};
          }};
}

results::Results results_of(const scene::Scene& scene, std::span<const Motion> all,
                            const RunOptions& options) {
  return collected(scene, motions(scene, options), all);
}

}  // namespace arcslip::studies

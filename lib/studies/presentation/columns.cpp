#include <arcslip/studies/presentation/columns.hpp>

#include <arcslip/model/reduction_report.hpp>
#include <arcslip/observables/quantities.hpp>
#include <arcslip/results/event_kinds.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/results/version.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

namespace arcslip::studies {
namespace {

constexpr double largest_error_of_reduction = 1e-3;  // by Krylov spaces more is refused

using observables::Quantity;
using observables::ResponsePoint;

std::vector<std::string> keys_of_path(std::string_view path) {
  std::vector<std::string> all;
  for (auto point = path.find('.'); point != std::string_view::npos; point = path.find('.')) {
    all.emplace_back(path.substr(0, point));
    path.remove_prefix(point + 1);
  }
  all.emplace_back(path);
  return all;
}

/// Puts the quantities that things of this origin may have to a table of items, of each of which of(item) is
/// one; null: the item has none.
template <class Of, class Item, class OfItem>
void add_quantities(std::span<const Quantity<Of>> quantities, const typename Quantity<Of>::Origin& origin,
                    const scene::Scene& scene, const Asked& asked, const std::vector<std::string>& prefix,
                    OfItem of, results::TableOf<Item>& table) {
  for (const Quantity<Of>& quantity : quantities) {
    if (quantity.in && !quantity.in(origin)) continue;
    const bool with_maxima = quantity.path.starts_with("maxima.") || quantity.path == "stick_estimate";
    if ((!asked.maxima && with_maxima) || (!asked.amplitude && quantity.path == "amplitude")) continue;
    if (!std::is_same_v<Of, observables::ElementResponse> && asked.mode &&
        !observables::is_of_modes(quantity.path))
      continue;
    std::vector<std::string> path = prefix;
    for (std::string& key : keys_of_path(quantity.path)) path.push_back(std::move(key));
    const bool is_frequency = quantity.unit == observables::frequency_unit;
    const double unit = is_frequency ? scene::to_rad_per_s(scene.frequency_unit) : 1;
    const std::string_view unit_name = is_frequency ? scene::unit_name(scene.frequency_unit) : quantity.unit;
    std::visit(
        [&](auto get) {
          table.add(std::move(path), std::string(unit_name), std::string(quantity.meaning),
                    [get, of, unit, has = quantity.has](const Item& item) {
                      using Got = std::decay_t<decltype(get(std::declval<const Of&>()))>;
                      const Of* from = of(item);
                      if (!from || (has && !has(*from))) return std::optional<Got>();
                      if constexpr (std::is_same_v<Got, double>)
                        return std::optional<Got>(get(*from) / unit);
                      else
                        return std::optional<Got>(get(*from));
                    });
        },
        quantity.get);
  }
}

}  // namespace

results::TableOf<ResponsePoint> responses(const scene::Scene& scene, const Asked& asked) {
  results::TableOf<ResponsePoint> table;
  if (!asked.over.empty())
    table.add({asked.over}, parameter_unit(scene, asked.over), "the continuation parameter",
              [](const ResponsePoint& response) { return response.over; });
  add_quantities(
      observables::response_quantities(), scene, scene, asked, {},
      [](const ResponsePoint& response) { return &response; }, table);
  if (asked.stability)
    add_quantities(
        observables::stability_quantities(), scene, scene, asked, {},
        [](const ResponsePoint& response) { return response.stability ? &*response.stability : nullptr; },
        table);
  if (asked.mode)
    add_quantities(
        observables::mode_quantities(), scene, scene, {}, {},
        [](const ResponsePoint& response) { return &response; }, table);
  const std::vector<scene::Part> elements = scene::all_elements(scene);
  const auto add_element = [&](std::size_t e) {
    if (elements[e].detailed)
      add_quantities(
          observables::element_quantities(), elements[e], scene, asked, {"elements", elements[e].name},
          [e](const ResponsePoint& response) {
            return e < response.elements.size() ? &response.elements[e] : nullptr;
          },
          table);
  };
  for (std::size_t e = 0; e < scene.elements.size(); ++e) add_element(e);
  const std::size_t of_patches = table.columns().size();
  for (std::size_t e = scene.elements.size(); e < elements.size(); ++e) add_element(e);
  table.set_details(of_patches);
  for (std::size_t k = 0; k < scene.patches.size(); ++k)
    add_quantities(
        observables::patch_quantities(), scene.patches[k], scene, asked, {"patches", scene.patches[k].name},
        [k](const ResponsePoint& response) {
          return k < response.patches.size() ? &response.patches[k] : nullptr;
        },
        table);
  for (std::size_t r = 0; r < scene.responses.size(); ++r)
    if (const scene::Response& named = scene.responses[r]; !named.name.empty())
      add_quantities(
          observables::named_response_quantities(), named, scene,
          {.maxima = asked.maxima, .mode = asked.mode}, {"responses", named.name},
          [r](const ResponsePoint& response) {
            return r < response.responses.size() ? &response.responses[r] : nullptr;
          },
          table);
  if (asked.order)
    table.add({"order"}, "", "highest harmonic kept at this point, of those of the motion's period",
              [](const ResponsePoint& response) { return response.order; });
  if (asked.coefficients)
    table.add({"coefficients"}, "m", "Fourier coefficients a_n, b_n of the response, for each harmonic",
              [](const ResponsePoint& response) { return response.coefficients; });
  return table;
}

void add_columns(const scene::Scene& scene, const NamedValues& set, std::vector<results::Column>& columns) {
  for (const auto& [name, value] : set) {
    const auto is_there = [&, &name = name](const results::Column& column) {
      return column.path.front() == name;
    };
    if (std::none_of(columns.begin(), columns.end(), is_there))
      columns.push_back({{name}, results::Type::number, parameter_unit(scene, name), "given by `for_each`"});
  }
}

void add_stick(const scene::Scene& scene, std::vector<results::Shown>& shown,
               const std::vector<std::string>& doubts) {
  using observables::is_friction_part;
  const auto count = std::count_if(scene.elements.begin(), scene.elements.end(), is_friction_part);
  const bool one = static_cast<std::size_t>(count) + scene.patches.size() == 1;
  const auto add_parts = [&](const std::vector<scene::Part>& parts, const char* key) {
    for (const scene::Part& part : parts)
      if (is_friction_part(part))
        shown.push_back({.title = (one ? "" : part.name + " ") + "stick (%)",
                         .path = {key, part.name, "stick_percent"},
                         .format = "%.4f",
                         .error = {key, part.name, "stick_estimate"},
                         .doubtful = doubts});
  };
  add_parts(scene.elements, "elements");
  add_parts(scene.patches, "patches");
}

std::string doubt_of_reduction(const scene::Scene& scene, double highest_harmonic,
                               const control::Control& control) {
  if (!scene.matrices ||
      (scene.matrices->errors.empty() && scene.matrices->reduction.method == scene::ReductionMethod::krylov))
    return {};
  auto found = observables::error_of_reduction(scene, 0, control);
  if (!found || found->error <= largest_error_of_reduction) return {};
  if (highest_harmonic > 0) found = observables::error_of_reduction(scene, highest_harmonic, control);
  if (found->error <= largest_error_of_reduction) return {};
  return "the reduction of the structure may have an error of " + results::quantity(found->error, "") +
         " up to " + results::quantity(found->frequency, scene::unit_name(scene.frequency_unit)) +
         ": keep more modes";
}

results::Header header(const scene::Scene& scene) {
  const std::string unit(scene::unit_name(scene.frequency_unit));
  results::Header header{"arcslip " + std::string(results::version()), scene::hash(scene), scene.title, unit};
  if (const auto reduction = observables::reduction(scene)) {
    header.reduction = {{"rows", reduction->rows},
                        {"kept", reduction->kept},
                        {"coordinates", reduction->coordinates},
                        {"error", reduction->error},
                        {"highest_frequency", scene.matrices->highest_frequency, unit}};
    if (const auto method = scene.matrices->reduction.method; method != scene::ReductionMethod::krylov)
      header.reduction.push_back({"method", std::string(scene::name(method))});
    if (scene.matrices->copies > 1 && scene.matrices->faces.empty())
      header.reduction.push_back({"copies", scene.matrices->copies});
    if (reduction->highest_speed > 0)
      header.reduction.push_back({"highest_speed", reduction->highest_speed, "rad/s"});
  }
  return header;
}

results::Object stop(const observables::Stop& stop) {
  return {
      {"reason", stop.reason.code}, {"value", stop.value}, {"limit", stop.limit}, {"message", stop.message}};
}

results::Object solver(const observables::SolverSummary& summary) {
  return {{"linear_solver", summary.linear_solver},
          {"unknowns", summary.unknowns},
          {"points", summary.points},
          {"rejected_steps", summary.rejected_steps},
          {"residuals", summary.residuals},
          {"jacobians", summary.jacobians},
          {"factorizations", summary.factorizations},
          {"solves", summary.solves},
          {"seconds", summary.seconds, "s"}};
}

std::string doubt_of_stops(const std::string& element) {
  return element.empty() ? ""
                         : "\"" + element +
                               "\" stops where its motion reverses, since its friction has no stiffness: the "
                               "error falls slowly with the harmonics; give the contact a stiffness";
}

namespace {

using UnstablePart = std::pair<const ResponsePoint*, const ResponsePoint*>;  // its ends

bool is_limit(const observables::ResponseEvent& event) {
  namespace event_kinds = observables::event_kinds;
  return event.point.stability && event_kinds::contains(event_kinds::limits_of_stability, event.kind);
}

/// Between events where there are any: also where two of them have no point between them.
std::vector<UnstablePart> unstable_parts(const observables::ResponseBranch& branch) {
  const auto& points = branch.points;
  const auto is_unstable = [&](std::size_t i) {
    return points[i].stability && points[i].stability->unstable > 0;
  };
  std::vector<UnstablePart> parts;
  bool now = false;
  const auto cross = [&](const ResponsePoint& at) {
    if (!now)
      parts.push_back({&at, &at});
    else
      parts.back().second = &at;
    now = !now;
  };
  auto event = branch.events.begin();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ResponsePoint* last = nullptr;
    std::vector<const ResponsePoint*> crossings;  // of the circle: one side has no other multipliers outside
    for (; event != branch.events.end() && event->after < i; ++event) {
      if (i == 0 || !branch.of.empty() || !is_limit(*event))
        continue;  // on a curve of limits none is crossed
      last = &event->point;
      if (event->point.stability->unstable == 0) crossings.push_back(last);
    }
    const bool crosses = now != is_unstable(i);
    if (crossings.size() % 2 !=
        (crosses ? 1 : 0)) {  // multipliers that touch the circle, or jump: the point decides
      if (crossings.empty())
        crossings.push_back(last ? last : now ? &points[i - 1] : &points[i]);
      else
        crossings.erase(crossings.begin());
    }
    for (const ResponsePoint* at : crossings) cross(*at);
    if (now) parts.back().second = &points[i];
  }
  return parts;
}

}  // namespace

std::string unstable_ranges(const scene::Scene& scene, const observables::ResponseBranch& branch) {
  const auto text_of = [&](const ResponsePoint& at) {
    const double unit = branch.over.empty() ? in_scene_unit(scene, 1) : 1;
    const double value = branch.over.empty() ? at.omega : at.over, estimate = at.location_estimate;
    const double error = at.truncation_flagged ? results::doubtful_error(value, estimate) : estimate;
    return results::with_error(unit * value, unit * error, "%.8g");
  };
  std::string text;
  for (const auto& [from, to] : unstable_parts(branch))
    text +=
        (text.empty() ? (branch.of.empty() ? "unstable from " : "no limit of stability from ") : ", from ") +
        text_of(*from) + " to " + text_of(*to);
  if (text.empty()) return text;
  const std::string unit = branch.over.empty() ? std::string(scene::unit_name(scene.frequency_unit))
                                               : parameter_unit(scene, branch.over);
  return text + (unit.empty() ? "" : " " + unit);
}

std::string untraced(const observables::ResponseBranch& branch) {
  std::string text;
  for (const std::string& each : branch.untraced) text += (text.empty() ? "not followed: " : "; ") + each;
  return text;
}

std::string doubt_of(const observables::ResponseBranch& branch) {
  if (!branch.doubt.empty()) return branch.doubt;
  const auto stops = [](const auto& point) { return !point.stops.empty(); };
  const auto first = std::find_if(branch.points.begin(), branch.points.end(), stops);
  if (first == branch.points.end())
    return branch.unknown_stability.empty() ? "" : "without its stability: " + branch.unknown_stability;
  return "at " + std::to_string(std::count_if(first, branch.points.end(), stops)) + " of " +
         std::to_string(branch.points.size()) + " points " + doubt_of_stops(first->stops);
}

}  // namespace arcslip::studies

#include <arcslip/optimize/studies.hpp>

#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/study/optimum_results.hpp>
#include <arcslip/optimize/study/optimum_study.hpp>
#include <arcslip/optimize/study/read_settings.hpp>
#include <arcslip/studies/study_kind.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace arcslip::optimize {
namespace {

using namespace scene::file;
using scene::Key;
using scene::KeyType;
using scene::ParameterUse;

constexpr int largest_search = 100'000'000;  // evaluations, and other whole numbers of a search

const std::array criteria = {Word<Criterion>{name(Criterion::worst), Criterion::worst},
                             Word<Criterion>{name(Criterion::mean), Criterion::mean}};

Node pair_of(const DesignVariable& variable) {
  return node(std::vector{variable.lower, variable.upper});
}

void write_design(const OptimumProblem& problem, const scene::Scene& /*scene*/, Node::Object& to) {
  std::vector<std::string> over;
  Node::List bounds;
  for (const DesignVariable& variable : problem.over) {
    over.push_back(variable.name);
    bounds.push_back(pair_of(variable));
  }
  to.push_back({"over", node(over)});
  to.push_back({"bounds", {std::move(bounds)}});
}

void add_limits(double at_least, double at_most, Node::Object& object) {
  if (std::isfinite(at_least)) object.push_back({"at_least", node(at_least)});
  if (std::isfinite(at_most)) object.push_back({"at_most", node(at_most)});
}

Node node_of(const std::vector<std::pair<std::string, double>>& values) {
  Node::Object object;
  for (const auto& [name, value] : values) object.push_back({name, node(value)});
  return {std::move(object)};
}

void write_constraints(const OptimumProblem& problem, const scene::Scene& /*scene*/, Node::Object& to) {
  Node::List list;
  for (const ObservableLimit& limit : problem.limits) {
    Node::Object each = {{"observable", node(limit.observable)}};
    add_limits(limit.at_least, limit.at_most, each);
    list.push_back({std::move(each)});
  }
  for (const LinearLimit& limit : problem.linear_limits) {
    Node::Object each = {{"sum", node_of(limit.weights)}};
    add_limits(limit.at_least, limit.at_most, each);
    list.push_back({std::move(each)});
  }
  to.push_back({"constraints", {std::move(list)}});
}

void write_cases(const OptimumProblem& problem, const scene::Scene& scene, Node::Object& to) {
  if (problem.cases.empty()) return;
  Node::List list;
  for (const LoadCase& each : problem.cases) {
    Node::Object object = {{"set", node_of(each.set)}, {"weight", node(each.weight)}};
    if (each.response)
      object.push_back({"response", {Node::Object{place_member(*each.response, scene.dofs)}}});
    list.push_back({std::move(object)});
  }
  to.push_back({"cases", {std::move(list)}});
}

void write_scatter(const OptimumProblem& problem, const scene::Scene& /*scene*/, Node::Object& to) {
  Node::Object scatter;
  for (const DesignVariable& variable : problem.scatter)
    scatter.push_back({variable.name, pair_of(variable)});
  to.push_back({"scatter", {std::move(scatter)}});
}

void drop_from(std::string_view parameter, OptimumProblem& problem) {
  std::erase_if(problem.scatter, [&](const DesignVariable& v) { return v.name == parameter; });
  for (LoadCase& each : problem.cases)
    std::erase_if(each.set, [&](const auto& named) { return named.first == parameter; });
}

void read_along(const Reading& reading, OptimumSettings& settings) {
  const Location place = reading.keys.find("along");
  for (const std::string& key : scene::keys_next_to(KeyType::followed))
    if (place.node == nullptr && reading.keys.has(key))
      reading.faults.add(reading.keys.find(key).pointer, "found the key " + scene::file::quoted(key) +
                                                             " without \"along\", whose range it belongs to");
  if (place.node == nullptr) return;
  DesignVariable along;
  const scene::Field field = read_parameter(place, reading.parameters, along.name, reading.faults);
  std::vector<std::string> nearby;
  for (const char* key : {"constraints", "cases", "scatter"}) {
    const Location other = reading.keys.find(key);
    const auto* list = other.node != nullptr ? other.node->get<Node::List>() : nullptr;
    const auto* object = other.node != nullptr ? other.node->get<Node::Object>() : nullptr;
    if ((list != nullptr && !list->empty()) || (object != nullptr && !object->empty()))
      nearby.emplace_back(key);
  }
  if (!nearby.empty())
    reading.faults.add(place.pointer, "found \"along\" together with " + listed(nearby) +
                                          ", which it does not support; must be given alone");
  const bool is_other =
      !nearby.empty() || is_taken(along.name, place.pointer, taken(settings.problem), reading.faults);
  std::tie(along.lower, along.upper) = read_range(reading, field);
  if (!is_other) settings.along = std::move(along);
}

constexpr std::string_view bounds_schema =
    R"({"type": "array", "items": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}})";
constexpr std::string_view scatter_schema =
    R"({"type": "object", "additionalProperties":
        {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}})";
constexpr std::string_view constraints_schema = R"({"type": "array", "items": {
    "type": "object",
    "properties": {"observable": {"type": "string"},
                   "sum": {"type": "object", "additionalProperties": {"type": "number"}},
                   "at_least": {"type": "number"}, "at_most": {"type": "number"}},
    "additionalProperties": false,
    "oneOf": [{"required": ["observable"]}, {"required": ["sum"]}],
    "anyOf": [{"required": ["at_least"]}, {"required": ["at_most"]}]}})";
constexpr std::string_view cases_schema = R"({"oneOf": [
    {"type": "array", "minItems": 1, "items": {
       "type": "object",
       "properties": {"set": {"type": "object", "additionalProperties": {"type": "number"}},
                      "weight": {"type": "number", "exclusiveMinimum": 0},
                      "response": {"type": "object"}},
       "additionalProperties": false}},
    {"type": "object", "minProperties": 1,
     "additionalProperties": {"type": "array", "items": {"type": "number"}, "minItems": 1}}]})";
constexpr std::string_view number_schema = R"({"type": "number"})";

Key with_schema(Key key, std::string_view schema) {
  key.schema = schema;
  return key;
}

KeyGroup<OptimumSettings> of_problem(KeyGroup<OptimumProblem> group) {
  return within(&OptimumSettings::problem, std::move(group));
}

KeyGroup<OptimumSettings> of_search(KeyGroup<SearchSettings> group) {
  return within(&OptimumSettings::search, std::move(group));
}

void visit_limits(const std::string& pointer, DesignVariable& of, const scene::NumberVisitor& visit) {
  visit(pointer + "/0", of.lower);
  visit(pointer + "/1", of.upper);
}

void add_design(KeysOf<OptimumSettings>& keys) {
  keys.add(of_problem({{{"over", KeyType::parameters, "", "parameters \"part.field\" or constants", "", true,
                         "the design parameters"},
                        with_schema({"bounds", KeyType::other, "parameter", "a pair [lower, upper] for each",
                                     "", true, "lower and upper bound of each"},
                                    bounds_schema)},
                       read_design,
                       write_design,
                       [](const OptimumProblem& problem, std::vector<ParameterUse>& all) {
                         for (ParameterUse& each : taken(problem)) all.push_back(std::move(each));
                       },
                       drop_from,
                       {},
                       [](OptimumProblem& problem, const scene::NumberVisitor& visit) {
                         for (std::size_t k = 0; k < problem.over.size(); ++k)
                           visit_limits("/bounds/" + std::to_string(k), problem.over[k], visit);
                       }}));
  keys.add(of_problem(window(&OptimumProblem::frequency_from, &OptimumProblem::frequency_to)));
}

void add_search(KeysOf<OptimumSettings>& keys) {
  constexpr const char* algorithm = "a string, the name of an NLopt algorithm";
  keys.add(of_search(scene::file::text("algorithm", &SearchSettings::algorithm, algorithm,
                                       "\"" + std::string(default_algorithm) + "\"", "the NLopt algorithm")));
  keys.add(of_search(scene::file::text("local", &SearchSettings::local, algorithm, "",
                                       "the local algorithm of MLSL and AUGLAG, such as LN_BOBYQA")));
  keys.add(of_search(whole("evaluations", &SearchSettings::evaluations, 1, largest_search,
                           "maximum number of design evaluations")));
  keys.add(of_search(scene::file::number(
      &SearchSettings::seconds,
      {.name = "seconds", .unit = "s", .lower = 0, .upper = std::numeric_limits<double>::infinity()},
      "time limit of the search; 0: no limit")));
  keys.add(of_search(whole("population", &SearchSettings::population, 0, largest_search,
                           "population size of stochastic algorithms; 0: their default")));
  keys.add(of_search(whole("seed", &SearchSettings::seed, 0, largest_search,
                           "random seed of stochastic algorithms: the same seed gives the same run")));
  keys.add(
      of_search(whole("starts", &SearchSettings::starts, 1, largest_search,
                      "with several parameters or constraints: maximum number of local searches, which start "
                      "at the scene's own design and at the best of designs spread over the bounds; 1: only "
                      "at its own")));
}

void add_demands(KeysOf<OptimumSettings>& keys) {
  keys.add(of_problem(
      {{with_schema({"constraints", KeyType::other, "", "a list of objects", "[]", false,
                     "limits on observables of the peaks and on linear combinations of parameters"},
                    constraints_schema)},
       read_constraints,
       write_constraints}));
  keys.add(of_problem({{with_schema({"cases", KeyType::other, "", "a list of objects, or lists of values", "",
                                     false, "load cases of the design"},
                                    cases_schema)},
                       read_cases,
                       write_cases}));
  keys.add(of_problem(word("criterion", &OptimumProblem::criterion, criteria,
                           "what is minimized over the cases: the largest weighted amplitude, or the "
                           "weighted mean")));
  keys.add(of_problem(
      {{with_schema({"scatter", KeyType::other, "parameter", "pairs [lower, upper] by parameter", "{}", false,
                     "uncertain parameters, given by bounds; their worst case counts"},
                    scatter_schema)},
       read_scatter,
       write_scatter,
       {},
       {},
       {},
       [](OptimumProblem& problem, const scene::NumberVisitor& visit) {
         for (DesignVariable& each : problem.scatter)
           visit_limits(scene::file::child("/scatter", each.name), each, visit);
       }}));
}

KeyGroup<OptimumSettings> along() {
  return {{{"along", KeyType::followed, "", "a parameter \"part.field\" or a constant", "", false,
            "the parameter over which the optimum is continued"},
           with_schema({"from", KeyType::other, "parameter", "within the parameter's bounds", "", false,
                        "first value of that parameter"},
                       number_schema),
           with_schema({"to", KeyType::other, "parameter", "above \"from\"", "", false,
                        "last value of that parameter"},
                       number_schema)},
          read_along,
          [](const OptimumSettings& settings, const scene::Scene&, Node::Object& to) {
            if (!settings.along) return;
            to.push_back({"along", node(settings.along->name)});
            to.push_back({"from", node(settings.along->lower)});
            to.push_back({"to", node(settings.along->upper)});
          },
          [](const OptimumSettings& settings, std::vector<ParameterUse>& all) {
            if (settings.along) all.push_back({settings.along->name, "which the study goes \"along\""});
          },
          {},
          {},
          [](OptimumSettings& settings, const scene::NumberVisitor& visit) {
            if (!settings.along) return;
            visit("/from", settings.along->lower);
            visit("/to", settings.along->upper);
          }};
}

KeysOf<OptimumSettings> keys() {
  KeysOf<OptimumSettings> keys;
  add_design(keys);
  add_search(keys);
  add_demands(keys);
  keys.add(along());
  keys.check(
      [](const Reading& reading, OptimumSettings& settings) { check_criterion(reading, settings.problem); });
  return keys;
}

studies::Truncation truncation_of(std::span<const OptimumCurveResult> curves) {
  studies::Truncation found;
  for (const OptimumCurveResult& each : curves) {
    studies::add(each.curve.status, each.curve.stop, found);
    for (const OptimumPoint& point : each.curve.points) studies::add(point.response, found);
  }
  return found;
}

studies::Truncation truncation_of(std::span<const OptimumResult> optima) {
  studies::Truncation found;
  for (const OptimumResult& each : optima) {
    studies::add(each.status, each.stop, found);
    studies::add(each.optimum.point, found);
    // Which of equally high peaks is the highest one is a matter of rounding.
    for (const LoadCaseResult& peak : each.optimum.cases)
      if (peak.active) studies::add(peak.point, found);
  }
  return found;
}

// What a computation describes refers to its settings, which it therefore owns.
using SharedSettings = std::shared_ptr<const OptimumSettings>;

std::unique_ptr<studies::Computation> computed_curve(const scene::Scene& scene,
                                                     const SharedSettings& settings) {
  auto of = std::make_unique<studies::ComputationOf<OptimumCurveResult>>(
      described_curves(scene, settings->problem, settings->along->name),
      [settings](const studies::Case& at, const control::Control& control) {
        return std::vector{optimum_curve_study(at.scene, *settings, control)};
      },
      [&scene](std::span<const OptimumCurveResult> all) { return std::vector{figures_of(scene, all)}; });
  of->truncation_of_items = [](std::span<const OptimumCurveResult> all) { return truncation_of(all); };
  return of;
}

std::unique_ptr<studies::Computation> computed_optimum(const scene::Scene& scene,
                                                       const OptimumSettings& given,
                                                       const studies::RunOptions& options) {
  const SharedSettings settings = std::make_shared<const OptimumSettings>(with_places(scene, given));
  check_limits(scene, settings->problem);  // before the first study of a run
  if (settings->along) return computed_curve(scene, settings);
  auto of = std::make_unique<studies::ComputationOf<OptimumResult>>(
      described_optima(scene, settings->problem),
      [settings, curves = options.figures, threads = options.threads](const studies::Case& at,
                                                                      const control::Control& control) {
        return std::vector{
            optimum_study(at.scene, *settings, control,
                          {.curves = curves, .alone = at.alone, .threads = at.alone ? threads : 1})};
      },
      [&scene](std::span<const OptimumResult> all) { return figures_of(scene, all); });
  of->truncation_of_items = [](std::span<const OptimumResult> all) { return truncation_of(all); };
  return of;
}

}  // namespace

std::string_view name(Criterion criterion) {
  return criterion == Criterion::worst ? "worst" : "mean";
}

std::vector<ParameterUse> taken(const OptimumProblem& problem) {
  std::vector<ParameterUse> all;
  for (const DesignVariable& variable : problem.over)
    all.push_back({variable.name, "which the study is \"over\""});
  for (const LoadCase& each : problem.cases)
    for (const auto& value : each.set) all.push_back({value.first, "which \"cases\" set"});
  for (const DesignVariable& variable : problem.scatter)
    all.push_back({variable.name, "which is in \"scatter\""});
  return all;
}

const studies::StudyKind& optimum_type() {
  static const studies::StudyKind kind({.name = "optimum",
                                        .help = "the parameters that minimize the highest resonance peak",
                                        .verb = "optimize",
                                        .coefficients = false},
                                       keys(), computed_optimum);
  return kind;
}

void add_studies(scene::Catalogue& catalogue) {
  catalogue.studies.push_back(scene::lasting<scene::StudyType>(optimum_type()));
}

}  // namespace arcslip::optimize

#include <arcslip/optimize/study/read_settings.hpp>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace arcslip::optimize {

using namespace scene::file;
using scene::Field;

namespace {

std::pair<double, double> read_limits(const Keys& keys, Faults& faults) {
  const Location least = keys.find("at_least"), most = keys.find("at_most");
  const double at_least = read_number(least, any_number, faults).value_or(any_number.lower);
  const double at_most = read_number(most, any_number, faults).value_or(any_number.upper);
  if (least.node == nullptr && most.node == nullptr) {
    faults.add(keys.pointer(), "found neither \"at_least\" nor \"at_most\", must have one of them");
  } else if (!(at_least < at_most)) {
    faults.add(keys.pointer(), "found \"at_least\" " + number_text(at_least) + " and \"at_most\" " +
                                   number_text(at_most) + ", must be the lower and the upper limit");
  }
  return {at_least, at_most};
}

std::vector<std::pair<std::string, double>> read_sum(const Location& place, const OptimumProblem& problem,
                                                     Faults& faults) {
  const std::size_t before = faults.count();
  std::vector<std::pair<std::string, double>> weights;
  std::vector<std::string> known;
  for (const DesignVariable& variable : problem.over) known.push_back(variable.name);
  for (const Member* member : members(place, faults)) {
    const Location item{&member->value, child(place.pointer, member->key)};
    const auto is = [&](const std::string& name) {
      return std::find(known.begin(), known.end(), name) != known.end();
    };
    const std::string name = is(member->key) ? member->key : member->key + ".value";
    if (faults.full()) {
      faults.add({}, {});
    } else if (!is(name)) {
      faults.add(item.pointer, "found " + shown(member->key) +
                                   ", must be one of the parameters that the study is \"over\", " +
                                   listed(known) + hint(member->key, known));
    } else {
      weights.emplace_back(name, read_number(item, any_number, faults).value_or(0));
    }
  }
  const bool any = std::any_of(weights.begin(), weights.end(), [](auto& each) { return each.second != 0; });
  if (!any && faults.count() == before) {
    faults.add(place.pointer,
               "found no weight other than 0, must have one for at least one of " + listed(known));
  }
  return weights;
}

}  // namespace

void read_design(const Reading& reading, OptimumProblem& problem) {
  const Keys& keys = reading.keys;
  Faults& faults = reading.faults;
  constexpr std::string_view names = "a list of at least one parameter \"part.field\" or constant";
  constexpr std::string_view pairs = "a list of pairs [lower, upper], one for each parameter of \"over\"";
  const Location over = keys.require("over", std::string(names), faults);
  const Location bounds = keys.require("bounds", std::string(pairs), faults);
  const Node::List* parameters = read_list(over, names, faults);
  const Node::List* ranges = read_list(bounds, pairs, faults);
  if (parameters != nullptr && parameters->empty())
    faults.add(over.pointer, "found an empty list, must be " + std::string(names));
  if (parameters != nullptr && ranges != nullptr && parameters->size() != ranges->size()) {
    faults.add(bounds.pointer, "found " + std::to_string(ranges->size()) + " for " +
                                   std::to_string(parameters->size()) + " in \"over\", must be " +
                                   std::string(pairs));
  }
  for (std::size_t i = 0; parameters != nullptr && i < parameters->size(); ++i) {
    const Location item{&(*parameters)[i], child(over.pointer, i)};
    DesignVariable variable;
    const Field field = read_parameter(item, reading.parameters, variable.name, faults);
    const bool again = std::any_of(problem.over.begin(), problem.over.end(),
                                   [&](const DesignVariable& other) { return other.name == variable.name; });
    if (again && !variable.name.empty())
      faults.add(item.pointer, "found " + shown(variable.name) + " again, must be named once");
    if (ranges != nullptr && i < ranges->size()) {
      std::tie(variable.lower, variable.upper) =
          read_pair(reading, {&(*ranges)[i], child(bounds.pointer, i)},
                    "a pair [lower, upper], each " + allowed_text(field), field, "bound");
    }
    problem.over.push_back(std::move(variable));
  }
}

void read_constraints(const Reading& reading, OptimumProblem& problem) {
  const Location place = reading.keys.find("constraints");
  Faults& faults = reading.faults;
  if (place.node == nullptr) return;
  const Node::List* list = read_list(place, "a list of objects", faults);
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const Location item{&(*list)[i], child(place.pointer, i)};
    const Keys keys(item, {"observable", "sum", "at_least", "at_most"}, faults);
    if (!keys.is_object()) continue;
    if (keys.has("observable") == keys.has("sum")) {
      faults.add(item.pointer, keys.has("sum")
                                   ? "found \"observable\" and \"sum\" together, must have one of them"
                                   : "found neither \"observable\" nor \"sum\", must have one of them");
    }
    const auto [at_least, at_most] = read_limits(keys, faults);
    if (keys.has("sum")) {
      problem.linear_limits.push_back({read_sum(keys.find("sum"), problem, faults), at_least, at_most});
    } else {
      constexpr std::string_view wanted = "a string, such as \"energy_friction\" or \"damper.stick_percent\"";
      problem.limits.push_back(
          {read_string(keys.find("observable"), wanted, faults).value_or(""), at_least, at_most});
    }
  }
}

using namespace scene::file;
using scene::Field;

namespace {

constexpr int largest_cases = 1000;

// The product of the lists, the last one fastest.
void add_product(const Location& place, const Reading& reading, OptimumProblem& problem) {
  Faults& faults = reading.faults;
  const auto lists = read_value_lists(place, reading.parameters, taken(problem), faults);
  if (lists.empty()) return;
  std::size_t count = 1;
  for (const auto& list : lists) {
    count *= list.second.size();
    if (count > largest_cases || lists.size() > largest_cases) {
      faults.add(place.pointer,
                 "found more than " + std::to_string(largest_cases) +
                     " cases, which are all combinations of the values, or parameters; must be at most " +
                     std::to_string(largest_cases));
      return;
    }
  }
  std::vector<LoadCase> cases(1);
  for (const auto& [parameter, values] : lists) {
    std::vector<LoadCase> longer;
    for (const LoadCase& each : cases) {
      for (const double value : values) {
        longer.push_back(each);
        longer.back().set.emplace_back(parameter, value);
      }
    }
    cases = std::move(longer);
  }
  problem.cases = std::move(cases);
}

LoadCase read_case(const Location& place, const Reading& reading,
                   const std::vector<scene::ParameterUse>& already) {
  Faults& faults = reading.faults;
  LoadCase one;
  const Keys keys(place, {"set", "weight", "response"}, faults);
  const Location set = keys.find("set"), response = keys.find("response");
  for (const Member* member : members(set, faults)) {
    const Location item{&member->value, child(set.pointer, member->key)};
    const std::size_t before = faults.count();
    std::string parameter = member->key;
    const Field field = bounds_of(parameter, item.pointer, reading.parameters, faults);
    if (faults.count() == before && !is_taken(parameter, item.pointer, already, faults))
      one.set.emplace_back(parameter, read_number(item, field, faults).value_or(0));
  }
  const Field weight{.name = "weight",
                     .unit = "-",
                     .lower = 0,
                     .upper = std::numeric_limits<double>::infinity(),
                     .lower_open = true};
  one.weight = read_number(keys.find("weight"), weight, faults).value_or(one.weight);
  if (response.node != nullptr) {
    one.response =
        read_direction(Keys(response, {"at", "between", "direction"}, faults), reading.dofs, faults);
  }
  return one;
}

}  // namespace

void read_cases(const Reading& reading, OptimumProblem& problem) {
  const Location place = reading.keys.find("cases");
  Faults& faults = reading.faults;
  constexpr std::string_view wanted =
      "a list of at least one object with the keys \"set\", \"weight\", \"response\", or an object with a "
      "list of values for each of its parameters";
  if (place.node == nullptr) return;
  const auto* object = place.node->get<Node::Object>();
  const auto* list = place.node->get<Node::List>();
  if (object == nullptr && list == nullptr) {
    add_wrong_type(place, wanted, faults);
  } else if (object != nullptr ? object->empty() : list->empty()) {
    faults.add(place.pointer,
               std::string(object != nullptr ? "found an empty object" : "found an empty list") +
                   ", must be " + std::string(wanted));
  } else if (object != nullptr) {
    add_product(place, reading, problem);
  } else if (list->size() > largest_cases) {
    faults.add(place.pointer, "found " + std::to_string(list->size()) + " cases, must be at most " +
                                  std::to_string(largest_cases));
  } else {
    const std::vector<scene::ParameterUse> already = taken(problem);
    std::vector<LoadCase> cases;
    for (std::size_t i = 0; i < list->size(); ++i)
      cases.push_back(read_case({&(*list)[i], child(place.pointer, i)}, reading, already));
    problem.cases = std::move(cases);
  }
}

void read_scatter(const Reading& reading, OptimumProblem& problem) {
  const Location place = reading.keys.find("scatter");
  Faults& faults = reading.faults;
  const std::vector<scene::ParameterUse> already = taken(problem);
  std::vector<DesignVariable> scatter;
  for (const Member* member : members(place, faults)) {
    const Location item{&member->value, child(place.pointer, member->key)};
    const std::size_t before = faults.count();
    std::string parameter = member->key;
    const Field field = bounds_of(parameter, item.pointer, reading.parameters, faults);
    if (faults.count() == before && !is_taken(parameter, item.pointer, already, faults)) {
      DesignVariable& variable = scatter.emplace_back(DesignVariable{parameter});
      std::tie(variable.lower, variable.upper) =
          read_pair(reading, item, "a pair [lower, upper], each " + allowed_text(field), field, "bound");
    }
  }
  problem.scatter = std::move(scatter);
}

void check_criterion(const Reading& reading, const OptimumProblem& problem) {
  const Location place = reading.keys.find("criterion");
  if (problem.criterion != Criterion::mean) return;
  if (!problem.scatter.empty()) {
    reading.faults.add(
        place.pointer,
        "found \"mean\" together with \"scatter\", which takes the worst case; must be \"worst\"");
  } else if (!reading.keys.has("cases")) {
    reading.faults.add(place.pointer, "found \"mean\" without \"cases\"; must be \"worst\"");
  }
}

}  // namespace arcslip::optimize

#include <arcslip/optimize/read_settings.hpp>

#include <limits>
#include <tuple>
#include <utility>

namespace arcslip::optimize {

using namespace scene::file;
using scene::Field;

namespace {

constexpr int largest_cases = 1000;

// The product of the lists, the last one fastest.
void add_product(const Place& place, const Reading& reading, OptimumProblem& problem) {
  Faults& faults = reading.faults;
  const auto lists = read_value_lists(place, reading.parameters, taken(problem), faults);
  if (lists.empty()) {
    return;
  }
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
  std::vector<DesignCase> cases(1);
  for (const auto& [parameter, values] : lists) {
    std::vector<DesignCase> longer;
    for (const DesignCase& each : cases) {
      for (const double value : values) {
        longer.push_back(each);
        longer.back().set.emplace_back(parameter, value);
      }
    }
    cases = std::move(longer);
  }
  problem.cases = std::move(cases);
}

DesignCase read_case(const Place& place, const Reading& reading, const std::vector<scene::Taken>& already) {
  Faults& faults = reading.faults;
  DesignCase one;
  const Keys keys(place, {"set", "weight", "response"}, faults);
  const Place set = keys.find("set"), response = keys.find("response");
  for (const Member* member : members(set, faults)) {
    const Place item{&member->value, child(set.pointer, member->key)};
    const std::size_t before = faults.count();
    const Field field = bounds_of(member->key, item.pointer, reading.parameters, faults);
    if (faults.count() == before && !is_taken(member->key, item.pointer, already, faults)) {
      one.set.emplace_back(member->key, read_number(item, field, faults).value_or(0));
    }
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
  const Place place = reading.keys.find("cases");
  Faults& faults = reading.faults;
  constexpr std::string_view wanted =
      "a list of at least one object with the keys \"set\", \"weight\", \"response\", or an object with a "
      "list "
      "of values for each of its parameters";
  if (place.node == nullptr) {
    return;
  }
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
    const std::vector<scene::Taken> already = taken(problem);
    std::vector<DesignCase> cases;
    for (std::size_t i = 0; i < list->size(); ++i) {
      cases.push_back(read_case({&(*list)[i], child(place.pointer, i)}, reading, already));
    }
    problem.cases = std::move(cases);
  }
}

void read_scatter(const Reading& reading, OptimumProblem& problem) {
  const Place place = reading.keys.find("scatter");
  Faults& faults = reading.faults;
  const std::vector<scene::Taken> already = taken(problem);
  std::vector<DesignVariable> scatter;
  for (const Member* member : members(place, faults)) {
    const Place item{&member->value, child(place.pointer, member->key)};
    const std::size_t before = faults.count();
    const Field field = bounds_of(member->key, item.pointer, reading.parameters, faults);
    if (faults.count() == before && !is_taken(member->key, item.pointer, already, faults)) {
      DesignVariable& variable = scatter.emplace_back(DesignVariable{member->key});
      std::tie(variable.lower, variable.upper) =
          read_pair(item, "a pair [lower, upper], each " + allowed_text(field), field, "bound", faults);
    }
  }
  problem.scatter = std::move(scatter);
}

void check_criterion(const Reading& reading, const OptimumProblem& problem) {
  const Place place = reading.keys.find("criterion");
  if (problem.criterion != Criterion::mean) {
    return;
  }
  if (!problem.scatter.empty()) {
    reading.faults.add(place.pointer,
                       "found \"mean\" beside \"scatter\", of which the worst counts; must be \"worst\"");
  } else if (!reading.keys.has("cases")) {
    reading.faults.add(place.pointer, "found \"mean\" without \"cases\", of which it is; must be \"worst\"");
  }
}

}  // namespace arcslip::optimize

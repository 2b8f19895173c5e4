#include <arcslip/scene/read_design.hpp>

#include <algorithm>
#include <limits>
#include <tuple>

namespace arcslip::scene::detail {

void read_design(const Keys& keys, const Parameters& all, Study& study, Faults& faults) {
  constexpr std::string_view names = "a list of at least one parameter \"part.field\" or tie";
  constexpr std::string_view pairs = "a list of pairs [lower, upper], one for each parameter of \"over\"";
  const Place over = keys.require("over", std::string(names), faults);
  const Place bounds = keys.require("bounds", std::string(pairs), faults);
  const Node::List* parameters = read_list(over, names, faults);
  const Node::List* ranges = read_list(bounds, pairs, faults);
  if (parameters != nullptr && parameters->empty()) {
    faults.add(over.pointer, "found an empty list, must be " + std::string(names));
  }
  if (parameters != nullptr && ranges != nullptr && parameters->size() != ranges->size()) {
    faults.add(bounds.pointer, "found " + std::to_string(ranges->size()) + " for " +
                                   std::to_string(parameters->size()) + " in \"over\", must be " +
                                   std::string(pairs));
  }
  for (std::size_t i = 0; parameters != nullptr && i < parameters->size(); ++i) {
    const Place item{&(*parameters)[i], child(over.pointer, i)};
    DesignVariable variable;
    const Field field = read_parameter(item, all, variable.name, faults);
    const bool again = std::any_of(study.design.begin(), study.design.end(),
                                   [&](const DesignVariable& other) { return other.name == variable.name; });
    if (again && !variable.name.empty()) {
      faults.add(item.pointer, "found " + shown(variable.name) + " again, must be named once");
    }
    if (ranges != nullptr && i < ranges->size()) {
      std::tie(variable.lower, variable.upper) =
          read_pair({&(*ranges)[i], child(bounds.pointer, i)},
                    "a pair [lower, upper], each " + allowed_text(field), field, "bound", faults);
    }
    study.design.push_back(std::move(variable));
  }
}

void read_constraints(const Place& place, Study& study, Faults& faults) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (place.node == nullptr) {
    return;
  }
  const Node::List* list = read_list(place, "a list of objects", faults);
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const Place item{&(*list)[i], child(place.pointer, i)};
    const Keys keys(item, {"observable", "at_least", "at_most"}, faults);
    if (!keys.is_object()) {
      continue;
    }
    constexpr std::string_view wanted = "a string, such as \"energy_friction\" or \"damper.stick_percent\"";
    ObservableLimit limit;
    limit.observable =
        read_string(keys.require("observable", std::string(wanted), faults), wanted, faults).value_or("");
    const Field any{.name = "limit", .unit = "-", .lower = -infinity, .upper = infinity};
    const Place least = keys.find("at_least"), most = keys.find("at_most");
    if (least.node != nullptr) {
      limit.at_least = read_number(least, any, faults).value_or(limit.at_least);
    }
    if (most.node != nullptr) {
      limit.at_most = read_number(most, any, faults).value_or(limit.at_most);
    }
    if (least.node == nullptr && most.node == nullptr) {
      faults.add(item.pointer, "found neither \"at_least\" nor \"at_most\", must have one of them");
    } else if (!(limit.at_least < limit.at_most)) {
      faults.add(item.pointer, "found \"at_least\" " + number_text(limit.at_least) + " and \"at_most\" " +
                                   number_text(limit.at_most) + ", must be the lower and the upper limit");
    }
    study.constraints.push_back(std::move(limit));
  }
}

}  // namespace arcslip::scene::detail

#include <arcslip/scene/study_parameters.hpp>
#include <arcslip/scene/words.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::scene::file {
namespace {

constexpr int largest_range = 100'000;  // values

// What every one of the fields allows.
Field common(const std::vector<const Field*>& fields) {
  Field all = *fields.front();
  for (const Field* field : fields) {
    if (field->lower > all.lower) {
      all.lower = field->lower;
      all.lower_open = field->lower_open;
    } else if (field->lower == all.lower) {
      all.lower_open = all.lower_open || field->lower_open;
    }
    all.upper = std::min(all.upper, field->upper);
  }
  return all;
}

// {"from": 1, "to": 100, "count": 21, "spacing": "logarithmic"}
std::vector<double> read_range(const Location& place, const std::vector<const Field*>& fields,
                               Faults& faults) {
  const std::size_t before = faults.count();
  const Field bounds = fields.empty() || fields.front() == nullptr ? any_number : common(fields);
  const Keys keys(place, {"from", "to", "count", "spacing"}, faults);
  const auto from = read_number(keys.require("from", allowed_text(bounds), faults), bounds, faults);
  const auto to = read_number(keys.require("to", allowed_text(bounds), faults), bounds, faults);
  const auto count =
      read_integer(keys.require("count", "an integer from 2 to " + std::to_string(largest_range), faults), 2,
                   largest_range, faults);
  const auto spacing = read_choice(keys.find("spacing"), spacings, Spacing::linear, faults);
  if (faults.count() > before || !from || !to || !count) return {};
  const bool logarithmic = spacing == Spacing::logarithmic;
  if (logarithmic && !(*from > 0 && *to > 0)) {
    faults.add(keys.find(*from > 0 ? "to" : "from").pointer,
               "found " + number_text(*from > 0 ? *to : *from) +
                   ", must be above 0 where the spacing is \"logarithmic\"");
    return {};
  }
  if (*from == *to) {
    faults.add(keys.find("to").pointer, "found " + number_text(*to) + ", must differ from \"from\"");
    return {};
  }
  std::vector<double> values;
  for (int i = 0; i < *count; ++i) {
    const double share = i / (*count - 1.0);
    const double value =
        logarithmic ? *from * std::pow(*to / *from, share) : (1 - share) * *from + share * *to;
    values.push_back(std::clamp(value, std::min(*from, *to), std::max(*from, *to)));
  }
  values.back() = *to;
  return values;
}

std::vector<double> read_values(const Location& place, const std::vector<const Field*>& fields,
                                Faults& faults) {
  constexpr std::string_view wanted = "a list of at least one number";
  if (place.node != nullptr && place.node->get<Node::Object>() != nullptr)
    return read_range(place, fields, faults);
  std::vector<double> values;
  const Node::List* list = read_list(place, wanted, faults);
  if (list != nullptr && list->empty())
    faults.add(place.pointer, "found an empty list, must be " + std::string(wanted));
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const Node& node = (*list)[i];
    const auto* number = node.get<double>();
    const auto bad = std::find_if(fields.begin(), fields.end(), [&](const Field* field) {
      return number == nullptr || !within(*field, *number);
    });
    if (number != nullptr && bad == fields.end())
      values.push_back(*number);
    else if (bad != fields.end())
      read_number({&node, child(place.pointer, i)}, **bad, faults);
    else
      add_wrong_type({&node, child(place.pointer, i)}, "a number", faults);
  }
  return values;
}

}  // namespace

Parameters::Parameters(const std::vector<Tie>& all_ties, bool complete, const Names& all_names)
    : ties(all_ties), ties_complete(complete), names(all_names) {
  for (const Tie& tie : ties) {
    tie_by_name.emplace(tie.name, &tie);
    for (const std::string& member : tie.members) tie_of_field.emplace(member, &tie);
  }
}

std::vector<const Field*> fields_of(const std::string& parameter, const std::string& pointer,
                                    const Parameters& all, Faults& faults) {
  const auto tied = all.tie_of_field.find(parameter);
  if (tied != all.tie_of_field.end()) {
    faults.add(pointer,
               "found " + shown(parameter) + ", which is tied; must be its tie " + shown(tied->second->name));
    return {};
  }
  const auto tie = all.tie_by_name.find(parameter);
  Faults ignored;
  std::vector<const Field*> fields;
  if (tie != all.tie_by_name.end()) {
    for (const std::string& member : tie->second->members)
      fields.push_back(all.names.field(member, pointer, ignored));
  } else if (all.names.may_exist(parameter) ||
             (!all.ties_complete && parameter.find('.') == std::string::npos)) {
    return {};  // it may belong to what could not be read
  } else if (const Field* field = all.names.field(parameter, pointer, ignored)) {
    fields.push_back(field);
  } else if (!faults.full()) {
    std::vector<std::string> known;
    for (const Tie& each : all.ties) known.push_back(each.name);
    known.insert(known.end(), all.names.fields().begin(), all.names.fields().end());
    faults.add(pointer, "found the unknown parameter " + shown(parameter) + ", must be one of " +
                            listed(known) + hint(parameter, known));
  } else {
    faults.add({}, {});
  }
  return fields;
}

std::string with_unit(double value, const Field& field) {
  return number_text(value) + (field.unit == "-" ? "" : " " + std::string(field.unit));
}

Field bounds_of(const std::string& parameter, const std::string& pointer, const Parameters& all,
                Faults& faults) {
  const auto fields = fields_of(parameter, pointer, all, faults);
  const bool known = !fields.empty() && std::find(fields.begin(), fields.end(), nullptr) == fields.end();
  return known ? common(fields) : any_number;
}

bool is_taken(const std::string& parameter, const std::string& pointer, const std::vector<Taken>& taken,
              Faults& faults) {
  const auto found = std::find_if(taken.begin(), taken.end(),
                                  [&](const Taken& each) { return each.parameter == parameter; });
  if (found != taken.end())
    faults.add(pointer, "found " + shown(parameter) + ", " + found->how + "; must be another parameter");
  return found != taken.end();
}

Field read_parameter(const Location& place, const Parameters& all, std::string& parameter, Faults& faults) {
  constexpr std::string_view wanted = "a string, the parameter \"part.field\" or tie that is varied";
  const auto over = read_string(place, wanted, faults);
  if (!over) return any_number;
  parameter = *over;
  if (*over == "frequency") {
    faults.add(
        place.pointer,
        "found \"frequency\", must be another parameter; over the frequency is a study of kind \"frf\"");
    return any_number;
  }
  if (std::find(result_names.begin(), result_names.end(), *over) != result_names.end()) {
    faults.add(place.pointer,
               "found " + shown(*over) +
                   ", by which results name a quantity of their own; must be a tie of another name");
    return any_number;
  }
  return bounds_of(*over, place.pointer, all, faults);
}

ValueLists read_value_lists(const Location& place, const Parameters& all, const std::vector<Taken>& taken,
                            Faults& faults) {
  ValueLists lists;
  for (const Member* member : members(place, faults)) {
    const Location item{&member->value, child(place.pointer, member->key)};
    const auto fields = fields_of(member->key, item.pointer, all, faults);
    if (fields.empty() || !is_taken(member->key, item.pointer, taken, faults))
      lists.emplace_back(member->key, read_values(item, fields, faults));
  }
  return lists;
}

std::pair<double, double> read_pair(const Location& place, const std::string& wanted, const Field& field,
                                    std::string_view what, Faults& faults) {
  const Node::List* list = read_list(place, wanted, faults);
  if (list == nullptr) return {};
  if (list->size() != 2) {
    faults.add(place.pointer, "found a list of " + std::to_string(list->size()) + ", must be " + wanted);
    return {};
  }
  const auto lower = read_number({&list->front(), child(place.pointer, std::size_t{0})}, field, faults);
  const auto upper = read_number({&list->back(), child(place.pointer, std::size_t{1})}, field, faults);
  if (lower && upper && !(*lower < *upper)) {
    faults.add(child(place.pointer, std::size_t{1}), "found " + number_text(*upper) +
                                                         ", must be above the lower " + std::string(what) +
                                                         ", which is " + with_unit(*lower, field));
  }
  return {lower.value_or(0), upper.value_or(0)};
}

}  // namespace arcslip::scene::file

#include <arcslip/scene/formulas.hpp>
#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/study_parameters.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::scene::file {
namespace {

constexpr int largest_range = 100'000;  // values

// {"from": 1, "to": 100, "count": 21, "spacing": "logarithmic"}
std::vector<double> read_spaced_values(const Location& place, const Field& bounds, Faults& faults) {
  const std::size_t before = faults.count();
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

std::vector<double> read_value_list(const Location& place, const Field& bounds, Faults& faults) {
  constexpr std::string_view wanted = "a list of at least one number";
  if (place.node != nullptr && place.node->get<Node::Object>() != nullptr)
    return read_spaced_values(place, bounds, faults);
  std::vector<double> values;
  const Node::List* list = read_list(place, wanted, faults);
  if (list != nullptr && list->empty())
    faults.add(place.pointer, "found an empty list, must be " + std::string(wanted));
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i)
    if (const auto number = read_number({&(*list)[i], child(place.pointer, i)}, bounds, faults))
      values.push_back(*number);
  return values;
}

// All parameters that are there.
std::vector<std::string> known_parameters(const Parameters& all) {
  std::vector<std::string> known;
  for (const Constant& constant : all.scene.constants) known.push_back(constant.name);
  known.insert(known.end(), all.names.fields().begin(), all.names.fields().end());
  return known;
}

void add_follower_fault(const Scene& scene, const std::string& parameter, const NumberText& formula,
                        const std::string& pointer, Faults& faults) {
  faults.add(pointer, "found " + shown(parameter) + ", which is given by the formula " + shown(formula.text) +
                          "; must be what that follows: " + listed(independent_parameters(scene, formula)));
}

}  // namespace

const Parameters& no_parameters() {
  static const Scene scene;
  static const Names names;
  static const Parameters none{scene, true, names};
  return none;
}

std::optional<Field> field_of(std::string& parameter, const std::string& pointer, const Parameters& all,
                              Faults& faults) {
  const auto& constants = all.scene.constants;
  const bool is_constant = std::any_of(constants.begin(), constants.end(),
                                       [&](const Constant& each) { return each.name == parameter; });
  const bool bare = parameter.find('.') == std::string::npos;
  Faults ignored;
  const Field* field = nullptr;
  if (!is_constant) {
    if (all.names.may_exist(parameter) || (!all.constants_complete && bare)) return {};
    if (bare && all.names.field(parameter + ".value", pointer, ignored) != nullptr) parameter += ".value";
    field = all.names.field(parameter, pointer, ignored);
    if (field == nullptr && faults.full()) faults.add({}, {});
    if (field == nullptr && !faults.full()) {
      const std::vector<std::string> known = known_parameters(all);
      faults.add(pointer, "found the unknown parameter " + shown(parameter) + ", must be one of " +
                              listed(known) + hint(parameter, known));
    }
    if (field == nullptr) return {};
  }
  if (parameter_of(all.scene, parameter).empty()) return *field;  // of a part with a fault
  if (const NumberText* formula = parameter_formula(all.scene, parameter)) {
    add_follower_fault(all.scene, parameter, *formula, pointer, faults);
    return {};
  }
  return is_constant ? parameter_field(all.scene, parameter) : *field;
}

std::optional<double> read_followed_number(const Location& place, const Field& field,
                                           const std::string& study, const Parameters& all, Faults& faults) {
  const auto given = read_given_number(place, field, faults);
  if (!given) return {};
  if (!given->follows) return given->value;
  if (all.texts == nullptr) return read_number(place, field, faults);  // which says so
  try {
    NumberText formula = read_formula(all.scene, given->text);
    if (std::isnan(value(all.scene, formula)) && faults.count() > 0)
      return {};  // it follows what has a fault
    if (const std::string why = objection_to(all.scene, field, formula); !why.empty()) {
      faults.add(place.pointer, why);
      return {};
    }
    all.texts->emplace_back(place.pointer.substr(study.size()), formula);
    return value(all.scene, formula);
  } catch (const formula::FormulaError& error) {
    if (!all.names.may_exist(error.fault().name))
      add_formula_fault(error, place.pointer, known_parameters(all), faults);
  }
  return {};
}

std::string with_unit(double value, const Field& field) {
  return number_text(value) + (field.unit == "-" || field.unit.empty() ? "" : " " + std::string(field.unit));
}

Field bounds_of(std::string& parameter, const std::string& pointer, const Parameters& all, Faults& faults) {
  return field_of(parameter, pointer, all, faults).value_or(any_number);
}

bool is_taken(const std::string& parameter, const std::string& pointer,
              const std::vector<ParameterUse>& taken, Faults& faults) {
  const auto found = std::find_if(taken.begin(), taken.end(),
                                  [&](const ParameterUse& each) { return each.parameter == parameter; });
  if (found != taken.end())
    faults.add(pointer, "found " + shown(parameter) + ", " + found->how + "; must be another parameter");
  return found != taken.end();
}

Field read_parameter(const Location& place, const Parameters& all, std::string& parameter, Faults& faults) {
  constexpr std::string_view wanted = "a string, the parameter \"part.field\" or constant that is varied";
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
                   ", by which results name a quantity of their own; must be a constant of another name");
    return any_number;
  }
  return bounds_of(parameter, place.pointer, all, faults);
}

ValueLists read_value_lists(const Location& place, const Parameters& all,
                            const std::vector<ParameterUse>& taken, Faults& faults) {
  ValueLists lists;
  for (const Member* member : members(place, faults)) {
    const Location item{&member->value, child(place.pointer, member->key)};
    std::string parameter = member->key;
    const auto field = field_of(parameter, item.pointer, all, faults);
    if (!field || !is_taken(parameter, item.pointer, taken, faults))
      lists.emplace_back(parameter, read_value_list(item, field.value_or(any_number), faults));
  }
  return lists;
}

namespace {

// The values of one row, in the order of the first.
class ParameterRows {
 public:
  ParameterRows(const Parameters& all, const std::vector<ParameterUse>& taken, Faults& faults)
      : all_(all), taken_(taken), faults_(faults) {}

  void read_first(const Location& place) {
    Faults reported_below;
    for (const Member* member : members(place, reported_below)) {
      const std::string pointer = child(place.pointer, member->key);
      std::string parameter = member->key;
      bounds_.push_back(bounds_of(parameter, pointer, all_, faults_));
      is_taken(parameter, pointer, taken_, faults_);
      index_.emplace(member->key, lists_.size());
      lists_.emplace_back(std::move(parameter), std::vector<double>());
    }
    if (lists_.empty() && place.node->get<Node::Object>() != nullptr)
      faults_.add(place.pointer,
                  "found no parameter, must be an object with a value of each of some parameters");
    read(place);
  }

  void read(const Location& place) {
    if (!Keys(place, {}, faults_).is_object()) return;
    std::vector<double> values(lists_.size(), std::numeric_limits<double>::quiet_NaN());
    std::vector<bool> given(lists_.size());
    Faults reported_above;
    for (const Member* member : members(place, reported_above)) {
      const Location item{&member->value, child(place.pointer, member->key)};
      const auto k = index_.find(member->key);
      if (k == index_.end()) {
        faults_.add(item.pointer,
                    "found " + shown(member->key) + ", must be one of the parameters of the first row");
        continue;
      }
      given[k->second] = true;
      values[k->second] = read_number(item, bounds_[k->second], faults_).value_or(0);
    }
    for (std::size_t k = 0; k < lists_.size(); ++k) {
      if (!given[k])
        faults_.add(place.pointer,
                    "found no value of " + shown(lists_[k].first) + ", which the first row has");
      lists_[k].second.push_back(values[k]);
    }
  }

  ValueLists take() { return std::move(lists_); }

 private:
  const Parameters& all_;
  const std::vector<ParameterUse>& taken_;
  Faults& faults_;
  ValueLists lists_;
  std::vector<Field> bounds_;
  std::unordered_map<std::string, std::size_t> index_;
};

}  // namespace

ValueLists read_rows(const Location& place, const Node::List& list, const Parameters& all,
                     const std::vector<ParameterUse>& taken, Faults& faults) {
  if (list.empty())
    faults.add(place.pointer,
               "found an empty list, must be a list of at least one row {\"part.field\": value}");
  ParameterRows rows(all, taken, faults);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Location row{&list[i], child(place.pointer, i)};
    i == 0 ? rows.read_first(row) : rows.read(row);
  }
  return rows.take();
}

std::vector<std::pair<std::string, std::string>> read_labels(const Location& place, const Parameters& all,
                                                             Faults& faults) {
  std::vector<std::pair<std::string, std::string>> labels;
  for (const Member* member : members(place, faults)) {
    const Location item{&member->value, child(place.pointer, member->key)};
    const std::vector<std::string> quantities(label_names.begin(), label_names.end());
    std::string axis = member->key;
    if (std::find(quantities.begin(), quantities.end(), axis) == quantities.end()) {
      const bool is_name = axis.find('.') != std::string::npos || !parameter_of(all.scene, axis).empty();
      if (all.constants_complete && !is_name)
        faults.add(item.pointer, "found " + shown(axis) + ", must be a parameter, or one of " +
                                     listed(quantities) + hint(axis, quantities));
      else if (parameter_of(all.scene, axis).empty() || parameter_formula(all.scene, axis) == nullptr)
        field_of(axis, item.pointer, all, faults);
    }
    const auto text = read_string(item, "a string, the label of an axis", faults);
    if (text && text->empty())
      faults.add(item.pointer, "found \"\", must be a label of at least one character");
    labels.emplace_back(axis, text.value_or(""));
  }
  return labels;
}

}  // namespace arcslip::scene::file

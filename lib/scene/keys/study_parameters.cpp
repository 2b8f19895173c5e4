#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/study_parameters.hpp>

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
std::vector<double> read_spaced_values(const Location& place, const std::vector<const Field*>& fields,
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

std::vector<double> read_value_list(const Location& place, const std::vector<const Field*>& fields,
                                    Faults& faults) {
  constexpr std::string_view wanted = "a list of at least one number";
  if (place.node != nullptr && place.node->get<Node::Object>() != nullptr)
    return read_spaced_values(place, fields, faults);
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

bool is_taken(const std::string& parameter, const std::string& pointer,
              const std::vector<ParameterUse>& taken, Faults& faults) {
  const auto found = std::find_if(taken.begin(), taken.end(),
                                  [&](const ParameterUse& each) { return each.parameter == parameter; });
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

ValueLists read_value_lists(const Location& place, const Parameters& all,
                            const std::vector<ParameterUse>& taken, Faults& faults) {
  ValueLists lists;
  for (const Member* member : members(place, faults)) {
    const Location item{&member->value, child(place.pointer, member->key)};
    const auto fields = fields_of(member->key, item.pointer, all, faults);
    if (fields.empty() || !is_taken(member->key, item.pointer, taken, faults))
      lists.emplace_back(member->key, read_value_list(item, fields, faults));
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
      const Field bounds = bounds_of(member->key, pointer, all_, faults_);
      is_taken(member->key, pointer, taken_, faults_);
      index_.emplace(member->key, lists_.size());
      bounds_.push_back(bounds);
      lists_.emplace_back(member->key, std::vector<double>());
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

void read_for_each(const Location& place, const Parameters& all, const std::vector<ParameterUse>& taken,
                   Study& study, Faults& faults) {
  if (are_samples(place, all)) {
    study.samples = read_samples(place, all, taken, faults);
    return;
  }
  const Node::List* list = place.node != nullptr ? place.node->get<Node::List>() : nullptr;
  if (list == nullptr) {
    study.for_each = read_value_lists(place, all, taken, faults);
    return;
  }
  if (list->empty())
    faults.add(place.pointer,
               "found an empty list, must be a list of at least one row {\"part.field\": value}");
  ParameterRows rows(all, taken, faults);
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Location row{&(*list)[i], child(place.pointer, i)};
    i == 0 ? rows.read_first(row) : rows.read(row);
  }
  study.for_each = rows.take();
  study.in_rows = !study.for_each.empty();
}

std::vector<std::pair<std::string, std::string>> read_labels(const Location& place, const Parameters& all,
                                                             Faults& faults) {
  std::vector<std::pair<std::string, std::string>> labels;
  for (const Member* member : members(place, faults)) {
    const Location item{&member->value, child(place.pointer, member->key)};
    const std::vector<std::string> quantities(label_names.begin(), label_names.end());
    if (std::find(quantities.begin(), quantities.end(), member->key) == quantities.end()) {
      if (all.ties_complete && member->key.find('.') == std::string::npos &&
          !all.tie_by_name.contains(member->key))
        faults.add(item.pointer, "found " + shown(member->key) + ", must be a parameter, or one of " +
                                     listed(quantities) + hint(member->key, quantities));
      else
        fields_of(member->key, item.pointer, all, faults);
    }
    const auto text = read_string(item, "a string, the label of an axis", faults);
    if (text && text->empty())
      faults.add(item.pointer, "found \"\", must be a label of at least one character");
    labels.emplace_back(member->key, text.value_or(""));
  }
  return labels;
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

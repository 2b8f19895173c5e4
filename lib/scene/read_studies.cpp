#include <arcslip/scene/read_studies.hpp>
#include <arcslip/scene/words.hpp>

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace arcslip::scene::detail {
namespace {

// Where the parameters of a scene are looked up by name.
struct Parameters {
  const std::vector<Tie>& ties;
  bool ties_complete;
  const Names& names;
  std::unordered_map<std::string_view, const Tie*> tie_by_name, tie_of_field;
};

// The fields that a value for this parameter must suit; empty where a fault is told.
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
    for (const std::string& member : tie->second->members) {
      fields.push_back(all.names.field(member, pointer, ignored));
    }
  } else if (all.names.may_exist(parameter) ||
             (!all.ties_complete && parameter.find('.') == std::string::npos)) {
    return {};  // it may belong to what could not be read
  } else if (const Field* field = all.names.field(parameter, pointer, ignored)) {
    fields.push_back(field);
  } else if (!faults.full()) {
    std::vector<std::string> known;
    for (const Tie& each : all.ties) {
      known.push_back(each.name);
    }
    known.insert(known.end(), all.names.fields().begin(), all.names.fields().end());
    faults.add(pointer, "found the unknown parameter " + shown(parameter) + ", must be one of " +
                            listed(known) + hint(parameter, known));
  } else {
    faults.add({}, {});
  }
  return fields;
}

std::vector<double> read_values(const Place& place, const std::vector<const Field*>& fields, Faults& faults) {
  constexpr std::string_view wanted = "a list of at least one number";
  std::vector<double> values;
  const Node::List* list = read_list(place, wanted, faults);
  if (list != nullptr && list->empty()) {
    faults.add(place.pointer, "found an empty list, must be " + std::string(wanted));
  }
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const Node& node = (*list)[i];
    const auto* number = node.get<double>();
    const auto bad = std::find_if(fields.begin(), fields.end(), [&](const Field* field) {
      return number == nullptr || !within(*field, *number);
    });
    if (number != nullptr && bad == fields.end()) {
      values.push_back(*number);
    } else if (bad != fields.end()) {
      read_number({&node, child(place.pointer, i)}, **bad, faults);
    } else {
      add_wrong_type({&node, child(place.pointer, i)}, "a number", faults);
    }
  }
  return values;
}

void read_for_each(const Place& place, const Parameters& all, Study& study, Faults& faults) {
  if (place.node == nullptr || !Keys(place, {}, faults).is_object()) {
    return;
  }
  std::unordered_set<std::string_view> seen;
  for (const Member& member : *place.node->get<Node::Object>()) {
    if (!seen.insert(member.key).second) {
      continue;  // told as a duplicate key
    }
    const Place item{&member.value, child(place.pointer, member.key)};
    const bool in_design = std::any_of(study.design.begin(), study.design.end(),
                                       [&](const DesignVariable& v) { return v.name == member.key; });
    if (in_design || (!study.over.empty() && member.key == study.over)) {
      faults.add(item.pointer,
                 "found " + shown(member.key) + ", which the study is \"over\"; must be another parameter");
      continue;
    }
    const auto fields = fields_of(member.key, item.pointer, all, faults);
    study.for_each.emplace_back(member.key, read_values(item, fields, faults));
  }
}

// Results are filed under the study's name.
bool is_file_name(const std::string& name) {
  const auto forbidden = [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return c == '/' || c == '\\' || code < 0x20 || code == 0x7f;
  };
  return !name.empty() && name.size() <= 100 && name.front() != '.' &&
         std::none_of(name.begin(), name.end(), forbidden);
}

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

Field frequency_field(FrequencyUnit unit) {
  return {.name = "frequency",
          .unit = unit_name(unit),
          .lower = 0,
          .upper = std::numeric_limits<double>::infinity(),
          .lower_open = true};
}

std::string with_unit(double value, const Field& field) {
  return number_text(value) + (field.unit == "-" ? "" : " " + std::string(field.unit));
}

void read_range(const Keys& keys, const Field& bounds, Study& study, Faults& faults) {
  const auto from = read_number(keys.require("from", allowed_text(bounds), faults), bounds, faults);
  const Place to_place = keys.require("to", allowed_text(bounds), faults);
  const auto to = read_number(to_place, bounds, faults);
  study.from = from.value_or(0);
  study.to = to.value_or(0);
  if (from && to && !(*from < *to)) {
    faults.add(to_place.pointer, "found " + number_text(*to) + ", must be above \"from\", which is " +
                                     with_unit(*from, bounds));
  }
}

// A parameter that the study is over, and what bounds it; any number where a fault is told.
Field read_parameter(const Place& place, const Parameters& all, std::string& parameter, Faults& faults) {
  constexpr std::string_view wanted = "a string, the parameter \"part.field\" or tie that is varied";
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Field any{.name = "over", .unit = "-", .lower = -infinity, .upper = infinity};
  const auto over = read_string(place, wanted, faults);
  if (!over) {
    return any;
  }
  parameter = *over;
  if (*over == "frequency") {
    faults.add(
        place.pointer,
        "found \"frequency\", must be another parameter; over the frequency is a study of kind \"frf\"");
    return any;
  }
  if (std::find(result_names.begin(), result_names.end(), *over) != result_names.end()) {
    faults.add(place.pointer,
               "found " + shown(*over) +
                   ", by which results name a quantity of their own; must be a tie of another name");
    return any;
  }
  const auto fields = fields_of(*over, place.pointer, all, faults);
  const bool known = !fields.empty() && std::find(fields.begin(), fields.end(), nullptr) == fields.end();
  return known ? common(fields) : any;
}

Field read_over(const Keys& keys, const Parameters& all, Study& study, Faults& faults) {
  constexpr std::string_view wanted = "a string, the parameter \"part.field\" or tie that is varied";
  return read_parameter(keys.require("over", std::string(wanted), faults), all, study.over, faults);
}

// A pair [lower, upper], or nothing where a fault is told.
void read_bounds(const Place& place, const Field& field, DesignVariable& variable, Faults& faults) {
  const std::string wanted = "a pair [lower, upper], each " + allowed_text(field);
  const Node::List* list = read_list(place, wanted, faults);
  if (list == nullptr) {
    return;
  }
  if (list->size() != 2) {
    faults.add(place.pointer, "found a list of " + std::to_string(list->size()) + ", must be " + wanted);
    return;
  }
  const auto lower = read_number({&list->front(), child(place.pointer, std::size_t{0})}, field, faults);
  const auto upper = read_number({&list->back(), child(place.pointer, std::size_t{1})}, field, faults);
  variable.lower = lower.value_or(0);
  variable.upper = upper.value_or(0);
  if (lower && upper && !(*lower < *upper)) {
    faults.add(child(place.pointer, std::size_t{1}), "found " + number_text(*upper) +
                                                         ", must be above the lower bound, which is " +
                                                         with_unit(*lower, field));
  }
}

// The parameters of a design in "over", and as many pairs in "bounds".
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
      read_bounds({&(*ranges)[i], child(bounds.pointer, i)}, field, variable, faults);
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

void read_window(const Keys& keys, const Field& bounds, Study& study, Faults& faults) {
  const std::string wanted = "a window [lower, upper] of two frequencies, each " + allowed_text(bounds);
  const Place place = keys.require("frequency", wanted, faults);
  const Node::List* list = read_list(place, wanted, faults);
  if (list == nullptr) {
    return;
  }
  if (list->size() != 2) {
    faults.add(place.pointer, "found a list of " + std::to_string(list->size()) + ", must be " + wanted);
    return;
  }
  const auto lower = read_number({&list->front(), child(place.pointer, std::size_t{0})}, bounds, faults);
  const auto upper = read_number({&list->back(), child(place.pointer, std::size_t{1})}, bounds, faults);
  study.frequency_from = lower.value_or(0);
  study.frequency_to = upper.value_or(0);
  if (lower && upper && !(*lower < *upper)) {
    faults.add(child(place.pointer, std::size_t{1}), "found " + number_text(*upper) +
                                                         ", must be above the lower end, which is " +
                                                         with_unit(*lower, bounds));
  }
}

void read_one_frequency(const Keys& keys, const Field& bounds, Study& study, Faults& faults) {
  const std::string wanted = "one frequency, " + allowed_text(bounds);
  const Place place = keys.require("frequency", wanted, faults);
  if (place.node != nullptr && place.node->get<Node::List>() != nullptr) {
    add_wrong_type(place, wanted, faults);
    return;
  }
  study.frequency_from = study.frequency_to = read_number(place, bounds, faults).value_or(0);
}

void read_time(const Keys& keys, TimeSettings& time, Faults& faults) {
  time.method = read_choice(keys.find("method"), time_methods, time.method, faults);
  const auto whole = [&](const char* key, int largest, int& value) {
    value = read_integer(keys.find(key), 1, largest, faults).value_or(value);
  };
  whole("steps", largest_steps, time.steps);
  whole("periods", largest_periods, time.periods);
  whole("recorded", largest_periods, time.recorded);
  const Field tolerance{.name = "tolerance", .unit = "-", .lower = 0, .upper = 1};
  time.tolerance = read_number(keys.find("tolerance"), tolerance, faults).value_or(time.tolerance);
  const double instants = static_cast<double>(time.steps) * time.recorded;
  if (instants > largest_steps) {
    faults.add(keys.find(keys.has("recorded") ? "recorded" : "steps").pointer,
               "found " + std::to_string(time.recorded) + " periods of " + std::to_string(time.steps) +
                   " steps to record, must be at most " + std::to_string(largest_steps) + " steps together");
  }
}

// Says of a key of other kinds which ones these are.
std::string kinds_with(std::string_view key) {
  std::vector<std::string> kinds;
  for (const auto& kind : study_kinds) {
    const auto keys = study_keys(kind.value);
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) {
      kinds.emplace_back(kind.text);
    }
  }
  return kinds.empty() ? "" : "which belongs to studies of kind " + listed(kinds);
}

StudyKind read_kind(const Place& study, Faults& faults) {
  Faults told_later;
  const Place place =
      Keys(study, {}, told_later).require("kind", "one of " + listed(texts(study_kinds)), faults);
  return read_choice(place, study_kinds, Study{}.kind, faults);
}

// The name "frf", "frf_2", ... that no other study has.
std::string unused_name(const std::string& wish, std::unordered_map<std::string, int>& next,
                        const std::unordered_map<std::string, std::string>& used) {
  std::string name;
  int& n = next[wish];
  do {
    ++n;
    name = n == 1 ? wish : wish + '_' + std::to_string(n);
  } while (used.contains(name));
  return name;
}

}  // namespace

std::vector<Study> read_studies(const Place& place, FrequencyUnit unit, const std::vector<Tie>& ties,
                                bool ties_complete, const Names& names, Faults& faults) {
  Parameters all{ties, ties_complete, names, {}, {}};
  for (const Tie& tie : ties) {
    all.tie_by_name.emplace(tie.name, &tie);
    for (const std::string& member : tie.members) {
      all.tie_of_field.emplace(member, &tie);
    }
  }
  std::vector<Study> studies;
  std::unordered_map<std::string, std::string> used;  // names and where they stand
  const Node::List* list = read_list(place, "a list of objects", faults);
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    Study& study = studies.emplace_back();
    const Place item{&(*list)[i], child(place.pointer, i)};
    const std::size_t before = faults.count();
    if (item.node->get<Node::Object>() != nullptr) {
      study.kind = read_kind(item, faults);
    }
    if (faults.count() > before) {
      continue;  // without its kind nobody knows what else it may hold
    }
    const Keys keys(item, study_keys(study.kind), faults, kinds_with);
    if (!keys.is_object()) {
      continue;
    }
    const Place name = keys.find("name");
    if (const auto text = read_string(name, "a string, the name of the study", faults)) {
      const auto [first, is_new] = used.emplace(*text, name.pointer);
      if (!is_file_name(*text)) {
        faults.add(name.pointer,
                   "found " + shown(*text) +
                       ", must be a name of 1 to 100 characters that does not begin with '.' and has no "
                       "'/', '\\' and control characters, since results are filed under it");
      } else if (!is_new) {
        faults.add(name.pointer, "found the name " + shown(*text) + " again, which is also at " +
                                     first->second + "; studies must have different names");
      }
      study.name = *text;
    }
    const Field frequency = frequency_field(unit);
    if (study.kind == StudyKind::frf) {
      read_range(keys, frequency, study, faults);
    } else if (study.kind == StudyKind::time) {
      read_one_frequency(keys, frequency, study, faults);
      read_time(keys, study.time, faults);
    } else if (study.kind == StudyKind::optimum) {
      read_design(keys, all, study, faults);
      read_window(keys, frequency, study, faults);
      const Place algorithm = keys.find("algorithm");
      if (algorithm.node != nullptr) {
        study.algorithm =
            read_string(algorithm, "a string, the name of an algorithm of NLopt", faults).value_or("");
      }
      read_constraints(keys.find("constraints"), study, faults);
    } else {
      read_range(keys, read_over(keys, all, study, faults), study, faults);
      (study.kind == StudyKind::trace ? read_one_frequency : read_window)(keys, frequency, study, faults);
    }
    read_for_each(keys.find("for_each"), all, study, faults);
  }
  std::unordered_map<std::string, int> next;
  for (Study& study : studies) {
    if (study.name.empty()) {
      study.name = unused_name(std::string(word_of(study_kinds, study.kind)), next, used);
      used.emplace(study.name, "");
    }
  }
  return studies;
}

}  // namespace arcslip::scene::detail

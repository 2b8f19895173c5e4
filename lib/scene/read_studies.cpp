#include <arcslip/scene/read_cases.hpp>
#include <arcslip/scene/read_design.hpp>
#include <arcslip/scene/read_studies.hpp>
#include <arcslip/scene/study_parameters.hpp>
#include <arcslip/scene/words.hpp>

#include <algorithm>
#include <limits>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace arcslip::scene::detail {
namespace {

// Results are filed under the study's name.
bool is_file_name(const std::string& name) {
  const auto forbidden = [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return c == '/' || c == '\\' || code < 0x20 || code == 0x7f;
  };
  return !name.empty() && name.size() <= 100 && name.front() != '.' &&
         std::none_of(name.begin(), name.end(), forbidden);
}

Field frequency_field(FrequencyUnit unit) {
  return {.name = "frequency",
          .unit = unit_name(unit),
          .lower = 0,
          .upper = std::numeric_limits<double>::infinity(),
          .lower_open = true};
}

// Beyond it the square of a frequency, times a mass, may be no number any more.
constexpr double largest_frequency = 1e100;

void check_frequency(double value, const std::string& pointer, const Field& bounds, Faults& faults) {
  if (value > largest_frequency) {
    faults.add(pointer, "found " + number_text(value) + ", must be at most " +
                            with_unit(largest_frequency, bounds) +
                            ": numbers with its square would overflow");
  }
}

std::pair<double, double> read_range(const Keys& keys, const Field& bounds, Faults& faults) {
  const auto from = read_number(keys.require("from", allowed_text(bounds), faults), bounds, faults);
  const Place to_place = keys.require("to", allowed_text(bounds), faults);
  const auto to = read_number(to_place, bounds, faults);
  if (from && to && !(*from < *to)) {
    faults.add(to_place.pointer, "found " + number_text(*to) + ", must be above \"from\", which is " +
                                     with_unit(*from, bounds));
  }
  return {from.value_or(0), to.value_or(0)};
}

Field read_over(const Keys& keys, const Parameters& all, Study& study, Faults& faults) {
  constexpr std::string_view wanted = "a string, the parameter \"part.field\" or tie that is varied";
  return read_parameter(keys.require("over", std::string(wanted), faults), all, study.over, faults);
}

void read_window(const Keys& keys, const Field& bounds, Study& study, Faults& faults) {
  const std::string wanted = "a window [lower, upper] of two frequencies, each " + allowed_text(bounds);
  const Place place = keys.require("frequency", wanted, faults);
  std::tie(study.frequency_from, study.frequency_to) = read_pair(place, wanted, bounds, "end", faults);
  check_frequency(study.frequency_from, child(place.pointer, std::size_t{0}), bounds, faults);
  check_frequency(study.frequency_to, child(place.pointer, std::size_t{1}), bounds, faults);
}

void read_one_frequency(const Keys& keys, const Field& bounds, Study& study, Faults& faults) {
  const std::string wanted = "one frequency, " + allowed_text(bounds);
  const Place place = keys.require("frequency", wanted, faults);
  if (place.node != nullptr && place.node->get<Node::List>() != nullptr) {
    add_wrong_type(place, wanted, faults);
    return;
  }
  study.frequency_from = study.frequency_to = read_number(place, bounds, faults).value_or(0);
  check_frequency(study.frequency_from, place.pointer, bounds, faults);
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

void read_search(const Keys& keys, SearchSettings& search, Faults& faults) {
  constexpr std::string_view algorithm = "a string, the name of an algorithm of NLopt";
  search.algorithm = read_string(keys.find("algorithm"), algorithm, faults).value_or("");
  search.local = read_string(keys.find("local"), algorithm, faults).value_or("");
  const auto whole = [&](const char* key, int least, int& value) {
    value = read_integer(keys.find(key), least, largest_search, faults).value_or(value);
  };
  whole("evaluations", 1, search.evaluations);
  whole("population", 0, search.population);
  whole("seed", 0, search.seed);
  const Field seconds{
      .name = "seconds", .unit = "s", .lower = 0, .upper = std::numeric_limits<double>::infinity()};
  search.seconds = read_number(keys.find("seconds"), seconds, faults).value_or(search.seconds);
}

void read_along(const Keys& keys, const Parameters& all, Study& study, Faults& faults) {
  const Place place = keys.find("along");
  for (const char* key : {"from", "to"}) {
    if (place.node == nullptr && keys.has(key)) {
      faults.add(keys.find(key).pointer,
                 "found the key " + quoted(key) + " without \"along\", the parameter of which it is a value");
    }
  }
  if (place.node == nullptr) {
    return;
  }
  DesignVariable along;
  const Field field = read_parameter(place, all, along.name, faults);
  std::vector<std::string> beside;
  for (const char* key : {"constraints", "cases", "scatter"}) {
    const Place other = keys.find(key);
    const auto* list = other.node != nullptr ? other.node->get<Node::List>() : nullptr;
    const auto* object = other.node != nullptr ? other.node->get<Node::Object>() : nullptr;
    if ((list != nullptr && !list->empty()) || (object != nullptr && !object->empty())) {
      beside.emplace_back(key);
    }
  }
  if (!beside.empty()) {
    faults.add(place.pointer, "found \"along\" beside " + listed(beside) +
                                  ", with which no optimum is followed; must stand without");
  }
  const bool taken = !beside.empty() || is_taken(along.name, place.pointer, study, faults);
  std::tie(along.lower, along.upper) = read_range(keys, field, faults);
  if (!taken) {
    study.along = std::move(along);
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

std::vector<Study> read_studies(const Place& place, FrequencyUnit unit, const Parameters& all,
                                const Dofs& dofs, Faults& faults) {
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
      std::tie(study.from, study.to) = read_range(keys, frequency, faults);
      check_frequency(study.from, keys.find("from").pointer, frequency, faults);
      check_frequency(study.to, keys.find("to").pointer, frequency, faults);
    } else if (study.kind == StudyKind::time) {
      read_one_frequency(keys, frequency, study, faults);
      read_time(keys, study.time, faults);
    } else if (study.kind == StudyKind::optimum) {
      read_design(keys, all, study, faults);
      read_window(keys, frequency, study, faults);
      read_search(keys, study.search, faults);
      read_constraints(keys.find("constraints"), study, faults);
      read_cases(keys.find("cases"), all, dofs, study, faults);
      read_scatter(keys.find("scatter"), all, study, faults);
      read_criterion(keys, study, faults);
      read_along(keys, all, study, faults);
    } else {
      std::tie(study.from, study.to) = read_range(keys, read_over(keys, all, study, faults), faults);
      (study.kind == StudyKind::trace ? read_one_frequency : read_window)(keys, frequency, study, faults);
    }
    study.for_each = read_value_lists(keys.find("for_each"), all, study, faults);
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

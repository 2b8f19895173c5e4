#include <arcslip/scene/formulas.hpp>
#include <arcslip/scene/keys/read_studies.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>

namespace arcslip::scene::file {
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

std::vector<std::string> names_of(const Catalogue& catalogue) {
  std::vector<std::string> names;
  for (const auto& type : catalogue.studies) names.emplace_back(type->name());
  return names;
}

// The keys of a study of some kind, in the order in which they are written.
std::vector<std::string> study_keys(const StudyType& type) {
  std::vector<std::string> names{"name", "kind"};
  for (const Key& key : type.keys()) names.push_back(key.name);
  names.emplace_back("for_each");
  return names;
}

// Explains to which kinds a key of other kinds belongs.
std::string kinds_with(std::string_view key, const Catalogue& catalogue) {
  std::vector<std::string> kinds;
  for (const auto& type : catalogue.studies) {
    const auto keys = study_keys(*type);
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) kinds.emplace_back(type->name());
  }
  return kinds.empty() ? "" : "which belongs to studies of kind " + listed(kinds);
}

// Null after a fault.
const StudyType* read_kind(const Location& study, const Catalogue& catalogue, Faults& faults) {
  const std::vector<std::string> known = names_of(catalogue);
  Faults reported_later;
  const Location place = Keys(study, {}, reported_later).require("kind", "one of " + listed(known), faults);
  const auto name = read_string(place, "one of " + listed(known), faults);
  const StudyType* type = name ? catalogue.study(*name) : nullptr;
  if (name && type == nullptr) {
    faults.add(place.pointer,
               "found " + shown(*name) + ", must be one of " + listed(known) + hint(*name, known));
  }
  return type;
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

// Numbers of a study follow their formulas, but not what the study itself changes.
void check_followed(Study& study, const std::string& pointer, const Scene& scene, Faults& faults) {
  std::vector<std::string> followed;
  study.type->settings().visit_numbers(study.settings,
                                       [&](const std::string& at, double&) { followed.push_back(at); });
  std::vector<ParameterUse> changed = study.type->settings().taken(study.settings);
  for (const auto& list : study.for_each) changed.push_back({list.first, "which \"for_each\" changes"});
  for (const auto& sampled : study.samples.parameters)
    changed.push_back({sampled.first, "which \"for_each\" changes"});
  for (const auto& [at, formula] : study.texts) {
    if (std::find(followed.begin(), followed.end(), at) == followed.end())
      faults.add(pointer + at,
                 "found " + shown(formula.text) + ", a formula of parameters, must be a number");
    for (const std::string& parameter : independent_parameters(scene, formula))
      for (const ParameterUse& each : changed)
        if (each.parameter == parameter)
          faults.add(pointer + at, "found " + shown(formula.text) + ", which follows " + shown(parameter) +
                                       ", " + each.how + "; must be a number");
  }
}

}  // namespace

Field frequency_field(FrequencyUnit unit) {
  return {.name = "frequency",
          .unit = unit_name(unit),
          .lower = 0,
          .upper = std::numeric_limits<double>::infinity(),
          .lower_open = true};
}

std::vector<Study> read_studies(const Location& place, FrequencyUnit unit, const Parameters& all,
                                const Dofs& dofs, const FileSource& source, const Catalogue& catalogue,
                                Faults& faults) {
  const Field frequency = frequency_field(unit);
  const Elsewhere elsewhere = [&](std::string_view key) { return kinds_with(key, catalogue); };
  std::vector<Study> studies;
  std::unordered_map<std::string, std::string> used;  // names and where they stand
  const Node::List* list = read_list(place, "a list of objects", faults);
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const Location item{&(*list)[i], child(place.pointer, i)};
    Study study;
    if (item.node->get<Node::Object>() != nullptr) {
      study.type = read_kind(item, catalogue, faults);
      if (study.type == nullptr) continue;  // without its kind its other keys are unknown
    }
    const Keys keys(
        item, study.type != nullptr ? study_keys(*study.type) : std::vector<std::string>{"name", "kind"},
        faults, elsewhere);
    if (!keys.is_object()) continue;
    const Location name = keys.find("name");
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
    const Parameters with_texts{all.scene, all.constants_complete, all.names, &study.texts};
    const Reading reading{keys, frequency, with_texts, dofs, faults, source};
    study.settings = study.type->settings().read(reading);
    read_for_each(keys.find("for_each"), reading, study.type->settings().taken(study.settings), study);
    check_followed(study, item.pointer, all.scene, faults);
    studies.push_back(std::move(study));
  }
  std::unordered_map<std::string, int> next;
  for (Study& study : studies) {
    if (study.name.empty()) {
      study.name = unused_name(std::string(study.type->name()), next, used);
      used.emplace(study.name, "");
    }
  }
  return studies;
}

}  // namespace arcslip::scene::file

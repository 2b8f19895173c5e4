// The parameters of a scene by their names.
#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/study_type.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace arcslip::scene {
namespace {

// One field of one part; Value is double or const double.
template <class Value>
struct Slot {
  const Field* field = nullptr;
  Value* value = nullptr;
};

template <class AnyScene>
auto sections(AnyScene& scene) {
  return std::array{&scene.masses,   &scene.springs,  &scene.dampers, &scene.damping,
                    &scene.rotation, &scene.elements, &scene.patches, &scene.excitation};
}

// The slot of "part.field", or an empty one.
template <class Value, class AnyScene>
Slot<Value> find_slot(AnyScene& scene, std::string_view name) {
  const std::size_t dot = name.find('.');
  if (dot == std::string_view::npos) return {};
  for (auto* section : sections(scene)) {
    for (auto& part : *section) {
      if (part.name != name.substr(0, dot)) continue;
      const std::span<const Field> fields = part.fields();
      for (std::size_t i = 0; i < fields.size(); ++i)
        if (fields[i].name == name.substr(dot + 1)) return {&fields[i], &part.values[i]};
    }
  }
  return {};
}

const Tie* find_tie(const Scene& scene, std::string_view name) {
  const auto tie =
      std::find_if(scene.ties.begin(), scene.ties.end(), [&](const Tie& t) { return t.name == name; });
  return tie != scene.ties.end() ? &*tie : nullptr;
}

// All slots of a parameter: one, or the members of a tie.
template <class Value, class AnyScene>
std::vector<Slot<Value>> slots_of(AnyScene& scene, std::string_view name) {
  std::vector<std::string> members = {std::string(name)};
  if (const Tie* tie = find_tie(scene, name)) members = tie->members;
  std::vector<Slot<Value>> slots;
  for (const std::string& member : members) {
    slots.push_back(find_slot<Value>(scene, member));
    if (slots.back().value == nullptr) {
      const std::vector<std::string> known = parameter_names(scene);
      throw ParameterError("unknown parameter " + file::shown(member) + ", must be one of " +
                           file::listed(known) + file::hint(member, known));
    }
  }
  return slots;
}

}  // namespace

std::vector<std::string> parameter_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Tie& tie : scene.ties) names.push_back(tie.name);
  for (const auto* section : sections(scene)) {
    for (const Part& part : *section)
      for (const Field& field : part.fields()) names.push_back(part.name + '.' + std::string(field.name));
  }
  return names;
}

std::vector<const Field*> parameter_fields(const Scene& scene, std::string_view parameter) {
  std::vector<const Field*> fields;
  for (const auto& slot : slots_of<const double>(scene, parameter)) fields.push_back(slot.field);
  return fields;
}

double value(const Scene& scene, std::string_view parameter) {
  return *slots_of<const double>(scene, parameter).front().value;
}

void set(Scene& scene, std::string_view parameter, double value) {
  const auto slots = slots_of<double>(scene, parameter);
  for (const Tie& tie : scene.ties) {
    if (std::find(tie.members.begin(), tie.members.end(), parameter) != tie.members.end()) {
      throw ParameterError("parameter " + file::quoted(parameter) + " is tied, must be set by its tie " +
                           file::quoted(tie.name));
    }
  }
  for (const auto& slot : slots) {
    if (!file::within(*slot.field, value)) {
      throw ParameterError("parameter " + file::quoted(parameter) + ": " +
                           file::bound_fault(*slot.field, value));
    }
  }
  for (const auto& slot : slots) *slot.value = value;
  for (Study& study : scene.studies) drop(study, parameter);
}

void drop(Study& study, std::string_view parameter) {
  std::erase_if(study.for_each, [&](const auto& list) { return list.first == parameter; });
  study.in_rows = study.in_rows && !study.for_each.empty();
  std::erase_if(study.samples.parameters, [&](const auto& sampled) { return sampled.first == parameter; });
  if (study.samples.parameters.empty()) study.samples = {};
  study.type->settings().drop(parameter, study.settings);
}

}  // namespace arcslip::scene

#include <arcslip/scene/keys/parameter_names.hpp>

#include <arcslip/scene/keys/enum_words.hpp>

#include <algorithm>

namespace arcslip::scene::file {

std::string objection(const std::string& name) {
  if (name.empty()) return "must be a name of at least one character";
  if (name == ground) return "which is reserved for the fixed frame; must be another name";
  if (name == "frequency") return "which is reserved for the excitation frequency; must be another name";
  const auto forbidden = [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return c == '.' || c == '=' || code <= 0x20 || code == 0x7f;
  };
  if (std::any_of(name.begin(), name.end(), forbidden))
    return "must be a name without '.', '=' and white space";
  return {};
}

bool Names::add(const std::string& name, const std::string& pointer, Faults& faults) {
  if (const std::string reason = objection(name); !reason.empty()) {
    faults.add(pointer, "found " + shown(name) + ", " + reason);
    return false;
  }
  return add_new(name, pointer, faults);
}

bool Names::add_constant(const std::string& name, const std::string& pointer, Faults& faults) {
  const std::size_t dot = name.find('.');
  std::string reason = objection(name.substr(0, dot));
  if (reason.empty() && dot != std::string::npos) reason = objection(name.substr(dot + 1));
  if (name == "pi") reason = "which is 3.14159... in formulas; must be another name";
  if (reason.empty()) return add_new(name, pointer, faults);
  faults.add(pointer, "found " + shown(name) + ", " + reason);
  return false;
}

bool Names::add_new(const std::string& name, const std::string& pointer, Faults& faults) {
  const auto [first, is_new] = pointers_.emplace(name, pointer);
  if (!is_new) {
    faults.add(pointer, "found the name " + shown(name) + " again, which is also at " +
                            faults.reported(first->second) +
                            "; parts and constants must have different names");
  }
  return is_new;
}

bool Names::may_exist(std::string_view parameter) const {
  const auto part = parts_.find(parameter.substr(0, parameter.find('.')));
  return part == parts_.end() ? !complete_ : !part->second;
}

const Field* Names::field(std::string_view parameter, const std::string& pointer, Faults& faults) const {
  const std::size_t dot = parameter.find('.');
  const auto part = parts_.find(parameter.substr(0, dot));
  if (dot != std::string_view::npos && part != parts_.end() && part->second) {
    for (const Field& field : *part->second)
      if (field.name == parameter.substr(dot + 1)) return &field;
  }
  if (faults.full()) {
    faults.add({}, {});
  } else if (!may_exist(parameter)) {
    faults.add(pointer, "found " + shown(parameter) + ", must be one of the parameters " + listed(fields_) +
                            hint(parameter, fields_));
  }
  return nullptr;
}

void Names::set_fields(const std::string& part, std::span<const Field> fields) {
  parts_.emplace(part, std::vector<Field>(fields.begin(), fields.end()));
  for (const Field& field : fields) fields_.push_back(part + '.' + std::string(field.name));
}

void Names::set_unknown(const std::string& part) {
  parts_.emplace(part, std::nullopt);
}

}  // namespace arcslip::scene::file

#include <arcslip/scene/keys/section_keys.hpp>

namespace arcslip::scene::file {

Settings read_section(const Location& place, const SettingsKeys& table, const Field& frequency,
                      const FileSource& source, const Dofs& dofs, Faults& faults) {
  std::vector<std::string> names;
  for (const Key& key : table.keys()) names.push_back(key.name);
  const Keys keys(place, names, faults);
  return table.read({keys, frequency, no_parameters(), dofs, faults, source});
}

Key key_of(std::string name, std::string unit, std::string allowed, std::string help, std::string schema,
           bool required) {
  Key key{std::move(name), KeyType::other, std::move(unit), std::move(allowed), "",
          required,        std::move(help)};
  key.schema = std::move(schema);
  return key;
}

KeyGroup<double> optional_frequency(const std::string& name, std::string help) {
  return {{{name, KeyType::frequency, "frequency", "above 0", "", false, std::move(help)}},
          [=](const Reading& reading, double& value) {
            value = read_number(reading.keys.find(name), reading.frequency, reading.faults).value_or(0);
          },
          [=](const double& value, const Scene&, Node::Object& to) {
            if (value > 0) to.push_back({name, node(value)});
          }};
}

}  // namespace arcslip::scene::file

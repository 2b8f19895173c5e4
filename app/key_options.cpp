#include "key_options.hpp"

#include "option_values.hpp"

#include <arcslip/scene/keys/write_values.hpp>

#include <algorithm>

namespace arcslip::app {
namespace {

using scene::Key;
using scene::KeyType;
using scene::file::Node;

std::string type_name(const Key& key) {
  switch (key.type) {
    case KeyType::number:
      return "X";
    case KeyType::whole:
      return "N";
    case KeyType::text:
      return "NAME";
    case KeyType::word:
      return "WORD";
    case KeyType::value:
    case KeyType::frequency:
      return key.name == "from" ? "A" : key.name == "to" ? "B" : "F";
    case KeyType::window:
      return key.unit == "frequency" ? "F" : "X";
    case KeyType::parameter:
      return "NAME.FIELD";
    case KeyType::parameters:
      return "NAME.FIELD[=A:B]";
    case KeyType::followed:
    case KeyType::other:
      break;
  }
  return "NAME.FIELD=A:B";
}

std::string help(const Key& key) {
  std::string text = key.help;
  if (key.type == KeyType::window) text += key.unit == "frequency" ? ", lower and upper" : ", from and to";
  if (key.unit == "frequency") text += ", in the scene's unit";
  if (key.type == KeyType::value && key.name == "from") text += ", in its unit";
  if (key.type == KeyType::parameter) text += ", e.g. damper.normal_load";
  if (key.type == KeyType::parameters)
    text += ", each with its bounds, e.g. damper.normal_load=0.1:100; may be repeated";
  if (key.type == KeyType::followed) text += ", with its range, e.g. force.cosine=1:8";
  if (!key.otherwise.empty()) {
    const bool is_text = key.otherwise.front() == '"';
    text +=
        " (default: " + (is_text ? key.otherwise.substr(1, key.otherwise.size() - 2) : key.otherwise) + ")";
  }
  return text;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all.append(" ").append(text);
  return all;
}

bool has_ranges(const Key& key) {
  return key.type == KeyType::parameters || key.type == KeyType::followed;
}

std::vector<RangeOption> ranges_of(const std::string& option, const std::vector<std::string>& texts) {
  std::vector<RangeOption> ranges;
  for (const std::string& text : texts) ranges.push_back(parameter_range(option, text));
  return ranges;
}

Node node_of(const Key& key, const std::string& option, const std::vector<std::string>& texts) {
  using scene::file::node;
  const std::string& first = texts.front();
  switch (key.type) {
    case KeyType::number:
      return node(*number(option, first, "a number, " + key.allowed));
    case KeyType::value:
      return node(*number(option, first, "a value of the parameter, a finite number"));
    case KeyType::whole:
      return node(*whole_number(option, first, key.allowed));
    case KeyType::frequency:
      return node(*frequency(option, first));
    case KeyType::window:
      return node(key.unit == "frequency" ? frequencies(texts)
                                          : numbers(option, texts, "two numbers, " + key.allowed));
    case KeyType::parameter:
      if (first.empty()) {
        throw UsageError(option + " needs the name of a parameter, such as " + option +
                         " damper.normal_load");
      }
      break;
    default:
      break;
  }
  return node(std::string_view(first));
}

}  // namespace

std::string KeyOption::type_name() const {
  return app::type_name(key);
}

std::string KeyOption::help() const {
  return app::help(key);
}

GivenKey KeyOption::given() const {
  const bool may_be_empty = key.type == KeyType::text || key.type == KeyType::parameter || has_ranges(key);
  if (!may_be_empty && std::find(texts.begin(), texts.end(), "") != texts.end())
    throw UsageError(name() + " needs a nonempty value");
  GivenKey given{key, name() + joined(texts), {}};
  if (has_ranges(key))
    given.value = ranges_of(name(), texts);
  else
    given.value = node_of(key, name(), texts);
  return given;
}

std::vector<KeyOption> options_of(const std::vector<Key>& keys) {
  std::vector<KeyOption> options;
  for (const Key& key : keys)
    if (key.type != KeyType::other) options.push_back({key});
  return options;
}

}  // namespace arcslip::app

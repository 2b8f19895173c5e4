#include "key_options.hpp"

#include "option_values.hpp"

#include <arcslip/scene/keys/write_values.hpp>

#include <algorithm>
#include <cstddef>

namespace arcslip::app {
namespace {

using scene::Key;
using scene::KeyType;
using scene::file::Node;

constexpr const char* for_each = "for_each";

/// "one|all"
std::string words(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& word : all) text += (text.empty() ? "" : "|") + word;
  return text;
}

std::string type_name(const Key& key) {
  switch (key.type) {
    case KeyType::number:
      return "X";
    case KeyType::whole:
      return "N";
    case KeyType::text:
      return "NAME";
    case KeyType::word:
      return words(key.words);
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
      return "NAME.FIELD=A:B";
    case KeyType::other:
      break;
  }
  return key.name == for_each ? "NAME.FIELD=V,V..." : "JSON";
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

Node json_of(const std::string& option, const std::string& text) {
  try {
    return scene::file::read_tree(text);
  } catch (const scene::SceneError& error) {
    throw UsageError(option + ": found no JSON: " + error.faults().front().message);
  }
}

/// "1,3,10", or the range "0.1:100:31", logarithmic as "0.1:100:31:log".
Node values_of(const std::string& option, const std::string& text) {
  const std::string wanted = "numbers with commas, or from:to:count, with :log for logarithmic steps";
  const bool is_range = text.find(':') != std::string::npos;
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == (is_range ? ':' : ','))
      parts.emplace_back();
    else
      parts.back() += c;
  const bool is_log = is_range && parts.size() == 4 && parts.back() == "log";
  if (is_log) parts.pop_back();
  const bool is_empty = std::find(parts.begin(), parts.end(), "") != parts.end();
  if (is_empty || (is_range && parts.size() != 3))
    throw UsageError(option + ": found the values \"" + text + "\", must be " + wanted);
  const std::vector<double> values = numbers(option, parts, wanted);
  if (!is_range) return scene::file::node(values);
  Node::Object range{{"from", {values[0]}}, {"to", {values[1]}}, {"count", {values[2]}}};
  if (is_log) range.push_back({"spacing", {std::string("logarithmic")}});
  return {std::move(range)};
}

/// Lists by name, or one JSON value.
Node lists_of(const std::string& option, const std::vector<std::string>& texts) {
  const char first = texts.front().front();
  if (first == '{' || first == '[') return json_of(option, texts.front());
  Node::Object lists;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals == 0 || equals == std::string::npos)
      throw UsageError(option + " " + text + ": give it as name.field=value,value, such as " + option +
                       " damper.normal_load=1,3,10");
    lists.push_back({text.substr(0, equals), values_of(option, text.substr(equals + 1))});
  }
  return {std::move(lists)};
}

Node other_of(const KeyOption& of) {
  const std::string& first = of.texts.front();
  if (of.key.name == for_each) return lists_of(of.name(), of.texts);
  if (!of.is_flag()) return json_of(of.name(), first);
  if (first == "true" || first == "false") return {first == "true"};
  return {first};
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

std::string option_of(const std::string& key) {
  std::string name = "--" + key;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

std::string KeyOption::names() const {
  const std::string plain = "--" + key.name;
  return plain == name() ? name() : name() + "," + plain;
}

bool KeyOption::is_flag() const {
  return key.type == KeyType::other && key.allowed.starts_with("true");
}

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
  else if (key.type == KeyType::other)
    given.value = other_of(*this);
  else
    given.value = node_of(key, name(), texts);
  return given;
}

std::vector<KeyOption> options_of(const std::vector<Key>& keys) {
  std::vector<std::string> given_with;
  for (const Key& key : keys)
    for (const std::string& other : scene::keys_next_to(key.type)) given_with.push_back(other);
  std::vector<KeyOption> options;
  for (const Key& key : keys)
    if (std::find(given_with.begin(), given_with.end(), key.name) == given_with.end())
      options.push_back({key});
  Key each;
  each.name = for_each;
  each.help =
      "repeat the study for each of some values, as damper.normal_load=1,3,10 or =0.1:100:31:log, and for "
      "all "
      "combinations where it is repeated; or the JSON of a scene";
  options.push_back({each});
  return options;
}

}  // namespace arcslip::app

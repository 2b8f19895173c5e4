#include "key_options.hpp"

#include "option_values.hpp"

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
      return "F";
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
  if (key.type == KeyType::window) text += ", lower and upper";
  if (key.unit == "frequency") text += ", in the scene's unit";
  if (key.type == KeyType::value && key.name == "from") text += ", in its unit";
  if (key.type == KeyType::parameter) text += ", as damper.normal_load";
  if (key.type == KeyType::parameters)
    text += ", each with its bounds, as damper.normal_load=0.1:100; may be repeated";
  if (key.type == KeyType::followed) text += ", with its range, as force.cosine=1:8";
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

std::variant<Node, std::vector<ParameterRange>> value(const Key& key, const std::string& option,
                                                      const std::vector<std::string>& texts) {
  const std::string& first = texts.front();
  switch (key.type) {
    case KeyType::number:
      return Node{*number(option, first, "a number, " + key.allowed)};
    case KeyType::value:
      return Node{*number(option, first, "a value of the parameter, a finite number")};
    case KeyType::whole:
      return Node{static_cast<double>(*whole_number(option, first, key.help))};
    case KeyType::frequency:
      return Node{*frequency(option, first)};
    case KeyType::window: {
      Node::List list;
      for (const double each : frequencies(texts)) list.push_back({each});
      return Node{std::move(list)};
    }
    case KeyType::parameters:
    case KeyType::followed: {
      std::vector<ParameterRange> ranges;
      for (const std::string& text : texts) ranges.push_back(parameter_range(option, text));
      return ranges;
    }
    case KeyType::parameter:
      if (first.empty()) {
        throw UsageError(option + " needs the name of a parameter, such as " + option +
                         " damper.normal_load");
      }
      break;
    case KeyType::text:
    case KeyType::word:
    case KeyType::other:
      break;
  }
  return Node{first};
}

}  // namespace

KeyTexts with_options(const std::vector<Key>& keys) {
  KeyTexts texts;
  for (const Key& key : keys) {
    if (key.type != KeyType::other) texts.push_back({key, {}});
  }
  return texts;
}

void add_key_options(KeyTexts& keys, CLI::App& verb) {
  for (auto& [key, texts] : keys) {
    CLI::Option* option = verb.add_option("--" + key.name, texts, help(key));
    option->type_name(type_name(key))->allow_extra_args(false);  // what follows may be the scene
    if (key.type == KeyType::window) {
      option->expected(2);
    } else if (key.type == KeyType::parameters) {
      option->expected(1)->take_all();
    } else {
      option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::Throw);
    }
  }
}

std::vector<GivenKey> given_keys(const KeyTexts& keys, const CLI::App& verb) {
  std::vector<GivenKey> given;
  for (const auto& [key, texts] : keys) {
    const std::string option = "--" + key.name;
    if (verb.get_option(option)->count() > 0 && !texts.empty()) {
      given.push_back({key, option + joined(texts), value(key, option, texts)});
    }
  }
  return given;
}

}  // namespace arcslip::app

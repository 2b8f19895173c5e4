#include <arcslip/results/shown.hpp>

#include <arcslip/results/text.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace arcslip::results {

const Value* find(const Object& object, std::span<const std::string> path) {
  const auto has_key = [&](const Member& member) { return member.key == path.front(); };
  const auto found = std::find_if(object.begin(), object.end(), has_key);
  if (found == object.end()) return nullptr;
  if (path.size() == 1) return &found->value;
  const auto* inner = std::get_if<Object>(&found->value.get());
  return inner ? find(*inner, path.subspan(1)) : nullptr;
}

std::string text_in(const Object& object, const std::string& key) {
  const Value* value = find(object, {&key, 1});
  const auto* text = value ? std::get_if<std::string>(&value->get()) : nullptr;
  return text ? *text : std::string();
}

namespace {

constexpr const char* no_value = "-";

std::string text_of(const Value& value, const std::string& format, double error = 0, bool doubtful = false) {
  return std::visit(
      [&](const auto& is) -> std::string {
        using Is = std::decay_t<decltype(is)>;
        if constexpr (std::is_same_v<Is, double>) {
          const double at_least = doubtful ? doubtful_error(is, error) : error;
          return std::isfinite(is) ? with_error(is, at_least, format.c_str()) : no_value;
        } else if constexpr (std::is_same_v<Is, long>) {
          return std::to_string(is);
        } else if constexpr (std::is_same_v<Is, std::string>) {
          return is;
        } else if constexpr (std::is_same_v<Is, bool>) {
          return is ? "yes" : "no";
        } else {
          return no_value;
        }
      },
      value.get());
}

bool is_set(const Object& object, const std::string& name) {
  const Value* flag = name.empty() ? nullptr : find(object, {&name, 1});
  return flag && std::holds_alternative<bool>(flag->get()) && std::get<bool>(flag->get());
}

bool stands_instead(const Object& object, const Shown& each) {
  const Value* word = each.instead.of.empty() ? nullptr : find(object, {&each.instead.of, 1});
  const auto* text = word ? std::get_if<std::string>(&word->get()) : nullptr;
  const auto& words = each.instead.words;
  return text && is_set(object, each.path.front()) &&
         std::find(words.begin(), words.end(), *text) != words.end();
}

bool is_doubtful(const Object& object, const std::string& name) {
  const Value* value = find(object, {&name, 1});
  const auto* number = value ? std::get_if<double>(&value->get()) : nullptr;
  return is_set(object, name) || (number && !std::isfinite(*number));
}

}  // namespace

std::vector<std::string> shown_cells(const std::vector<Shown>& shown, const Object& object,
                                     const Object& facts) {
  std::vector<std::string> row;
  for (const Shown& each : shown) {
    const Value* value = find(object, each.path);
    if (!value) value = find(facts, each.path);
    const Value* estimate = each.error.empty() ? nullptr : find(object, each.error);
    const auto* error = estimate ? std::get_if<double>(&estimate->get()) : nullptr;
    const double size = error && std::isfinite(*error) ? *error * each.error_unit : 0;
    const bool doubtful = std::any_of(each.doubtful.begin(), each.doubtful.end(),
                                      [&](const std::string& name) { return is_doubtful(object, name); });
    row.push_back(value ? text_of(*value, each.format, size, doubtful) : no_value);
    if (row.back() == no_value && is_set(object, each.otherwise)) row.back() = each.otherwise;
    if (stands_instead(object, each)) row.back() = each.instead.text;
  }
  return row;
}

std::vector<std::string> set_cells(const Schema& schema, const Object& set) {
  std::vector<std::string> row;
  for (const Column& column : schema.set) {
    const Value* value = find(set, column.path);
    const auto* number = value ? std::get_if<double>(&value->get()) : nullptr;
    row.push_back(number ? shortest(*number) : no_value);
  }
  return row;
}

std::vector<std::string> shown_titles(const Schema& schema) {
  std::vector<std::string> titles;
  for (const Column& column : schema.set) titles.push_back(with_unit(name(column), column.unit));
  for (const Shown& each : schema.shown) titles.push_back(each.title);
  titles.push_back(schema.noun);
  return titles;
}

}  // namespace arcslip::results

#include <arcslip/results/shown.hpp>

#include <arcslip/results/text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
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
constexpr int digits_of_pairs = 4;

constexpr std::size_t most_pairs = 2;

/// "0.9950 + 0.0998i, 0.9950 - 0.0998i" of the first pairs [re, im]; "" where the list is of others.
std::string text_of_pairs(const Value::List& list) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most_pairs, list.size()); ++i) {
    const auto* pair = std::get_if<Value::Numbers>(&list[i].get());
    if (pair == nullptr || pair->size() != 2) return "";
    const double imaginary = (*pair)[1];
    text += (i > 0 ? ", " : "") + to_digits((*pair)[0], digits_of_pairs);
    if (imaginary != 0)
      text += (imaginary < 0 ? " - " : " + ") + to_digits(std::abs(imaginary), digits_of_pairs) + "i";
  }
  return text;
}

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
        } else if constexpr (std::is_same_v<Is, Value::List>) {
          const std::string pairs = text_of_pairs(is);
          return pairs.empty() ? no_value : pairs;
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

std::vector<ShownCell> shown_cells(const std::vector<Shown>& shown, const Object& object,
                                   const Object& facts) {
  std::vector<ShownCell> row;
  for (const Shown& each : shown) {
    const Value* value = find(object, each.path);
    if (!value) value = find(facts, each.path);
    const Value* estimate = each.error.empty() ? nullptr : find(object, each.error);
    const auto* error = estimate ? std::get_if<double>(&estimate->get()) : nullptr;
    const double size = error && std::isfinite(*error) ? *error * each.error_unit : 0;
    const bool doubtful = std::any_of(each.doubtful.begin(), each.doubtful.end(),
                                      [&](const std::string& name) { return is_doubtful(object, name); });
    ShownCell& cell = row.emplace_back();
    cell.text = value ? text_of(*value, each.format, size, doubtful) : no_value;
    const auto* number = value && !each.unit.empty() ? std::get_if<double>(&value->get()) : nullptr;
    if (number && std::isfinite(*number)) {
      cell.value = *number;
      cell.error = doubtful ? doubtful_error(*number, size) : size;
    }
    if (cell.text == no_value && is_set(object, each.otherwise)) cell = {each.otherwise};
    if (stands_instead(object, each)) cell = {each.instead.text};
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

std::vector<std::vector<std::string>> text_rows(const Schema& schema,
                                                const std::vector<std::vector<ShownCell>>& rows) {
  std::vector<std::vector<std::string>> texts(rows.size() + 1);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const ShownCell& cell : rows[i]) texts[i + 1].push_back(cell.text);
  std::vector<std::string>& titles = texts.front();
  for (const Column& column : schema.set) titles.push_back(with_unit(name(column), column.unit));
  for (const Shown& each : schema.shown) {
    const std::size_t c = titles.size();
    double largest = 0;
    for (const auto& row : rows)
      if (c < row.size() && std::isfinite(row[c].value)) largest = std::max(largest, std::abs(row[c].value));
    const PrefixedUnit in = prefixed(each.unit, largest);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (c < rows[i].size() && std::isfinite(rows[i][c].value))
        texts[i + 1][c] = with_error(in.factor * rows[i][c].value, in.factor * rows[i][c].error, "%.6f");
    titles.push_back(each.unit.empty() ? each.title : with_unit(each.title, in.unit));
  }
  titles.push_back(schema.noun);
  return texts;
}

}  // namespace arcslip::results

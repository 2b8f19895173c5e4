#include "option_values.hpp"

#include <arcslip/results/text.hpp>
#include <arcslip/scene/scene.hpp>

#include <charconv>
#include <cmath>

namespace arcslip::app {
namespace {

std::optional<double> finite_number(const std::string& text) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  begin += begin != end && *begin == '+' ? 1 : 0;
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  return error == std::errc() && stop == end && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace

Assignment assignment(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--set " + text + ": give it as name.field=value, such as --set damper.normal_load=3");
  const std::string value = text.substr(equals + 1);
  return {text.substr(0, equals), value, finite_number(value)};
}

std::optional<double> number(const std::string& option, const std::string& text, const std::string& what) {
  const auto value = finite_number(text);
  if (!text.empty() && !value) throw UsageError(option + " " + text + ": must be " + what);
  return value;
}

std::vector<double> numbers(const std::string& option, const std::vector<std::string>& texts,
                            const std::string& what) {
  std::vector<double> values;
  for (const std::string& text : texts) values.push_back(number(option, text, what).value());
  return values;
}

std::optional<double> frequency(const std::string& option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto value = finite_number(text);
  if (!value || *value <= 0)
    throw UsageError(option + " " + text + ": must be a frequency above 0, a finite number");
  return value;
}

std::optional<double> accuracy(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto value = finite_number(text);
  if (!value || !(*value >= scene::finest_accuracy && *value <= scene::coarsest_accuracy))
    throw UsageError("--accuracy " + text + ": must be a number from " +
                     results::shortest(scene::finest_accuracy) + " to " +
                     results::shortest(scene::coarsest_accuracy));
  return value;
}

std::optional<int> whole_number(const std::string& option, const std::string& text, const std::string& what) {
  if (text.empty()) return std::nullopt;
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size())
    throw UsageError(option + " " + text + ": must be " + what);
  return value;
}

RangeOption parameter_range(const std::string& option, const std::string& text) {
  const auto equals = text.find('=');
  const std::string name = text.substr(0, equals);
  if (text.empty()) {
    throw UsageError(option + " needs the name of a parameter, such as " + option +
                     " damper.normal_load=0.1:100");
  }
  if (name.empty()) throw UsageError(option + " " + text + ": give it as name.field=lower:upper");
  if (equals == std::string::npos) return {name, std::nullopt};
  const std::string bounds = text.substr(equals + 1);
  const auto colon = bounds.find(':');
  const auto lower = finite_number(bounds.substr(0, colon));
  const auto upper = colon == std::string::npos ? std::nullopt : finite_number(bounds.substr(colon + 1));
  if (!lower || !upper) {
    throw UsageError(option + " " + text + ": found the range \"" + bounds +
                     "\", must be two finite numbers, lower:upper");
  }
  return {name, std::pair(*lower, *upper)};
}

std::vector<double> frequencies(const std::vector<std::string>& texts) {
  std::vector<double> values;
  for (const std::string& text : texts) values.push_back(frequency("--frequency", text).value());
  if (values.size() == 2 && !(values[0] < values[1])) {
    throw UsageError("--frequency " + texts[0] + " " + texts[1] +
                     ": must be a window, the lower frequency before the upper one");
  }
  return values;
}

}  // namespace arcslip::app

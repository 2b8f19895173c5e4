#pragma once
// Conversion of option texts to values. Each function throws UsageError, naming the option, for an invalid
// text; an empty text means that the option was not given.

#include "options.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::app {

/// --set name.field=value.
Assignment assignment(const std::string& text);

/// what: the expected value in error messages, "a finite number".
std::optional<double> number(const std::string& option, const std::string& text, const std::string& what);
std::vector<double> numbers(const std::string& option, const std::vector<std::string>& texts,
                            const std::string& what);
std::optional<int> whole_number(const std::string& option, const std::string& text, const std::string& what);
std::optional<double> frequency(const std::string& option, const std::string& text);
/// --accuracy
std::optional<double> accuracy(const std::string& text);
/// --frequency: one frequency, or a window.
std::vector<double> frequencies(const std::vector<std::string>& texts);
/// name.field, or name.field=lower:upper.
RangeOption parameter_range(const std::string& option, const std::string& text);

}  // namespace arcslip::app

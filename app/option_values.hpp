#pragma once
// From the text of an option to its value. Each throws UsageError, with the option, for what is none; an
// empty text is an option that was not given.

#include "options.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::app {

/// --set name.field=value.
std::pair<std::string, double> assignment(const std::string& text);

/// what: "a finite number", told where it is none.
std::optional<double> number(const std::string& option, const std::string& text, const std::string& what);
std::optional<int> whole_number(const std::string& option, const std::string& text, const std::string& what);
std::optional<double> frequency(const std::string& option, const std::string& text);
/// --frequency: one, or a window.
std::vector<double> frequencies(const std::vector<std::string>& texts);
/// name.field, or name.field=lower:upper.
ParameterRange parameter_range(const std::string& option, const std::string& text);

}  // namespace arcslip::app

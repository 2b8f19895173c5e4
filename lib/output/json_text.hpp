#pragma once
// What the writers of JSON have in common.

#include <arcslip/observables/response.hpp>

#include <arcslip/scene/visible.hpp>

#include <nlohmann/json.hpp>

#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::output::detail {

using Json = nlohmann::ordered_json;

/// On one line; bytes that are not UTF-8 are replaced. A terminal may show it.
inline std::string text(const Json& json) {
  return scene::visible(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

inline Json named_values(const std::vector<std::pair<std::string, double>>& values) {
  Json json = Json::object();
  for (const auto& [key, value] : values) {
    json[key] = value;
  }
  return json;
}

inline Json stop(const observables::Stop& stop) {
  return {{"reason", stop.reason}, {"value", stop.value}, {"limit", stop.limit}, {"message", stop.message}};
}

/// The keys "study" and "kind" of a result, with a comma behind them; "" where it does not know them.
inline std::string origin(const std::string& study, const std::string& kind) {
  return study.empty() && kind.empty() ? ""
                                       : "\"study\": " + text(study) + ", \"kind\": " + text(kind) + ",\n";
}

/// A list with an item a line, written as it goes.
template <class Range, class ToJson>
void write_list(std::ostream& out, const Range& range, const ToJson& to_json) {
  out << '[';
  const char* separator = "\n";
  for (const auto& item : range) {
    out << separator << text(to_json(item));
    separator = ",\n";
  }
  out << ']';
}

}  // namespace arcslip::output::detail

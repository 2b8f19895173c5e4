#pragma once
// Members of a JSON object as text, without a tree of them: for the many points of a branch.

#include <arcslip/observables/quantities.hpp>
#include <arcslip/output/units.hpp>

#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace arcslip::output::detail {

/// Paths are written as they come: a group is opened where a path enters it, and closed where one leaves it.
class JsonMembers {
 public:
  explicit JsonMembers(std::string& out) : out_(out) { out_ += '{'; }

  /// path: keys that need no escape, joined by points. Its value is to follow.
  void key(std::string_view path) {
    std::size_t level = 0;
    while (level < groups_.size() && path.starts_with(groups_[level]) && path[groups_[level].size()] == '.')
      path.remove_prefix(groups_[level++].size() + 1);
    leave(level);
    for (auto end = path.find('.'); end != std::string_view::npos; end = path.find('.')) {
      quoted(groups_.emplace_back(path.substr(0, end)));
      out_ += '{';
      separator_ = "";
      path.remove_prefix(end + 1);
    }
    quoted(path);
  }

  /// At the top; a name in quotes, escaped.
  void escaped_key(std::string_view name) {
    leave(0);
    out_.append(std::exchange(separator_, ",")).append(name) += ':';
  }

  void value(bool flag) { out_ += flag ? "true" : "false"; }

  /// The shortest that reads back exactly, with a point or an exponent; null where it is not finite.
  void value(double number) {
    const std::size_t begin = out_.size();
    out_ += std::isfinite(number) ? shortest(number) : "null";
    if (out_.find_first_of(".en", begin) == std::string::npos) out_ += ".0";
  }

  void value(const std::vector<double>& list) {
    out_ += '[';
    const char* separator = "";
    for (const double each : list) {
      out_ += std::exchange(separator, ",");
      value(each);
    }
    out_ += ']';
  }

  /// Those that `of` has. unit: rad/s in the scene's unit of frequency.
  template <class Of>
  void quantities(std::span<const observables::Quantity<Of>> all, const Of& of, double unit) {
    for (const auto& each : all) {
      if (each.has && !each.has(of)) continue;
      key(each.path);
      if (each.unit == observables::frequency_unit)
        value(std::get<0>(each.get)(of) / unit);
      else
        std::visit([&](auto get) { value(get(of)); }, each.get);
    }
  }

  void end() {
    leave(0);
    out_ += '}';
  }

 private:
  void leave(std::size_t level) {
    for (; groups_.size() > level; groups_.pop_back()) out_ += '}';
  }

  void quoted(std::string_view key) {
    out_.append(std::exchange(separator_, ",")).append("\"").append(key) += "\":";
  }

  std::string& out_;
  std::vector<std::string_view> groups_;
  const char* separator_ = "";
};

}  // namespace arcslip::output::detail

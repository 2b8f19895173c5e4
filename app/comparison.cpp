#include "output/standard_output.hpp"
#include "result_file.hpp"

#include <arcslip/results/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::app {
namespace {

using results::Value;

constexpr std::size_t differences_shown = 20;
constexpr std::size_t shown_of_value = 60;  // characters

/// What a computation took, which differs from run to run.
constexpr std::array<std::string_view, 4> of_work = {"solver", "seconds", "time", "threads"};

/// Whether a number is one that others follow from: a frequency, an amplitude, a parameter.
bool is_first_of_all(std::string_view what) {
  constexpr std::string_view optimum = ".optimum.";
  const auto at = what.find(optimum);
  const bool is_design = at != std::string_view::npos &&
                         what.find('.', at + optimum.size()) != std::string_view::npos &&
                         what.find(".elements.") == std::string_view::npos;
  return is_design || what.ends_with(".frequency") || what.ends_with(".amplitude") ||
         what.find(" set") != std::string_view::npos || what.find(".parameters.") != std::string_view::npos;
}

/// Compares results and keeps what differs.
class Differences {
 public:
  explicit Differences(double tolerance) : tolerance_(tolerance) {}

  void compare(const std::string& what, const Value& a, const Value& b) {
    const auto* number_a = std::get_if<double>(&a.get());
    const auto* number_b = std::get_if<double>(&b.get());
    if (number_a != nullptr && number_b != nullptr) return compare(what, *number_a, *number_b);
    const auto* object_a = std::get_if<results::Object>(&a.get());
    const auto* object_b = std::get_if<results::Object>(&b.get());
    if (object_a != nullptr && object_b != nullptr) return compare(what, *object_a, *object_b);
    const auto list_a = items(a), list_b = items(b);
    if (list_a && list_b) {
      if (list_a->size() != list_b->size())
        return differ(what + ": " + std::to_string(list_a->size()) + " and " +
                      std::to_string(list_b->size()) + " values");
      for (std::size_t i = 0; i < list_a->size(); ++i)
        compare(what + "[" + std::to_string(i + 1) + "]", (*list_a)[i], (*list_b)[i]);
      return;
    }
    ++compared_;
    if (text(a) != text(b)) differ(what + ": " + text(a) + " and " + text(b));
  }

  void compare(const std::string& what, double a, double b) {
    ++compared_;
    const double scale = std::max(std::abs(a), std::abs(b));
    const double relative = a == b ? 0 : std::abs(a - b) / scale;
    if (relative <= tolerance_) return;
    if (relative > largest_) {
      largest_ = relative;
      where_ = what;
    }
    differ(what + ": " + results::to_digits(a, 10) + " and " + results::to_digits(b, 10) +
               ", relative difference " + results::to_digits(relative, 2),
           !is_first_of_all(what));
  }

  void compare(const std::string& what, const results::Object& a, const results::Object& b) {
    for (const results::Member& member : a) {
      if (std::find(of_work.begin(), of_work.end(), member.key) != of_work.end()) continue;
      const auto same = find(b, member.key);
      if (same == b.end())
        differ(what + "." + member.key + ": only in the first");
      else
        compare(what + "." + member.key, member.value, same->value);
    }
    for (const results::Member& member : b)
      if (find(a, member.key) == a.end() &&
          std::find(of_work.begin(), of_work.end(), member.key) == of_work.end())
        differ(what + "." + member.key + ": only in the second");
  }

  /// is_derived: it follows from others, which are shown before it.
  void differ(std::string sentence, bool is_derived = false) {
    ++count_;
    auto& list = is_derived ? derived_ : shown_;
    if (list.size() < differences_shown) list.push_back(std::move(sentence));
  }

  std::size_t count() const { return count_; }
  void write(std::ostream& out) const {
    std::vector<std::string> all = shown_;
    for (const std::string& sentence : derived_)
      if (all.size() < differences_shown) all.push_back(sentence);
    for (const std::string& sentence : all) out << sentence << '\n';
    if (count_ > all.size()) out << "... and " << count_ - all.size() << " more\n";
    out << count_ << (count_ == 1 ? " difference" : " differences") << " beyond a relative "
        << results::to_digits(tolerance_, 3) << ", of " << compared_ << " values\n";
    if (largest_ > 0)
      out << "the largest relative difference is " << results::to_digits(largest_, 3) << ", of " << where_
          << '\n';
  }

 private:
  static results::Object::const_iterator find(const results::Object& in, const std::string& key) {
    return std::find_if(in.begin(), in.end(), [&](const results::Member& each) { return each.key == key; });
  }

  static std::optional<Value::List> items(const Value& value) {
    if (const auto* list = std::get_if<Value::List>(&value.get())) return *list;
    if (const auto* numbers = std::get_if<Value::Numbers>(&value.get()))
      return Value::List(numbers->begin(), numbers->end());
    return {};
  }

  static std::string text(const Value& value) {
    if (const auto* is = std::get_if<std::string>(&value.get()))
      return "\"" + is->substr(0, shown_of_value) + "\"";
    if (const auto* is = std::get_if<bool>(&value.get())) return *is ? "true" : "false";
    if (const auto* is = std::get_if<double>(&value.get())) return results::to_digits(*is, 10);
    return std::holds_alternative<std::nullptr_t>(value.get()) ? "null" : "a value of another kind";
  }

  double tolerance_, largest_ = 0;
  std::size_t count_ = 0, compared_ = 0;
  std::string where_;
  std::vector<std::string> shown_{}, derived_{};
};

/// Rows that pair by their number. Of points the number may differ, as steps do: then their count alone is
/// in the summary of the solver, and events and facts decide.
void compare_tables(const std::string& what, const results::Table& table, const results::Rows& a,
                    const results::Table& other, const results::Rows& b, Differences& differences) {
  const bool is_events = table.key == "events";
  if (a.count != b.count) {
    if (is_events)
      differences.differ(what + ": " + std::to_string(a.count) + " and " + std::to_string(b.count) +
                         " events");
    return;
  }
  for (std::size_t i = 0; i < a.count; ++i)
    differences.compare(what + " " + (is_events ? "event" : table.key + " row") + " " + std::to_string(i + 1),
                        results::object(table.columns, a, i), results::object(other.columns, b, i));
}

void compare_results_of(const results::Results& first, const results::Result& a,
                        const results::Results& second, const results::Result& b, const std::string& what,
                        Differences& differences) {
  differences.compare(what + " set", a.head.set, b.head.set);
  differences.compare(what + " status", Value(results::name(a.end.status)),
                      Value(results::name(b.end.status)));
  const results::Object stop_a = a.end.stop, stop_b = b.end.stop;
  const auto reason = [](const results::Object& stop) {
    for (const results::Member& member : stop)
      if (member.key == "reason") return member.value;
    return Value();
  };
  differences.compare(what + " stop.reason", reason(stop_a), reason(stop_b));
  differences.compare(what, a.end.facts, b.end.facts);
  const auto& tables_a = first.schemas[a.schema].tables;
  const auto& tables_b = second.schemas[b.schema].tables;
  for (std::size_t t = 0; t < tables_a.size(); ++t)
    for (std::size_t u = 0; u < tables_b.size(); ++u)
      if (tables_a[t].key == tables_b[u].key)
        compare_tables(what, tables_a[t], a.tables[t], tables_b[u], b.tables[u], differences);
}

/// The results of a list, in their order.
std::vector<const results::Result*> results_in(const results::Results& all, const std::string& list) {
  std::vector<const results::Result*> of;
  for (const results::Result& result : all.results)
    if (all.schemas[result.schema].list == list) of.push_back(&result);
  return of;
}

}  // namespace

ExitCode compare_results(const CommandOptions& options) {
  const results::Results first = read_results(options.files[0]), second = read_results(options.files[1]);
  Differences differences(options.tolerance);
  std::vector<std::string> lists;
  for (const auto* all : {&first, &second})
    for (const results::Schema& schema : all->schemas)
      if (std::find(lists.begin(), lists.end(), schema.list) == lists.end()) lists.push_back(schema.list);
  for (const std::string& list : lists) {
    const auto a = results_in(first, list), b = results_in(second, list);
    if (a.size() != b.size())
      differences.differ(list + ": " + std::to_string(a.size()) + " and " + std::to_string(b.size()) +
                         " results");
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      compare_results_of(first, *a[i], second, *b[i], list + " " + std::to_string(i + 1), differences);
  }
  std::ostringstream text;
  if (first.header.scene_hash != second.header.scene_hash) text << "the scenes differ\n";
  differences.write(text);
  StandardOutput screen;
  screen.write_lines([&](std::ostream& out) { out << text.str(); });
  screen.finish();
  return differences.count() > 0 ? ExitCode::differ : ExitCode::done;
}

}  // namespace arcslip::app

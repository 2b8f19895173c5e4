#include <arcslip/report/parts.hpp>

#include <arcslip/results/shown.hpp>
#include <arcslip/results/text.hpp>

#include <array>
#include <cmath>
#include <span>

namespace arcslip::report {
namespace {

using results::Member;
using results::Object;
using results::Value;

constexpr int shown_digits = 6;
constexpr int estimate_digits = 2;

const Value* value_at(const Object& object, std::initializer_list<std::string> path) {
  const std::vector<std::string> keys(path);
  return results::find(object, keys);
}

double number_at(const Object& object, std::initializer_list<std::string> path) {
  const Value* value = value_at(object, path);
  const auto* number = value ? std::get_if<double>(&value->get()) : nullptr;
  return number ? *number : std::nan("");
}

bool flag_at(const Object& object, const std::string& key) {
  const Value* value = value_at(object, {key});
  const auto* flag = value ? std::get_if<bool>(&value->get()) : nullptr;
  return flag && *flag;
}

const Object* object_at(const Object& object, std::initializer_list<std::string> path) {
  const Value* value = value_at(object, path);
  return value ? std::get_if<Object>(&value->get()) : nullptr;
}

std::span<const Value> list_at(const Object& object, const std::string& key) {
  const Value* value = value_at(object, {key});
  const auto* list = value ? std::get_if<Value::List>(&value->get()) : nullptr;
  return list ? std::span<const Value>(*list) : std::span<const Value>();
}

std::string few(double value) {
  return results::to_digits(value, estimate_digits);
}

std::string with_unit(double value, const std::string& unit) {
  return results::readable(value, unit, shown_digits);
}

std::string unit_of(const Object& object, const std::string& key) {
  for (const Member& member : object)
    if (member.key == key) return member.unit;
  return {};
}

/// The names of the parameters: those that stand before the amplitude.
std::vector<std::string> design_of(const Object& optimum) {
  std::vector<std::string> names;
  for (const Member& member : optimum) {
    if (member.key == "amplitude") break;
    names.push_back(member.key);
  }
  return names;
}

void write_place(Html& html, const Object& facts, const Object& optimum) {
  const std::string criterion = results::text_in(facts, "criterion");  // of several cases
  html.open("p", {{"class", "found"}});
  html.write(criterion == "mean" ? "The lowest mean of the peaks of all cases is "
             : criterion.empty() ? "The lowest peak is "
                                 : "The lowest peak of the worst case is ");
  html.element("strong", with_unit(number_at(optimum, {"amplitude"}), "m"));
  const double frequency = number_at(optimum, {"frequency"});
  if (std::isfinite(frequency) && criterion != "mean")
    html.write(" at " + with_unit(frequency, unit_of(optimum, "frequency")));
  const char* separator = ", with ";
  for (const std::string& name : design_of(optimum)) {
    html.write(separator);
    html.element("strong", name + " = " + with_unit(number_at(optimum, {name}), unit_of(optimum, name)));
    separator = " and ";
  }
  html.write(".").close();
  if (const Value* feasible = value_at(optimum, {"feasible"}); feasible && !flag_at(optimum, "feasible"))
    html.element("p", "A constraint is violated there.", {{"class", "advice"}});
}

/// What ends a range: "a bound of the search", "a constraint".
std::string cut(const Object& range, const std::string& side) {
  if (flag_at(range, side + "_is_bound")) return " (a bound of the search)";
  return flag_at(range, side + "_is_limit") ? " (a constraint)" : "";
}

void write_ranges(Html& html, const Object& optimum, const Object& ranges) {
  html.open("div", {{"class", "wide"}}).open("table", {{"class", "ranges"}}).open("thead").open("tr");
  for (const char* title : {"parameter", "peak at most", "from", "to"})
    html.element("th", title, {{"scope", "col"}});
  html.close().close().open("tbody");
  for (const Member& member : ranges) {
    const std::string unit = unit_of(optimum, member.key);
    for (const Value& each : list_at(ranges, member.key)) {
      const auto* range = std::get_if<Object>(&each.get());
      if (!range) continue;
      const double share = number_at(*range, {"share"});
      constexpr double percent = 100;
      html.open("tr").element("th", member.key, {{"scope", "row"}});
      html.element("td", results::to_digits(percent * share, shown_digits) + " % above the lowest");
      html.element("td", with_unit(number_at(*range, {"lower"}), unit) + cut(*range, "lower"));
      html.element("td", with_unit(number_at(*range, {"upper"}), unit) + cut(*range, "upper")).close();
    }
  }
  html.close().close().close();
}

std::size_t active_peaks(const Object& certificate) {
  std::size_t count = 0;
  for (const Value& each : list_at(certificate, "peaks"))
    if (const auto* peak = std::get_if<Object>(&each.get())) count += flag_at(*peak, "active") ? 1 : 0;
  return count;
}

void write_curvature(Html& html, const Object& certificate) {
  const auto rows = list_at(certificate, "curvature");
  const auto* row = rows.size() == 1 ? std::get_if<Value::Numbers>(&rows.front().get()) : nullptr;
  if (row && row->size() == 1 && row->front() > 0)
    html.element("li", "The curve of the peak is bent upwards there, so that it is a minimum.");
}

void write_peaks(Html& html, const Object& certificate) {
  const std::size_t peaks = active_peaks(certificate);
  if (peaks > 1)
    html.element("li", "There " + std::to_string(peaks) +
                           " peaks are equally high: a change that lowers one of them raises another.");
  else if (peaks == 1)
    html.element("li", "One peak is the highest there.");
  for (const Value& each : list_at(certificate, "limits"))
    if (const auto* limit = std::get_if<Object>(&each.get()))
      html.element("li", "The limit on " + results::text_in(*limit, "limit") +
                             " holds the design where it is: relaxing it by 1 % lowers the peak by about " +
                             few(number_at(*limit, {"multiplier"})) + " %.");
}

void write_others(Html& html, const Object& certificate) {
  const std::size_t others = list_at(certificate, "others").size();
  if (others == 0)
    html.element("li", "No response on another branch was found.");
  else if (flag_at(certificate, "others_lower"))
    html.element("li", std::to_string(others) +
                           " responses on other branches were found; all of them are lower than this peak.");
  else
    html.element("li",
                 "A response on another branch is higher than this peak: which of the two the structure has "
                 "depends on how it gets there.",
                 {{"class", "advice"}});
}

void write_direct(Html& html, const Object& facts) {
  const Object* difference = object_at(facts, {"direct", "difference"});
  if (!difference) return;
  html.element("li",
               "A second method, the lowest point of the curve of peaks, finds the same design within " +
                   few(number_at(*difference, {"design"})) + " and the same peak within " +
                   few(number_at(*difference, {"amplitude"})) + ", relative.");
}

void write_certificate(Html& html, const Search& search, const Object& certificate) {
  const bool is_complete = search.status == results::Status::complete;
  html.element("h4", is_complete ? "Why this is a minimum" : "What is known about it");
  html.open("ul", {{"class", "certificate"}});
  const double gradient = number_at(certificate, {"stationarity"});
  if (is_complete)
    html.element("li",
                 "To first order no change of the parameters lowers the peak: what is left of the "
                 "gradient is " +
                     few(gradient) + ", and at most 1e-5 is accepted.");
  else
    html.element("li", "The search ended early: what is left of the gradient is " + few(gradient) +
                           ", so that this is not certified.");
  write_peaks(html, certificate);
  write_curvature(html, certificate);
  write_others(html, certificate);
  write_direct(html, search.facts);
  html.element("li", "It is a local minimum. A lower one elsewhere within the bounds is not excluded.");
  html.close();
}

}  // namespace

void write_optimum(Html& html, const Search& search) {
  if (!search.set.empty()) html.element("h3", search.set);
  const Object* optimum = object_at(search.facts, {"optimum"});
  if (optimum) write_place(html, search.facts, *optimum);
  if (const Object* certificate = object_at(search.facts, {"certificate"}); optimum && certificate) {
    if (const Object* ranges = object_at(*certificate, {"ranges"}); ranges && !ranges->empty())
      write_ranges(html, *optimum, *ranges);
    write_certificate(html, search, *certificate);
  }
  if (search.text.empty()) return;
  if (!optimum) {
    html.element("pre", search.text);
    return;
  }
  html.open("details").element("summary", "As the command prints it").element("pre", search.text).close();
}

}  // namespace arcslip::report

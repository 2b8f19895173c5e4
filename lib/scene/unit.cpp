#include <arcslip/scene/unit.hpp>

#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/scene.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

namespace arcslip::scene {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int highest_power = 64;
constexpr std::size_t longest_unit = 60;

struct NamedUnit {
  std::string_view name;
  Unit unit;
  bool with_prefix;
};
constexpr NamedUnit named_units[] = {
    {"m", {.length = 1}, true},
    {"g", {.mass = 1, .ten = -3}, true},
    {"s", {.time = 1}, true},
    {"N", {.mass = 1, .length = 1, .time = -2}, true},
    {"Pa", {.mass = 1, .length = -1, .time = -2}, true},
    {"J", {.mass = 1, .length = 2, .time = -2}, true},
    {"W", {.mass = 1, .length = 2, .time = -3}, true},
    {"Hz", {.time = -1, .angle = 1, .turns = 1, .other = 2 * pi}, true},
    {"rad", {.angle = 1}, true},
    {"deg", {.angle = 1, .other = pi / 180}, false},
    {"rpm", {.time = -1, .angle = 1, .turns = 1, .other = 2 * pi / 60}, false},
    {"min", {.time = 1, .other = 60}, false},
    {"t", {.mass = 1, .ten = 3}, false},
    {"%", {.ten = -2}, false},
    {"1", {}, false},
};

constexpr std::pair<std::string_view, int> prefixes[] = {{"p", -12},     {"n", -9}, {"u", -6}, {"\u00b5", -6},
                                                         {"\u03bc", -6}, {"m", -3}, {"c", -2}, {"d", -1},
                                                         {"k", 3},       {"M", 6},  {"G", 9},  {"T", 12}};

// In the order of preference.
constexpr std::string_view coherent_units[] = {
    "kg",  "m",   "s",   "rad",   "N",      "N/m",   "N s/m", "m/s",    "m/s^2", "Pa",  "J",  "W",
    "m^2", "m^3", "1/s", "rad/s", "kg/m^3", "N/m^2", "N/m^3", "kg m^2", "m^3/J", "m^4", "1/m"};

// By the power n, times those before.
void multiply(Unit& all, const Unit& by, int n) {
  all.mass += n * by.mass;
  all.length += n * by.length;
  all.time += n * by.time;
  all.angle += n * by.angle;
  all.ten += n * by.ten;
  all.turns += n * by.turns;
  if (by.other != 1) all.other *= std::pow(by.other, n);
}

std::optional<Unit> symbol(std::string_view name) {
  for (const NamedUnit& each : named_units)
    if (each.name == name) return each.unit;
  for (const auto& [prefix, ten] : prefixes) {
    if (!name.starts_with(prefix)) continue;
    for (const NamedUnit& each : named_units)
      if (each.with_prefix && each.name == name.substr(prefix.size())) {
        Unit unit = each.unit;
        unit.ten += ten;
        return unit;
      }
  }
  return {};
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

/// Reads products and quotients of powers.
class UnitReader {
 public:
  explicit UnitReader(std::string_view text) : text_(text) {}

  std::optional<Unit> whole() {
    Unit all;
    if (!factor(all, 1)) return {};
    bool divided = false;
    for (bool apart = skip_spaces(); !text_.empty(); apart = skip_spaces()) {
      const bool divides = take('/');
      if (!divides && (divided || text_.front() == ')')) return {};  // N/m s: is it N s/m, or N/(m s)?
      if (!divides && !take('*') && !take("\u00b7") && !apart) return {};
      divided = divided || divides;
      skip_spaces();
      if (!(divides && take('(') ? group(all) : factor(all, divides ? -1 : 1))) return {};
    }
    return all;
  }

 private:
  bool take(char c) {
    if (text_.empty() || text_.front() != c) return false;
    text_.remove_prefix(1);
    return true;
  }
  bool take(std::string_view text) {
    if (!text_.starts_with(text)) return false;
    text_.remove_prefix(text.size());
    return true;
  }
  bool skip_spaces() {
    bool any = false;
    while (take(' ')) any = true;
    return any;
  }

  // What is divided by, after its parenthesis.
  bool group(Unit& all) {
    for (skip_spaces(); !take(')'); skip_spaces()) {
      static_cast<void>(take('*') || take("\u00b7"));
      skip_spaces();
      if (!factor(all, -1)) return false;
    }
    return true;
  }

  bool factor(Unit& all, int sign) {
    std::size_t end = 0;
    if (take('1')) return true;
    if (take('%')) {
      all.ten -= 2 * sign;
      return true;
    }
    while (end < text_.size() && is_letter(text_[end]) && !at_superscript(end)) ++end;
    const auto unit = symbol(text_.substr(0, end));
    if (!unit) return false;
    text_.remove_prefix(end);
    const auto power = take_power();
    if (!power) return false;
    multiply(all, *unit, sign * *power);
    return true;
  }

  bool at_superscript(std::size_t at) const {
    const std::string_view rest = text_.substr(at);
    return rest.starts_with("\u00b2") || rest.starts_with("\u00b3") || rest.starts_with("\u00b7");
  }

  // 1 if there is none.
  std::optional<int> take_power() {
    if (take("\u00b2")) return 2;
    if (take("\u00b3")) return 3;
    if (!take('^')) return 1;
    int power = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), power);
    if (error != std::errc() || power == 0 || std::abs(power) > highest_power) return {};
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return power;
  }

  std::string_view text_;
};

std::string with_power(std::string_view name, int power) {
  return std::string(name) + (power == 1 ? "" : '^' + std::to_string(power));
}

}  // namespace

std::optional<Unit> unit_of(std::string_view text) {
  if (text == "-") return Unit{};
  if (text.empty() || text.size() > longest_unit) return {};
  return UnitReader(text).whole();
}

std::string coherent_text(const Unit& unit) {
  if (unit.turns == 1 && unit.same_dimension({.time = -1})) return "Hz";
  const Unit plain{unit.mass, unit.length, unit.time, unit.angle};
  if (plain.same_dimension({}) && plain.angle == 0) return "-";
  for (const std::string_view each : coherent_units)
    if (const auto known = unit_of(each); known->same_dimension(plain) && known->angle == plain.angle)
      return std::string(each);
  std::string above, below;
  for (const auto& [name, power] : {std::pair<std::string_view, int>{"kg", plain.mass},
                                    {"m", plain.length},
                                    {"s", plain.time},
                                    {"rad", plain.angle}}) {
    std::string& side = power > 0 ? above : below;
    if (power != 0) side += (side.empty() ? "" : " ") + with_power(name, std::abs(power));
  }
  if (above.empty()) above = "1";
  if (below.empty()) return above;
  return above + '/' + (below.find(' ') == std::string::npos ? below : '(' + below + ')');
}

std::string objection_to_unit(std::string_view text) {
  const auto unit = unit_of(text);
  const std::string found = "found the unit \"" + std::string(text) + "\", must be ";
  if (!unit) return found + "a unit as \"N/m\" or \"N s/m\"";
  const std::string coherent = coherent_text(*unit);
  if (unit->ten == 0 && (unit->other == 1 || unit_of(coherent)->other == unit->other)) return {};
  return found + '"' + coherent + "\", in which formulas take the value; it may be given as \"3 " +
         std::string(text) + '"';
}

std::optional<Quantity> split_quantity(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  double value = 0;
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  const char* const begin = text.data() + sign;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (end == begin || error != std::errc() || !std::isfinite(value)) return {};
  const auto digits = static_cast<std::size_t>(end - text.data());
  std::string_view rest = text.substr(digits);
  const bool apart = rest.starts_with(' ');
  while (rest.starts_with(' ')) rest.remove_prefix(1);
  if (rest.empty() || !(is_letter(rest.front()) || rest.front() == '%' || (apart && rest.front() == '1')))
    return {};
  return Quantity{text.substr(sign, digits - sign), rest};
}

std::optional<double> value_in(std::string_view number, const Unit& unit, const Unit& wanted) {
  if (!unit.same_dimension(wanted) || (unit.angle != wanted.angle && unit.other != wanted.other)) return {};
  if (unit.angle != wanted.angle && wanted.time != 0) return {};  // Hz is no 1/s
  // The power of ten joins the digits, so that 0.2 mm is the number that 0.0002 is.
  std::string digits(number);
  int ten = unit.ten - wanted.ten;
  if (const std::size_t e = digits.find_first_of("eE"); e != std::string::npos) {
    int own = 0;
    const char* from = digits.data() + e + 1;
    if (*from == '+') ++from;
    if (std::from_chars(from, digits.data() + digits.size(), own).ec != std::errc()) return {};
    ten += own;
    digits.erase(e);
  }
  digits += 'e' + std::to_string(ten);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) return {};
  value *= unit.other / wanted.other;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

namespace {

/// The unit that may be meant by another text: one that differs in capitals, "kg" for "Kg", or in a letter.
std::string nearest_unit(std::string_view text) {
  std::vector<std::string> known(std::begin(coherent_units), std::end(coherent_units));
  known.insert(known.end(),
               {"g",   "mm",  "cm",  "\u00b5m", "ms",  "kN",  "MN",  "N/mm", "kN/mm", "kN/m", "MN/m",
                "MPa", "GPa", "kPa", "Hz",      "kHz", "deg", "rpm", "min",  "kg/s",  "mJ",   "kW"});
  const auto lowered = [](std::string_view word) {
    std::string all(word);
    std::transform(all.begin(), all.end(), all.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return all;
  };
  for (const std::string& unit : known)
    if (lowered(unit) == lowered(text)) return unit;
  return nearest(text, known);
}

bool has_decimal_comma(std::string_view text) {
  const auto comma = text.find_first_not_of("+-0123456789");
  const auto is_digit = [&](std::size_t at) {
    return at < text.size() && text[at] >= '0' && text[at] <= '9';
  };
  return comma != std::string_view::npos && comma > 0 && text[comma] == ',' && is_digit(comma - 1) &&
         is_digit(comma + 1);
}

}  // namespace

std::string objection_to_number(std::string_view text) {
  if (has_decimal_comma(text)) {
    std::string meant(text);
    meant[meant.find(',')] = '.';
    return "found " + file::shown(text) + ", must have a decimal point: " + file::shown(meant);
  }
  const auto quantity = split_quantity(text);
  if (!quantity || unit_of(quantity->unit)) return "";
  const std::string near = nearest_unit(quantity->unit);
  return "found the unknown unit " + file::shown(quantity->unit) +
         ", must be a unit as \"N/m\", \"mm\", or \"N s/m\"" +
         (near.empty() ? "" : "; did you mean " + file::shown(near) + "?");
}

}  // namespace arcslip::scene

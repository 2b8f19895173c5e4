#include <arcslip/report/html.hpp>

#include <arcslip/results/text.hpp>

#include <cmath>

namespace arcslip::report {

std::string text(std::string_view any) {
  std::string out;
  for (const char c : results::visible_lines(any)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string json_for_script(std::string json) {
  for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at))
    json.replace(at, 1, "\\u003c");
  return json;
}

void Html::tag(std::string_view name, Attributes attributes, std::string_view end) {
  out_ << '<' << name;
  for (const Attribute& each : attributes) out_ << ' ' << each.name << "=\"" << text(each.value) << '"';
  out_ << end;
}

Html& Html::open(std::string_view name, Attributes attributes) {
  tag(name, attributes, ">");
  open_.emplace_back(name);
  return *this;
}

Html& Html::close() {
  out_ << "</" << open_.back() << ">\n";
  open_.pop_back();
  return *this;
}

Html& Html::empty(std::string_view name, Attributes attributes) {
  tag(name, attributes, "/>");
  return *this;
}

Html& Html::element(std::string_view name, std::string_view any, Attributes attributes) {
  tag(name, attributes, ">");
  out_ << text(any) << "</" << name << '>';
  return *this;
}

Html& Html::write(std::string_view any) {
  out_ << text(any);
  return *this;
}

Html& Html::raw(std::string_view markup) {
  out_ << markup;
  return *this;
}

std::string plain_number(double value) {
  constexpr int digits = 10;
  return results::to_digits(value, digits);
}

std::string shortened(const std::string& name, std::size_t most) {
  std::size_t count = 0, end = 0;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if ((static_cast<unsigned char>(name[i]) & 0xc0) == 0x80) continue;  // within a character
    if (++count == most) end = i;
    if (count > most) return name.substr(0, end) + "…";
  }
  return name;
}

std::string pixels(double value) {
  constexpr double tenth = 10;
  const double rounded = std::round(value * tenth) / tenth;
  return results::shortest(rounded == 0 ? 0.0 : rounded);
}

}  // namespace arcslip::report

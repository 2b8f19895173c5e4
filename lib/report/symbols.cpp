#include <arcslip/report/schematic.hpp>

namespace arcslip::report {
namespace {

constexpr double half_width = 30;      // of a symbol
constexpr std::size_t name_room = 20;  // characters

/// A zigzag from x to x + width.
std::string zigzag(double x, double y, double width) {
  constexpr int teeth = 6;
  constexpr double height = 8;
  std::string path = "L" + pixels(x) + " " + pixels(y);
  for (int i = 0; i < teeth; ++i)
    path += "L" + pixels(x + width * (i + 0.5) / teeth) + " " + pixels(y + (i % 2 == 0 ? -height : height));
  return path + "L" + pixels(x + width) + " " + pixels(y);
}

std::string spring(double x, double y) {
  return zigzag(x - half_width, y, 2 * half_width);
}

/// A piston in a cylinder that is open on the right.
std::string damper(double x, double y) {
  return "H" + pixels(x - 14) + "M" + pixels(x + 14) + " " + pixels(y - 9) + "H" + pixels(x - 14) + "V" +
         pixels(y + 9) + "H" + pixels(x + 14) + "M" + pixels(x + 4) + " " + pixels(y - 7) + "V" +
         pixels(y + 7) + "M" + pixels(x + 4) + " " + pixels(y);
}

/// A spring and a slider in series.
std::string friction(double x, double y) {
  return zigzag(x - half_width - 8, y, 36) + "H" + pixels(x + 6) + "M" + pixels(x + 6) + " " + pixels(y - 6) +
         "H" + pixels(x + 34) + "M" + pixels(x - 2) + " " + pixels(y + 1) + "H" + pixels(x + 26) + "M" +
         pixels(x + 6) + " " + pixels(y - 6) + "V" + pixels(y) + "M" + pixels(x + 34) + " " + pixels(y - 6) +
         "V" + pixels(y) + "M" + pixels(x + 34) + " " + pixels(y);
}

std::string box(double x, double y) {
  return "H" + pixels(x - half_width) + "M" + pixels(x - half_width) + " " + pixels(y - 9) + "H" +
         pixels(x + half_width) + "V" + pixels(y + 9) + "H" + pixels(x - half_width) + "ZM" +
         pixels(x + half_width) + " " + pixels(y);
}

std::string shape(Symbol symbol, double x, double y) {
  switch (symbol) {
    case Symbol::spring:
    case Symbol::nonlinear_spring:
      return spring(x, y);
    case Symbol::damper:
      return damper(x, y);
    case Symbol::friction:
      return friction(x, y);
    case Symbol::other:
      break;
  }
  return box(x, y);
}

}  // namespace

void write_link(Html& html, const Link& link, double left, double right, double y) {
  const double x = (left + right) / 2;
  html.open("g", {{"class", "link"}});
  html.empty("path",
             {{"d", "M" + pixels(left) + " " + pixels(y) + shape(link.symbol, x, y) + "H" + pixels(right)}});
  if (link.symbol == Symbol::nonlinear_spring)
    html.empty("path", {{"d", "M" + pixels(x - 20) + " " + pixels(y + 14) + "L" + pixels(x + 20) + " " +
                                  pixels(y - 14) + "m-8 1l8 -1l-3 7"}});
  if (link.symbol == Symbol::friction)
    html.empty("path", {{"class", "load"},
                        {"d", "M" + pixels(x + 20) + " " + pixels(y - 20) + "V" + pixels(y - 8) +
                                  "m-3 -5l3 5l3 -5"}});
  html.element("text", shortened(link.name, name_room),
               {{"x", pixels(x)}, {"y", pixels(y - 22)}, {"text-anchor", "middle"}});
  html.element("text", shortened(link.value, name_room),
               {{"class", "value"}, {"x", pixels(x)}, {"y", pixels(y + 26)}, {"text-anchor", "middle"}});
  const bool is_right = link.is_positive_right;
  html.element("text", "+",
               {{"class", "sign"},
                {"x", pixels(is_right ? right - 8 : left + 8)},
                {"y", pixels(y - 5)},
                {"text-anchor", "middle"}});
  html.close();
}

}  // namespace arcslip::report

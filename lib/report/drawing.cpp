#include <arcslip/report/parts.hpp>
#include <arcslip/report/schematic.hpp>

#include <algorithm>

namespace arcslip::report {
namespace {

// Pixels.
constexpr double margin = 24, gap_width = 150, box_width = 96, row_height = 66, head_room = 58,
                 foot_room = 44;

constexpr std::size_t box_room = 16;  // characters

double left_of(int column) {
  return margin + gap_width + column * (gap_width + box_width);
}

double middle_of(int row) {
  return head_room + (row + 0.5) * row_height;
}

/// A hatched line on the left of a place.
void write_ground(Html& html, double x, double from, double to) {
  std::string hatches;
  for (double y = from + 6; y <= to; y += 8) hatches += "M" + pixels(x) + " " + pixels(y) + "l-8 6";
  html.empty("path",
             {{"class", "ground"}, {"d", "M" + pixels(x) + " " + pixels(from) + "V" + pixels(to) + hatches}});
}

void write_links(Html& html, const Schematic& of) {
  double wall = 0;  // down to which the ground on the left reaches
  for (const Link& link : of.links) {
    const double y = middle_of(link.row), right = left_of(link.to);
    double left = link.from == ground ? right - gap_width + 14 : left_of(link.from) + box_width;
    if (link.from == ground && link.to == 0) {
      left = margin;
      wall = std::max(wall, y + row_height / 2);
    } else if (link.from == ground) {
      write_ground(html, left, y - 16, y + 16);
    }
    write_link(html, link, left, right, y);
  }
  if (wall > 0) write_ground(html, margin, head_room, wall);
}

void write_column(Html& html, const Column& column, double x) {
  const double middle = x + box_width / 2, bottom = head_room + column.rows * row_height;
  html.open("g", {{"class", column.is_response ? "mass response" : "mass"}});
  html.empty("rect", {{"x", pixels(x)},
                      {"y", pixels(head_room)},
                      {"width", pixels(box_width)},
                      {"height", pixels(bottom - head_room)},
                      {"rx", "4"}});
  double y = head_room + 22;
  html.element("text", shortened(column.name, box_room),
               {{"class", "name"}, {"x", pixels(middle)}, {"y", pixels(y)}, {"text-anchor", "middle"}});
  for (const std::string& mass : column.masses)
    html.element(
        "text", shortened(mass, box_room),
        {{"class", "value"}, {"x", pixels(middle)}, {"y", pixels(y += 16)}, {"text-anchor", "middle"}});
  if (!column.forces.empty()) {
    html.empty("path",
               {{"class", "force"},
                {"d", "M" + pixels(middle - 30) + " " + pixels(head_room - 12) + "h60m-9 -5l9 5l-9 5"}});
    std::string all;
    for (const std::string& force : column.forces) all += (all.empty() ? "" : ", ") + force;
    html.element("text", shortened(all, 2 * box_room),
                 {{"x", pixels(middle)}, {"y", pixels(head_room - 24)}, {"text-anchor", "middle"}});
  }
  if (column.is_response)
    html.element(
        "text", "response",
        {{"class", "value"}, {"x", pixels(middle)}, {"y", pixels(bottom + 16)}, {"text-anchor", "middle"}});
  html.close();
}

void write_body(Html& html, const Schematic& of) {
  if (of.of_matrices == 0) return;
  const double right = left_of(of.of_matrices - 1) + box_width + 10, left = left_of(0) - 10;
  html.empty("rect", {{"class", "body"},
                      {"x", pixels(left)},
                      {"y", pixels(head_room - 10)},
                      {"width", pixels(right - left)},
                      {"height", pixels(of.rows * row_height + 34)},
                      {"rx", "10"}});
  html.element(
      "text", of.body,
      {{"class", "value"}, {"x", pixels(left + 8)}, {"y", pixels(head_room + of.rows * row_height + 38)}});
}

void write_conventions(Html& html, const Schematic& of) {
  html.open("div", {{"class", "conventions"}});
  if (of.why_not.empty())
    html.element("p",
                 "The drawing has all motions along one axis, positive to the right. The displacement of a "
                 "link is that of its end with "
                 "the sign + less that of the other end, and its force acts against it.");
  if (of.has_normal_loads)
    html.element("p",
                 "A normal load is positive in compression; a displacement along the normal is positive "
                 "into the contact. A negative normal load at rest is a gap.");
  if (!of.others.empty()) {
    html.element("p", of.why_not.empty() ? "Not drawn as links:" : "Its parts with several directions:");
    html.open("ul");
    for (const std::string& other : of.others) html.element("li", other);
    html.close();
  }
  html.close();
}

}  // namespace

void write_drawing(Html& html, const scene::Scene& scene) {
  const Schematic of = schematic(scene);
  if (!of.why_not.empty()) {
    html.element("p", of.why_not);
  } else {
    const double width = left_of(static_cast<int>(of.columns.size()) - 1) + box_width + margin,
                 height = head_room + of.rows * row_height + foot_room;
    html.open("div", {{"class", "wide"}});
    html.open("svg",
              {{"class", "scene"},
               {"viewBox", "0 0 " + pixels(width) + " " + pixels(height)},
               {"width", pixels(width)},
               {"height", pixels(height)},
               {"role", "img"},
               {"aria-label", "Drawing of the structure: its parts stand in the table of parameters"}});
    write_body(html, of);
    write_links(html, of);
    for (std::size_t i = 0; i < of.columns.size(); ++i)
      write_column(html, of.columns[i], left_of(static_cast<int>(i)));
    html.close().close();
  }
  write_conventions(html, of);
}

}  // namespace arcslip::report

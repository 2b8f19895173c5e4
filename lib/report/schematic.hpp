#pragma once
// A scene as a row of masses, with what links them: where each stands in a drawing.

#include <arcslip/report/html.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <vector>

namespace arcslip::report {

enum class Symbol { spring, damper, nonlinear_spring, friction, other };

inline constexpr int ground = -1;  // as a column

/// A spring, damper or element between two degrees of freedom, or one and the ground.
struct Link {
  std::string name, value;  // "k", "17890 N/m"; of an element the name of its law
  Symbol symbol = Symbol::other;
  int from = ground, to = 0;      // columns, from the left
  bool is_positive_right = true;  // the displacement at `to` counts positive, and that at `from` negative
  int row = 0;
};

/// A degree of freedom.
struct Column {
  std::string name;
  std::vector<std::string> masses{}, forces{};
  bool is_response = false;
  int rows = 1;  // down to which it reaches
};

struct Schematic {
  std::vector<Column> columns{};
  std::vector<Link> links{};
  int rows = 1;
  int of_matrices = 0;                // the first columns: points of one body
  std::string body{};                 // what that is
  std::vector<std::string> others{};  // what is not drawn, in words
  bool has_normal_loads = false;
  std::string why_not{};  // in place of a drawing
};

Schematic schematic(const scene::Scene& scene);

/// Draws the symbol of a link between two places at a height, with its name and value.
void write_link(Html& html, const Link& link, double left, double right, double y);

}  // namespace arcslip::report

#pragma once
// A kind of events of branches and curves: a constant with a name, words, a mark in figures and an
// explanation.

#include <ostream>
#include <string>
#include <string_view>

namespace arcslip::results {

/// The shapes of marks, in the order of gnuplot's point types.
enum class Shape {
  none,
  plus,
  cross,
  star,
  square,
  filled_square,
  circle,
  filled_circle,
  triangle,
  filled_triangle,
  inverted_triangle,
  filled_inverted_triangle,
  diamond,
  filled_diamond,
  pentagon,
  filled_pentagon
};

/// How figures mark an event; by default they do not.
struct Mark {
  Shape shape = Shape::none;
  double size = 1, line_width = 0;  // 0: as the figure has it
  std::string_view label{};         // empty: that of the line that it is on
  bool labelled = true;
};

/// A kind is known by its name, which is that of its monitors: results keep the name alone, so that a monitor
/// of a user's own needs no entry in event_kinds.hpp.
struct EventKind {
  std::string_view name{};   // as results write it: "period_doubling"
  std::string_view words{};  // in messages and figures: "period doubling"
  Mark mark{};
  std::string_view help{};  // one line of Markdown
  std::string_view of{};    // of which results it is an event: "frequency responses"

  operator std::string() const { return std::string(name); }  // the name of a monitor, the kind of an event
  friend constexpr bool operator==(const EventKind& a, const EventKind& b) { return a.name == b.name; }
  friend constexpr bool operator==(const EventKind& kind, std::string_view name) { return kind.name == name; }
  friend std::ostream& operator<<(std::ostream& to, const EventKind& kind) { return to << kind.name; }
};

}  // namespace arcslip::results

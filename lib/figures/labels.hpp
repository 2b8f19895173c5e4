#pragma once

#include <string>
#include <utility>
#include <vector>

namespace arcslip::figures {

/// A position in a figure; x and y from 0 to 1 over the axes.
struct Position {
  double x = 0, y = 0;
};

enum class LabelSide { none, above, right, left, below, above_right, above_left, below_right, below_left };

struct LabelMetrics {
  double character_width = 0.0165, line_height = 0.05;  // shares of the axes
};

/// A label's anchor relative to its mark, in characters and lines, and its alignment: -1 right, 0 centred,
/// 1 left.
struct LabelOffset {
  double x, y;
  int alignment;
};
LabelOffset offset(LabelSide side);

/// Texts that cover no other text, mark or line, and stay within the axes.
class LabelPlacer {
 public:
  /// lines: polylines.
  explicit LabelPlacer(std::vector<std::vector<Position>> lines, const LabelMetrics& metrics = {})
      : lines_(std::move(lines)), metrics_(metrics) {}

  /// Keeps texts off a mark.
  void keep_off(const Position& mark);
  /// Returns the side of a place at which a text stands from now on; none if there is no room.
  LabelSide place(const Position& at, const std::string& text);

 private:
  struct Box {
    double left, right, bottom, top;
    bool meets(const Box& other) const;
    bool is_within_axes() const { return left >= 0 && right <= 1 && bottom >= 0 && top <= 1; }
    bool meets(const Position& a, const Position& b) const;
  };
  Box box(const Position& at, const std::string& text, LabelSide side) const;
  bool is_free(const Box& candidate) const;

  std::vector<std::vector<Position>> lines_;
  LabelMetrics metrics_;
  std::vector<Box> taken_{};
};

}  // namespace arcslip::figures

#pragma once

#include <string>
#include <vector>

namespace arcslip::output {

/// A position in a figure; x and y from 0 to 1 over the axes.
struct Position {
  double x = 0, y = 0;
};

/// A text to be placed near a mark.
struct LabelWish {
  Position mark;
  std::string text;
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

/// A position of each label within the axes that covers no other label, mark or line (all polylines); none if
/// there is no such position.
std::vector<LabelSide> place_labels(const std::vector<LabelWish>& wishes,
                                    const std::vector<std::vector<Position>>& lines,
                                    const LabelMetrics& metrics = {});

}  // namespace arcslip::output

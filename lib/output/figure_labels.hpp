#pragma once

#include <string>
#include <vector>

namespace arcslip::output {

/// A place in a figure; x and y from 0 to 1 over the axes.
struct Place {
  double x = 0, y = 0;
};

/// A text that wants to stand near a mark.
struct LabelWish {
  Place mark;
  std::string text;
};

enum class LabelSide { none, above, right, left, below, above_right, above_left, below_right, below_left };

struct LabelMetrics {
  double character_width = 0.0165, line_height = 0.05;  // shares of the axes
};

/// A label's anchor relative to its mark, in characters and lines, and how the text lies there: -1 it ends at
/// the anchor, 0 is centred, 1 begins there.
struct LabelOffset {
  double x, y;
  int alignment;
};
LabelOffset offset(LabelSide side);

/// Where each label stands so that it covers no other label, no mark and no line (all polylines) and stays
/// within the axes; none where there is no such side.
std::vector<LabelSide> place_labels(const std::vector<LabelWish>& wishes,
                                    const std::vector<std::vector<Place>>& lines,
                                    const LabelMetrics& metrics = {});

}  // namespace arcslip::output

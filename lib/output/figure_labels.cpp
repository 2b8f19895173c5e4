#include <arcslip/output/figure_labels.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace arcslip::output {
namespace {

struct Box {
  double left, right, bottom, top;

  bool meets(const Box& other) const {
    return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
  }
  bool is_within_axes() const { return left >= 0 && right <= 1 && bottom >= 0 && top <= 1; }
  /// Clips the segment by each side in turn (Liang and Barsky 1984).
  bool meets_segment(const Position& a, const Position& b) const {
    double first = 0;
    double last = 1;
    const auto clip = [&](double step, double room) {  // share * step <= room
      if (step == 0) return room >= 0;
      (step < 0 ? first : last) = step < 0 ? std::max(first, room / step) : std::min(last, room / step);
      return first <= last;
    };
    return clip(a.x - b.x, a.x - left) && clip(b.x - a.x, right - a.x) && clip(a.y - b.y, a.y - bottom) &&
           clip(b.y - a.y, top - a.y);
  }
};

double characters(const std::string& text) {
  const auto starts_character = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
  return static_cast<double>(std::count_if(text.begin(), text.end(), starts_character));
}

Box box(const LabelWish& wish, LabelSide side, const LabelMetrics& metrics) {
  const LabelOffset shift = offset(side);
  const double width = characters(wish.text) * metrics.character_width;
  const double anchor = wish.mark.x + shift.x * metrics.character_width;
  const double left = anchor - (1 - shift.alignment) * width / 2;
  const double middle = wish.mark.y + shift.y * metrics.line_height;
  const double margin = metrics.character_width / 2;
  return {left - margin, left + width + margin, middle - 0.4 * metrics.line_height,
          middle + 0.4 * metrics.line_height};
}

bool meets_line(const Box& box, const std::vector<Position>& line) {
  for (std::size_t i = 1; i < line.size(); ++i)
    if (box.meets_segment(line[i - 1], line[i])) return true;
  return false;
}

}  // namespace

LabelOffset offset(LabelSide side) {
  switch (side) {
    case LabelSide::right:
      return {1.2, 0, 1};
    case LabelSide::left:
      return {-1.2, 0, -1};
    case LabelSide::below:
      return {0, -0.85, 0};
    case LabelSide::above_right:
      return {0.8, 0.65, 1};
    case LabelSide::above_left:
      return {-0.8, 0.65, -1};
    case LabelSide::below_right:
      return {0.8, -0.7, 1};
    case LabelSide::below_left:
      return {-0.8, -0.7, -1};
    case LabelSide::above:
    case LabelSide::none:
      break;
  }
  return {0, 0.85, 0};
}

std::vector<LabelSide> place_labels(const std::vector<LabelWish>& wishes,
                                    const std::vector<std::vector<Position>>& lines,
                                    const LabelMetrics& metrics) {
  constexpr std::array sides{LabelSide::above,      LabelSide::right,       LabelSide::left,
                             LabelSide::above_left, LabelSide::above_right, LabelSide::below,
                             LabelSide::below_left, LabelSide::below_right};
  std::vector<Box> taken;
  for (const auto& [mark, text] : wishes) {
    const double half_width = metrics.character_width / 2;
    const double half_height = metrics.line_height / 5;
    taken.push_back({mark.x - half_width, mark.x + half_width, mark.y - half_height, mark.y + half_height});
  }
  std::vector<LabelSide> chosen;
  for (const LabelWish& wish : wishes) {
    const auto is_free = [&](LabelSide side) {
      const Box candidate = box(wish, side, metrics);
      return candidate.is_within_axes() &&
             std::none_of(taken.begin(), taken.end(),
                          [&](const Box& other) { return candidate.meets(other); }) &&
             std::none_of(lines.begin(), lines.end(),
                          [&](const std::vector<Position>& line) { return meets_line(candidate, line); });
    };
    const auto* const side = std::find_if(sides.begin(), sides.end(), is_free);
    chosen.push_back(side == sides.end() ? LabelSide::none : *side);
    if (side != sides.end()) taken.push_back(box(wish, *side, metrics));
  }
  return chosen;
}

}  // namespace arcslip::output

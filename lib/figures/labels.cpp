#include <arcslip/figures/labels.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace arcslip::figures {
namespace {

double characters(const std::string& text) {
  const auto starts_character = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
  return static_cast<double>(std::count_if(text.begin(), text.end(), starts_character));
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

bool LabelPlacer::Box::meets(const Box& other) const {
  return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
}

/// Clips the segment by each side in turn (Liang and Barsky 1984).
bool LabelPlacer::Box::meets(const Position& a, const Position& b) const {
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

LabelPlacer::Box LabelPlacer::box(const Position& at, const std::string& text, LabelSide side) const {
  const LabelOffset shift = offset(side);
  const double width = characters(text) * metrics_.character_width;
  const double anchor = at.x + shift.x * metrics_.character_width;
  const double left = anchor - (1 - shift.alignment) * width / 2;
  const double middle = at.y + shift.y * metrics_.line_height;
  const double margin = metrics_.character_width / 2;
  return {left - margin, left + width + margin, middle - 0.4 * metrics_.line_height,
          middle + 0.4 * metrics_.line_height};
}

bool LabelPlacer::is_free(const Box& candidate) const {
  const auto meets_line = [&](const std::vector<Position>& line) {
    for (std::size_t i = 1; i < line.size(); ++i)
      if (candidate.meets(line[i - 1], line[i])) return true;
    return false;
  };
  return candidate.is_within_axes() &&
         std::none_of(taken_.begin(), taken_.end(),
                      [&](const Box& other) { return candidate.meets(other); }) &&
         std::none_of(lines_.begin(), lines_.end(), meets_line);
}

void LabelPlacer::keep_off(const Position& mark) {
  const double half_width = metrics_.character_width / 2, half_height = metrics_.line_height / 5;
  taken_.push_back({mark.x - half_width, mark.x + half_width, mark.y - half_height, mark.y + half_height});
}

LabelSide LabelPlacer::place(const Position& at, const std::string& text) {
  for (const LabelSide side :
       {LabelSide::above, LabelSide::right, LabelSide::left, LabelSide::above_left, LabelSide::above_right,
        LabelSide::below, LabelSide::below_left, LabelSide::below_right}) {
    const Box candidate = box(at, text, side);
    if (!is_free(candidate)) continue;
    taken_.push_back(candidate);
    return side;
  }
  return LabelSide::none;
}

}  // namespace arcslip::figures

#include <arcslip/output/gnuplot_style.hpp>

#include <arcslip/results/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace arcslip::output {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : results::visible(text)) {
    if (c == '\'') {
      result += R"('."'".')";  // gnuplot takes a doubled quote at the beginning for an empty text
    } else {
      result += c;
    }
  }
  return result + "'";
}

std::string shortened(const std::string& text, int longest) {
  int characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts_character = (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80;
    if (starts_character && ++characters > longest) {
      return text.substr(0, i) + " ...";
    }
  }
  return text;
}

std::string line_colour(std::size_t line, std::size_t lines) {
  constexpr std::array<std::array<int, 3>, 7> anchors{{{13, 8, 135},
                                                       {84, 2, 163},
                                                       {139, 10, 165},
                                                       {185, 50, 137},
                                                       {219, 92, 104},
                                                       {228, 112, 72},
                                                       {226, 138, 24}}};
  const double place = lines > 1 ? static_cast<double>(line) / static_cast<double>(lines - 1) *
                                       static_cast<double>(anchors.size() - 1)
                                 : 0.0;
  const auto lower = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  const double share = place - static_cast<double>(lower);
  std::array<char, 8> text{};
  std::array<unsigned, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    rgb[i] =
        static_cast<unsigned>(std::lround((1 - share) * anchors[lower][i] + share * anchors[lower + 1][i])) &
        0xffu;
  }
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", rgb[0], rgb[1], rgb[2]);
  return text.data();
}

std::string line_dash(std::size_t line) {
  constexpr std::array<const char*, 4> dashes{"solid", "(14,5)", "(4,4)", "(14,4,3,4)"};
  return dashes[line % dashes.size()];
}

}  // namespace arcslip::output

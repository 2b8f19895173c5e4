#pragma once

#include <cstddef>
#include <string>

namespace arcslip::output {

/// A text as gnuplot reads it: in single quotes, where nothing is special but the quote itself.
/// Characters that XML and terminals do not take are escaped (results/text.hpp).
std::string quoted(const std::string& text);

/// The first `longest` characters (UTF-8) of a text, and " ..." where there are more.
std::string shortened(const std::string& text, int longest);

/// Colour of a line by its rank, "#0d0887": the map "plasma" without its light end, so that the order of a
/// family shows, also in grey and to the colour-blind.
std::string line_colour(std::size_t line, std::size_t lines);

/// Dash type of a line, so that neighbours differ without colour.
std::string line_dash(std::size_t line);

}  // namespace arcslip::output

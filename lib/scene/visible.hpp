#pragma once
// Text from outside (names, keys, paths, words of other programs), made safe to show.

#include <string>
#include <string_view>

namespace arcslip::scene {

/// The text with every character escaped that commands a terminal, changes how its neighbours look, or is
/// none: control characters (C0, DEL, C1), marks and embeddings of writing direction, separators of lines and
/// paragraphs, noncharacters (U+FFFE, U+FFFF and their like) and surrogates, as JSON escapes them (\u009b);
/// bytes that are not UTF-8, as \x9b. What it has made it leaves as it is.
std::string visible(std::string_view text);

/// The same, but line breaks (\n) stay.
std::string visible_lines(std::string_view text);

}  // namespace arcslip::scene

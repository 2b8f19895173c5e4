#pragma once
// What must hold of any bytes that are given as a scene.

#include <string>
#include <vector>

namespace fuzz {

/// How far the bytes came.
enum class Reached { refused, read, traced };

struct Findings {
  Reached reached = Reached::refused;
  std::vector<std::string> faults;  // of Arcslip, one sentence each; none is well
};

/// Reads the text as a scene, writes it, reads that again, and traces a frequency response with few harmonics
/// and at most some dozen points where it is small enough.
///  - What cannot be read is a SceneError; each fault has a message and, unless it is one of the whole file,
///    a pointer to what stands in the text, or would.
///  - What is written reads back as the same scene, to the last bit.
///  - A response has finite numbers only, keeps its energy balance, and its results are sound JSON and
///    a table with as many cells in each row.
///  - No message names NaN, infinity or a part of the program unless the text itself does.
Findings examine(const std::string& text);

}  // namespace fuzz

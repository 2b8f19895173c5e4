#pragma once
// Scene files with one fault each and how it must be reported: the table of the tests and of
// docs/robustness.md.

#include <cstddef>
#include <istream>
#include <memory>
#include <string>
#include <vector>

namespace arcslip::scene::test {

struct BadScene {
  std::string name;
  std::string text;
  std::string pointer;
  std::string message_part;
  std::size_t repeats = 0;  // of the last character of the text, made while they are read
};

/// A sound scene with two degrees of freedom, from which most rows are made.
const std::string& good_scene();
/// good_scene() with one piece of it, which must stand in it once, replaced.
std::string good_scene_with(const std::string& piece, const std::string& replacement);

const std::vector<BadScene>& bad_scenes();
/// The text as a stream.
std::unique_ptr<std::istream> open(const BadScene& bad);

}  // namespace arcslip::scene::test

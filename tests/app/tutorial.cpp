// docs/tutorial.md: its commands print what stands behind them.

#include "catch.hpp"
#include "environment.hpp"
#include "program.hpp"

#include <fstream>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

using namespace app_test;

namespace {

struct Block {
  std::string language;
  std::vector<std::string> lines;

  std::string text() const {
    std::string all;
    for (const std::string& line : lines) all += line + '\n';
    return all;
  }
};

std::string without_blanks(const std::string& line) {
  const std::size_t first = line.find_first_not_of(' ');
  return first == std::string::npos ? "" : line.substr(first);
}

std::vector<Block> blocks_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<Block> blocks;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    const std::string text = without_blanks(line);
    if (text.starts_with("```")) {
      inside = !inside;
      if (inside) blocks.push_back({text.substr(3), {}});
    } else if (inside) {
      blocks.back().lines.push_back(line);
    }
  }
  return blocks;
}

// A line without leading blanks, times, which differ from run to run, and what rounding makes.
std::string comparable(const std::string& line) {
  static const std::regex time(R"([0-9.e-]+ s: )"), rounding(R"([0-9.]+e-(0[89]|[1-9][0-9])|0\.0e\+00)");
  return std::regex_replace(std::regex_replace(without_blanks(line), time, "T s: "), rounding, "0");
}

std::string run_command(const Workplace& place, const std::string& line) {
  std::istringstream words(line.substr(0, line.find(" #")));
  std::vector<std::string> arguments;
  for (std::string word; words >> word;) arguments.push_back(word);
  arguments.erase(arguments.begin());
  const Ended ended = run(place, arguments, {{"PATH", "/nonexistent"}});
  return ended.err + ended.out;
}

std::string with_piece_replaced(std::string text, const std::string& piece, const std::string& by) {
  REQUIRE(text.find(piece) != std::string::npos);
  return text.replace(text.find(piece), piece.size(), by);
}

// The lines are in the output, in this order; "..." stands for any.
void check_output(const Block& block, const std::string& output) {
  std::istringstream text(output);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(comparable(line));
  std::size_t next = 0;
  for (const std::string& line : block.lines) {
    if (without_blanks(line) == "...") continue;
    std::size_t at = next;
    while (at < lines.size() && lines[at] != comparable(line)) ++at;
    CAPTURE(line, output);
    CHECK(at < lines.size());
    if (at < lines.size()) next = at + 1;
  }
}

}  // namespace

TEST_CASE("the commands of the tutorial print what it shows") {
  const Workplace place;
  std::string scene;
  std::optional<std::string> output;
  int compared = 0;
  for (const Block& block : blocks_of(source_folder() + "/docs/tutorial.md")) {
    if (block.language == "json" && scene.empty()) {
      scene = block.text();
      place.write("damper.json", scene);
    } else if (block.language == "json") {
      const std::size_t end = scene.find_last_of('}');
      place.write("damper.json",
                  scene.substr(0, scene.find_last_not_of(" \n", end - 1) + 1) + ",\n" + block.text() + "}\n");
      output = run_command(place, "arcslip run damper.json");
    } else if (block.language == "sh") {
      output.reset();
      for (const std::string& line : block.lines)
        if (without_blanks(line).starts_with("arcslip "))
          output = output.value_or("") + run_command(place, line);
    } else if (!block.lines.empty() && block.lines.front().starts_with("bad.json")) {
      place.write("bad.json",
                  with_piece_replaced(with_piece_replaced(scene, "\"normal_load\"", "\"normal_laod\""),
                                      "\"value\": 2.0}]\n  },", "\"value\": -2}]\n  },"));
      check_output(block, run_command(place, "arcslip check bad.json"));
      ++compared;
    } else if (output) {
      check_output(block, *output);
      ++compared;
    }
  }
  CHECK(compared >= 9);
}

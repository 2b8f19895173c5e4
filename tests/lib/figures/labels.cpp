#include "catch.hpp"

#include <arcslip/figures/labels.hpp>

#include <string>
#include <utility>
#include <vector>

using namespace arcslip;
using figures::LabelSide;
using figures::Position;

namespace {

std::vector<LabelSide> sides(const std::vector<std::pair<Position, std::string>>& wishes,
                             std::vector<std::vector<Position>> lines) {
  figures::LabelPlacer placer(std::move(lines), {0.02, 0.05});
  for (const auto& [mark, text] : wishes) placer.keep_off(mark);
  std::vector<LabelSide> all;
  for (const auto& [mark, text] : wishes) all.push_back(placer.place(mark, text));
  return all;
}

}  // namespace

TEST_CASE("a label keeps off marks, lines, other labels and the border") {
  CHECK(sides({{{0.5, 0.5}, "3 N"}}, {}) == std::vector{LabelSide::above});
  CHECK(sides({{{0.5, 0.97}, "3 N"}}, {}) == std::vector{LabelSide::right});
  CHECK(sides({{{0.99, 0.97}, "3 N"}}, {}) == std::vector{LabelSide::left});
  CHECK(sides({{{0.5, 0.5}, "3 N"}}, {{{0, 0.55}, {1, 0.55}}}) == std::vector{LabelSide::right});
  CHECK(sides({{{0.5, 0.5}, "3 N"}, {{0.5, 0.501}, "4 N"}}, {}) ==
        std::vector{LabelSide::above, LabelSide::right});
  std::vector<std::vector<Position>> hatched;
  for (int i = 0; i <= 100; ++i) hatched.push_back({{0, i / 100.0}, {1, i / 100.0}});
  CHECK(sides({{{0.5, 0.5}, "3 N"}}, hatched) == std::vector{LabelSide::none});
}

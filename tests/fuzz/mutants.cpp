// Mutants of scenes, examined one by one. ARCSLIP_MUTANTS is how many; by default 3000, or 100 000 with
// ARCSLIP_FULL=1. The same ones on every machine; ARCSLIP_FIRST_MUTANT is the seed of the first one, so that
// several processes share them.

#include "catch.hpp"
#include "environment.hpp"

#include "fuzz/examine.hpp"
#include "fuzz/mutation.hpp"
#include "lib/scene/format/bad_scenes.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = 100'000;  // of a mutant

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The corpus and the scenes of the examples, by their names.
std::vector<std::string> scenes() {
  std::vector<fs::path> paths;
  for (const char* folder : {"/tests/fuzz/corpus", "/examples"})
    for (const auto& entry : fs::recursive_directory_iterator(source_folder() + folder))
      if (entry.path().extension() == ".json") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const fs::path& path : paths) texts.push_back(content(path));
  return texts;
}

fuzz::Findings check(const std::string& text) {
  const fuzz::Findings findings = fuzz::examine(text);
  for (const std::string& fault : findings.faults) {
    CAPTURE(text);
    FAIL_CHECK(fault);
  }
  return findings;
}

}  // namespace

TEST_CASE("the corpus, the examples and the faulty scenes pass the examination of mutants themselves") {
  for (const std::string& text : scenes()) check(text);
  for (const auto& bad : arcslip::scene::test::bad_scenes()) {
    if (bad.repeats > 0) continue;  // too large to be held
    CAPTURE(bad.name);
    CHECK(check(bad.text).reached == fuzz::Reached::refused);
  }
}

TEST_CASE(
    "mutants of scenes end with a fault that has its place, or a finite response, and read back as written") {
  const std::vector<std::string> origins = scenes();
  std::map<fuzz::Reached, int> reached;
  const std::uint64_t count = fuzz::mutants.count();
  const std::uint64_t first = fuzz::first_mutant.count();
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    CAPTURE(seed);
    const std::string mutant = fuzz::mutate(origins[seed % origins.size()], seed, most_bytes);
    ++reached[check(mutant).reached];
  }
  // Else it would be the parser alone that is tested.
  CAPTURE(reached[fuzz::Reached::refused], reached[fuzz::Reached::read], reached[fuzz::Reached::traced]);
  CHECK(reached[fuzz::Reached::read] + reached[fuzz::Reached::traced] > 0.1 * static_cast<double>(count));
  CHECK(reached[fuzz::Reached::traced] > 0.05 * static_cast<double>(count));
  CHECK(reached[fuzz::Reached::refused] > 0.1 * static_cast<double>(count));
}

#include "bad_topics.hpp"

#include <algorithm>
#include <sstream>
#include <streambuf>
#include <utility>

namespace arcslip::scene::test {
namespace {

// A text and its last character many times again, of which little is in memory at a time.
class RepeatingBuffer : public std::streambuf {
 public:
  RepeatingBuffer(std::string text, std::size_t repeats)
      : text_(std::move(text)), block_(1 << 16, text_.back()), repeats_(repeats) {
    setg(text_.data(), text_.data(), text_.data() + text_.size());
  }

 protected:
  int_type underflow() override {
    const std::size_t count = std::min(repeats_, block_.size());
    if (count == 0) return traits_type::eof();
    repeats_ -= count;
    setg(block_.data(), block_.data(), block_.data() + count);
    return traits_type::to_int_type(block_.front());
  }

 private:
  std::string text_, block_;
  std::size_t repeats_;
};

class RepeatingStream : public std::istream {
 public:
  RepeatingStream(const std::string& text, std::size_t repeats)
      : std::istream(nullptr), buffer_(text, repeats) {
    rdbuf(&buffer_);
  }

 private:
  RepeatingBuffer buffer_;
};

}  // namespace

void add_bad_files(std::vector<BadScene>& rows) {
  const std::string& good = good_scene();
  rows.push_back({"empty file", "", "", "line 1, column 1: the file is empty, must hold a scene"});
  rows.push_back({"only white space", " \n\t\n", "", "line 3, column 1: the file is empty"});
  rows.push_back({"truncated JSON", good.substr(0, good.size() / 2), "", "the file ends too early"});
  rows.push_back({"truncated in a number", "{\"a\": -", "", "line 1, column 8: the file ends too early"});
  rows.push_back({"truncated in a string", "{\n\"form", "", "line 2, column 6: the file ends too early"});
  rows.push_back({"no JSON at all", "structure: 3", "", "line 1, column 1: this is not JSON"});
  rows.push_back({"a comma too many", "{\"format\":\n \"arcslip-scene-1\",}", "",
                  "line 2, column 20: this is not JSON"});
  rows.push_back({"something after the end", good + "x", "", "expected end of input"});
  rows.push_back({"something after the end, behind a NUL byte", "{}\n" + std::string(1, '\0') + good, "",
                  "line 2, column 1: found a NUL byte, must be JSON in UTF-8, which has none"});
  rows.push_back({"text that is not UTF-8", "{\"title\": \"\xff\"}", "", "ill-formed UTF-8 byte"});
  rows.push_back(
      {"100 000 nested lists", std::string(100'000, '['), "",
       "line 1, column 65: found lists or objects nested deeper than 64, must be at most 64 deep"});
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
  rows.push_back({"100 000 nested objects", objects, "", "nested deeper than 64"});
  rows.push_back({"a number of 1 GB", "[1", "",
                  "found more than 67108864 bytes, a scene must be at most 64 MB", 1'000'000'000});
  rows.push_back({"a number of 20 000 digits", "[" + std::string(20'000, '1') + "]", "",
                  "\"... (20000 bytes), a number that is too large, must be a finite number"});
  rows.push_back(
      {"1e99999", good_scene_with("50}", "1e99999}"), "", "found \"1e99999\", a number that is too large"});
  rows.push_back({"NaN", good_scene_with("50}", "NaN}"), "", "JSON has no NaN and no Infinity"});
  rows.push_back({"nan", good_scene_with("50}", "nan}"), "", "JSON has no NaN and no Infinity"});
  rows.push_back({"Infinity", good_scene_with("50}", "Infinity}"), "", "JSON has no NaN and no Infinity"});
  rows.push_back({"-Infinity", good_scene_with("50}", "-Infinity}"), "", "JSON has no NaN and no Infinity"});
  rows.push_back(
      {"a list for a scene", "[]", "", "found a list, must be an object with the keys \"format\""});
}

std::unique_ptr<std::istream> open(const BadScene& bad) {
  if (bad.repeats > 0) return std::make_unique<RepeatingStream>(bad.text, bad.repeats);
  return std::make_unique<std::istringstream>(bad.text);
}

}  // namespace arcslip::scene::test

#pragma once
// A JSON text as a tree of its own words: numbers and strings as they were written, keys in their order and
// as often as they stand there. Any word may be replaced by any other, also by one that is no JSON.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

struct Node {
  enum class Kind { word, list, object };
  Kind kind = Kind::word;
  std::string word{};               // Kind::word: "1e5", "\"a\"", "true"
  std::vector<std::string> keys{};  // Kind::object: as written, with quotation marks; one for each item
  std::vector<Node> items{};        // Kind::list, Kind::object

  bool is_string() const { return kind == Kind::word && !word.empty() && word.front() == '"'; }
  bool is_number() const;
};

/// Empty where the text is no JSON, as far as this can tell, or is nested deeper than 100.
std::optional<Node> parse(std::string_view text);
std::string print(const Node& node);

}  // namespace fuzz

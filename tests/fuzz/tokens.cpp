#include "fuzz/tokens.hpp"

#include <utility>

namespace fuzz {
namespace {

constexpr int deepest = 100;
constexpr std::string_view blanks = " \t\r\n";

class Parser {
 public:
  explicit Parser(std::string_view text) : rest_(text) {}

  std::optional<Node> value(int depth = 0) {
    skip_blanks();
    if (rest_.empty() || depth > deepest) return {};
    if (rest_.front() == '[') return items(Node::Kind::list, ']', depth);
    if (rest_.front() == '{') return items(Node::Kind::object, '}', depth);
    std::string word = next_word();
    if (word.empty()) return {};
    return Node{Node::Kind::word, std::move(word)};
  }

  bool at_end() {
    skip_blanks();
    return rest_.empty();
  }

 private:
  void skip_blanks() {
    const auto first = rest_.find_first_not_of(blanks);
    rest_.remove_prefix(first == std::string_view::npos ? rest_.size() : first);
  }

  bool take(char c) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  std::string next_word() {
    skip_blanks();
    std::size_t end = 0;
    if (!rest_.empty() && rest_.front() == '"') {
      for (end = 1; end < rest_.size() && rest_[end] != '"'; ++end) end += rest_[end] == '\\';
      if (end >= rest_.size()) return "";
      ++end;
    } else {
      end = std::min(rest_.find_first_of(" \t\r\n,:[]{}\""), rest_.size());
    }
    std::string word(rest_.substr(0, end));
    rest_.remove_prefix(end);
    return word;
  }

  std::optional<Node> items(Node::Kind kind, char close, int depth) {
    rest_.remove_prefix(1);
    Node node{kind};
    if (take(close)) return node;
    do {
      if (kind == Node::Kind::object) {
        node.keys.push_back(next_word());
        if (node.keys.back().empty() || !take(':')) return {};
      }
      std::optional<Node> item = value(depth + 1);
      if (!item) return {};
      node.items.push_back(std::move(*item));
    } while (take(','));
    if (!take(close)) return {};
    return node;
  }

  std::string_view rest_;
};

void print(const Node& node, std::string& out) {
  if (node.kind == Node::Kind::word) {
    out += node.word;
    return;
  }
  const bool object = node.kind == Node::Kind::object;
  out += object ? '{' : '[';
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) out += ", ";
    if (object) out += node.keys[i] + ": ";
    print(node.items[i], out);
  }
  out += object ? '}' : ']';
}

}  // namespace

bool Node::is_number() const {
  return kind == Kind::word && !word.empty() &&
         std::string_view("-0123456789").find(word.front()) != std::string_view::npos;
}

std::optional<Node> parse(std::string_view text) {
  Parser parser(text);
  std::optional<Node> node = parser.value();
  if (node && !parser.at_end()) return {};
  return node;
}

std::string print(const Node& node) {
  std::string out;
  print(node, out);
  return out;
}

}  // namespace fuzz

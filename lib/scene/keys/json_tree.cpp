#include <arcslip/scene/keys/json_tree.hpp>

#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/scene.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

namespace arcslip::scene::file {
namespace {

// With long double nlohmann's parser goes on after a number such as 1e999, which is then one fault among the
// others.
using Json =
    nlohmann::basic_json<std::map, std::vector, std::string, bool, std::int64_t, std::uint64_t, long double>;

constexpr std::size_t between_questions = 1 << 14;  // whether to go on, in values

[[noreturn]] void fail(std::string message) {
  throw SceneError({{"", std::move(message)}});
}

// A text and how much of it the parser has taken.
class Source {
 public:
  explicit Source(std::string_view text) : text_(text) {}
  bool at_end() const { return taken_ == text_.size(); }
  char current() const { return text_[taken_]; }
  void advance() { ++taken_; }
  std::size_t taken() const { return taken_; }

  // Line and column of the byte with this number, counted from 1.
  std::string place_of(std::size_t byte) const {
    const std::string_view before = text_.substr(0, byte == 0 ? 0 : byte - 1);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t last_break = before.rfind('\n');
    const std::size_t start = last_break == std::string_view::npos ? 0 : last_break + 1;
    return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - start + 1);
  }
  std::string place() const { return place_of(taken_); }

 private:
  std::string_view text_;
  std::size_t taken_ = 0;
};

// The iterator that nlohmann's parser wants. Without a source it is the end.
class SourceIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  SourceIterator() = default;
  explicit SourceIterator(Source& source) : source_(&source) {}
  char operator*() const { return source_->current(); }
  SourceIterator& operator++() {
    source_->advance();
    return *this;
  }
  SourceIterator operator++(int) {
    const SourceIterator before = *this;
    source_->advance();
    return before;
  }
  friend bool operator==(const SourceIterator& a, const SourceIterator& b) {
    return a.at_end() == b.at_end();
  }
  friend bool operator!=(const SourceIterator& a, const SourceIterator& b) { return !(a == b); }

 private:
  bool at_end() const { return source_ == nullptr || source_->at_end(); }
  Source* source_ = nullptr;
};

// The sentence of nlohmann's message without its number and its place.
std::string reason_of(std::string_view what) {
  constexpr std::size_t longest = 200;
  const std::size_t syntax = what.find("syntax error ");
  if (syntax != std::string_view::npos) what.remove_prefix(syntax);
  std::string reason(what.substr(0, longest));
  // it quotes the input, which need not be UTF-8
  std::replace_if(
      reason.begin(), reason.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; }, '?');
  return reason + (what.size() > longest ? "..." : "");
}

// The parser stops within NaN, nan, Infinity, inf and their like.
bool is_not_finite(std::string_view token) {
  return token.ends_with('N') || token.ends_with('I') || token.ends_with('i') || token.ends_with("na");
}

class TreeBuilder : public nlohmann::json_sax<Json> {
 public:
  TreeBuilder(Source& source, Node& root, const control::Control& control)
      : source_(source), root_(root), control_(control) {}

  bool null() override { return add(Node{nullptr}); }
  bool boolean(bool value) override { return add(Node{value}); }
  bool number_integer(std::int64_t value) override { return add(Node{static_cast<double>(value)}); }
  bool number_unsigned(std::uint64_t value) override { return add(Node{static_cast<double>(value)}); }
  bool number_float(long double value, const std::string& digits) override {
    double exact = 0;  // rounded once, from the digits, and not twice by way of long double
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), exact);
    if (result.ec == std::errc::result_out_of_range) exact = static_cast<double>(value);
    return std::isfinite(exact) ? add(Node{exact}) : add(Node{Oversized{digits}});
  }
  bool string(std::string& value) override { return add(Node{std::move(value)}); }
  bool binary(Json::binary_t&) override { return false; }  // no text has it
  bool start_object(std::size_t) override { return open(Node{Node::Object{}}); }
  bool start_array(std::size_t) override { return open(Node{Node::List{}}); }
  bool key(std::string& value) override {
    std::get<Node::Object>(open_.back()->value).push_back({std::move(value), Node{}});
    return true;
  }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool parse_error(std::size_t byte, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    const std::string_view what = error.what();
    const std::string place = source_.place_of(byte);
    const bool too_early = byte > source_.taken();  // the parser asked for a byte beyond the last
    if (too_early && count_ == 0 && what.find("unexpected end of input") != std::string_view::npos) {
      fail(place +
           ": the file is empty, must hold a scene: an object with \"format\": " + quoted(format_name));
    }
    if (error.id == 406)  // beyond even long double
      fail(place + ": found " + shown(token) + ", a number that is too large, must be a finite number");
    if (too_early) fail(place + ": the file ends too early: " + reason_of(what));
    fail(place + ": this is not JSON: " + reason_of(what) +
         (is_not_finite(token) ? "; a number must be finite (JSON has no NaN and no Infinity)" : ""));
  }

 private:
  Node* place(Node&& node) {
    if (++count_ > largest_count) {
      fail(source_.place() + ": found more than " + std::to_string(largest_count) +
           " values, must be at most that many");
    }
    if (count_ % between_questions == 0 && !control_.keep_going())
      throw control::Interrupted("interrupted while the scene was read");
    if (open_.empty()) {
      root_ = std::move(node);
      return &root_;
    }
    if (auto* list = std::get_if<Node::List>(&open_.back()->value))
      return &list->emplace_back(std::move(node));
    Node& value = std::get<Node::Object>(open_.back()->value).back().value;
    value = std::move(node);
    return &value;
  }
  bool add(Node&& node) {
    place(std::move(node));
    return true;
  }
  bool open(Node&& node) {
    if (open_.size() == static_cast<std::size_t>(largest_depth)) {
      fail(source_.place() + ": found lists or objects nested deeper than " + std::to_string(largest_depth) +
           ", must be at most " + std::to_string(largest_depth) + " deep");
    }
    open_.push_back(place(std::move(node)));  // stays where it is: its parent grows only after it is closed
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  Source& source_;
  Node& root_;
  const control::Control& control_;
  std::vector<Node*> open_;
  std::size_t count_ = 0;
};

}  // namespace

Node read_tree(std::string_view text, const control::Control& control) {
  Source source(text);
  const std::size_t nul = text.find('\0');  // nlohmann's parser takes it for the end
  if (nul != std::string_view::npos)
    fail(source.place_of(nul + 1) + ": found a NUL byte, must be JSON in UTF-8, which has none");
  Node root;
  TreeBuilder builder(source, root, control);
  Json::sax_parse(SourceIterator(source), SourceIterator(), &builder);
  return root;
}

std::string described(const Node& node) {
  if (const auto* flag = node.get<bool>()) return *flag ? "true" : "false";
  if (const auto* number = node.get<double>()) return number_text(*number) + " (a number)";
  if (const auto* oversized = node.get<Oversized>()) {
    const std::string& digits = oversized->digits;
    return (digits.size() > 40 ? digits.substr(0, 40) + "... (" + std::to_string(digits.size()) + " digits)"
                               : digits) +
           " (a number that is too large)";
  }
  if (const auto* text = node.get<std::string>()) return shown(*text) + " (a string)";
  if (node.get<Node::List>() != nullptr) return "a list";
  return node.get<Node::Object>() != nullptr ? "an object" : "null";
}

// Printing a tree so that a person likes to read it.

namespace {

constexpr std::size_t line_width = 110;

// A value on one line.
std::string on_one_line(const Node& node) {
  std::string text;
  if (const auto* object = node.get<Node::Object>()) {
    for (const Member& member : *object)
      text += (text.empty() ? "" : ", ") + file::quoted(member.key) + ": " + on_one_line(member.value);
    return '{' + text + '}';
  }
  if (const auto* list = node.get<Node::List>()) {
    for (const Node& item : *list) text += (text.empty() ? "" : ", ") + on_one_line(item);
    return '[' + text + ']';
  }
  if (const auto* string = node.get<std::string>()) return file::quoted(*string);
  if (const auto* number = node.get<double>()) return number_text(*number);
  if (const auto* oversized = node.get<Oversized>()) return oversized->digits;
  return node.get<bool>() != nullptr ? (*node.get<bool>() ? "true" : "false") : "null";
}

bool holds_containers(const Node::List& list) {
  for (const Node& item : list)
    if (item.get<Node::List>() != nullptr || item.get<Node::Object>() != nullptr) return true;
  return false;
}

void print(const Node& node, std::size_t indent, std::size_t column, std::string& out);

// Begins the next of several items that stand side by side, on a new line where it does not fit any more.
void begin_item(bool first, std::size_t width, std::size_t indent, std::size_t& column, std::string& out) {
  if (!first && column + 1 + width > line_width) {
    out += '\n' + std::string(indent, ' ');
    column = indent;
  } else if (!first) {
    out += ' ';
    ++column;
  }
}

// Words or numbers side by side.
void print_leaves(const Node::List& list, std::size_t indent, std::size_t column, std::string& out) {
  out += '[';
  ++column;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string item = on_one_line(list[i]) + (i + 1 < list.size() ? "," : "]");
    begin_item(i == 0, item.size(), indent + 1, column, out);
    out += item;
    column += item.size();
  }
}

// The members of a list's item side by side.
void print_item(const Node::Object& object, std::size_t indent, std::string& out) {
  out += '{';
  std::size_t column = indent + 1;
  for (std::size_t i = 0; i < object.size(); ++i) {
    const std::string key = file::quoted(object[i].key) + ": ";
    const std::string value = on_one_line(object[i].value);
    begin_item(i == 0, key.size() + value.size() + 1, indent + 1, column, out);
    out += key;
    column += key.size();
    if (column + value.size() + 1 <= line_width) {
      out += value;
      column += value.size();
    } else {
      print(object[i].value, indent + 1, column, out);
      column = line_width;  // what follows begins a line
    }
    out += i + 1 < object.size() ? "," : "}";
    ++column;
  }
}

void print_members(const Node::Object& object, std::size_t indent, std::string& out) {
  const std::string margin = '\n' + std::string(indent, ' ');
  for (std::size_t i = 0; i < object.size(); ++i) {
    const std::string key = file::quoted(object[i].key) + ": ";
    out += (i == 0 ? "{" : ",") + margin + "  " + key;
    print(object[i].value, indent + 2, indent + 2 + key.size(), out);
  }
  out += margin + '}';
}

void print_items(const Node::List& list, std::size_t indent, std::string& out) {
  const std::string margin = '\n' + std::string(indent, ' ');
  for (std::size_t i = 0; i < list.size(); ++i) {
    out += (i == 0 ? "[" : ",") + margin + "  ";
    const std::string line = on_one_line(list[i]);
    const auto* object = list[i].get<Node::Object>();
    if (object != nullptr && indent + 2 + line.size() + 1 > line_width)
      print_item(*object, indent + 2, out);
    else
      out += line;
  }
  out += margin + ']';
}

// `column` is where the value begins; one column is kept for the comma after it.
void print(const Node& node, std::size_t indent, std::size_t column, std::string& out) {
  const std::string line = on_one_line(node);
  if (column + line.size() + 1 <= line_width)
    out += line;
  else if (const auto* object = node.get<Node::Object>())
    print_members(*object, indent, out);
  else if (const auto* list = node.get<Node::List>())
    holds_containers(*list) ? print_items(*list, indent, out) : print_leaves(*list, column, column, out);
  else
    out += line;
}

}  // namespace

std::string print_tree(const Node& root) {
  std::string out;
  if (const auto* object = root.get<Node::Object>(); object != nullptr && !object->empty())
    print_members(*object, 0, out);
  else
    out = on_one_line(root);
  return out + '\n';
}

}  // namespace arcslip::scene::file

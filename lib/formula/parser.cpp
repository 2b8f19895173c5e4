#include <arcslip/formula/formula.hpp>
#include <arcslip/formula/operations.hpp>
#include <arcslip/formula/tape_builder.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

namespace arcslip::formula {
namespace {

constexpr std::string_view wanted = "must be a number, a name, a function or \"(\"";
constexpr std::string_view wanted_next = "must be an operator or the end";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
// Bytes of UTF-8 beyond ASCII are letters.
bool begins_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}
bool is_in_name(char c) {
  return begins_name(c) || is_digit(c);
}
bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

struct Comparison {
  std::string_view text;
  Operation operation;
  bool swapped;
};
// The longer ones first.
constexpr Comparison comparisons[] = {
    {"<=", Operation::less_or_equal, false}, {">=", Operation::less_or_equal, true},
    {"==", Operation::equal, false},         {"!=", Operation::not_equal, false},
    {"<", Operation::less, false},           {">", Operation::less, true}};

/// Reads the text of one expression into nodes.
class Parser {
 public:
  Parser(std::string_view text, std::size_t index, const InputOf& input_of, TapeBuilder& tape,
         Formula::Author author)
      : text_(text),
        index_(index),
        input_of_(input_of),
        tape_(tape),
        has_limits_(author == Formula::Author::user) {}

  int whole() {
    if (has_limits_ && text_.size() > longest_text)
      fail(longest_text, "is longer than " + std::to_string(longest_text) + " characters");
    const int node = comparison();
    if (!at_end())
      fail(at_, "found " + found() + ", " + std::string(wanted_next) +
                    (is_after_number() ? "; numbers in formulas have no units, but those of the SI" : ""));
    return node;
  }

 private:
  // A level of the text: parentheses, signs and powers within one another.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > largest_depth)
        parser_.fail(parser_.at_, "is nested deeper than " + std::to_string(largest_depth) + " levels");
    }
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  int comparison() {
    const Level level(*this);
    const int left = sum();
    const Comparison* found_one = taken_comparison();
    if (found_one == nullptr) return left;
    const std::size_t from = at_;
    const int right = sum();
    const std::size_t next = at_;
    if (taken_comparison() != nullptr) fail(next, "found a second comparison, must be in parentheses");
    return found_one->swapped ? node(from, found_one->operation, right, left)
                              : node(from, found_one->operation, left, right);
  }

  int sum() {
    int left = product();
    for (;;) {
      const std::size_t from = at_;
      if (taken('+'))
        left = node(from, Operation::add, left, product());
      else if (taken('-'))
        left = node(from, Operation::subtract, left, product());
      else
        return left;
    }
  }

  int product() {
    int left = signed_power();
    for (;;) {
      skip_spaces();
      const std::size_t from = at_;
      if (text_.substr(at_, 2) == "**") fail(at_, "found \"**\", must be \"^\" for a power");
      if (taken('*'))
        left = node(from, Operation::multiply, left, signed_power());
      else if (taken('/'))
        left = node(from, Operation::divide, left, signed_power());
      else
        return left;
    }
  }

  int signed_power() {
    const std::size_t from = at_;
    if (taken('+')) {
      const Level level(*this);
      return signed_power();
    }
    if (taken('-')) {
      const Level level(*this);
      return node(from, Operation::negate, signed_power());
    }
    return power();
  }

  int power() {
    const int base = atom();
    const std::size_t from = at_;
    if (!taken('^')) return base;
    const Level level(*this);
    return node_of_power(from, base, signed_power());
  }

  int atom() {
    skip_spaces();
    if (at_ >= text_.size()) fail(at_, "ends, " + std::string(wanted));
    const char c = text_[at_];
    if (is_digit(c) || c == '.') return number();
    if (begins_name(c) || c == '\'') return name();
    if (taken('(')) {
      const int inside = comparison();
      close("\")\" or an operator");
      return inside;
    }
    fail(at_, "found " + found() + ", " + std::string(wanted));
  }

  int number() {
    double value = 0;
    const char* const first = text_.data() + at_;
    const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), value);
    if (error == std::errc::result_out_of_range || (error == std::errc() && !std::isfinite(value)))
      fail(at_, "found a number beyond the range of doubles");
    if (error != std::errc()) fail(at_, "found " + found() + ", " + std::string(wanted));
    const std::size_t from = at_;
    at_ += static_cast<std::size_t>(end - first);
    if (at_ < text_.size() && begins_name(text_[at_]))
      fail(from, "found a number with letters behind it, must have an operator between them");
    return node(from, Operation::constant, -1, -1, -1, value);
  }

  // A name, or the call of a function.
  int name() {
    const std::size_t from = at_;
    std::string text;
    bool quoted = false;
    for (bool more = true; more;) {
      quoted = part_of_name(text) || quoted;
      more = at_ + 1 < text_.size() && text_[at_] == '.' &&
             (begins_name(text_[at_ + 1]) || text_[at_ + 1] == '\'');
      if (more) text += text_[at_++];
    }
    skip_spaces();
    if (!quoted && at_ < text_.size() && text_[at_] == '(') return call(from, text);
    if (const auto input = input_of_(text)) return node(from, Operation::input, -1, -1, -1, *input);
    if (text == "pi") return node(from, Operation::constant, -1, -1, -1, std::numbers::pi);
    throw_unknown(FormulaFault::Kind::unknown_name, from, text, "name");
  }

  // Appends it; true if it is in quotes.
  bool part_of_name(std::string& text) {
    const std::size_t from = at_;
    if (text_[at_] != '\'') {
      while (at_ < text_.size() && is_in_name(text_[at_])) text += text_[at_++];
      return false;
    }
    const std::size_t end = text_.find('\'', at_ + 1);
    if (end == std::string_view::npos) fail(from, "found a quote that does not end");
    if (end == at_ + 1) fail(from, "found an empty name in quotes");
    text += text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return true;
  }

  int call(std::size_t from, const std::string& text) {
    const auto all = functions();
    const auto function =
        std::find_if(all.begin(), all.end(), [&](const Function& f) { return f.name == text; });
    if (function == all.end()) throw_unknown(FormulaFault::Kind::unknown_function, from, text, "function");
    taken('(');
    const Level level(*this);
    std::vector<int> arguments;
    do arguments.push_back(comparison());
    while (taken(','));
    close("\",\", \")\" or an operator");
    const int count = static_cast<int>(arguments.size());
    if (count < function->least || count > function->most)
      fail(from, "found " + text + " with " + std::to_string(count) +
                     (count == 1 ? " argument" : " arguments") + ", must have " +
                     std::to_string(function->least) + (function->most > function->least ? " or more" : ""));
    if (function->operation == Operation::power) return node_of_power(from, arguments[0], arguments[1]);
    if (function->operation == Operation::choose)
      return node(from, Operation::choose, arguments[0], arguments[1], arguments[2]);
    if (count == 1) return node(from, function->operation, arguments[0]);
    int all_of = arguments[0];  // of min and max, which may have more than two
    for (int k = 1; k < count; ++k)
      all_of = node(from, function->operation, all_of, arguments[static_cast<std::size_t>(k)]);
    return all_of;
  }

  int node_of_power(std::size_t from, int base, int exponent) {
    if (tape_.is_constant(exponent)) {
      const double n = tape_.at(exponent).value;
      if (n == 0) return node(from, Operation::constant, -1, -1, -1, 1);
      if (n == 1) return base;
      if (n == std::round(n) && std::abs(n) <= largest_whole_power)
        return node(from, Operation::whole_power, base, -1, -1, n);
    }
    return node(from, Operation::power, base, exponent);
  }

  // from: where the operation stands.
  int node(std::size_t from, Operation operation, int a, int b = -1, int c = -1, double value = 0) {
    const int made = tape_.add(operation, a, b, c, value);
    if (has_limits_ && tape_.size() > static_cast<std::size_t>(largest_size))
      fail(from, "has more than " + std::to_string(largest_size) + " operations");
    if (tape_.is_constant(made) && !std::isfinite(tape_.at(made).value))
      fail(from, "found a value that is not a finite number");
    return made;
  }

  const Comparison* taken_comparison() {
    skip_spaces();
    for (const Comparison& comparison : comparisons)
      if (text_.substr(at_, comparison.text.size()) == comparison.text) {
        at_ += comparison.text.size();
        return &comparison;
      }
    if (at_ < text_.size() && text_[at_] == '=') fail(at_, "found \"=\", must be \"==\" for a comparison");
    return nullptr;
  }

  void close(std::string_view must) {
    skip_spaces();
    if (taken(')')) return;
    fail(at_, (at_end() ? "ends" : "found " + found()) + ", must be " + std::string(must));
  }

  void skip_spaces() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }
  bool taken(char c) {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool at_end() {
    skip_spaces();
    return at_ >= text_.size();
  }

  std::size_t column(std::size_t at) const {
    return 1 + static_cast<std::size_t>(std::count_if(
                   text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(std::min(at, text_.size())),
                   [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
  }
  static std::string shown(std::string_view text) {
    constexpr std::size_t most = 60;
    return '"' + std::string(text.substr(0, most)) + (text.size() > most ? "...\"" : "\"");
  }
  // What stands here: a name, or a character.
  std::string found() const {
    std::size_t end = at_;
    while (end < text_.size() && is_in_name(text_[end])) ++end;
    return shown(text_.substr(at_, std::max<std::size_t>(end - at_, 1)));
  }
  [[noreturn]] void fail(std::size_t at, const std::string& message) const {
    throw FormulaError({FormulaFault::Kind::text, index_, column(at)},
                       "column " + std::to_string(column(at)) + ": " + message);
  }
  /// Whether a name follows a number, as a unit would.
  bool is_after_number() const {
    const auto before = text_.substr(0, at_).find_last_not_of(" \t\n\r");
    return before != std::string_view::npos && is_digit(text_[before]) && begins_name(text_[at_]);
  }
  [[noreturn]] void throw_unknown(FormulaFault::Kind kind, std::size_t at, const std::string& name,
                                  const std::string& noun) const {
    throw FormulaError({kind, index_, column(at), name},
                       "column " + std::to_string(column(at)) + ": found the unknown " + noun + ' ' +
                           shown(name) + (name == "PI" || name == "Pi" ? " (the constant is \"pi\")" : ""));
  }

  std::string_view text_;
  std::size_t index_;
  const InputOf& input_of_;
  TapeBuilder& tape_;
  bool has_limits_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Formula::Formula(std::span<const std::string> expressions, const InputOf& input_of, Author author) {
  TapeBuilder tape;
  for (std::size_t k = 0; k < expressions.size(); ++k)
    results_.push_back(Parser(expressions[k], k, input_of, tape, author).whole());
  // Without what is only part of constants.
  const std::vector<Node> all = tape.take();
  const std::vector<char> needed = needed_by(all, results_);
  std::vector<int> place(all.size(), -1);
  const auto moved = [&](int node) { return node < 0 ? node : place[static_cast<std::size_t>(node)]; };
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (!needed[n]) continue;
    place[n] = static_cast<int>(nodes_.size());
    nodes_.push_back({all[n].operation, moved(all[n].a), moved(all[n].b), moved(all[n].c), all[n].value});
  }
  for (int& result : results_) result = moved(result);
}

}  // namespace arcslip::formula

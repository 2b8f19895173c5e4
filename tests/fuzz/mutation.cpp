#include "fuzz/mutation.hpp"

#include "fuzz/tokens.hpp"
#include "random.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace fuzz {
namespace {

using namespace std::string_literals;
using test_random::Random;

// Numbers at the ends of what doubles and integers hold, and what is no number although it looks like one.
constexpr std::array extreme_numbers{"0",
                                     "-0",
                                     "-0.0",
                                     "1",
                                     "-1",
                                     "0.5",
                                     "2",
                                     "1e-300",
                                     "-1e-300",
                                     "5e-324",
                                     "-5e-324",
                                     "1e300",
                                     "1e308",
                                     "-1e308",
                                     "1.7976931348623157e308",
                                     "1e150",
                                     "1e-150",
                                     "1e20",
                                     "1e-20",
                                     "1e12",
                                     "1e-12",
                                     "1e5",
                                     "1e-5",
                                     "2147483647",
                                     "2147483648",
                                     "-2147483649",
                                     "4294967296",
                                     "9223372036854775808",
                                     "18446744073709551616",
                                     "9007199254740993",
                                     "2.225e-308",
                                     "2000",
                                     "2001",
                                     "63"};
constexpr std::array broken_numbers{"1e999", "-1e999", "nan",   "NaN", "-nan",   "Infinity", "-Infinity",
                                    "inf",   "01",     "1.",    ".5",  "+1",     "0x10",     "1e",
                                    "1e+",   "--1",    "1_000", "1,5", "1e-999", "null",     "true"};

// Names and keys: those that mean something elsewhere, and those that hurt a terminal, a table or a figure.
const std::vector<std::string>& strange_strings() {
  static const std::vector<std::string> all{R"("")",
                                            R"(" ")",
                                            R"("ground")",
                                            R"("frequency")",
                                            R"("nan")",
                                            R"("inf")",
                                            R"("a.b")",
                                            R"("d.")",
                                            R"(".value")",
                                            R"("value")",
                                            R"("-")",
                                            R"("..")",
                                            R"("/")",
                                            R"("~1~0")",
                                            R"("a/b")",
                                            R"("@a")",
                                            R"("=1+1")",
                                            R"("d,1")",
                                            R"("a\"b")",
                                            R"("a\\b")",
                                            R"("a\nb")",
                                            R"("\r\n")",
                                            R"("\u0000")",
                                            R"("a\u0000b")",
                                            R"("\u001b[31m")",
                                            R"("\u009b31m")",
                                            R"("\u0085")",
                                            R"("\u2028")",
                                            R"("\u202e")",
                                            R"("\ufffe")",
                                            R"("\uffff")",
                                            R"("\ud800")",
                                            R"("\udc00\ud800")",
                                            R"("\ud83d\ude00")",
                                            R"("\x41")",
                                            R"("\u12")",
                                            R"("%s%n")",
                                            "\"$(reboot)\"",
                                            R"("`date`")",
                                            R"("';\"")",
                                            "\"\xc3\xa9\"",
                                            "\"\xe2\x82\xac\"",
                                            "\"\xf0\x9f\x98\x80\"",
                                            "\"\xff\"",
                                            "\"\xc0\x80\"",
                                            "\"\xed\xa0\x80\"",
                                            "\"a\tb\"",
                                            "\"a\nb\"",
                                            "\"\0\""s,
                                            "\"\x1b\"",
                                            "\"" + std::string(5000, 'x') + "\"",
                                            "\"" + std::string(100, '.') + "\""};
  return all;
}

// What a scene is written with.
constexpr std::array vocabulary{
    R"("cubic_spring")", R"("jenkins")",   R"("frf")",       R"("trace")",        R"("peaks")",
    R"("folds")",        R"("time")",      R"("optimum")",   R"("sampled")",      R"("exact")",
    R"("Hz")",           R"("rad/s")",     R"("at")",        R"("between")",      R"("value")",
    R"("harmonic")",     R"("direction")", R"("sum")",       R"("from")",         R"("to")",
    R"("over")",         R"("for_each")",  R"("stiffness")", R"("cosine")",       R"("sine")",
    R"("ground")",       R"("shooting")",  R"("newmark")",   R"("worst")",        R"("samples")",
    R"("modes")",        R"("amplitude")", R"("of")",        R"("bifurcations")", R"("sweep")",
    R"("start")",        R"("accuracy")",  R"("copies")",    R"("copy")"};

void collect(Node& node, std::vector<Node*>& all) {
  all.push_back(&node);
  for (Node& item : node.items) collect(item, all);
}

std::string scaled(const std::string& number, Random& random) {
  const double factor = std::pow(10.0, random.between(-3, 3)) * (random.one_in(8) ? -1 : 1);
  const double value = std::strtod(number.c_str(), nullptr);
  std::array<char, 40> text{};
  if (random.one_in(2) && std::abs(value) < 1e9 && value == std::floor(value))
    std::snprintf(text.data(), text.size(), "%.0f", value + random.count(-3, 3));
  else
    std::snprintf(text.data(), text.size(), "%.17g", std::isfinite(value * factor) ? value * factor : value);
  return text.data();
}

class Mutation {
 public:
  Mutation(Node& root, std::uint64_t seed) : root_(root), random_(seed) {}

  void run() {
    const bool mild = random_.one_in(2);  // a scene that goes on being read
    int changes = 1;
    while (changes < 20 && random_.one_in(2)) ++changes;
    for (int i = 0; i < changes; ++i) {
      nodes_.clear();
      collect(root_, nodes_);
      mild ? change_mildly() : change_wildly();
    }
  }

  /// What stands around the document and does not belong to it.
  std::string print() {
    std::string text = fuzz::print(root_);
    if (!random_.one_in(20)) return text;
    switch (random_.count(0, 4)) {
      case 0:
        return text + std::string(1, '\0');
      case 1:
        return text + text;
      case 2:
        return text.substr(0, random_.below(text.size() + 1));
      case 3:
        return "\xef\xbb\xbf" + text;
      default:
        text.insert(random_.below(text.size() + 1), 1, static_cast<char>(random_.count(0, 255)));
    }
    return text;
  }

 private:
  template <class Wanted>
  Node* some(const Wanted& wanted) {
    std::vector<Node*> found;
    for (Node* node : nodes_)
      if (wanted(*node)) found.push_back(node);
    return found.empty() ? nullptr : found[random_.below(found.size())];
  }
  Node* some_number() {
    return some([](const Node& node) { return node.is_number(); });
  }
  Node* some_string() {
    return some([](const Node& node) { return node.is_string(); });
  }
  Node* some_container() {
    return some([](const Node& node) { return !node.items.empty(); });
  }
  Node* some_object() {
    return some([](const Node& node) { return node.kind == Node::Kind::object && !node.items.empty(); });
  }
  Node& any() { return *nodes_[random_.below(nodes_.size())]; }

  void change_mildly() {
    switch (random_.count(0, 9)) {
      case 0:
      case 1:
      case 2:
      case 3:
        if (Node* number = some_number()) number->word = scaled(number->word, random_);
        break;
      case 4:
      case 5:
        if (Node* number = some_number()) number->word = random_.of(extreme_numbers);
        break;
      case 6:
        exchange_strings();
        break;
      case 7:
        duplicate();
        break;
      case 8:
        erase();
        break;
      default:
        exchange_values();
    }
  }

  void change_wildly() {
    switch (random_.count(0, 13)) {
      case 0:
        if (Node* number = some_number()) number->word = random_.of(extreme_numbers);
        break;
      case 1:
        if (Node* number = some_number()) number->word = random_.of(broken_numbers);
        break;
      case 2:
        any() = Node{Node::Kind::word, random_.of(strange_strings())};
        break;
      case 3:
        if (Node* text = some_string()) text->word = random_.of(strange_strings());
        break;
      case 4:
        change_key(random_.of(strange_strings()));
        break;
      case 5:
        change_key(random_.of(vocabulary));
        break;
      case 6:
        if (Node* text = some_string()) text->word = random_.of(vocabulary);
        break;
      case 7:
        multiply();
        break;
      case 8:
        nest();
        break;
      case 9:
        change_type();
        break;
      case 10:
        copy_anywhere();
        break;
      case 11:
        swap_keys();
        break;
      case 12:
        duplicate();
        break;
      default:
        change_mildly();
    }
  }

  void exchange_strings() {
    Node *a = some_string(), *b = some_string();
    if (a && b) random_.one_in(2) ? std::swap(a->word, b->word) : void(a->word = b->word);
  }

  void exchange_values() {
    if (Node* container = some_container())
      std::swap(container->items[random_.below(container->items.size())],
                container->items[random_.below(container->items.size())]);
  }

  void duplicate() {
    Node* container = some_container();
    if (!container) return;
    const std::size_t i = random_.below(container->items.size());
    container->items.push_back(Node(container->items[i]));
    if (container->kind == Node::Kind::object) container->keys.push_back(std::string(container->keys[i]));
  }

  void erase() {
    Node* container = some_container();
    if (!container) return;
    const auto i = static_cast<std::ptrdiff_t>(random_.below(container->items.size()));
    container->items.erase(container->items.begin() + i);
    if (container->kind == Node::Kind::object) container->keys.erase(container->keys.begin() + i);
  }

  void change_key(const std::string& key) {
    if (Node* object = some_object()) object->keys[random_.below(object->keys.size())] = key;
  }

  void swap_keys() {
    if (Node* object = some_object())
      std::swap(object->keys[random_.below(object->keys.size())],
                object->keys[random_.below(object->keys.size())]);
  }

  void multiply() {
    Node* container = some_container();
    if (!container) return;
    const std::size_t i = random_.below(container->items.size());
    const Node item = container->items[i];
    const int copies = static_cast<int>(random_.logarithmic(2, 3000));
    for (int k = 0; k < copies; ++k) {
      container->items.push_back(item);
      if (container->kind == Node::Kind::object) container->keys.push_back("\"k" + std::to_string(k) + "\"");
    }
  }

  void nest() {
    Node& node = any();
    const int depth = static_cast<int>(random_.logarithmic(1, 300));
    for (int k = 0; k < depth; ++k) {
      Node outer{random_.one_in(2) ? Node::Kind::list : Node::Kind::object};
      if (outer.kind == Node::Kind::object) outer.keys.emplace_back("\"a\"");
      outer.items.push_back(std::move(node));
      node = std::move(outer);
    }
  }

  void change_type() {
    static constexpr std::array words{"null", "true", "false", "0", "\"\"", "\"a\"", "1.5"};
    Node& node = any();
    const int type = random_.count(0, 8);
    if (type == 0)
      node = Node{Node::Kind::list};
    else if (type == 1)
      node = Node{Node::Kind::object};
    else
      node = Node{Node::Kind::word, random_.of(words)};
  }

  void copy_anywhere() {
    const Node copy = any();
    any() = copy;
  }

  Node& root_;
  Random random_;
  std::vector<Node*> nodes_;
};

std::string with_other_bytes(std::string text, Random& random) {
  for (int changes = random.count(1, 8); changes > 0; --changes) {
    const auto byte = static_cast<char>(random.count(0, 255));
    if (text.empty() || random.one_in(3))
      text.insert(random.below(text.size() + 1), 1, byte);
    else if (random.one_in(2))
      text[random.below(text.size())] = byte;
    else
      text.erase(random.below(text.size()), 1);
  }
  return text;
}

}  // namespace

std::string mutate(const std::string& text, std::uint64_t seed, std::size_t most) {
  std::string mutant;
  if (std::optional<Node> root = parse(text)) {
    Mutation mutation(*root, seed);
    mutation.run();
    mutant = mutation.print();
  } else {
    Random random(seed);
    mutant = with_other_bytes(text, random);
  }
  if (mutant.size() > most) mutant.resize(most);
  return mutant;
}

}  // namespace fuzz

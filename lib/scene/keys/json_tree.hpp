#pragma once
// A JSON text as an ordered tree that keeps duplicate keys, so that every fault of a file can be reported.

#include <arcslip/control/run_control.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace arcslip::scene::file {

struct Member;

/// A number too large for a double, as written.
struct Oversized {
  std::string digits;
};

/// One JSON value. The nesting of a tree read from a file is at most scene::largest_depth.
struct Node {
  using List = std::vector<Node>;
  using Object = std::vector<Member>;  // in the order of the file, duplicates kept
  std::variant<std::nullptr_t, bool, double, Oversized, std::string, List, Object> value;

  template <class T>
  const T* get() const {
    return std::get_if<T>(&value);
  }
};

struct Member {
  std::string key;
  Node value;
};

/// Reads one JSON text. Throws SceneError with one fault, including line and column, if it is not JSON or
/// exceeds largest_depth or largest_count; control::Interrupted if `control` ends.
Node read_tree(std::string_view text, const control::Control& control = {});

/// The text of a tree, indented by two, compact where it fits on one line. Numbers have the shortest
/// exact text.
std::string print_tree(const Node& root);

/// A value in words: `"abc" (a string)`, `3 (a number)`, `a list`.
std::string described(const Node& node);

}  // namespace arcslip::scene::file

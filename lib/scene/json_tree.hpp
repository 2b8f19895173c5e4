#pragma once
// A JSON text as an ordered tree that keeps duplicate keys, so that every fault of a file can be told.

#include <arcslip/scene/stop_request.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace arcslip::scene::file {

struct Member;

/// A number that is too large for a double, as it was written.
struct Oversized {
  std::string digits;
};

/// One JSON value. Nesting is at most scene::largest_depth in a tree that was read.
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

/// Reads one JSON text. Throws SceneError with one fault, which tells the line and the column, where it is
/// not JSON or exceeds largest_depth or largest_count; Interrupted where `stop` is asked for.
Node read_tree(std::string_view text, const StopRequest& stop = {});

/// The text of a tree, indented by two, with what fits on one line on one line. Numbers are as short as they
/// can be without loss.
std::string print_tree(const Node& root);

/// A value in words: `"abc" (a string)`, `3 (a number)`, `a list`.
std::string described(const Node& node);

}  // namespace arcslip::scene::file

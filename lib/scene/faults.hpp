#pragma once
// Collection of the faults of a scene file, and the phrases of their messages.

#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace arcslip::scene::file {

/// Where the item of a list stands in the file: an entry of the list there and, if this is repeated, the name
/// and the value of its index.
struct Origin {
  std::size_t entry;
  std::string index{};
  int number = 0;
  std::string list{};  // its pointer in the file, where it stands elsewhere there
};
/// The items of lists with repeated entries, by the pointer of the list.
using Origins = std::unordered_map<std::string, std::vector<Origin>>;

/// The faults found so far. Only the first thousand or so are kept, so that no file can exhaust the memory.
class Faults {
 public:
  void add(std::string pointer, std::string message);
  std::size_t count() const { return count_; }
  /// From here on pointers are of a tree with repeated entries, and reported as those of the file.
  void set_origins(Origins origins) { origins_ = std::move(origins); }
  /// A pointer as it is reported within a message.
  std::string reported(const std::string& pointer) const;
  /// True if further faults are only counted, and need no message.
  bool full() const;
  /// Throws SceneError if there is any fault.
  void raise() const;

 private:
  /// Makes it a pointer of the file; null: it is in no list with repeated entries.
  const Origin* to_file(std::string& pointer) const;

  Origins origins_;
  std::vector<Fault> kept_;
  std::size_t count_ = 0, size_ = 0;
};

/// Pointer to a member of an object or list, with the escapes of RFC 6901.
std::string child(std::string_view pointer, std::string_view key);
std::string child(std::string_view pointer, std::size_t index);

/// The shortest exact text of a number: 17890, 0.1, 1e+20.
std::string number_text(double value);
/// A JSON string with its quotes.
std::string quoted(std::string_view text);
/// The same, shortened to fit a message.
std::string shown(std::string_view text);
/// `"a", "b", "c"`, at most twenty.
std::string listed(std::span<const std::string> words);
/// `; did you mean "word"?`, or "" if no known word is similar.
std::string hint(std::string_view word, std::span<const std::string> known);

bool within(const Field& field, double value);
/// Leaves what the bounds of another field allow as well.
void narrow(Field& field, const Field& by);
/// What a field allows: "at least 0 kg", "above 0 N/m", "a finite number (N)".
std::string allowed_text(const Field& field);
/// "found -1.24, must be at least 0 kg".
std::string bound_fault(const Field& field, double value);

}  // namespace arcslip::scene::file

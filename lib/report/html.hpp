#pragma once
// HTML and SVG as text. Names and titles are of strangers: each passes through text() or an Attribute, and
// becomes no markup.

#include <cstddef>
#include <initializer_list>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::report {

/// A text for an element or an attribute: &, <, > and quotes as entities, what is unsafe for a terminal as
/// visible() has it, so that no direction of writing changes.
std::string text(std::string_view any);

/// JSON for a script element: no < in it begins markup or ends the element.
std::string json_for_script(std::string json);

struct Attribute {
  std::string_view name;
  std::string value;  // any text
};

/// Writes elements, one within the other.
class Html {
 public:
  explicit Html(std::ostream& out) : out_(out) {}

  using Attributes = std::initializer_list<Attribute>;

  Html& open(std::string_view name, Attributes attributes = {});
  Html& close();
  /// An element without content.
  Html& empty(std::string_view name, Attributes attributes = {});
  /// An element with this text.
  Html& element(std::string_view name, std::string_view any, Attributes attributes = {});
  Html& write(std::string_view any);
  /// Trusted markup, as it is.
  Html& raw(std::string_view markup);

 private:
  void tag(std::string_view name, Attributes attributes, std::string_view end);

  std::ostream& out_;
  std::vector<std::string> open_;
};

/// A number for people: "500000", "0.134", "1e-12".
std::string plain_number(double value);

/// A name where there is little room, with so many characters at most: "a long na…".
std::string shortened(const std::string& name, std::size_t most);

/// A length in a drawing, to a tenth of a pixel.
std::string pixels(double value);

}  // namespace arcslip::report

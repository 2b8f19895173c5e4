#pragma once
// A page as a browser without scripts takes it: its elements. Throws where elements are not closed in order.

#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace markup {

struct Element {
  std::string name;
  std::map<std::string, std::string> attributes{};
  std::string text{};  // of it and all in it, with entities resolved
};

inline std::string resolved(std::string text) {
  for (const auto& [entity, character] :
       {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}, {"&amp;", "&"}})
    for (std::size_t at = text.find(entity); at != std::string::npos; at = text.find(entity, at + 1))
      text.replace(at, std::string_view(entity).size(), character);
  return text;
}

/// The name and attributes of a tag, from behind its <.
inline Element tag(std::string_view text) {
  std::size_t at = text.find_first_of(" >/\n");
  Element element{std::string(text.substr(0, at))};
  while (at < text.size() && (text[at] == ' ' || text[at] == '\n')) {
    const std::size_t equals = text.find("=\"", at), end = text.find('"', equals + 2);
    if (equals == std::string_view::npos || end == std::string_view::npos) break;
    element.attributes[std::string(text.substr(at + 1, equals - at - 1))] =
        resolved(std::string(text.substr(equals + 2, end - equals - 2)));
    at = end + 1;
  }
  return element;
}

/// All elements, in the order in which they end.
inline std::vector<Element> elements(const std::string& page) {
  const std::set<std::string> empty{"meta", "!DOCTYPE"};
  std::vector<Element> open, all;
  std::size_t at = 0;
  while (at < page.size()) {
    const std::size_t begin = page.find('<', at);
    const std::string text = resolved(page.substr(at, begin - at));
    for (Element& each : open) each.text += text;
    if (begin == std::string::npos) break;
    const bool is_raw = !open.empty() && (open.back().name == "script" || open.back().name == "style");
    if (is_raw && page.compare(begin, 2 + open.back().name.size(), "</" + open.back().name) != 0) {
      open.back().text += '<';
      at = begin + 1;
      continue;
    }
    std::size_t end = begin;  // of the tag, a > outside quotes
    for (bool quoted = false; end < page.size() && (quoted || page[end] != '>'); ++end)
      if (page[end] == '"') quoted = !quoted;
    const std::string inner = page.substr(begin + 1, end - begin - 1);
    at = end + 1;
    if (inner.starts_with("/")) {
      if (open.empty() || open.back().name != inner.substr(1))
        throw std::runtime_error("<" + inner + "> closes " + (open.empty() ? "nothing" : open.back().name));
      all.push_back(open.back());
      open.pop_back();
    } else if (inner.ends_with("/") || empty.contains(tag(inner).name)) {
      all.push_back(tag(inner));
    } else {
      open.push_back(tag(inner));
    }
  }
  if (!open.empty()) throw std::runtime_error("<" + open.back().name + "> is not closed");
  return all;
}

/// Those of a name, and of a class among theirs.
inline std::vector<Element> named(const std::vector<Element>& all, const std::string& name,
                                  const std::string& of_class = {}) {
  std::vector<Element> found;
  for (const Element& each : all) {
    const auto classes = each.attributes.find("class");
    const std::string list = classes == each.attributes.end() ? "" : " " + classes->second + " ";
    if (each.name == name && (of_class.empty() || list.find(" " + of_class + " ") != std::string::npos))
      found.push_back(each);
  }
  return found;
}

}  // namespace markup

// Printing a tree so that a person likes to read it.
#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/json_tree.hpp>

namespace arcslip::scene::file {
namespace {

constexpr std::size_t line_width = 110;

// A value on one line.
std::string on_one_line(const Node& node) {
  std::string text;
  if (const auto* object = node.get<Node::Object>()) {
    for (const Member& member : *object) {
      text += (text.empty() ? "" : ", ") + quoted(member.key) + ": " + on_one_line(member.value);
    }
    return '{' + text + '}';
  }
  if (const auto* list = node.get<Node::List>()) {
    for (const Node& item : *list) {
      text += (text.empty() ? "" : ", ") + on_one_line(item);
    }
    return '[' + text + ']';
  }
  if (const auto* string = node.get<std::string>()) {
    return quoted(*string);
  }
  if (const auto* number = node.get<double>()) {
    return number_text(*number);
  }
  if (const auto* oversized = node.get<Oversized>()) {
    return oversized->digits;
  }
  return node.get<bool>() != nullptr ? (*node.get<bool>() ? "true" : "false") : "null";
}

bool holds_containers(const Node::List& list) {
  for (const Node& item : list) {
    if (item.get<Node::List>() != nullptr || item.get<Node::Object>() != nullptr) {
      return true;
    }
  }
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
    const std::string key = quoted(object[i].key) + ": ";
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
    const std::string key = quoted(object[i].key) + ": ";
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
    if (object != nullptr && indent + 2 + line.size() + 1 > line_width) {
      print_item(*object, indent + 2, out);
    } else {
      out += line;
    }
  }
  out += margin + ']';
}

// `column` is where the value begins; one column is kept for the comma after it.
void print(const Node& node, std::size_t indent, std::size_t column, std::string& out) {
  const std::string line = on_one_line(node);
  if (column + line.size() + 1 <= line_width) {
    out += line;
  } else if (const auto* object = node.get<Node::Object>()) {
    print_members(*object, indent, out);
  } else if (const auto* list = node.get<Node::List>()) {
    holds_containers(*list) ? print_items(*list, indent, out) : print_leaves(*list, column, column, out);
  } else {
    out += line;
  }
}

}  // namespace

std::string print_tree(const Node& root) {
  std::string out;
  if (const auto* object = root.get<Node::Object>(); object != nullptr && !object->empty()) {
    print_members(*object, 0, out);
  } else {
    out = on_one_line(root);
  }
  return out + '\n';
}

}  // namespace arcslip::scene::file

#include <arcslip/scene/format/repeat.hpp>

#include <arcslip/scene/format/tree_lookup.hpp>
#include <arcslip/scene/keys/read_values.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <utility>

namespace arcslip::scene::file {
namespace {

struct Index {
  std::string name = "i";
  int count = 0;
  bool cyclic = false;
};

bool is_repeated(const Node& item) {
  const auto* object = item.get<Node::Object>();
  return object != nullptr && std::any_of(object->begin(), object->end(),
                                          [](const Member& member) { return member.key == "repeat"; });
}

std::optional<Index> read_index(const Location& place, Faults& faults) {
  const std::string wanted = "an integer from 1 to " + std::to_string(largest_repeat);
  const std::size_t before = faults.count();
  Index index;
  Location count = place;
  if (place.node->get<Node::Object>() != nullptr) {
    const Keys keys(place, {"count", "index", "cyclic"}, faults);
    count = keys.require("count", wanted, faults);
    const Location name = keys.find("index");
    index.name = read_string(name, "a name of letters", faults).value_or(index.name);
    const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0; };
    if (index.name.empty() || !std::all_of(index.name.begin(), index.name.end(), is_letter))
      faults.add(name.pointer, "found " + shown(index.name) + ", must be a name of letters, such as \"i\"");
    if (const Location cyclic = keys.find("cyclic"); cyclic.node != nullptr) {
      if (const bool* is = cyclic.node->get<bool>())
        index.cyclic = *is;
      else
        add_wrong_type(cyclic, "true or false", faults);
    }
  } else if (place.node->get<double>() == nullptr) {
    add_wrong_type(place, wanted + ", or an object with the keys \"count\", \"index\", \"cyclic\"", faults);
    return {};
  }
  index.count = read_integer(count, 1, largest_repeat, faults).value_or(0);
  return faults.count() == before ? std::optional(index) : std::nullopt;
}

// What all copies together may have yet.
struct Budget {
  std::size_t values = largest_count, bytes = largest_size;

  bool take(std::size_t size) {
    if (values == 0 || size > bytes) return false;
    --values;
    bytes -= size;
    return true;
  }
};

// The copy of an entry for one value of the index. Functions return the fault that they found, its pointer
// relative to what they were given.
class Copy {
 public:
  using Found = std::optional<Fault>;

  Copy(const Index& index, int i, Budget& budget) : index_(index), i_(i), budget_(budget) {}

  Found fill(const Node& from, Node& to) {
    const auto* text = from.get<std::string>();
    if (!budget_.take(text != nullptr ? text->size() : 0)) return too_much();
    if (text != nullptr) return fill_text(*text, to.value.emplace<std::string>());
    if (const auto* object = from.get<Node::Object>()) {
      const Node::List* each = each_of(*object);
      return each != nullptr ? fill_each(*each, to) : fill_members(*object, to.value.emplace<Node::Object>());
    }
    if (const auto* list = from.get<Node::List>()) {
      auto& items = to.value.emplace<Node::List>(list->size());
      for (std::size_t k = 0; k < items.size(); ++k)
        if (Found fault = fill((*list)[k], items[k])) return within(std::to_string(k), std::move(fault));
      return {};
    }
    to = from;
    return {};
  }

 private:
  static Found within(std::string_view key, Found fault) {
    if (fault) fault->pointer = child("", key) + fault->pointer;
    return fault;
  }

  static Found too_much() {
    return Fault{"", "found copies of more than " + std::to_string(largest_count) + " values or " +
                         std::to_string(largest_size >> 20) +
                         " MB of text in all repeated entries together, must be at most as many"};
  }

  static const Node::List* each_of(const Node::Object& object) {
    const Node::List* each = nullptr;
    for (const Member& member : object)
      if (member.key == "each")
        each = member.value.get<Node::List>();
      else if (member.key != comment_key)
        return nullptr;
    return each;
  }

  Found fill_each(const Node::List& each, Node& to) {
    if (each.size() != static_cast<std::size_t>(index_.count))
      return Fault{"/each", "found a list of " + std::to_string(each.size()) + ", must have " +
                                std::to_string(index_.count) + " values, one for each " + index_.name};
    const auto k = static_cast<std::size_t>(i_ - 1);
    return within("each", within(std::to_string(k), fill(each[k], to)));
  }

  Found fill_members(const Node::Object& object, Node::Object& to) {
    to.reserve(object.size());
    for (const Member& member : object) {
      if (member.key == comment_key && member.value.get<std::string>() != nullptr) continue;
      if (!budget_.take(member.key.size())) return too_much();
      Member& copy = to.emplace_back();
      Found fault = fill_text(member.key, copy.key);
      if (!fault) fault = fill(member.value, copy.value);
      if (fault) return within(member.key, std::move(fault));
    }
    return {};
  }

  Found fill_text(std::string_view text, std::string& to) const {
    while (!text.empty()) {
      const std::size_t open = std::min(text.find('{'), text.size());
      to += text.substr(0, open);
      text.remove_prefix(open);
      if (text.empty()) break;
      const std::string_view braces = text.substr(0, std::min(text.find('}'), text.size() - 1) + 1);
      const auto number = number_in(braces);
      if (!number) {
        const std::string& name = index_.name;
        return Fault{"", "found " + shown(braces) + ", must be \"{" + name +
                             "}\", or a neighbour such as \"{" + name + "+1}\" or \"{" + name + "-1}\""};
      }
      to += std::to_string(*number);
      text.remove_prefix(braces.size());
    }
    return {};
  }

  // Of "{i}", "{i+1}", "{i-1}".
  std::optional<int> number_in(std::string_view braces) const {
    if (!braces.starts_with("{" + index_.name) || !braces.ends_with('}')) return {};
    braces.remove_prefix(1 + index_.name.size());
    braces.remove_suffix(1);
    int shift = 0;
    if (!braces.empty()) {
      if (braces.front() != '+' && braces.front() != '-') return {};
      const char* begin = braces.data() + (braces.front() == '+' ? 1 : 0);
      const auto [end, error] = std::from_chars(begin, braces.data() + braces.size(), shift);
      if (error != std::errc() || end != braces.data() + braces.size() || std::abs(shift) > largest_repeat ||
          braces.starts_with("+-"))
        return {};
    }
    const int n = index_.count;
    return index_.cyclic ? ((i_ + shift - 1) % n + n) % n + 1 : i_ + shift;
  }

  const Index& index_;
  int i_;
  Budget& budget_;
};

// Delays an excitation by the phase 2 pi order (i - 1)/count.
void delay(Node::Object& excitation, int order, int i, int count) {
  for (const char* key : {"cosine", "sine"})
    if (find(excitation, key) == nullptr) excitation.push_back({key, {0.0}});
  auto* cosine = std::get_if<double>(&find(excitation, "cosine")->value);
  auto* sine = std::get_if<double>(&find(excitation, "sine")->value);
  if (cosine == nullptr || sine == nullptr) return;  // a fault that the reader finds
  const auto part = (std::int64_t{order} * (i - 1) % count + count) % count;
  const double phase = 2 * std::numbers::pi * static_cast<double>(part) / count;
  const bool quarter = 4 * part % count == 0;  // of which cosine and sine are whole numbers
  const double c = quarter ? std::round(std::cos(phase)) : std::cos(phase);
  const double s = quarter ? std::round(std::sin(phase)) : std::sin(phase);
  const double first_cosine = *cosine, first_sine = *sine;
  *cosine = c * first_cosine - s * first_sine;
  *sine = s * first_cosine + c * first_sine;
}

class Repeater {
 public:
  explicit Repeater(Faults& faults) : faults_(faults) {}

  /// texts: items are texts, of which a repeated one has its copies in the key "name".
  void repeat(Node* node, const std::string& pointer, bool texts = false, bool excites = false) {
    auto* list = node != nullptr ? std::get_if<Node::List>(&node->value) : nullptr;
    if (list == nullptr || std::none_of(list->begin(), list->end(), is_repeated)) return;
    Node::List all;
    std::vector<Origin> origins;
    for (std::size_t k = 0; k < list->size(); ++k) {
      if (!is_repeated((*list)[k])) {
        all.push_back(std::move((*list)[k]));
        origins.push_back({k});
        continue;
      }
      auto& entry = std::get<Node::Object>((*list)[k].value);
      const auto index = take_index(entry, child(pointer, k));
      const auto order = excites ? take_engine_order(entry, child(pointer, k)) : std::nullopt;
      if (texts && !is_name({&(*list)[k], child(pointer, k)})) continue;
      for (int i = 1; index && i <= index->count; ++i) {
        Node copy;
        if (auto fault = Copy(*index, i, budget_).fill((*list)[k], copy)) {
          faults_.add(child(pointer, k) + fault->pointer, std::move(fault->message));
          break;
        }
        auto& members = std::get<Node::Object>(copy.value);
        if (order) delay(members, *order, i, index->count);
        if (texts) copy = Node{std::move(*find(members, "name"))};
        all.push_back(std::move(copy));
        origins.push_back({k, index->name, i});
      }
    }
    *list = std::move(all);
    origins_.emplace(pointer, std::move(origins));
  }

  Origins origins() && { return std::move(origins_); }

 private:
  // Without the key in the entry; of two the second stays, which the reader does not know.
  static std::optional<Node> take(Node::Object& entry, std::string_view key) {
    const auto found =
        std::find_if(entry.begin(), entry.end(), [&](const Member& m) { return m.key == key; });
    if (found == entry.end()) return {};
    Node value = std::move(found->value);
    entry.erase(found);
    return value;
  }

  std::optional<Index> take_index(Node::Object& entry, const std::string& pointer) {
    const auto value = take(entry, "repeat");
    return read_index({&*value, child(pointer, "repeat")}, faults_);
  }

  std::optional<int> take_engine_order(Node::Object& entry, const std::string& pointer) {
    const auto value = take(entry, "engine_order");
    return read_integer({value ? &*value : nullptr, child(pointer, "engine_order")}, -largest_engine_order,
                        largest_engine_order, faults_);
  }

  bool is_name(const Location& entry) {
    const std::size_t before = faults_.count();
    const Keys keys(entry, {"name"}, faults_);
    constexpr const char* wanted = "a string, the name of each";
    read_string(keys.require("name", wanted, faults_), wanted, faults_);
    return faults_.count() == before;
  }

  Faults& faults_;
  Budget budget_;
  Origins origins_;
};

}  // namespace

Origins repeat(Node& scene, Faults& faults) {
  Repeater repeater(faults);
  Node* structure = find(&scene, "structure");
  repeater.repeat(find(structure, "dofs"), "/structure/dofs", true);
  for (const char* section : {"masses", "springs", "dampers"})
    repeater.repeat(find(structure, section), child("/structure", section));
  for (const char* section : {"elements", "patches", "response"})
    repeater.repeat(find(&scene, section), child("", section));
  repeater.repeat(find(&scene, "excitation"), "/excitation", false, true);
  if (Node* response = find(&scene, "response"); response != nullptr) {
    repeater.repeat(find(response, "max_of"), "/response/max_of");
    if (response->get<Node::List>() != nullptr) {
      auto& list = std::get<Node::List>(response->value);
      for (std::size_t k = 0; k < list.size(); ++k)
        repeater.repeat(find(&list[k], "max_of"), child(child("/response", k), "max_of"));
    }
  }
  if (Node* ties = find(&scene, "ties"); ties != nullptr && ties->get<Node::Object>() != nullptr)
    for (Member& tie : std::get<Node::Object>(ties->value))
      repeater.repeat(&tie.value, child("/ties", tie.key), true);
  return std::move(repeater).origins();
}

}  // namespace arcslip::scene::file

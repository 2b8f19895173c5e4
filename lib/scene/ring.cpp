#include <arcslip/scene/ring.hpp>

#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/repeat.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

namespace arcslip::scene::file {
namespace {

constexpr const char* place = "/structure/cyclic";
constexpr std::string_view index_name = "sector";

Node* find(Node* object, std::string_view key) {
  auto* members = object != nullptr ? std::get_if<Node::Object>(&object->value) : nullptr;
  if (members == nullptr) return nullptr;
  const auto found =
      std::find_if(members->begin(), members->end(), [&](const Member& m) { return m.key == key; });
  return found != members->end() ? &found->value : nullptr;
}

Node::List* list_in(Node* object, std::string_view key) {
  Node* found = find(object, key);
  return found != nullptr ? std::get_if<Node::List>(&found->value) : nullptr;
}

bool read_full(const Location& full, Faults& faults) {
  if (full.node == nullptr) return false;
  const bool* is = full.node->get<bool>();
  if (is == nullptr) add_wrong_type(full, "true or false", faults);
  return is != nullptr && *is;
}

std::optional<Cyclic> read_numbers(const Keys& keys, Faults& faults) {
  const auto required = [&](const char* key, int lower, int upper) {
    const std::string wanted = "an integer from " + std::to_string(lower) + " to " + std::to_string(upper);
    return read_integer(keys.require(key, wanted, faults), lower, upper, faults);
  };
  const auto sectors = required("sectors", least_sectors, largest_sectors);
  const auto order = required("engine_order", -largest_engine_order, largest_engine_order);
  if (!sectors || !order) return {};
  return Cyclic{*sectors, *order};
}

/// The entries of one sector, changed to entries that stand for all.
class Sector {
 public:
  Sector(Node& scene, const Cyclic& of, Faults& faults) : scene_(scene), of_(of), faults_(faults) {
    structure_ = find(&scene, "structure");
    if (const Node::List* dofs = list_in(structure_, "dofs"))
      for (const Node& dof : *dofs)
        if (const auto* name = dof.get<std::string>()) dofs_.push_back(*name);
  }

  void repeat_parts() {
    for (const char* section : {"masses", "springs", "dampers"}) repeat_all(list_in(structure_, section));
    repeat_all(list_in(&scene_, "elements"));
    if (Node::List* excitation = list_in(&scene_, "excitation"))
      for (Node& entry : *excitation) excite(entry);
    repeat_all(list_in(&scene_, "excitation"));
  }

  void repeat_names() {
    if (Node::List* dofs = list_in(structure_, "dofs")) repeat_texts(*dofs, {});
    if (Node* ties = find(&scene_, "ties"); ties != nullptr && ties->get<Node::Object>() != nullptr)
      for (Member& tie : std::get<Node::Object>(ties->value))
        if (auto* members = std::get_if<Node::List>(&tie.value.value)) repeat_texts(*members, ".");
  }

  void repeat_response() {
    Node* response = find(&scene_, "response");
    if (response == nullptr && dofs_.size() == 1) {
      Node::Object at{{"at", {dofs_.front()}}};
      auto* root = std::get_if<Node::Object>(&scene_.value);
      root->push_back({"response", {std::move(at)}});
      response = &root->back().value;
    }
    if (response == nullptr) return;
    if (auto* list = std::get_if<Node::List>(&response->value)) {
      repeat_all(list);
    } else if (auto* one = std::get_if<Node::Object>(&response->value)) {
      own_ = "1";
      next_ = "2";
      set_places(*one);
    }
  }

  void mistune(const Node* mistuning) {
    if (mistuning == nullptr) return;
    const Location all{mistuning, child(place, "mistuning")};
    const auto own = numbers();
    for (const Member* member : members(all, faults_)) {
      const Member& parameter = *member;
      const Location at{&parameter.value, child(all.pointer, parameter.key)};
      const auto found =
          std::find_if(own.begin(), own.end(), [&](const auto& each) { return each.first == parameter.key; });
      const auto factors = read_factors(at);
      if (found == own.end()) {
        std::vector<std::string> known;
        for (const auto& each : own) known.push_back(each.first);
        faults_.add(at.pointer, "found " + shown(parameter.key) +
                                    ", must be one of the numbers of the sector's parts " + listed(known) +
                                    hint(parameter.key, known));
      } else if (factors) {
        const double common = *found->second->get<double>();
        Node::List each(factors->size());
        for (std::size_t i = 0; i < each.size(); ++i) each[i].value = common * (*factors)[i];
        Node list{std::move(each)};
        Node::Object values(1);
        values[0].key = "each";
        values[0].value = std::move(list);
        found->second->value = std::move(values);
      }
    }
  }

 private:
  Node repeat() const {
    return {Node::Object{{"count", {static_cast<double>(of_.sectors)}},
                         {"index", {std::string(index_name)}},
                         {"cyclic", {true}}}};
  }

  void repeat_all(Node::List* entries) {
    if (entries == nullptr) return;
    for (Node& entry : *entries) {
      auto* object = std::get_if<Node::Object>(&entry.value);
      if (object == nullptr) continue;  // a fault that the reader finds
      set_places(*object);
      if (Node* name = find(&entry, "name"); name != nullptr && name->get<std::string>() != nullptr)
        std::get<std::string>(name->value) += own_;
      object->push_back({"repeat", repeat()});
    }
  }

  // "part.field" gets the number before the point.
  void repeat_texts(Node::List& texts, std::string_view before) const {
    for (Node& item : texts) {
      const auto* text = item.get<std::string>();
      if (text == nullptr) continue;
      std::string name = *text;
      name.insert(before.empty() ? name.size() : std::min(name.find(before), name.size()), own_);
      item.value = Node::Object{{"repeat", repeat()}, {"name", {std::move(name)}}};
    }
  }

  bool is_dof(const std::string& name) const {
    return std::find(dofs_.begin(), dofs_.end(), name) != dofs_.end();
  }

  void set_place(Node& at) const {
    if (auto* own = std::get_if<std::string>(&at.value)) {
      if (is_dof(*own)) *own += own_;
    } else if (Node* next = find(&at, next_key); next != nullptr && next->get<std::string>() != nullptr) {
      std::string name = std::get<std::string>(next->value);
      if (is_dof(name)) name += next_;
      at.value = std::move(name);
    }
  }

  void set_weights(Node::Object& weights) const {
    Node::Object all;
    for (Member& weight : weights) {
      const auto* next = weight.key == next_key ? weight.value.get<Node::Object>() : nullptr;
      if (next == nullptr) {
        if (is_dof(weight.key)) weight.key += own_;
        all.push_back(std::move(weight));
        continue;
      }
      for (const Member& there : *next) {
        all.push_back(there);
        if (is_dof(there.key)) all.back().key += next_;
      }
    }
    weights = std::move(all);
  }

  // Also in the slots of an element and of a response at several places.
  void set_places(Node::Object& entry) const {
    for (Member& member : entry) {
      auto* object = std::get_if<Node::Object>(&member.value.value);
      auto* list = std::get_if<Node::List>(&member.value.value);
      if (member.key == "at")
        set_place(member.value);
      else if (member.key == "between" && list != nullptr)
        for (Node& end : *list) set_place(end);
      else if (member.key == "direction" && object != nullptr)
        set_weights(*object);
      else if (object != nullptr)
        set_places(*object);
      else if (member.key == "max_of" && list != nullptr)
        for (Node& item : *list)
          if (auto* one = std::get_if<Node::Object>(&item.value)) set_places(*one);
    }
  }

  // The delay of harmonic n is n times that of the first; a motion of the ground without a place is that of
  // the sector.
  void excite(Node& entry) const {
    auto* object = std::get_if<Node::Object>(&entry.value);
    if (object == nullptr) return;
    Node::Object added;
    const Node* harmonic = find(&entry, "harmonic");
    const double n = harmonic != nullptr && harmonic->get<double>() != nullptr ? *harmonic->get<double>() : 1;
    if (n == std::floor(n) && n >= 0 && n <= largest_order) {
      const auto order = static_cast<std::int64_t>(n) * of_.engine_order % of_.sectors;
      added.push_back({"engine_order", {static_cast<double>(order)}});
    }
    if (moves_ground(entry) && find(&entry, "at") == nullptr && find(&entry, "between") == nullptr &&
        find(&entry, "direction") == nullptr) {
      Node::Object all;
      for (const std::string& dof : dofs_) all.push_back({dof, {1.0}});
      added.push_back({"direction", {std::move(all)}});
    }
    object->insert(object->end(), added.begin(), added.end());
  }

  static bool moves_ground(Node& entry) {
    const Node* type = find(&entry, "type");
    const auto* name = type != nullptr ? type->get<std::string>() : nullptr;
    return name != nullptr &&
           (*name == base_displacement_type().name() || *name == base_acceleration_type().name());
  }

  std::optional<std::vector<double>> read_factors(const Location& at) {
    const std::string wanted =
        "a list of " + std::to_string(of_.sectors) + " numbers, a factor for each sector";
    const std::size_t before = faults_.count();
    const Node::List* list = read_list(at, wanted, faults_);
    if (list == nullptr) return {};
    if (list->size() != static_cast<std::size_t>(of_.sectors)) {
      faults_.add(at.pointer, "found a list of " + std::to_string(list->size()) + ", must be " + wanted);
      return {};
    }
    std::vector<double> factors;
    for (std::size_t i = 0; i < list->size(); ++i)
      factors.push_back(read_number({&(*list)[i], child(at.pointer, i)}, any_number, faults_).value_or(1));
    return faults_.count() == before ? std::optional(factors) : std::nullopt;
  }

  // "part.field" and its place, of each number.
  std::vector<std::pair<std::string, Node*>> numbers() {
    std::vector<std::pair<std::string, Node*>> all;
    for (Node::List* section : {list_in(structure_, "masses"), list_in(structure_, "springs"),
                                list_in(structure_, "dampers"), list_in(&scene_, "elements")}) {
      if (section == nullptr) continue;
      for (Node& entry : *section) {
        const Node* name = find(&entry, "name");
        if (name == nullptr || name->get<std::string>() == nullptr) continue;
        for (Member& member : std::get<Node::Object>(entry.value))
          if (member.value.get<double>() != nullptr)
            all.emplace_back(*name->get<std::string>() + '.' + member.key, &member.value);
      }
    }
    return all;
  }

  Node& scene_;
  Node* structure_;
  const Cyclic of_;
  Faults& faults_;
  std::vector<std::string> dofs_;
  std::string own_ = "{sector}", next_ = "{sector+1}";
};

// Where the entries behind repeated ones stand in the file.
void put_behind(const Origins& first, Origins& then) {
  for (auto& [list, items] : then) {
    const auto before = first.find(list);
    if (before == first.end()) continue;
    for (Origin& item : items) {
      const Origin& behind = before->second[item.entry];
      item.entry = behind.entry;
      if (item.index.empty()) item = behind;
    }
  }
  for (const auto& [list, items] : first) then.emplace(list, items);
}

}  // namespace

std::optional<Cyclic> read_cyclic(const Location& at, Faults& faults) {
  if (at.node == nullptr) return {};
  const Keys keys(at, {"sectors", "engine_order", "full", "mistuning"}, faults);
  if (!keys.is_object()) return {};
  if (const Location mistuning = keys.find("mistuning"); mistuning.node != nullptr)
    faults.add(mistuning.pointer,
               "found \"mistuning\", which belongs to a full ring; must have \"full\": true beside it");
  read_full(keys.find("full"), faults);
  return read_numbers(keys, faults);
}

Ring write_out_ring(Node& scene, Origins& origins, Faults& faults) {
  Node* structure = find(&scene, "structure");
  Node* cyclic = find(structure, "cyclic");
  Faults told_later;
  if (!read_full({find(cyclic, "full"), {}}, told_later)) return {};
  const Keys keys({cyclic, place}, {"sectors", "engine_order", "full", "mistuning"}, faults);
  const auto of = read_numbers(keys, faults);
  for (const char* key : {"matrices", "beam", "rod"})
    if (find(structure, key) != nullptr)
      faults.add(child(place, "full"), "found true beside " + quoted(key) +
                                           ", must be false, or the sector must be of masses and springs");
  if (find(&scene, "patches") != nullptr)
    faults.add(child(place, "full"),
               "found true beside \"patches\", must be false, or the contacts must be elements");
  if (!of) return {};
  Sector sector(scene, *of, faults);
  sector.mistune(find(cyclic, "mistuning"));
  if (faults.count() > 0) return {};
  sector.repeat_parts();
  sector.repeat_names();
  sector.repeat_response();
  std::erase_if(std::get<Node::Object>(structure->value), [](const Member& m) { return m.key == "cyclic"; });
  Origins all = repeat(scene, faults);
  put_behind(origins, all);
  origins = std::move(all);
  return {of->sectors};
}

void tie_sectors(const Ring& ring, Scene& scene) {
  std::set<std::string, std::less<>> tied;
  for (const Tie& tie : scene.ties) tied.insert(tie.members.begin(), tie.members.end());
  const auto sectors = static_cast<std::size_t>(ring.sectors);
  if (sectors == 0) return;
  for (const auto* section : {&scene.masses, &scene.springs, &scene.dampers, &scene.elements})
    for (std::size_t first = 0; first + sectors <= section->size(); first += sectors) {
      const std::string_view numbered = (*section)[first].name;
      const std::string_view part = numbered.substr(0, numbered.size() - 1);  // without the 1
      const auto fields = (*section)[first].fields();
      for (std::size_t k = 0; k < fields.size(); ++k) {
        Tie tie{std::string(part) + '.' + std::string(fields[k].name), {}};
        bool free = true;
        for (std::size_t i = 0; i < sectors; ++i) {
          const Part& each = (*section)[first + i];
          tie.members.push_back(each.name + '.' + std::string(fields[k].name));
          free = free && !tied.contains(tie.members.back()) && each.values[k] == (*section)[first].values[k];
        }
        if (free) scene.ties.push_back(std::move(tie));
      }
    }
}

}  // namespace arcslip::scene::file

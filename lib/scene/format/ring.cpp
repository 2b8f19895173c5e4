#include <arcslip/scene/format/ring.hpp>

#include <arcslip/scene/files/row_names.hpp>
#include <arcslip/scene/format/constants.hpp>
#include <arcslip/scene/format/mistuning.hpp>
#include <arcslip/scene/format/repeat.hpp>
#include <arcslip/scene/format/tree_lookup.hpp>
#include <arcslip/scene/keys/section_keys.hpp>
#include <arcslip/scene/part_type.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_set>
#include <utility>

namespace arcslip::scene {
namespace file {
namespace {

constexpr const char* cyclic_place = "/structure/cyclic";
constexpr std::string_view index_name = "sector";

bool read_full(const Location& full, Faults& faults) {
  if (full.node == nullptr) return false;
  const bool* is = full.node->get<bool>();
  if (is == nullptr) add_wrong_type(full, "true or false", faults);
  return is != nullptr && *is;
}

KeysOf<Cyclic> keys_of_cyclic() {
  KeysOf<Cyclic> all;
  all.add(required(whole("sectors", &Cyclic::sectors, least_sectors, largest_sectors, "of the ring")));
  all.add(required(whole("engine_order", &Cyclic::engine_order, -largest_engine_order, largest_engine_order,
                         "m: the excitation of the next sector is that of this one, later by m/sectors of a "
                         "period, in every harmonic")));
  all.add(
      {{flag("full", false, "all sectors instead of one").keys.front(),
        key_of(
            "mistuning", "-", "an object with a list of numbers for each of some parameters",
            "of a full ring: `\"kb.value\"` of sector i is multiplied by number i of its list, and so is the "
            "stiffness matrix by that of `\"matrices.stiffness\"`",
            R"({"type": "object", "additionalProperties":
                       {"type": "array", "items": {"type": ["number", "string"]}}})")},
       [](const Reading& reading, Cyclic&) {
         const bool full = read_full(reading.keys.find("full"), reading.faults);
         if (const Location mistuning = reading.keys.find("mistuning"); mistuning.node != nullptr && !full)
           reading.faults.add(
               mistuning.pointer,
               "found \"mistuning\", which belongs to a full ring; must have \"full\": true next to it");
       },
       [](const Cyclic&, const Scene&, Node::Object&) {}});
  return all;
}

/// The entries of one sector, changed to entries that stand for all.
class Sector {
 public:
  Sector(Node& scene, const Cyclic& of, const FileSource& source) : scene_(scene), of_(of) {
    if (find(structure(), "matrices") != nullptr) dofs_ = row_names({find(structure(), "names"), {}}, source);
    if (const Node::List* dofs = list_in(structure(), "dofs"))
      for (const Node& dof : *dofs)
        if (const auto* name = dof.get<std::string>()) dofs_.push_back(*name);
    is_dof_.insert(dofs_.begin(), dofs_.end());
  }

  void repeat_parts() {
    for (const char* section : {"masses", "springs", "dampers"}) repeat_all(list_in(structure(), section));
    repeat_all(list_in(&scene_, "elements"));
    if (Node::List* excitation = list_in(&scene_, "excitation"))
      for (Node& entry : *excitation) excite(entry);
    repeat_all(list_in(&scene_, "excitation"));
  }

  void repeat_names() {
    if (Node::List* dofs = list_in(structure(), "dofs")) repeat_texts(*dofs, {});
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

  // One copy of the structure for each sector.
  void copy_matrices() {
    if (auto* matrices = find(structure(), "matrices"); matrices != nullptr)
      if (auto* files = std::get_if<Node::Object>(&matrices->value))
        files->push_back({"copies", {static_cast<double>(of_.sectors)}});
  }

 private:
  // Looked for at each use: a key that is added to the scene moves its members.
  Node* structure() const { return find(&scene_, "structure"); }

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

  bool is_dof(const std::string& name) const { return is_dof_.contains(name); }

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
    const bool shaped = find(&entry, "shape") != nullptr;
    if (shaped) added.push_back({"copy", {Node::Object{{"each", numbers()}}}});
    if (moves_ground(entry) && !shaped && find(&entry, "at") == nullptr &&
        find(&entry, "between") == nullptr && find(&entry, "direction") == nullptr) {
      Node::Object all;
      for (const std::string& dof : dofs_) all.push_back({dof, {1.0}});
      added.push_back({"direction", {std::move(all)}});
    }
    object->insert(object->end(), added.begin(), added.end());
  }

  // Of the sectors.
  Node numbers() const {
    Node::List all;
    for (int i = 1; i <= of_.sectors; ++i) all.push_back({static_cast<double>(i)});
    return {std::move(all)};
  }

  static bool moves_ground(Node& entry) {
    const Node* type = find(&entry, "type");
    const auto* name = type != nullptr ? type->get<std::string>() : nullptr;
    return name != nullptr &&
           (*name == base_displacement_type().name() || *name == base_acceleration_type().name());
  }

  Node& scene_;
  const Cyclic of_;
  std::vector<std::string> dofs_;
  std::unordered_set<std::string> is_dof_;  // these names
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

// What the ring gives to the matrices and shapes of its sectors.
void refuse_copies(Node& scene, Faults& faults) {
  const std::string matrices = "/structure/matrices";
  if (find(find(find(&scene, "structure"), "matrices"), "copies") != nullptr)
    faults.add(child(matrices, "copies"),
               "found copies in a full ring, must be left out: each sector has one");
  if (find(find(find(&scene, "structure"), "matrices"), "stiffness_factors") != nullptr)
    faults.add(child(matrices, "stiffness_factors"), "found factors in a full ring, must be " +
                                                         quoted(matrices_stiffness) +
                                                         " in \"mistuning\" of \"cyclic\"");
  Node::List* excitation = list_in(&scene, "excitation");
  for (std::size_t i = 0; excitation != nullptr && i < excitation->size(); ++i)
    if (find(&(*excitation)[i], "copy") != nullptr)
      faults.add(child(child("/excitation", i), "copy"),
                 "found a copy in a full ring, must be left out: a shape acts on all sectors, later by the "
                 "engine order");
}

}  // namespace

std::optional<Cyclic> read_cyclic(const Location& at, Faults& faults) {
  if (at.node == nullptr) return {};
  const std::size_t before = faults.count();
  const auto read = read_section(at, cyclic_keys(), any_number, FileSource(), Dofs(), faults).as<Cyclic>();
  return faults.count() == before ? std::optional(read) : std::nullopt;
}

Ring write_out_ring(Node& scene, const FileSource& source, Origins& origins, Faults& faults) {
  Node* structure = find(&scene, "structure");
  Node* cyclic = find(structure, "cyclic");
  Faults reported_later;
  if (!read_full({find(cyclic, "full"), {}}, reported_later)) return {};
  const auto of = read_cyclic({cyclic, cyclic_place}, faults);
  for (const char* key : {"beam", "rod"})
    if (find(structure, key) != nullptr)
      faults.add(child(cyclic_place, "full"),
                 "found true next to " + quoted(key) +
                     ", must be false, or the sector must be of masses and springs, or of matrices");
  if (find(&scene, "patches") != nullptr)
    faults.add(child(cyclic_place, "full"),
               "found true next to \"patches\", must be false, or the contacts must be elements");
  refuse_copies(scene, faults);
  if (!of) return {};
  mistune(scene, of->sectors, faults);
  if (faults.count() > 0) return {};
  Sector sector(scene, *of, source);
  sector.copy_matrices();
  sector.repeat_parts();
  sector.repeat_names();
  sector.repeat_response();
  // Looked for again: a key that is added to the scene moves its members.
  std::erase_if(std::get<Node::Object>(find(&scene, "structure")->value),
                [](const Member& m) { return m.key == "cyclic"; });
  Origins all = repeat(scene, faults);
  put_behind(origins, all);
  for (int k = 0; k < of->sectors; ++k)
    all["/structure/matrices/stiffness_factors"].push_back(
        {static_cast<std::size_t>(k), {}, 0, child("/structure/cyclic/mistuning", matrices_stiffness)});
  origins = std::move(all);
  return {of->sectors};
}

void tie_sectors(const Ring& ring, Scene& scene) {
  const auto sectors = static_cast<std::size_t>(ring.sectors);
  if (sectors == 0) return;
  for (const auto* section : {&scene.masses, &scene.springs, &scene.dampers, &scene.elements})
    for (std::size_t first = 0; first + sectors <= section->size(); first += sectors) {
      const std::string_view numbered = (*section)[first].name;
      const std::string_view part = numbered.substr(0, numbered.size() - 1);  // without the 1
      const auto fields = (*section)[first].fields();
      for (std::size_t k = 0; k < fields.size(); ++k) {
        std::vector<std::string> members;
        bool free = true;
        for (std::size_t i = 0; i < sectors; ++i) {
          const Part& each = (*section)[first + i];
          members.push_back(each.name + '.' + std::string(fields[k].name));
          free = free && each.formula(k) == nullptr && each.values[k] == (*section)[first].values[k];
        }
        if (free) tie_to_constant(scene, std::string(part) + '.' + std::string(fields[k].name), members);
      }
    }
}

}  // namespace file

const SettingsKeys& cyclic_keys() {
  static const file::KeysOf<Cyclic> all = file::keys_of_cyclic();
  return all;
}

}  // namespace arcslip::scene

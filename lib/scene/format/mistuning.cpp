#include <arcslip/scene/format/mistuning.hpp>

#include <arcslip/scene/format/tree_lookup.hpp>
#include <arcslip/scene/keys/read_values.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace arcslip::scene::file {
namespace {

using Numbers = std::vector<std::pair<std::string, Node*>>;

// "part.field" and its place, of each number.
Numbers numbers_in(Node& scene) {
  Node* structure = find(&scene, "structure");
  Numbers all;
  for (Node::List* section : {list_in(structure, "masses"), list_in(structure, "springs"),
                              list_in(structure, "dampers"), list_in(&scene, "elements")}) {
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

Node number_list(const std::vector<double>& values) {
  Node::List list(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) list[i].value = values[i];
  return {std::move(list)};
}

}  // namespace

void mistune(Node& scene, int sectors, Faults& faults) {
  Node* structure = find(&scene, "structure");
  const Node* mistuning = find(find(structure, "cyclic"), "mistuning");
  if (mistuning == nullptr) return;
  Node* matrices = find(structure, "matrices");
  auto* files = matrices != nullptr ? std::get_if<Node::Object>(&matrices->value) : nullptr;
  const Location all{mistuning, "/structure/cyclic/mistuning"};
  const Numbers own = numbers_in(scene);
  for (const Member* member : members(all, faults)) {
    const std::string& parameter = member->key;
    const Location at{&member->value, child(all.pointer, parameter)};
    const auto found =
        std::find_if(own.begin(), own.end(), [&](const auto& each) { return each.first == parameter; });
    const bool of_matrices = files != nullptr && parameter == matrices_stiffness;
    const auto factors =
        read_factors(at, sectors, of_matrices ? above_0 : any_number, "a factor for each sector", faults);
    if (of_matrices && found != own.end()) {
      faults.add(at.pointer,
                 "found the stiffness of the matrices, which a part named \"matrices\" has as "
                 "well; the part must have another name");
    } else if (!of_matrices && found == own.end()) {
      std::vector<std::string> known;
      for (const auto& each : own) known.push_back(each.first);
      if (files != nullptr) known.emplace_back(matrices_stiffness);
      faults.add(at.pointer, "found " + shown(parameter) +
                                 ", must be one of the numbers of the sector's parts " + listed(known) +
                                 hint(parameter, known));
    } else if (factors && of_matrices) {
      files->push_back({"stiffness_factors", number_list(*factors)});
    } else if (factors) {
      const double common = *found->second->get<double>();
      std::vector<double> values;
      for (const double factor : *factors) {
        values.push_back(common * factor);
        if (!std::isfinite(values.back()))
          faults.add(child(at.pointer, values.size() - 1),
                     "found " + number_text(factor) + ", with which the value is too large for a number");
      }
      found->second->value = Node::Object{{"each", number_list(values)}};
    }
  }
}

}  // namespace arcslip::scene::file

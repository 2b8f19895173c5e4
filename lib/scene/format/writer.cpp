// A scene as the tree of its file, with every default.
#include <arcslip/scene/combinations.hpp>
#include <arcslip/scene/files/manifest.hpp>
#include <arcslip/scene/files/matrix_file.hpp>
#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/keys/section_keys.hpp>
#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/study_type.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::scene {
namespace file {

Node node(std::string_view text) {
  return {std::string(text)};
}

Node node(double value) {
  return {value};
}

Node node(int value) {
  return {static_cast<double>(value)};
}

Node node(const std::vector<double>& values) {
  Node::List list;
  for (const double value : values) list.push_back(node(value));
  return {std::move(list)};
}

Node node(const std::vector<std::string>& texts) {
  Node::List list;
  for (const std::string& text : texts) list.push_back(node(text));
  return {std::move(list)};
}

Member place_member(const Direction& direction, const std::vector<std::string>& dofs) {
  const auto name = [&](const Term& term) { return dofs[static_cast<std::size_t>(term.dof)]; };
  const auto place = [&](const Term& term) {
    Node of = node(name(term));
    return term.next ? Node{Node::Object{{std::string(next_key), std::move(of)}}} : of;
  };
  if (direction.size() == 1 && direction[0].weight == 1) return {"at", place(direction[0])};
  if (direction.size() == 2 && direction[0].weight == 1 && direction[1].weight == -1)
    return {"between", {Node::List{place(direction[0]), place(direction[1])}}};
  Node::Object weights, next;
  for (const Term& term : direction) (term.next ? next : weights).push_back({name(term), node(term.weight)});
  if (!next.empty()) weights.push_back({std::string(next_key), {std::move(next)}});
  return {"direction", {std::move(weights)}};
}

std::string json_text(const Node& value) {
  std::string text = print_tree(value);
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

namespace {

// Sets what a JSON pointer names; objects that are not there yet are made.
void set_at_pointer(Node::Object& root, std::string_view pointer, Node value) {
  Node holder{std::move(root)};
  Node* at = &holder;
  while (!pointer.empty()) {
    const std::size_t end = std::min(pointer.find('/', 1), pointer.size());
    const std::string key(pointer.substr(1, end - 1));
    pointer.remove_prefix(end);
    if (auto* list = std::get_if<Node::List>(&at->value)) {
      at = &(*list)[std::stoul(key)];
      continue;
    }
    if (!std::holds_alternative<Node::Object>(at->value)) at->value = Node::Object();
    auto& object = std::get<Node::Object>(at->value);
    auto own = std::find_if(object.begin(), object.end(), [&](const Member& m) { return m.key == key; });
    if (own == object.end()) own = object.insert(own, {key, {}});
    at = &own->value;
  }
  *at = std::move(value);
  root = std::move(std::get<Node::Object>(holder.value));
}

const NumberText* text_of(const Part& part, std::size_t field) {
  return field < part.texts.size() ? &part.texts[field] : nullptr;
}

// As it was given.
Node number_node(double value, const NumberText* text) {
  return text != nullptr && !text->text.empty() ? node(text->text) : node(value);
}

Node parts_node(const std::vector<Part>& parts, const Scene& scene, bool with_type = false) {
  const std::vector<std::string>& dofs = scene.dofs;
  Node::List list;
  for (const Part& part : parts) {
    Node::Object object = {{"name", node(part.name)}};
    if (with_type) object.push_back({"type", node(part.type->name())});
    const auto slots = part.type->slots_with(part.options);
    if (part.type->has_one_direction(part.options) && !part.directions.front().empty())
      object.push_back(place_member(part.directions.front(), dofs));
    for (std::size_t i = 0; i < slots.size(); ++i)
      object.push_back({std::string(slots[i]), {Node::Object{place_member(part.directions[i], dofs)}}});
    part.type->write_options(part.options, scene, object);
    if (part.wear_coefficient != 0) object.push_back({"wear_coefficient", node(part.wear_coefficient)});
    if (&parts == &scene.excitation) object.push_back({"harmonic", node(part.harmonic)});
    const std::span<const Field> fields = part.fields();
    for (std::size_t i = 0; i < fields.size(); ++i)
      if (fields[i].place.empty())
        object.push_back({std::string(fields[i].name), number_node(part.values[i], text_of(part, i))});
      else
        set_at_pointer(object, fields[i].place, number_node(part.values[i], text_of(part, i)));
    list.push_back({std::move(object)});
  }
  return {std::move(list)};
}

// A section with keys of its own.
template <class Values>
Node section_node(const Values& values, const SettingsKeys& table, const Scene& scene) {
  Node::Object object;
  table.write(Settings::of(values), scene, object);
  return {std::move(object)};
}

void add_matrices(const Matrices& matrices, const Scene& scene, Node::Object& structure) {
  if (matrices.bar) return write_bar(matrices, scene, structure);
  structure.push_back({"matrices", section_node(matrices, matrices_keys(), scene)});
  structure.push_back({"names", node(matrices.names.path)});
}

Node constants_node(const std::vector<Constant>& constants) {
  Node::Object object;
  for (const Constant& constant : constants) {
    Node::Object one{{"value", number_node(constant.value, &constant.text)}};
    if (!constant.unit.empty()) one.push_back({"unit", node(constant.unit)});
    if (std::isfinite(constant.lower) && std::isfinite(constant.upper))
      one.push_back({"bounds", node(std::vector{constant.lower, constant.upper})});
    if (!constant.help.empty()) one.push_back({"help", node(constant.help)});
    object.push_back({constant.name, one.size() == 1 ? std::move(one.front().value) : Node{std::move(one)}});
  }
  return {std::move(object)};
}

Node labels_node(const Scene& scene) {
  Node::Object object;
  for (const auto& [axis, text] : scene.labels) object.push_back({axis, node(text)});
  return {std::move(object)};
}

Node samples_node(const sampling::Plan& plan) {
  Node::Object distributions;
  for (const auto& [parameter, distribution] : plan.parameters) {
    const sampling::DistributionDescription& of = sampling::description(distribution.type);
    const std::vector<double> values(distribution.values.begin(),
                                     distribution.values.begin() + static_cast<long>(of.values.size()));
    distributions.push_back({parameter, {Node::Object{{std::string(of.name), node(values)}}}});
  }
  const auto design = std::find_if(sampling::designs().begin(), sampling::designs().end(),
                                   [&](const auto& each) { return each.value == plan.design; });
  return {Node::Object{{"distributions", {std::move(distributions)}},
                       {"count", node(static_cast<double>(plan.count))},
                       {"seed", node(static_cast<double>(plan.seed))},
                       {"design", node(design->text)}}};
}

Node for_each_node(const Study& study) {
  if (study.samples.count > 0) return samples_node(study.samples);
  if (study.rows_file.text) return node(study.rows_file.path);
  Node::Object lists;
  Node::List rows;
  for (const auto& [parameter, values] : study.for_each) lists.push_back({parameter, node(values)});
  const Combinations all(study);
  for (std::size_t k = 0; study.in_rows && k < all.size(); ++k) {
    Node::Object row;
    for (const auto& [parameter, value] : all[k]) row.push_back({parameter, node(value)});
    rows.push_back({std::move(row)});
  }
  return study.in_rows ? Node{std::move(rows)} : Node{std::move(lists)};
}

Node study_node(const Study& study, const Scene& scene) {
  Node::Object object = {{"name", node(study.name)}, {"kind", node(study.type->name())}};
  study.type->settings().write(study.settings, scene, object);
  for (const auto& [pointer, formula] : study.texts) set_at_pointer(object, pointer, node(formula.text));
  object.push_back({"for_each", for_each_node(study)});
  return {std::move(object)};
}

Node responses_node(const Scene& scene) {
  Node::List list;
  for (const Response& response : scene.responses) {
    Node::Object object;
    if (!response.name.empty()) object.push_back({"name", node(response.name)});
    if (response.others.empty()) {
      object.push_back(place_member(response.direction, scene.dofs));
    } else {
      Node::List places{Node{Node::Object{place_member(response.direction, scene.dofs)}}};
      for (const Direction& other : response.others)
        places.push_back({Node::Object{place_member(other, scene.dofs)}});
      object.push_back({"max_of", {std::move(places)}});
    }
    object.push_back({"frame", node(word_of(frames, response.frame))});
    list.push_back({std::move(object)});
  }
  const bool one = list.size() == 1 && scene.responses.front().name.empty();
  return one ? std::move(list.front()) : Node{std::move(list)};
}

Node studies_node(const Scene& scene) {
  Node::List list;
  for (const Study& study : scene.studies) list.push_back(study_node(study, scene));
  return {std::move(list)};
}

}  // namespace

Node tree(const Scene& scene) {
  Node::Object structure;
  if (scene.cyclic) structure.push_back({"cyclic", section_node(*scene.cyclic, cyclic_keys(), scene)});
  if (scene.matrices) add_matrices(*scene.matrices, scene, structure);
  const auto named = static_cast<std::ptrdiff_t>(scene.matrices ? scene.matrices->named() : 0);
  const std::vector<std::string> dofs(scene.dofs.begin() + named, scene.dofs.end());
  if (named == 0 || !dofs.empty()) structure.push_back({"dofs", node(dofs)});
  structure.insert(structure.end(), {{"masses", parts_node(scene.masses, scene)},
                                     {"springs", parts_node(scene.springs, scene)},
                                     {"dampers", parts_node(scene.dampers, scene)}});
  if (!scene.damping.empty()) structure.push_back({"damping", parts_node(scene.damping, scene, true)});
  if (!scene.rotation.empty()) {
    auto rotation = std::get<Node::List>(parts_node(scene.rotation, scene).value);
    structure.push_back({"rotation", std::move(rotation.front())});
  }
  Node::Object all{{"format", node(format_name)},
                   {"title", node(scene.title)},
                   {"frequency_unit", node(word_of(frequency_units, scene.frequency_unit))}};
  if (!scene.constants.empty()) all.push_back({"constants", constants_node(scene.constants)});
  all.insert(all.end(),
             {{"structure", {std::move(structure)}}, {"elements", parts_node(scene.elements, scene, true)}});
  if (!scene.patches.empty()) all.push_back({"patches", parts_node(scene.patches, scene)});
  all.push_back({"excitation", parts_node(scene.excitation, scene, true)});
  if (!scene.labels.empty()) all.push_back({"labels", labels_node(scene)});
  all.push_back({"harmonics", section_node(scene.harmonics, harmonics_keys(), scene)});
  all.push_back({"response", responses_node(scene)});
  all.push_back({"studies", studies_node(scene)});
  return {std::move(all)};
}

}  // namespace file

std::string write(const Scene& scene) {
  return file::print_tree(file::tree(scene));
}

std::string hash(const Scene& scene) {
  ContentHash hash;
  Scene copy = scene;
  std::vector<std::shared_ptr<const std::string>> texts;
  for (NamedFile* file : files(copy)) {  // what they hold, wherever they are
    texts.push_back(file->text);
    file->path.clear();
  }
  hash.add(write(copy));
  for (const auto& text : texts) {
    hash.add(std::to_string(text ? text->size() : 0) + ':');
    if (text) hash.add(*text);
  }
  return hash.text();
}

std::string_view unit_name(FrequencyUnit unit) {
  return file::word_of(file::frequency_units, unit);
}

}  // namespace arcslip::scene

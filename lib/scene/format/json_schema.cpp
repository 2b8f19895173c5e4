#include <arcslip/scene/format/json_schema.hpp>

#include <arcslip/scene/files/matrix_file.hpp>
#include <arcslip/scene/format/repeat.hpp>
#include <arcslip/scene/format/ring.hpp>
#include <arcslip/scene/keys/enum_words.hpp>
#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/write_values.hpp>
#include <arcslip/scene/study_type.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace arcslip::scene {
namespace file {
namespace {

using Object = Node::Object;

Node of(Object members) {
  return {std::move(members)};
}

Node of_type(std::string_view type) {
  return of({{"type", node(type)}});
}

/// A number may be a text with a unit, or a formula.
Node number_or_text_type() {
  return node(std::vector<std::string>{"number", "string"});
}
Node number_or_text() {
  return of({{"type", number_or_text_type()}});
}

Node list_of(Node item, int least = 0) {
  Object list{{"type", node("array")}, {"items", std::move(item)}};
  if (least > 0) list.push_back({"minItems", node(least)});
  return of(std::move(list));
}

/// An object whose members have any names.
Node map_of(Node value) {
  return of({{"type", node("object")}, {"additionalProperties", std::move(value)}});
}

/// An object with these keys and no others.
Object object_of(Object properties, const std::vector<std::string>& required) {
  properties.push_back({std::string(comment_key), of_type("string")});
  Object object{{"type", node("object")}, {"properties", of(std::move(properties))}};
  if (!required.empty()) object.push_back({"required", node(required)});
  object.push_back({"additionalProperties", {false}});
  return object;
}

void add_bounds(double lower, bool lower_open, double upper, Object& number) {
  if (std::isfinite(lower)) number.push_back({lower_open ? "exclusiveMinimum" : "minimum", node(lower)});
  if (std::isfinite(upper)) number.push_back({"maximum", node(upper)});
}

std::string text_with_unit(std::string_view text, std::string_view unit) {
  std::string all(text);
  if (!unit.empty() && unit != "-") all.append(" (").append(unit).append(")");
  return all;
}

Node number_schema(const Field& field) {
  Object number{{"type", number_or_text_type()},
                {"description", node(text_with_unit(field.help, field.unit))}};
  add_bounds(field.lower, field.lower_open, field.upper, number);
  if (field.default_value) number.push_back({"default", node(*field.default_value)});
  return of(std::move(number));
}

Node reference(std::string_view definition) {
  return of({{"$ref", node("#/$defs/" + std::string(definition))}});
}

/// What a repeated entry may have in its place for each value of the index, too.
Node or_each(Node value) {
  return of({{"anyOf", {Node::List{std::move(value), reference("each")}}}});
}

/// A text, or a repeated one.
Node word() {
  return of({{"anyOf", {Node::List{of_type("string"), reference("names")}}}});
}

/// The keys that say where something acts, and that one of them must be there. next: also in the next sector.
void add_place(Object& properties, bool next = true) {
  const Node name = next ? reference("dof") : of_type("string");
  properties.push_back({"at", name});
  properties.push_back(
      {"between",
       of({{"type", node("array")}, {"items", name}, {"minItems", node(2)}, {"maxItems", node(2)}})});
  properties.push_back({"direction", next ? reference("weights") : map_of(number_or_text())});
}

/// One sector of a ring, or all.
Node cyclic() {
  const auto whole = [](int lower, int upper, const char* help) {
    return of({{"type", node("integer")},
               {"minimum", node(lower)},
               {"maximum", node(upper)},
               {"description", node(help)}});
  };
  return of(object_of(
      {{"sectors", whole(least_sectors, largest_sectors, "of the ring")},
       {"engine_order", whole(-largest_engine_order, largest_engine_order,
                              "periods around the ring, by which the excitation of each sector is delayed")},
       {"full", of({{"type", node("boolean")},
                    {"default", {false}},
                    {"description", node("all sectors instead of one in the wave of the engine order")}})},
       {"mistuning",
        of({{"type", node("object")},
            {"additionalProperties", of({{"type", node("array")}, {"items", number_or_text()}})},
            {"description", node("of a full ring: factors of a part's value, or of the stiffness matrix, for "
                                 "each sector")}})}},
      {"sectors", "engine_order"}));
}

Node one_place(bool or_several = false) {
  Node::List choices;
  std::vector<const char*> keys{"at", "between", "direction"};
  if (or_several) keys.push_back("max_of");
  for (const char* key : keys) choices.push_back(of({{"required", node(std::vector<std::string>{key})}}));
  return {std::move(choices)};
}

template <class Words, class Choice>
Node one_of_words(const Words& words, Choice otherwise) {
  return of({{"enum", node(texts(words))}, {"default", node(word_of(words, otherwise))}});
}

/// What the value of a key may be.
Object schema_of_key(const Key& key) {
  switch (key.type) {
    case KeyType::number:
    case KeyType::whole: {
      Object number{{"type", key.type == KeyType::whole ? node("integer") : number_or_text_type()}};
      add_bounds(key.lower, key.lower_open, key.upper, number);
      return number;
    }
    case KeyType::frequency:
      return {{"type", number_or_text_type()}, {"exclusiveMinimum", node(0)}};
    case KeyType::value:
      return {{"type", number_or_text_type()}};
    case KeyType::window:
      return {{"type", node("array")},
              {"items", of({{"type", number_or_text_type()}, {"exclusiveMinimum", node(0)}})},
              {"minItems", node(2)},
              {"maxItems", node(2)}};
    case KeyType::word:
      return {{"enum", node(key.words)}};
    case KeyType::text:
    case KeyType::parameter:
    case KeyType::followed:
      return {{"type", node("string")}};
    case KeyType::parameters:
      return {{"type", node("array")}, {"items", of_type("string")}, {"minItems", node(1)}};
    case KeyType::other:
      break;
  }
  return std::get<Object>(read_tree(key.schema.empty() ? std::string("{}") : key.schema).value);
}

/// What repeated entries (repeat.hpp) are made of.
Node definitions() {
  const Node count = of({{"type", node("integer")}, {"minimum", node(1)}, {"maximum", node(largest_repeat)}});
  const Node index = of(object_of({{"count", count},
                                   {"index", of({{"type", node("string")}, {"default", node("i")}})},
                                   {"cyclic", of({{"type", node("boolean")}, {"default", {false}}})}},
                                  {"count"}));
  return of(
      {{"repeat", of({{"anyOf", {Node::List{count, index}}},
                      {"description", node("one for each index from 1 to a count; {i}, {i+1}, {i-1} in "
                                           "texts are the index and its neighbours")}})},
       {"each", of(object_of({{"each", of_type("array")}}, {"each"}))},
       {"dof", of({{"anyOf",
                    {Node::List{of_type("string"), of(object_of({{"next", of_type("string")}}, {"next"}))}}},
                   {"description", node("a degree of freedom, or that of the next sector of a ring")}})},
       {"weights", of({{"type", node("object")},
                       {"properties", of({{"next", map_of(number_or_text())}})},
                       {"additionalProperties", number_or_text()}})},
       {"names",
        of(object_of({{"repeat", reference("repeat")}, {"name", of_type("string")}}, {"repeat", "name"}))}});
}

Node place_object() {
  Object place;
  add_place(place);
  Object object = object_of(std::move(place), {});
  object.push_back({"oneOf", one_place()});
  return of(std::move(object));
}

/// One response, or a list of responses with names.
Node responses() {
  Object repeated{{"repeat", reference("repeat")}};
  add_place(repeated, false);
  Object one = object_of(std::move(repeated), {});
  one.push_back({"oneOf", one_place()});
  const Node places = list_of(of(std::move(one)), 1);
  const auto response = [&places](bool named) {
    Object place;
    if (named) place.insert(place.end(), {{"repeat", reference("repeat")}, {"name", of_type("string")}});
    add_place(place, false);
    place.push_back({"max_of", places});
    place.push_back({"frame", one_of_words(frames, Response{}.frame)});
    Object object = object_of(std::move(place), {});
    if (named) object.push_back({"required", node(std::vector<std::string>{"name"})});
    object.push_back({"oneOf", one_place(true)});
    return of(std::move(object));
  };
  return of({{"oneOf", {Node::List{response(false), list_of(response(true), 1)}}}});
}

/// A key with its meaning and default.
Node described_key(const Key& key) {
  Object value = schema_of_key(key);
  const std::string unit = key.unit == "frequency"   ? "the scene's unit"
                           : key.unit == "parameter" ? "the parameter's unit"
                                                     : key.unit;
  value.push_back({"description", node(text_with_unit(key.help, unit))});
  if (!key.otherwise.empty()) value.push_back({"default", read_tree(key.otherwise)});
  return of(std::move(value));
}

Node part_of(const PartType& type, bool with_type) {
  Object properties{{"repeat", reference("repeat")}, {"name", of_type("string")}};
  std::vector<std::string> required{"name"};
  if (with_type) {
    properties.push_back({"type", of({{"const", node(type.name())}})});
    if (&type != &force_type()) required.emplace_back("type");
  }
  const bool one_direction = type.has_one_direction({});
  const auto excitations = excitation_types();
  const bool excites = std::find(excitations.begin(), excitations.end(), &type) != excitations.end();
  if (one_direction) add_place(properties, !excites);
  for (const std::string_view slot : type.slots()) {
    properties.push_back({std::string(slot), place_object()});
    required.emplace_back(slot);
  }
  for (const Key& option : type.options()) {
    properties.push_back({option.name, or_each(described_key(option))});
    if (option.required) required.push_back(option.name);
  }
  if (excites) {
    properties.push_back(
        {"harmonic", of({{"type", node("integer")},
                         {"minimum", node(0)},
                         {"maximum", node(largest_order)},
                         {"default", node(Part{}.harmonic)},
                         {"description", node("harmonic of the excitation; 0: constant")}})});
    properties.push_back(
        {"engine_order",
         of({{"type", node("integer")},
             {"description", node("of a repeated excitation: periods around the ring, by which "
                                  "each is delayed")}})});
  }
  for (const Field& field : type.fields({})) {
    properties.push_back({std::string(field.name), or_each(number_schema(field))});
    if (!field.default_value && !type.options_bring_fields())  // in its place
      required.emplace_back(field.name);
  }
  const auto dampings = damping_types();
  const bool of_structure = std::find(dampings.begin(), dampings.end(), &type) != dampings.end();
  if (with_type && !of_structure)
    properties.push_back({std::string(wear_coefficient.name), number_schema(wear_coefficient)});
  Object object = object_of(std::move(properties), required);
  if (type.names_directions() && !of_structure)
    object.back().value = place_object();
  else if (type.options_bring_fields())
    object.back().value = number_or_text();  // fields that the options bring
  const bool shaped = std::find(excitations.begin(), excitations.end(), &type) != excitations.end();
  if (one_direction && !shaped && !type.names_directions()) object.push_back({"oneOf", one_place()});
  if (&type == &force_type()) {
    auto places = std::get<Node::List>(one_place().value);
    places.push_back(of({{"required", node(std::vector<std::string>{"shape"})}}));
    object.push_back({"anyOf", {std::move(places)}});
  }
  return of(std::move(object));
}

// A part whose value may be given by another key.
Node or_given_by(Node part, const char* key, Node value) {
  auto& object = std::get<Object>(part.value);
  for (Member& member : object) {
    if (member.key == "properties")
      std::get<Object>(member.value.value).push_back({key, or_each(std::move(value))});
    if (member.key == "required") member.value = node(std::vector<std::string>{"name"});
  }
  Node::List choices;
  for (const char* either : {"value", key})
    choices.push_back(of({{"required", node(std::vector<std::string>{either})}}));
  object.push_back({"anyOf", {std::move(choices)}});
  return part;
}

Node spring() {
  return or_given_by(
      part_of(spring_type(), false), "frequency",
      of({{"type", number_or_text_type()},
          {"exclusiveMinimum", node(0)},
          {"description", node("natural frequency of the mass there on this spring alone (the scene's "
                               "unit)")}}));
}

Node damper() {
  return or_given_by(part_of(damper_type(), false), "damping_ratio",
                     of({{"type", number_or_text_type()},
                         {"minimum", node(0)},
                         {"description", node("of the mass there on the spring there")}}));
}

// A patch of contacts, whose fields depend on its law.
Node patch() {
  Object object = object_of(
      {{"name", of_type("string")},
       {"law", of_type("string")},
       {"file", of({{"type", node("string")}, {"description", node("the path of a CSV file of contacts")}})},
       {"details", of({{"type", node("boolean")}, {"default", {true}}})},
       {std::string(wear_coefficient.name), number_schema(wear_coefficient)}},
      {"name", "law", "file"});
  object.pop_back();  // other keys are fields and options of the law
  return of(std::move(object));
}

Node range() {
  return of(object_of({{"from", number_or_text()},
                       {"to", number_or_text()},
                       {"count", of({{"type", node("integer")}, {"minimum", node(2)}})},
                       {"spacing", one_of_words(spacings, Spacing::linear)}},
                      {"from", "to", "count"}));
}

Node described_text(const char* help) {
  return of({{"type", node("string")}, {"description", node(help)}});
}

/// Samples of parameters with distributions.
Node samples() {
  Node::List one_of;
  for (const sampling::DistributionDescription& each : sampling::distribution_types()) {
    Node::Object values =
        std::get<Object>(list_of(number_or_text(), static_cast<int>(each.values.size())).value);
    values.push_back({"maxItems", node(static_cast<int>(each.values.size()))});
    std::string help;
    for (const std::string_view value : each.values) help.append(help.empty() ? "" : ", ").append(value);
    values.push_back({"description", node(help)});
    one_of.push_back(
        of(object_of({{std::string(each.name), of(std::move(values))}}, {std::string(each.name)})));
  }
  const auto whole = [](int lower, int upper) {
    return Object{{"type", node("integer")}, {"minimum", node(lower)}, {"maximum", node(upper)}};
  };
  Object seed = whole(0, std::numeric_limits<int>::max());
  seed.push_back({"default", node(static_cast<int>(sampling::Plan{}.seed))});
  return of(object_of({{"distributions", map_of(of({{"oneOf", {std::move(one_of)}}}))},
                       {"count", of(whole(1, sampling::largest_sample_count))},
                       {"seed", of(std::move(seed))},
                       {"design", one_of_words(sampling::designs(), sampling::Plan{}.design)}},
                      {"distributions", "count"}));
}

Node study_of(const StudyType& type) {
  Object properties{
      {"name", of({{"type", node("string")}, {"minLength", node(1)}, {"maxLength", node(100)}})},
      {"kind", of({{"const", node(type.name())}})}};
  std::vector<std::string> required{"kind"};
  Object needs;  // keys that stand together or not at all
  for (const Key& key : type.keys()) {
    properties.push_back({key.name, described_key(key)});
    if (key.required) {
      required.push_back(key.name);
    } else if (const std::vector<std::string> nearby = keys_next_to(key.type); !nearby.empty()) {
      needs.push_back({key.name, node(nearby)});
      for (const std::string& each : nearby) needs.push_back({each, node(std::vector{key.name})});
    }
  }
  properties.push_back(
      {"for_each",
       of({{"oneOf",
            {Node::List{
                described_text("path of a CSV file: a column for each parameter, a row for each sample"),
                samples(), map_of(of({{"oneOf", {Node::List{list_of(number_or_text(), 1), range()}}}})),
                list_of(map_of(number_or_text()), 1)}}}})});
  Object study = object_of(std::move(properties), required);
  if (!needs.empty()) study.push_back({"dependentRequired", of(std::move(needs))});
  study.push_back({"title", node(type.help())});
  return of(std::move(study));
}

// Which matrices need not be symmetric.
Node unsymmetric() {
  Node word = of({{"enum", node(std::vector<std::string>{"stiffness", "damping"})}});
  return list_of(std::move(word), 1);
}

Node copies() {
  return of({{"type", node("integer")},
             {"minimum", node(1)},
             {"maximum", node(largest_copies)},
             {"default", node(Matrices{}.copies)},
             {"description", node("of the structure, side by side")}});
}

Node above_zero() {
  return of({{"type", number_or_text_type()}, {"exclusiveMinimum", node(0)}});
}

Node matrix_file() {
  return read_tree(matrix_file_schema(false));
}

Node rotation() {
  Object object = std::get<Object>(part_of(rotation_type(), false).value);
  for (Member& member : object) {
    if (member.key == "properties")
      std::erase_if(std::get<Object>(member.value.value),
                    [](const Member& own) { return own.key == "repeat"; });
    if (member.key == "required") member.value = node(std::vector<std::string>{"name"});
    if (member.key == "additionalProperties") member.value = {false};
  }
  Node::List choices;
  for (const char* either : {"speed", "engine_order"})
    choices.push_back(of({{"required", node(std::vector<std::string>{either})}}));
  object.push_back({"oneOf", {std::move(choices)}});
  return of(std::move(object));
}

Node reduction() {
  Object properties;
  for (const Key& key : reduction_keys().keys()) properties.push_back({key.name, described_key(key)});
  return of(object_of(std::move(properties), {}));
}

Node matrices_of_structure() {
  return of(object_of({{"mass", matrix_file()},
                       {"stiffness", matrix_file()},
                       {"damping", matrix_file()},
                       {"stiffness_speed_squared", matrix_file()},
                       {"gyroscopic", matrix_file()},
                       {"circulatory", matrix_file()},
                       {"unsymmetric", unsymmetric()},
                       {"highest_frequency", number_or_text()},
                       {"reduction", reduction()},
                       {"errors", list_of(list_of(of_type("number"), 2), 1)},
                       {"faces", of_type("string")},
                       {"copies", copies()},
                       {"stiffness_factors", list_of(above_zero())}},
                      {"mass", "stiffness"}));
}

Node beam_or_rod(bool bends) {
  Object keys{{"elements", of_type("integer")}, {"highest_frequency", number_or_text()}};
  for (const char* key : {"length", "young", "density", "area", "width", "height"})
    keys.push_back({key, number_or_text()});
  if (bends) keys.push_back({"inertia", number_or_text()});
  keys.push_back({"ends", list_of(one_of_words(bar_ends, BarEnd::clamped))});
  keys.push_back({"points", map_of(number_or_text())});
  return of(object_of(std::move(keys), {"elements", "length", "young", "density", "points"}));
}

// A list of parts, each of one of the types.
template <class Types>
Node list_of_types(const Types& types, int least = 0) {
  Node::List choices;
  for (const auto& type : types) choices.push_back(part_of(*type, true));
  return list_of(of({{"oneOf", {std::move(choices)}}}), least);
}

Node structure_section() {
  return of(object_of({{"cyclic", cyclic()},
                       {"dofs", list_of(word(), 1)},
                       {"masses", list_of(part_of(mass_type(), false))},
                       {"springs", list_of(spring())},
                       {"dampers", list_of(damper())},
                       {"matrices", matrices_of_structure()},
                       {"names", of_type("string")},
                       {"rotation", rotation()},
                       {"beam", beam_or_rod(true)},
                       {"rod", beam_or_rod(false)},
                       {"damping", list_of_types(damping_types())}},
                      {}));
}

Node harmonics_section() {
  Object samples{{"type", node("integer")}, {"default", node(Harmonics{}.samples)}};
  add_bounds(1, false, largest_samples, samples);
  Object order{{"type", node("integer")}};
  add_bounds(1, false, largest_order, order);
  Object period{{"type", node("integer")}, {"default", node(Harmonics{}.period)}};
  add_bounds(1, false, largest_period, period);
  Object accuracy{{"type", number_or_text_type()}, {"default", node(default_accuracy)}};
  add_bounds(finest_accuracy, false, coarsest_accuracy, accuracy);
  return of(object_of({{"order", of(std::move(order))},
                       {"accuracy", of(std::move(accuracy))},
                       {"period", of(std::move(period))},
                       {"friction", one_of_words(friction_methods, Harmonics{}.friction)},
                       {"samples", of(std::move(samples))},
                       {"kinks", one_of_words(kinks_words, Harmonics{}.kinks)}},
                      {}));
}

Node constant() {
  Node alone = number_or_text();
  Node with_more = of(object_of({{"value", number_or_text()},
                                 {"unit", of_type("string")},
                                 {"bounds", of({{"type", node("array")},
                                                {"items", number_or_text()},
                                                {"minItems", node(2)},
                                                {"maxItems", node(2)}})},
                                 {"help", of_type("string")}},
                                {"value"}));
  return of({{"anyOf", {Node::List{std::move(alone), std::move(with_more)}}}});
}

Node schema_of(const Catalogue& catalogue) {
  Node::List studies;
  for (const auto& type : catalogue.studies) studies.push_back(study_of(*type));
  Object root = object_of(
      {{"$schema", of_type("string")},
       {"format",
        of({{"enum", node(std::vector{std::string(format_name), std::string(first_format_name)})}})},
       {"title", of_type("string")},
       {"frequency_unit", one_of_words(frequency_units, Scene{}.frequency_unit)},
       {"structure", structure_section()},
       {"elements", list_of_types(catalogue.elements)},
       {"patches", list_of(patch())},
       {"excitation", list_of_types(excitation_types(), 1)},
       {"constants", map_of(constant())},
       {"ties", map_of(list_of(word(), 1))},
       {"labels", map_of(of_type("string"))},
       {"harmonics", harmonics_section()},
       {"response", responses()},
       {"studies", list_of(of({{"oneOf", {std::move(studies)}}}))}},
      {"format", "structure", "excitation"});
  Object schema{{"$schema", node("https://json-schema.org/draft/2020-12/schema")},
                {"title", node("Arcslip scene")}};
  schema.insert(schema.end(), root.begin(), root.end());
  schema.push_back({"$defs", definitions()});
  return of(std::move(schema));
}

}  // namespace
}  // namespace file

std::string json_schema(const Catalogue& catalogue) {
  return file::print_tree(file::schema_of(catalogue));
}

}  // namespace arcslip::scene

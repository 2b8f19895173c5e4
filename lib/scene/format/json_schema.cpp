#include <arcslip/scene/format/json_schema.hpp>

#include <arcslip/scene/format/repeat.hpp>
#include <arcslip/scene/keys/section_keys.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::scene {
namespace file {
namespace {

// Schemas are texts, which are put together.
constexpr const char *a_text = R"({"type": "string"})", *a_number = R"({"$ref": "#/$defs/number"})",
                     *one_place =
                         R"([{"required": ["at"]}, {"required": ["between"]}, {"required": ["direction"]}])";

/// An object with these keys, a comment, and what `rest` says of others.
class ObjectSchema {
 public:
  ObjectSchema& add(std::string_view key, const std::string& schema, bool required = false) {
    keys_ += file::quoted(key) + ": " + schema + ", ";
    if (required) required_ += (required_.empty() ? "" : ", ") + file::quoted(key);
    return *this;
  }
  /// next: also in the next sector.
  ObjectSchema& add_place(bool next) {
    const std::string name = next ? R"({"$ref": "#/$defs/dof"})" : a_text;
    add("at", name);
    add("between", R"({"type": "array", "items": )" + name + R"(, "minItems": 2, "maxItems": 2})");
    return add("direction", next ? R"({"$ref": "#/$defs/weights"})" : R"({"$ref": "#/$defs/numbers"})");
  }
  std::string with(const std::string& rest) const {
    return R"({"type": "object", "properties": {)" + keys_ +
           R"("comment": {"type": "string"}}, "required": [)" + required_ + "], " + rest + "}";
  }
  std::string alone() const { return with(R"("additionalProperties": false)"); }

 private:
  std::string keys_, required_;
};

std::string list_of(const std::string& item, int least = 0) {
  return R"({"type": "array", "items": )" + item + R"(, "minItems": )" + std::to_string(least) + "}";
}

/// An object whose members have any names.
std::string map_of(const std::string& value) {
  return R"({"type": "object", "additionalProperties": )" + value + "}";
}

std::string integer(long lower, long upper, const std::string& rest = "") {
  return R"({"type": "integer", "minimum": )" + std::to_string(lower) + R"(, "maximum": )" +
         std::to_string(upper) + rest + "}";
}

/// What a repeated entry may have in its place for each value of the index, too.
std::string or_each(const std::string& value) {
  return R"({"anyOf": [)" + value + R"(, {"$ref": "#/$defs/each"}]})";
}

template <class Words, class Choice>
std::string one_of_words(const Words& words, Choice otherwise) {
  return R"({"enum": )" + json_text(node(texts(words))) + R"(, "default": )" +
         json_text(node(word_of(words, otherwise))) + "}";
}

std::string bounds(const Key& key) {
  std::string all;
  if (std::isfinite(key.lower))
    all += (key.lower_open ? R"(, "exclusiveMinimum": )" : R"(, "minimum": )") + number_text(key.lower);
  return std::isfinite(key.upper) ? all + R"(, "maximum": )" + number_text(key.upper) : all;
}

/// What the value of a key may be, as the members of its schema.
std::string value_schema(const Key& key) {
  const std::string any = R"("type": ["number", "string"])", positive = any + R"(, "exclusiveMinimum": 0)";
  switch (key.type) {
    case KeyType::number:
      return any + bounds(key);
    case KeyType::whole:
      return R"("type": "integer")" + bounds(key);
    case KeyType::frequency:
      return positive;
    case KeyType::value:
      return any;
    case KeyType::window:
      return R"("type": "array", "items": {)" + positive + R"(}, "minItems": 2, "maxItems": 2)";
    case KeyType::word:
      return R"("enum": )" + json_text(node(key.words));
    case KeyType::text:
    case KeyType::parameter:
    case KeyType::followed:
      return R"("type": "string")";
    case KeyType::parameters:
      return R"("type": "array", "items": {"type": "string"}, "minItems": 1)";
    case KeyType::other:
      break;
  }
  return key.schema.empty() ? "" : key.schema.substr(1, key.schema.rfind('}') - 1);
}

/// A key with its meaning and default.
std::string key_schema(const Key& key) {
  const std::string unit = key.unit == "frequency"   ? "the scene's unit"
                           : key.unit == "parameter" ? "the parameter's unit"
                                                     : key.unit;
  std::string schema = value_schema(key);
  schema = "{" + schema + (schema.empty() ? "" : ", ") + R"("description": )" +
           file::quoted(unit.empty() || unit == "-" ? key.help : key.help + " (" + unit + ")");
  return schema + (key.otherwise.empty() ? "" : R"(, "default": )" + key.otherwise) + "}";
}

std::string field_schema(const Field& field) {
  Key key{std::string(field.name),
          KeyType::number,
          std::string(field.unit),
          "",
          "",
          false,
          std::string(field.help),
          field.lower,
          field.upper,
          field.lower_open};
  if (field.default_value) key.otherwise = json_text(node(*field.default_value));
  return key_schema(key);
}

/// What is used in many places; repeated entries are those of repeat.hpp.
std::string definitions() {
  const std::string count = integer(1, largest_repeat);
  const std::string index = ObjectSchema()
                                .add("count", count, true)
                                .add("index", R"({"type": "string", "default": "i"})")
                                .add("cyclic", R"({"type": "boolean", "default": false})")
                                .alone();
  return R"({"number": {"type": ["number", "string"]}, "numbers": )" + map_of(a_number) +
         R"(, "repeat": {"description": "one for each index from 1 to a count; {i}, {i+1}, {i-1} in texts are )" +
         R"(the index and its neighbours", "anyOf": [)" + count + ", " + index + R"(]}, "each": )" +
         ObjectSchema().add("each", R"({"type": "array"})", true).alone() +
         R"(, "dof": {"description": "a degree of freedom, or that of the next sector of a ring", "anyOf": [)" +
         a_text + ", " + ObjectSchema().add("next", a_text, true).alone() +
         R"(]}, "weights": {"type": "object", "properties": {"next": {"$ref": "#/$defs/numbers"}}, )" +
         R"("additionalProperties": {"$ref": "#/$defs/number"}}, "name": {"anyOf": [)" + a_text + ", " +
         ObjectSchema()
             .add("repeat", R"({"$ref": "#/$defs/repeat"})", true)
             .add("name", a_text, true)
             .alone() +
         R"(]}, "place": )" +
         ObjectSchema().add_place(true).with(R"("additionalProperties": false, "oneOf": )" +
                                             std::string(one_place)) +
         "}";
}

/// One response, or a list of responses with names.
std::string responses() {
  const std::string one_of_them = R"("additionalProperties": false, "oneOf": )" + std::string(one_place);
  const std::string place =
      ObjectSchema().add("repeat", R"({"$ref": "#/$defs/repeat"})").add_place(false).with(one_of_them);
  const auto response = [&](bool named) {
    ObjectSchema object;
    if (named) object.add("repeat", R"({"$ref": "#/$defs/repeat"})").add("name", a_text, true);
    object.add_place(false)
        .add("max_of", list_of(place, 1))
        .add("frame", one_of_words(frames, Response{}.frame));
    std::string rest = one_of_them;
    rest.insert(rest.size() - 1, R"(, {"required": ["max_of"]})");
    return object.with(rest);
  };
  return R"({"oneOf": [)" + response(false) + ", " + list_of(response(true), 1) + "]}";
}

/// A key of a spring or damper in place of its value.
struct GivenBy {
  const char *key = nullptr, *schema = nullptr;
};

std::string part_of(const PartType& type, bool with_type, const GivenBy& instead = {}) {
  const auto is_one_of = [&type](auto types) {
    return std::find(types.begin(), types.end(), &type) != types.end();
  };
  const bool excites = is_one_of(excitation_types()), damps = is_one_of(damping_types()),
             has_place = type.has_one_direction({});
  ObjectSchema object;
  object.add("repeat", R"({"$ref": "#/$defs/repeat"})").add("name", a_text, true);
  if (with_type)
    object.add("type", R"({"const": )" + file::quoted(type.name()) + "}", &type != &force_type());
  if (has_place) object.add_place(!excites);
  for (const std::string_view slot : type.slots()) object.add(slot, R"({"$ref": "#/$defs/place"})", true);
  for (const Key& option : type.options())
    object.add(option.name, or_each(key_schema(option)), option.required);
  if (excites)
    object
        .add("harmonic",
             integer(0, largest_order, R"(, "default": 1, "description": "of the excitation; 0: constant")"))
        .add("engine_order", R"({"type": "integer", "description":
           "of a repeated excitation: periods around the ring, by which each is delayed"})");
  for (const Field& field : type.fields({}))
    object.add(field.name, or_each(field_schema(field)),
               !field.default_value && !type.options_bring_fields() && instead.key == nullptr);
  if (with_type && !damps) object.add(wear_coefficient.name, field_schema(wear_coefficient));
  if (instead.key != nullptr) object.add(instead.key, or_each(instead.schema));
  const std::string others = type.names_directions() && !damps ? R"({"$ref": "#/$defs/place"})"
                             : type.options_bring_fields()     ? a_number  // fields that the options bring
                                                               : "false";
  std::string rest = R"("additionalProperties": )" + others;
  if (has_place && !excites && !type.names_directions()) rest += R"(, "oneOf": )" + std::string(one_place);
  if (&type == &force_type()) rest += R"(, "anyOf": [{"required": ["shape"]}, )" + std::string(one_place + 1);
  if (instead.key != nullptr)
    rest += R"(, "anyOf": [{"required": ["value"]}, {"required": [)" + file::quoted(instead.key) + "]}]";
  return object.with(rest);
}

/// A list of parts, each of one of the types.
template <class Types>
std::string parts_of(const Types& types, int least = 0) {
  std::string choices;
  for (const auto& type : types) choices += (choices.empty() ? "" : ", ") + part_of(*type, true);
  return list_of(R"({"oneOf": [)" + choices + "]}", least);
}

/// A patch of contacts, whose other keys are fields and options of its law.
std::string patch() {
  return ObjectSchema()
      .add("name", a_text, true)
      .add("law", a_text, true)
      .add("file", R"({"type": "string", "description": "the path of a CSV file of contacts"})", true)
      .add("details", R"({"type": "boolean", "default": true})")
      .add(wear_coefficient.name, field_schema(wear_coefficient))
      .with(R"("additionalProperties": true)");
}

std::string rotation() {
  ObjectSchema object;
  object.add("name", a_text, true);
  for (const Key& option : rotation_type().options()) object.add(option.name, key_schema(option));
  for (const Field& field : rotation_type().fields({})) object.add(field.name, field_schema(field));
  return object.with(
      R"("additionalProperties": false, "oneOf": [{"required": ["speed"]}, {"required": ["engine_order"]}])");
}

/// Samples of parameters with distributions.
std::string samples() {
  std::string choices;
  for (const sampling::DistributionDescription& each : sampling::distribution_types()) {
    std::string help;
    for (const std::string_view value : each.values) help.append(help.empty() ? "" : ", ").append(value);
    const std::string size = std::to_string(each.values.size());
    const std::string values = R"({"type": "array", "items": )" + std::string(a_number) +
                               R"(, "minItems": )" + size + R"(, "maxItems": )" + size +
                               R"(, "description": )" + file::quoted(help) + "}";
    choices += (choices.empty() ? "" : ", ") + ObjectSchema().add(each.name, values, true).alone();
  }
  return ObjectSchema()
      .add("distributions", map_of(R"({"oneOf": [)" + choices + "]}"), true)
      .add("count", integer(1, sampling::largest_sample_count), true)
      .add("seed", integer(0, std::numeric_limits<int>::max(),
                           R"(, "default": )" + std::to_string(sampling::Plan{}.seed)))
      .add("design", one_of_words(sampling::designs(), sampling::Plan{}.design))
      .alone();
}

std::string for_each() {
  const std::string range = ObjectSchema()
                                .add("from", a_number, true)
                                .add("to", a_number, true)
                                .add("count", R"({"type": "integer", "minimum": 2})", true)
                                .add("spacing", one_of_words(spacings, Spacing::linear))
                                .alone();
  return R"({"oneOf": [{"type": "string",
      "description": "path of a CSV file: a column for each parameter, a row for each sample"}, )" +
         samples() + ", " + map_of(R"({"oneOf": [)" + list_of(a_number, 1) + ", " + range + "]}") + ", " +
         list_of(R"({"$ref": "#/$defs/numbers"})", 1) + "]}";
}

std::string study_of(const StudyType& type) {
  ObjectSchema object;
  object.add("name", R"({"type": "string", "minLength": 1, "maxLength": 100})");
  object.add("kind", R"({"const": )" + file::quoted(type.name()) + "}", true);
  std::string needs;  // keys that stand together or not at all
  const auto need = [&](const std::string& key, const std::vector<std::string>& others) {
    needs += (needs.empty() ? "" : ", ") + file::quoted(key) + ": " + json_text(node(others));
  };
  for (const Key& key : type.keys()) {
    object.add(key.name, key_schema(key), key.required);
    const std::vector<std::string> nearby =
        key.required ? std::vector<std::string>() : keys_next_to(key.type);
    if (!nearby.empty()) need(key.name, nearby);
    for (const std::string& each : nearby) need(each, {key.name});
  }
  object.add("for_each", for_each());
  std::string rest = R"("additionalProperties": false, "title": )" + file::quoted(type.help());
  if (!needs.empty()) rest += R"(, "dependentRequired": {)" + needs + "}";
  return object.with(rest);
}

std::string constant() {
  const std::string pair =
      R"({"type": "array", "items": )" + std::string(a_number) + R"(, "minItems": 2, "maxItems": 2})";
  return ObjectSchema()
      .add("value", a_number, true)
      .add("unit", a_text)
      .add("bounds", pair)
      .add("help", a_text)
      .alone();
}

std::string structure() {
  return ObjectSchema()
      .add("cyclic", object_schema(cyclic_keys()))
      .add("dofs", list_of(R"({"$ref": "#/$defs/name"})", 1))
      .add("masses", list_of(part_of(mass_type(), false)))
      .add("springs",
           list_of(part_of(
               spring_type(), false,
               {"frequency", R"json({"type": ["number", "string"], "exclusiveMinimum": 0, "description":
             "natural frequency of the mass there on this spring alone (the scene's unit)"})json"})))
      .add("dampers",
           list_of(part_of(damper_type(), false,
                           {"damping_ratio", R"({"type": ["number", "string"], "minimum": 0, "description":
             "of the mass there on the spring there"})"})))
      .add("matrices", object_schema(matrices_keys()))
      .add("names", a_text)
      .add("rotation", rotation())
      .add("beam", object_schema(bar_keys(true)))
      .add("rod", object_schema(bar_keys(false)))
      .add("damping", parts_of(damping_types()))
      .alone();
}

std::string schema_of(const Catalogue& catalogue) {
  std::string studies;
  for (const auto& type : catalogue.studies) studies += (studies.empty() ? "" : ", ") + study_of(*type);
  const std::vector<std::string> formats{std::string(format_name), std::string(first_format_name)};
  return ObjectSchema()
      .add("$schema", a_text)
      .add("format", R"({"enum": )" + json_text(node(formats)) + "}", true)
      .add("title", a_text)
      .add("frequency_unit", one_of_words(frequency_units, Scene{}.frequency_unit))
      .add("structure", structure(), true)
      .add("elements", parts_of(catalogue.elements))
      .add("patches", list_of(patch()))
      .add("excitation", parts_of(excitation_types(), 1), true)
      .add("constants", map_of(R"({"anyOf": [)" + std::string(a_number) + ", " + constant() + "]}"))
      .add("ties", map_of(list_of(R"({"$ref": "#/$defs/name"})", 1)))
      .add("labels", map_of(a_text))
      .add("harmonics", object_schema(harmonics_keys()))
      .add("response", responses())
      .add("studies", list_of(R"({"oneOf": [)" + studies + "]}"))
      .with(R"("additionalProperties": false, "title": "Arcslip scene",
        "$schema": "https://json-schema.org/draft/2020-12/schema", "$defs": )" +
            definitions());
}

}  // namespace

std::string object_schema(const SettingsKeys& table) {
  ObjectSchema object;
  for (const Key& key : table.keys()) object.add(key.name, key_schema(key), key.required);
  return object.alone();
}

}  // namespace file

std::string json_schema(const Catalogue& catalogue) {
  return file::print_tree(file::read_tree(file::schema_of(catalogue)));
}

}  // namespace arcslip::scene

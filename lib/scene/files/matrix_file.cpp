#include <arcslip/scene/files/mat_file.hpp>
#include <arcslip/scene/files/matrix_file.hpp>
#include <arcslip/scene/files/matrix_market.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <filesystem>

namespace arcslip::scene::file {
namespace {

constexpr std::size_t largest_file = std::size_t{4} << 30;  // bytes

}  // namespace

MatrixFile read_matrix_file(const Location& place, const std::string& wanted, const Reading& reading,
                            int* column) {
  MatrixFile found;
  if (place.node == nullptr) return found;
  Faults& faults = reading.faults;
  Location path = place, variable;
  if (place.node->get<Node::Object>() != nullptr) {
    const Keys keys(place,
                    column != nullptr ? std::vector<std::string>{"file", "variable", "column"}
                                      : std::vector<std::string>{"file", "variable"},
                    faults);
    path = keys.require("file", "a string, the path of a file", faults);
    variable = keys.find("variable");
    if (variable.node != nullptr) {
      const auto name = read_string(variable, "a string, the name of a variable", faults);
      if (!name) return found;
      if (name->empty())
        faults.add(variable.pointer, "found \"\", must be the name of a variable, or left out");
      found.variable = *name;
    }
    if (column != nullptr)
      *column = read_integer(keys.find("column"), 1, std::numeric_limits<int>::max(), faults).value_or(1);
  }
  found.file = read_file_of(path, wanted, reading, largest_file).value_or(NamedFile{});
  if (!found.file.text) return found;
  for (const FileSource::Known& known : reading.source.matrices)
    if (known.text == found.file.text && known.variable == found.variable) found.matrix = known.matrix;
  if (found.matrix) return found;
  const std::string& text = *found.file.text;
  const bool of_matlab = is_mat_file(found.file.path, text);
  if (!found.variable.empty() && !of_matlab) {
    faults.add(variable.pointer, "found the variable " + shown(found.variable) + " of " +
                                     shown(found.file.path) +
                                     ", must stand next to a .mat file: others hold one matrix");
    return found;
  }
  try {
    const auto at = std::filesystem::path(reading.source.folder.path) / found.file.path;
    found.matrix = std::make_shared<const SparseMatrix>(
        of_matlab
            ? read_mat_file(at.string(), text, found.variable, shown(found.file.path), reading.source.control)
            : read_matrix_market(text, shown(found.file.path), reading.source.control));
    reading.source.matrices.push_back({found.file.text, found.variable, found.matrix});
  } catch (const MatrixError& error) {
    faults.add(place.pointer, error.what());
  }
  return found;
}

Node matrix_file_node(const MatrixFile& file, int column) {
  if (file.variable.empty() && column <= 1) return node(file.file.path);
  Node::Object object{{"file", node(file.file.path)}};
  if (!file.variable.empty()) object.push_back({"variable", node(file.variable)});
  if (column > 1) object.push_back({"column", node(column)});
  return {std::move(object)};
}

std::string matrix_file_schema(bool with_column) {
  return R"({"anyOf": [{"type": "string"}, {"type": "object", "properties": {"file": {"type": "string"},
    "variable": {"type": "string"}, )" +
         std::string(with_column ? R"("column": {"type": "integer", "minimum": 1}, )" : "") +
         R"("comment": {}}, "required": ["file"], "additionalProperties": false}]})";
}

}  // namespace arcslip::scene::file

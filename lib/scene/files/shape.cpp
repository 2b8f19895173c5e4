// The types of excitations, and the shapes that they may have.
#include <arcslip/scene/files/matrix_file.hpp>
#include <arcslip/scene/keys/study_keys.hpp>
#include <arcslip/scene/shape.hpp>

#include <array>

namespace arcslip::scene {
namespace {

constexpr Field force_fields[] = {
    {.name = "cosine",
     .unit = "N",
     .lower = -infinity,
     .upper = infinity,
     .default_value = 0.0,
     .help = "amplitude of the force along cos(harmonic w t)"},
    {.name = "sine",
     .unit = "N",
     .lower = -infinity,
     .upper = infinity,
     .default_value = 0.0,
     .help = "amplitude of the force along sin(harmonic w t)"},
};
constexpr Field base_displacement_fields[] = {
    {.name = "cosine",
     .unit = "m",
     .lower = -infinity,
     .upper = infinity,
     .default_value = 0.0,
     .help = "amplitude of the displacement of the ground along cos(harmonic w t)"},
    {.name = "sine",
     .unit = "m",
     .lower = -infinity,
     .upper = infinity,
     .default_value = 0.0,
     .help = "amplitude of the displacement of the ground along sin(harmonic w t)"},
};
constexpr Field base_acceleration_fields[] = {
    {.name = "cosine",
     .unit = "m/s^2",
     .lower = -infinity,
     .upper = infinity,
     .default_value = 0.0,
     .help = "amplitude of the acceleration of the ground along cos(harmonic w t)"},
    {.name = "sine",
     .unit = "m/s^2",
     .lower = -infinity,
     .upper = infinity,
     .default_value = 0.0,
     .help = "amplitude of the acceleration of the ground along sin(harmonic w t)"},
};

file::KeyGroup<Shape> shape_file(const std::string& name, ShapeFile Shape::*part, std::string help) {
  const std::string wanted = "a string, the path of a Matrix Market or .mat file with a vector over all rows";
  Key key{name, KeyType::other, "", wanted, "", false, std::move(help)};
  key.schema = file::matrix_file_schema(true);
  return {{key},
          [=](const file::Reading& reading, Shape& shape) {
            ShapeFile& own = shape.*part;
            const file::Location place = reading.keys.find(name);
            own.from = file::read_matrix_file(place, wanted, reading, &own.column);
            if (const auto& matrix = own.from.matrix; matrix && own.column > matrix->columns)
              reading.faults.add(place.pointer, "found a matrix of " + std::to_string(matrix->columns) +
                                                    " columns, must have the column " +
                                                    std::to_string(own.column));
          },
          [=](const Shape& shape, const Scene&, file::Node::Object& to) {
            const ShapeFile& own = shape.*part;
            if (own.is_given()) to.push_back({name, file::matrix_file_node(own.from, own.column)});
          },
          {},
          {},
          [=](Shape& shape, std::vector<NamedFile*>& files) {
            if (ShapeFile& own = shape.*part; own.is_given()) files.push_back(&own.from.file);
          }};
}

file::KeyGroup<Shape> copy_of_matrices() {
  const std::string allowed = "an integer from 1 to " + std::to_string(file::largest_copies);
  Key key{"copy",
          KeyType::whole,
          "-",
          allowed,
          "",
          false,
          "of the matrices on which the shape acts, where there are several",
          1,
          file::largest_copies};
  return {{key},
          [](const file::Reading& reading, Shape& shape) {
            const file::Location place = reading.keys.find("copy");
            shape.copy = file::read_integer(place, 1, file::largest_copies, reading.faults).value_or(0);
            if (place.node != nullptr && !reading.keys.has("shape") && !reading.keys.has("imaginary_shape"))
              reading.faults.add(place.pointer,
                                 "found a copy of matrices without \"shape\", must stand next to it: on "
                                 "which of the copies the shape acts");
          },
          [](const Shape& shape, const Scene&, file::Node::Object& to) {
            if (shape.copy > 0) to.push_back({"copy", file::node(shape.copy)});
          }};
}

file::KeysOf<Shape> shape_keys() {
  file::KeysOf<Shape> keys;
  keys.add(shape_file("shape", &Shape::real,
                      "of the force or of the motion of the ground, on all rows of matrices"));
  keys.add(shape_file("imaginary_shape", &Shape::imaginary, "its imaginary part, as of a travelling wave"));
  keys.add(copy_of_matrices());
  keys.check([](const file::Reading& reading, Shape& shape) {
    if (shape.imaginary.is_given() && !reading.keys.has("shape"))
      reading.faults.add(reading.keys.find("imaginary_shape").pointer,
                         "found an imaginary part alone, must stand next to \"shape\", the real part");
  });
  return keys;
}

class Excited final : public file::KeyedPart<Shape, PartType> {
 public:
  Excited(std::string_view name, std::span<const Field> fields)
      : KeyedPart(shape_keys()), name_(name), fields_(fields) {}
  std::string_view name() const override { return name_; }
  std::span<const Field> fields(const Settings&) const override { return fields_; }
  bool options_bring_fields() const override { return false; }
  // Without a shape a part has no options.
  Settings read_options(const file::Reading& from) const override {
    const bool shaped = from.keys.has("shape") || from.keys.has("imaginary_shape") || from.keys.has("copy");
    return shaped ? KeyedPart::read_options(from) : Settings();
  }

 private:
  std::string_view name_;
  std::span<const Field> fields_;
};

}  // namespace

std::vector<double> ShapeFile::values() const {
  const SparseMatrix& A = *from.matrix;
  std::vector<double> all(static_cast<std::size_t>(A.rows), 0.0);
  const auto j = static_cast<std::size_t>(column - 1);
  for (auto k = static_cast<std::size_t>(A.starts[j]); k < static_cast<std::size_t>(A.starts[j + 1]); ++k)
    all[static_cast<std::size_t>(A.row_of[k])] = A.values[k];
  return all;
}

const Shape* shape_of(const Part& excitation) {
  return excitation.options.empty() ? nullptr : &excitation.options.as<Shape>();
}

const PartType& force_type() {
  static const Excited type("force", force_fields);
  return type;
}

const PartType& base_displacement_type() {
  static const Excited type("base_displacement", base_displacement_fields);
  return type;
}

const PartType& base_acceleration_type() {
  static const Excited type("base_acceleration", base_acceleration_fields);
  return type;
}

std::span<const PartType* const> excitation_types() {
  static const std::array<const PartType*, 3> types = {&force_type(), &base_displacement_type(),
                                                       &base_acceleration_type()};
  return types;
}

bool is_base_motion(const PartType& type) {
  return &type == &base_displacement_type() || &type == &base_acceleration_type();
}

}  // namespace arcslip::scene

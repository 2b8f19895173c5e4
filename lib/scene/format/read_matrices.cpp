// Structures from matrices in files.
#include <arcslip/scene/files/face_rows.hpp>
#include <arcslip/scene/files/matrix_file.hpp>
#include <arcslip/scene/files/row_names.hpp>
#include <arcslip/scene/format/json_schema.hpp>
#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/read_studies.hpp>
#include <arcslip/scene/keys/section_keys.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace arcslip::scene {
namespace file {
namespace {

constexpr double agreeing = 1e-9;  // a(i,j) - a(j,i), relative to sqrt(a(i,i) a(j,j)) or to both

constexpr int largest_whole = 500;  // rows, of all copies
constexpr Field at_least_0{
    .name = "value", .unit = "-", .lower = 0, .upper = std::numeric_limits<double>::infinity()};

enum class Form { symmetric, skew, general };

constexpr const char* unsymmetric_wanted = "a list of at least one of \"stiffness\", \"damping\"";

std::string entry_place(int row, int column) {
  return "row " + std::to_string(row + 1) + ", column " + std::to_string(column + 1);
}

// What is wrong in many places, as the middle of one message: the first of them, and how many more.
class Places {
 public:
  template <class Text>
  void add(const Text& text) {
    if (++count_ <= most_named) reported_ += (count_ > 1 ? "; " : "") + text();
  }
  bool any() const { return count_ > 0; }
  std::string reported() const {
    return count_ <= most_named ? reported_
                                : reported_ + "; and " + std::to_string(count_ - most_named) + " more";
  }

 private:
  static constexpr std::size_t most_named = 3;
  std::size_t count_ = 0;
  std::string reported_;
};

// Where all rows cannot be degrees of freedom.
void check_whole(const std::string& pointer, const Matrices& matrices, Faults& faults) {
  const int copies = matrices.copies;
  if (matrices.highest_frequency > 0 || matrices.size() <= largest_whole / copies) return;
  faults.add(pointer, "found " + (copies > 1 ? std::to_string(copies) + " copies of " : "") + "matrices of " +
                          std::to_string(matrices.size()) +
                          " rows without \"highest_frequency\", must have it above " +
                          std::to_string(largest_whole) + " rows" + (copies > 1 ? " in all" : "") +
                          ": the highest frequency of a harmonic to which the structure is reduced");
}

struct MatrixKey {
  const char* name;
  MatrixFile Matrices::* file;
  bool required;
  Form form;  // unless the scene says that it is unsymmetric
  const char *unit, *help;
};
constexpr std::array<MatrixKey, 6> matrix_files = {
    {{"mass", &Matrices::mass, true, Form::symmetric, "kg", "symmetric"},
     {"stiffness", &Matrices::stiffness, true, Form::symmetric, "N/m",
      "of the size of the mass matrix, as all others; symmetric, or in `unsymmetric`"},
     {"damping", &Matrices::damping, false, Form::symmetric, "N s/m", "symmetric, or in `unsymmetric`"},
     {"stiffness_speed_squared", &Matrices::stiffness_speed_squared, false, Form::symmetric, "N/m s^2/rad^2",
      "symmetric: K2 of a [rotating structure](#rotation)"},
     {"gyroscopic", &Matrices::gyroscopic, false, Form::skew, "N s/m",
      "skew-symmetric: G, which multiplies the velocities; with a [rotation](#rotation) also multiplied by "
      "its "
      "speed, and in this unit times s/rad"},
     {"circulatory", &Matrices::circulatory, false, Form::skew, "N/m",
      "skew-symmetric: N, which multiplies the displacements, with a rotation as `gyroscopic`"}}};

KeyGroup<Matrices> file_of(const MatrixKey& own) {
  const std::string wanted = "a string, the path of a Matrix Market or .mat file";
  KeyGroup<Matrices> group{{key_of(own.name, own.unit, wanted, own.help, matrix_file_schema(false))},
                           [=](const Reading& reading, Matrices& of) {
                             of.*own.file = read_matrix_file(reading.keys.find(own.name), wanted, reading);
                           },
                           [=](const Matrices& of, const Scene&, Node::Object& to) {
                             const MatrixFile& file = of.*own.file;
                             // Without its path, as for the hash, a file still has its text or a variable.
                             const bool given = own.file == &Matrices::damping
                                                    ? of.has_damping() || !file.variable.empty()
                                                    : file.file.text != nullptr;
                             if (own.required || given) to.push_back({own.name, matrix_file_node(file)});
                           }};
  return own.required ? required(std::move(group)) : group;
}

void read_unsymmetric(const Reading& reading, Matrices& matrices) {
  Faults& faults = reading.faults;
  const Location place = reading.keys.find("unsymmetric");
  const Node::List* list = read_list(place, unsymmetric_wanted, faults);
  if (list == nullptr) return;
  if (list->empty())
    faults.add(place.pointer, std::string("found an empty list, must be ") + unsymmetric_wanted);
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Location at{&(*list)[i], child(place.pointer, i)};
    const auto key = read_string(at, "\"stiffness\" or \"damping\"", faults);
    if (!key) continue;
    const bool stiffness = *key == "stiffness";
    bool& flag = stiffness ? matrices.unsymmetric_stiffness : matrices.unsymmetric_damping;
    if (!stiffness && *key != "damping")
      faults.add(at.pointer, "found " + shown(*key) + ", must be \"stiffness\" or \"damping\"");
    else if (flag)
      faults.add(at.pointer, "found " + shown(*key) + " again, must be given once");
    else if (!stiffness && !reading.keys.has("damping"))
      faults.add(at.pointer, "found \"damping\" without the key \"damping\", must be next to that matrix");
    else
      flag = true;
  }
}

KeyGroup<Matrices> unsymmetric() {
  return {
      {key_of(
          "unsymmetric", "", unsymmetric_wanted,
          "these may be unsymmetric, as with the cross-coupled coefficients of journal bearings and seals",
          R"({"type": "array", "items": {"enum": ["stiffness", "damping"]}, "minItems": 1})")},
      read_unsymmetric,
      [](const Matrices& of, const Scene&, Node::Object& to) {
        std::vector<std::string> all;
        if (of.unsymmetric_stiffness) all.emplace_back("stiffness");
        if (of.unsymmetric_damping) all.emplace_back("damping");
        if (!all.empty()) to.push_back({"unsymmetric", node(all)});
      }};
}

KeyGroup<Matrices> reduction() {
  return {{key_of("reduction", "", "an object", "[how](#reduction) the structure is reduced",
                  object_schema(reduction_keys()))},
          [](const Reading& reading, Matrices& of) {
            const Location place = reading.keys.find("reduction");
            if (place.node == nullptr) return;
            of.reduction = read_section(place, reduction_keys(), reading.frequency, reading.source,
                                        reading.dofs, reading.faults)
                               .as<Reduction>();
            if (place.node->get<Node::Object>() != nullptr && !reading.keys.has("highest_frequency"))
              reading.faults.add(place.pointer,
                                 "found it without \"highest_frequency\", must be next to it: the highest "
                                 "frequency of a harmonic to which the structure is reduced");
          },
          [](const Matrices& of, const Scene& scene, Node::Object& to) {
            if (of.reduction == Reduction{}) return;
            Node::Object own;
            reduction_keys().write(Settings::of(of.reduction), scene, own);
            to.push_back({"reduction", {std::move(own)}});
          }};
}

void read_errors(const Reading& reading, Matrices& matrices) {
  Faults& faults = reading.faults;
  const Location place = reading.keys.find("errors");
  const Node::List* list = read_list(place, "a list of frequencies and the errors up to them", faults);
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const std::string pointer = child(place.pointer, i);
    const auto pair =
        read_factors({&(*list)[i], pointer}, 2, at_least_0, "a frequency and the error up to it", faults);
    if (!pair) continue;
    const double before = matrices.errors.empty() ? 0 : matrices.errors.back().frequency;
    if (pair->front() <= before)
      faults.add(child(pointer, 0), "found " + number_text(pair->front()) + ", must be above " +
                                        number_text(before) + ", the frequency before it");
    else
      matrices.errors.push_back({pair->front(), pair->back()});
  }
}

KeyGroup<Matrices> errors() {
  return {
      {key_of(
          "errors", "", "a list of pairs, a frequency and the error of the dynamic stiffness up to it",
          "of matrices that a reduction made, as `arcslip reduce` writes them, `[[90, 2e-5], [1000, 0.03]]`, "
          "frequencies in the scene's unit",
          R"({"type": "array", "minItems": 1, "items": {"type": "array", "minItems": 2, "maxItems": 2,
                      "items": {"type": "number", "minimum": 0}}})")},
      read_errors,
      [](const Matrices& of, const Scene&, Node::Object& to) {
        Node::List all;
        for (const auto& [frequency, error] : of.errors) all.push_back(node(std::vector{frequency, error}));
        if (!all.empty()) to.push_back({"errors", {std::move(all)}});
      }};
}

KeyGroup<Matrices> faces() {
  const std::string wanted = "a string, the path of a CSV file of own,next";
  return {{key_of("faces", "", wanted,
                  "of a sector of a [ring](#faces-of-a-sector): the rows that it shares with the next one",
                  R"({"type": "string"})")},
          [=](const Reading& reading, Matrices& of) {
            if (const auto file = read_file_of(reading.keys.find("faces"), wanted, reading))
              of.faces_file = *file;
          },
          [](const Matrices& of, const Scene&, Node::Object& to) {
            if (of.faces_file.text) to.push_back({"faces", node(of.faces_file.path)});
          }};
}

KeyGroup<Matrices> copies() {
  auto group =
      whole("copies", &Matrices::copies, 1, largest_copies, "[of the structure](#copies), side by side");
  group.read = [](const Reading& reading, Matrices& of) {
    const Location place = reading.keys.find("copies");
    if (place.node != nullptr)  // 0 after a fault
      of.copies = read_integer(place, 1, largest_copies, reading.faults).value_or(0);
  };
  group.write = [write = std::move(group.write)](const Matrices& of, const Scene& scene, Node::Object& to) {
    if (of.copies > 1) write(of, scene, to);
  };
  return group;
}

KeyGroup<Matrices> factors_of_stiffness() {
  return {{key_of("stiffness_factors", "-", "a list of a number above 0 for each copy",
                  "multiplies the stiffness matrix of each; without it 1",
                  R"({"type": "array", "items": {"type": ["number", "string"], "exclusiveMinimum": 0}})")},
          [](const Reading& reading, Matrices& of) {
            const Location place = reading.keys.find("stiffness_factors");
            if (place.node == nullptr || of.copies == 0) return;
            const auto factors = read_factors(place, of.copies, above_0,
                                              "a factor of the stiffness for each copy", reading.faults);
            of.stiffness_factors = factors.value_or(std::vector<double>());
          },
          [](const Matrices& of, const Scene&, Node::Object& to) {
            if (!of.stiffness_factors.empty())
              to.push_back({"stiffness_factors", node(of.stiffness_factors)});
          }};
}

KeysOf<Matrices> keys_of_matrices() {
  KeysOf<Matrices> all;
  for (const MatrixKey& own : matrix_files) all.add(file_of(own));
  all.add(unsymmetric());
  all.add(
      within(&Matrices::highest_frequency,
             optional_frequency("highest_frequency",
                                "required above 500 rows, of all copies together: up to it the structure is "
                                "[reduced](#reduction)")));
  all.add(reduction());
  all.add(errors());
  all.add(faces());
  all.add(copies());
  all.add(factors_of_stiffness());
  return all;
}

// Faults of the matrices, at the keys of their files.
class Files {
 public:
  Files(std::string pointer, Faults& faults) : pointer_(std::move(pointer)), faults_(faults) {}

  void check_forms(const Matrices& matrices) {
    for (const MatrixKey& own : matrix_files) {
      const bool general = (own.file == &Matrices::stiffness && matrices.unsymmetric_stiffness) ||
                           (own.file == &Matrices::damping && matrices.unsymmetric_damping);
      const MatrixFile& file = matrices.*own.file;
      if (file.matrix) check(own.name, *file.matrix, general ? Form::general : own.form);
      if (file.matrix && matrices.stiffness.matrix) check_size(own.name, file, matrices.size());
    }
  }

  // Of files that are sound each.
  void check_together(Matrices& matrices) {
    check_rows(matrices);
    check_mass("gyroscopic", matrices.gyroscopic, *matrices.mass.matrix);
    if (matrices.unsymmetric_damping) check_mass("damping", matrices.damping, *matrices.mass.matrix);
    check_whole(pointer_, matrices, faults_);
    check_factors(matrices);
    if (matrices.faces_file.text)
      read_face_rows({nullptr, child(pointer_, "faces")}, matrices.faces_file, matrices, faults_);
  }

 private:
  // Of its form, and but for the parts that grow with the speed without a negative diagonal entry.
  void check(const std::string& key, const SparseMatrix& A, Form form) {
    const auto fault = [&](const std::string& what) {
      faults_.add(child(pointer_, key), "found the " + key + " matrix with " + what);
    };
    if (A.rows != A.columns || A.rows == 0)
      return fault(std::to_string(A.rows) + " rows and " + std::to_string(A.columns) +
                   " columns, must be square");
    if (form == Form::skew) return check_skew(A, fault);
    const bool semidefinite = key != "stiffness_speed_squared";
    Places negative, asymmetric;
    for (int j = 0; j < A.columns; ++j)
      for (int k = A.starts[static_cast<std::size_t>(j)]; k < A.starts[static_cast<std::size_t>(j) + 1];
           ++k) {
        const int i = A.row_of[static_cast<std::size_t>(k)];
        const double value = A.values[static_cast<std::size_t>(k)];
        if (i == j && value < 0 && semidefinite)
          negative.add([&] { return number_text(value) + " in " + entry_place(i, j); });
        if (i == j || value == 0 || form == Form::general) continue;
        const double other = value_at(A, j, i);
        if (i < j && other != 0) continue;  // compared from there
        const double diagonal =
            std::sqrt(std::abs(value_at(A, i, i))) * std::sqrt(std::abs(value_at(A, j, j)));
        const double scale = std::max({std::abs(value), std::abs(other), diagonal});
        if (std::abs(value - other) <= agreeing * scale) continue;
        asymmetric.add([&] {
          return number_text(value) + " in " + entry_place(i, j) + " and " + number_text(other) + " in " +
                 entry_place(j, i);
        });
      }
    if (negative.any())
      fault(negative.reported() + ", must be positive semidefinite: no negative entry on the diagonal");
    if (asymmetric.any()) fault(asymmetric.reported() + ", must be symmetric");
  }

  template <class Fault>
  static void check_skew(const SparseMatrix& A, const Fault& fault) {
    Places wrong;
    for (int j = 0; j < A.columns; ++j) {
      const auto from = static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j)]),
                 to = static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j) + 1]);
      double largest = 0;
      for (std::size_t k = from; k < to; ++k)
        if (A.row_of[k] != j) largest = std::max(largest, std::abs(A.values[k]));
      for (std::size_t k = from; k < to; ++k) {
        const int i = A.row_of[k];
        const double value = A.values[k];
        if (i == j) {
          if (std::abs(value) > agreeing * largest)
            wrong.add([&] { return number_text(value) + " in " + entry_place(i, j); });
          continue;
        }
        const double other = value_at(A, j, i);
        if (value == 0 || (i < j && other != 0)) continue;  // compared from there
        if (std::abs(value + other) <= agreeing * std::max(std::abs(value), std::abs(other))) continue;
        wrong.add([&] {
          return number_text(value) + " in " + entry_place(i, j) + " and " + number_text(other) + " in " +
                 entry_place(j, i);
        });
      }
    }
    if (wrong.any())
      fault(wrong.reported() +
            ", must be skew-symmetric: entries across the diagonal of opposite signs, and 0 on it");
  }

  // Where velocities couple without symmetry there is mass: a motion without it would follow at once.
  void check_mass(const std::string& key, const MatrixFile& file, const SparseMatrix& M) {
    if (!file.matrix) return;
    const SparseMatrix& A = *file.matrix;
    Places without;
    for (int j = 0; j < A.columns; ++j)
      for (auto k = static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j)]);
           k < static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j) + 1]); ++k) {
        const int i = A.row_of[k];
        const double value = A.values[k], other = value_at(A, j, i);
        const bool skew = std::abs(value - other) > agreeing * std::max(std::abs(value), std::abs(other));
        if (!skew || (value_at(M, i, i) > 0 && value_at(M, j, j) > 0)) continue;
        const int row = value_at(M, i, i) > 0 ? j : i;
        without.add([&] {
          return number_text(value) + " in " + entry_place(i, j) + ", where the mass matrix has " +
                 number_text(value_at(M, row, row)) + " in " + entry_place(row, row);
        });
      }
    if (without.any())
      faults_.add(child(pointer_, key), "found the " + key + " matrix with " + without.reported() +
                                            ", must have mass in both rows that it couples");
  }

  void check_size(const std::string& key, const MatrixFile& file, int size) {
    if (file.matrix && file.matrix->rows != size)
      faults_.add(child(pointer_, key), "found a matrix of " + std::to_string(file.matrix->rows) +
                                            " rows, must have " + std::to_string(size) +
                                            " as the stiffness matrix");
  }

  void check_factors(const Matrices& matrices) {
    double largest = 0;
    for (const double value : matrices.stiffness.matrix->values) largest = std::max(largest, std::abs(value));
    for (std::size_t i = 0; i < matrices.stiffness_factors.size(); ++i)
      if (const double factor = matrices.stiffness_factors[i]; !std::isfinite(factor * largest))
        faults_.add(
            child(child(pointer_, "stiffness_factors"), i),
            "found " + number_text(factor) + ", with which the stiffness matrix is too large for a number");
  }

  void check_rows(const Matrices& matrices) {
    bool mass = false;
    Places empty;
    for (int i = 0; i < matrices.size(); ++i) {
      const double m = value_at(*matrices.mass.matrix, i, i), k = value_at(*matrices.stiffness.matrix, i, i);
      mass = mass || m > 0;
      if (m == 0 && k == 0) empty.add([&] { return std::to_string(i + 1); });
    }
    if (empty.any())
      faults_.add(pointer_, "found neither mass nor stiffness in row " + empty.reported() +
                                ", must have one of them on the diagonal in each row");
    if (!mass) faults_.add(child(pointer_, "mass"), "found no mass, must have some on its diagonal");
  }

  std::string pointer_;
  Faults& faults_;
};

std::optional<Matrices> read_matrix_files(const Location& place, FrequencyUnit unit, const FileSource& source,
                                          Faults& faults) {
  const std::size_t before = faults.count();
  auto matrices =
      read_section(place, matrices_keys(), frequency_field(unit), source, Dofs(), faults).as<Matrices>();
  if (source.derived) matrices.derived = source.derived;
  Files files(place.pointer, faults);
  files.check_forms(matrices);
  if (faults.count() > before) return {};
  files.check_together(matrices);
  return matrices;
}

// Which of the keys that give matrices there is; empty: none.
std::string key_of_matrices(const Keys& structure, Faults& faults) {
  std::string first;
  for (const std::string key : {"matrices", "beam", "rod"}) {
    if (!structure.has(key)) continue;
    if (!first.empty())
      faults.add(structure.find(key).pointer,
                 "found the key " + shown(key) + " next to " + shown(first) +
                     ", must be one of them: a structure has one set of matrices");
    else
      first = key;
  }
  return first;
}

// What copies and faces need next to them.
void check_ring(const Matrices& matrices, const std::string& pointer, bool cyclic, Faults& faults) {
  if (matrices.copies > 1 && cyclic)
    faults.add(child(pointer, "copies"),
               "found " + std::to_string(matrices.copies) +
                   " next to \"cyclic\", must be left out: one sector has one copy, and with \"full\": true "
                   "there are as many as sectors");
  if (matrices.copies == 1 && matrices.faces_file.text && !cyclic)
    faults.add(
        child(pointer, "faces"),
        "found the faces of a sector without \"cyclic\", must be next to it, or next to \"copies\" that "
        "make a ring");
}

}  // namespace

std::string objection_of_dof(const std::string& name, const Dofs& dofs) {
  if (name.empty()) return "must be a name of at least one character";
  if (name == ground) return "which is reserved for the fixed frame; must be another name";
  if (dofs.index.contains(name)) return "which stands for another degree of freedom; each must stand once";
  return {};
}

std::optional<Matrices> read_matrices(const Keys& structure, FrequencyUnit unit, const FileSource& source,
                                      Dofs& dofs, Faults& faults) {
  const std::string key = key_of_matrices(structure, faults);
  const std::size_t before = faults.count();
  const Location place = structure.find(key), names = structure.find("names");
  std::optional<Matrices> matrices;
  if (key == "matrices") {
    matrices = read_matrix_files(place, unit, source, faults);
    const std::string wanted = "a string, the path of a CSV file of name,row";
    const Reading reading{structure, any_number, no_parameters(), dofs, faults, source};
    const auto file = read_file_of(structure.require("names", wanted, faults), wanted, reading);
    if (matrices && file && file->text) {
      matrices->names = *file;
      read_row_names(names, *file, *matrices, dofs, faults);
    }
    if (matrices) check_ring(*matrices, place.pointer, structure.has("cyclic"), faults);
  } else if (!key.empty()) {
    matrices = read_bar(place, key == "beam", unit, source, dofs, faults);
    if (matrices) check_whole(place.pointer, *matrices, faults);
  } else if (names.node != nullptr) {
    faults.add(names.pointer, "found names of rows without \"matrices\", must be next to them");
    return {};
  }
  if (faults.count() > before) dofs.complete = false;
  return matrices;
}

}  // namespace file

const SettingsKeys& matrices_keys() {
  static const file::KeysOf<Matrices> all = file::keys_of_matrices();
  return all;
}

}  // namespace arcslip::scene

// Structures from matrices in files.
#include <arcslip/scene/files/face_rows.hpp>
#include <arcslip/scene/files/matrix_file.hpp>
#include <arcslip/scene/files/row_names.hpp>
#include <arcslip/scene/keys/read_parts.hpp>
#include <arcslip/scene/keys/read_studies.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <cmath>
#include <limits>

namespace arcslip::scene::file {
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

// Faults of the files, at their keys.
class Files {
 public:
  Files(const Location& place, const Field& frequency, const FileSource& source, Faults& faults)
      : keys_(place,
              {"mass", "stiffness", "damping", "stiffness_speed_squared", "gyroscopic", "circulatory",
               "unsymmetric", "highest_frequency", "reduction", "errors", "faces", "copies",
               "stiffness_factors"},
              faults),
        reading_{keys_, frequency, no_parameters(), no_dofs_, faults, source},
        faults_(faults) {}

  std::optional<Matrices> read() {
    if (!keys_.is_object()) return {};
    Matrices matrices;
    if (reading_.source.derived) matrices.derived = reading_.source.derived;
    read_unsymmetric(matrices);
    read_copies(matrices);
    const auto form = [](bool unsymmetric) { return unsymmetric ? Form::general : Form::symmetric; };
    matrices.stiffness = read_matrix("stiffness", true, form(matrices.unsymmetric_stiffness));
    matrices.mass = read_matrix("mass", true);
    matrices.damping = read_matrix("damping", false, form(matrices.unsymmetric_damping));
    matrices.stiffness_speed_squared = read_matrix("stiffness_speed_squared", false);
    matrices.gyroscopic = read_matrix("gyroscopic", false, Form::skew);
    matrices.circulatory = read_matrix("circulatory", false, Form::skew);
    if (const Location highest = keys_.find("highest_frequency"); highest.node != nullptr)
      matrices.highest_frequency = read_number(highest, reading_.frequency, faults_).value_or(0);
    read_reduction(matrices);
    read_errors(matrices);
    if (!matrices.stiffness.matrix || !matrices.mass.matrix) return {};
    check_size("mass", matrices.mass, matrices.size());
    check_size("damping", matrices.damping, matrices.size());
    check_size("stiffness_speed_squared", matrices.stiffness_speed_squared, matrices.size());
    check_size("gyroscopic", matrices.gyroscopic, matrices.size());
    check_size("circulatory", matrices.circulatory, matrices.size());
    if (faults_.count() > 0) return {};
    check_rows(matrices);
    check_mass("gyroscopic", matrices.gyroscopic, *matrices.mass.matrix);
    if (matrices.unsymmetric_damping) check_mass("damping", matrices.damping, *matrices.mass.matrix);
    check_whole(keys_.pointer(), matrices, faults_);
    check_factors(matrices);
    read_faces(matrices);
    return matrices;
  }

 private:
  void read_unsymmetric(Matrices& matrices) {
    const Location place = keys_.find("unsymmetric");
    if (place.node == nullptr) return;
    const Node::List* list = read_list(place, unsymmetric_wanted, faults_);
    if (list == nullptr) return;
    if (list->empty())
      faults_.add(place.pointer, std::string("found an empty list, must be ") + unsymmetric_wanted);
    for (std::size_t i = 0; i < list->size(); ++i) {
      const Location at{&(*list)[i], child(place.pointer, i)};
      const auto key = read_string(at, "\"stiffness\" or \"damping\"", faults_);
      if (!key) continue;
      const bool stiffness = *key == "stiffness";
      bool& flag = stiffness ? matrices.unsymmetric_stiffness : matrices.unsymmetric_damping;
      if (!stiffness && *key != "damping")
        faults_.add(at.pointer, "found " + shown(*key) + ", must be \"stiffness\" or \"damping\"");
      else if (flag)
        faults_.add(at.pointer, "found " + shown(*key) + " again, must be given once");
      else if (!stiffness && !keys_.has("damping"))
        faults_.add(at.pointer, "found \"damping\" without the key \"damping\", must be next to that matrix");
      else
        flag = true;
    }
  }

  void read_copies(Matrices& matrices) {
    const Location copies = keys_.find("copies"), factors = keys_.find("stiffness_factors");
    const auto count = read_integer(copies, 1, largest_copies, faults_);
    if (copies.node != nullptr && !count) return;
    matrices.copies = count.value_or(1);
    if (factors.node != nullptr)
      matrices.stiffness_factors =
          read_factors(factors, matrices.copies, above_0, "a factor of the stiffness for each copy", faults_)
              .value_or(std::vector<double>());
  }

  void read_reduction(Matrices& matrices) {
    const Location place = keys_.find("reduction");
    if (place.node == nullptr) return;
    std::vector<std::string> known;
    for (const Key& key : reduction_keys().keys()) known.push_back(key.name);
    const Keys own(place, known, faults_);
    if (!own.is_object()) return;
    const Reading from{own, reading_.frequency, no_parameters(), no_dofs_, faults_, reading_.source};
    matrices.reduction = reduction_keys().read(from).as<Reduction>();
    if (!keys_.has("highest_frequency"))
      faults_.add(place.pointer,
                  "found it without \"highest_frequency\", must be next to it: the highest frequency of a "
                  "harmonic to which the structure is reduced");
  }

  void read_errors(Matrices& matrices) {
    const Location place = keys_.find("errors");
    if (place.node == nullptr) return;
    const Node::List* list = read_list(place, "a list of frequencies and the errors up to them", faults_);
    for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
      const std::string pointer = child(place.pointer, i);
      const auto pair =
          read_factors({&(*list)[i], pointer}, 2, at_least_0, "a frequency and the error up to it", faults_);
      if (!pair) continue;
      const ErrorOfReduction error{pair->front(), pair->back()};
      if (error.frequency <= (matrices.errors.empty() ? 0 : matrices.errors.back().frequency))
        faults_.add(child(pointer, 0),
                    "found " + number_text(error.frequency) + ", must be above " +
                        number_text(matrices.errors.empty() ? 0 : matrices.errors.back().frequency) +
                        ", the frequency before it");
      else
        matrices.errors.push_back(error);
    }
  }

  void read_faces(Matrices& matrices) {
    const Location place = keys_.find("faces");
    if (place.node == nullptr) return;
    const auto file = read_file_of(place, "a string, the path of a CSV file of own,next", reading_);
    if (!file || !file->text) return;
    matrices.faces_file = *file;
    read_face_rows(place, *file, matrices, faults_);
  }

  MatrixFile read_matrix(const std::string& key, bool required, Form form = Form::symmetric) {
    const std::string wanted = "a string, the path of a Matrix Market or .mat file";
    const Location place = required ? keys_.require(key, wanted, faults_) : keys_.find(key);
    MatrixFile found = read_matrix_file(place, wanted, reading_);
    if (found.matrix) check(key, *found.matrix, place, form);
    return found;
  }

  // Of its form, and but for the parts that grow with the speed without a negative diagonal entry.
  void check(const std::string& key, const SparseMatrix& A, const Location& at, Form form) {
    const auto fault = [&](const std::string& what) {
      faults_.add(at.pointer, "found the " + key + " matrix with " + what);
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
      faults_.add(child(keys_.pointer(), key), "found the " + key + " matrix with " + without.reported() +
                                                   ", must have mass in both rows that it couples");
  }

  void check_size(const std::string& key, const MatrixFile& file, int size) {
    if (file.matrix && file.matrix->rows != size)
      faults_.add(child(keys_.pointer(), key), "found a matrix of " + std::to_string(file.matrix->rows) +
                                                   " rows, must have " + std::to_string(size) +
                                                   " as the stiffness matrix");
  }

  void check_factors(const Matrices& matrices) {
    double largest = 0;
    for (const double value : matrices.stiffness.matrix->values) largest = std::max(largest, std::abs(value));
    for (std::size_t i = 0; i < matrices.stiffness_factors.size(); ++i)
      if (const double factor = matrices.stiffness_factors[i]; !std::isfinite(factor * largest))
        faults_.add(
            child(child(keys_.pointer(), "stiffness_factors"), i),
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
      faults_.add(keys_.pointer(), "found neither mass nor stiffness in row " + empty.reported() +
                                       ", must have one of them on the diagonal in each row");
    if (!mass) faults_.add(child(keys_.pointer(), "mass"), "found no mass, must have some on its diagonal");
  }

  Keys keys_;
  Dofs no_dofs_;
  Reading reading_;
  Faults& faults_;
};

}  // namespace

std::string objection_of_dof(const std::string& name, const Dofs& dofs) {
  if (name.empty()) return "must be a name of at least one character";
  if (name == ground) return "which is reserved for the fixed frame; must be another name";
  if (dofs.index.contains(name)) return "which stands for another degree of freedom; each must stand once";
  return {};
}

std::optional<Matrices> read_matrices(const Keys& structure, FrequencyUnit unit, const FileSource& source,
                                      Dofs& dofs, Faults& faults) {
  const Location place = structure.find("matrices");
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
  if (first == "beam" || first == "rod") {
    const std::size_t before = faults.count();
    auto made = read_bar(structure.find(first), first == "beam", unit, source, dofs, faults);
    if (made) check_whole(structure.find(first).pointer, *made, faults);
    if (faults.count() > before) dofs.complete = false;
    return made;
  }
  if (place.node == nullptr) {
    if (const Location names = structure.find("names"); names.node != nullptr)
      faults.add(names.pointer, "found names of rows without \"matrices\", must be next to them");
    return {};
  }
  const std::size_t before = faults.count();
  const Field frequency = frequency_field(unit);
  auto matrices = Files(place, frequency, source, faults).read();
  const std::string wanted = "a string, the path of a CSV file of name,row";
  const Location names = structure.require("names", wanted, faults);
  const Keys& keys = structure;
  const Reading reading{keys, frequency, no_parameters(), dofs, faults, source};
  const auto file = read_file_of(names, wanted, reading);
  if (matrices && file && file->text) {
    matrices->names = *file;
    read_row_names(names, *file, *matrices, dofs, faults);
  }
  if (matrices && matrices->copies > 1 && structure.has("cyclic"))
    faults.add(child(place.pointer, "copies"),
               "found " + std::to_string(matrices->copies) +
                   " next to \"cyclic\", must be left out: one sector has one copy, and with \"full\": true "
                   "there are as many as sectors");
  if (matrices && matrices->copies == 1 && matrices->faces_file.text && !structure.has("cyclic"))
    faults.add(
        child(place.pointer, "faces"),
        "found the faces of a sector without \"cyclic\", must be next to it, or next to \"copies\" that "
        "make a ring");
  if (faults.count() > before) dofs.complete = false;
  return matrices;
}

}  // namespace arcslip::scene::file

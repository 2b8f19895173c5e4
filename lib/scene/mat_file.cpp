#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/mat_file.hpp>
#include <arcslip/scene/matrix_market.hpp>

#include <H5Dpublic.h>
#include <H5Epublic.h>
#include <H5Fpublic.h>
#include <H5Ppublic.h>
#include <H5Spublic.h>
#include <matio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace arcslip::scene {
namespace {

using file::listed;

constexpr std::size_t largest_full = (std::size_t{4} << 30) / 8;  // entries
constexpr std::size_t most_variables = 10'000;
constexpr std::size_t most_compressed = 1100;  // bytes of data in one of the file: zlib's limit is 1032
constexpr std::size_t header = 128;            // bytes before the first element of version 5
constexpr std::uint32_t matrix_element = 14, compressed_element = 15;

struct CloseFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using File = std::unique_ptr<mat_t, CloseFile>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

// HDF5 reports errors on standard error, unless told not to.
class QuietHdf5 {
 public:
  QuietHdf5() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;
  ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

bool is_version_5(std::string_view text) {
  return text.starts_with("MATLAB 5.0 MAT-file");
}
bool is_version_73(std::string_view text) {
  return text.starts_with("MATLAB 7.3 MAT-file");
}

std::string name_of(matio_classes type) {
  constexpr std::array<const char*, 18> names = {
      "an empty array", "a cell array", "a struct", "an object", "characters", "a sparse matrix",
      "doubles",        "singles",      "int8",     "uint8",     "int16",      "uint16",
      "int32",          "uint32",       "int64",    "uint64",    "a function", "an object"};
  const auto k = static_cast<std::size_t>(type);
  return k < names.size() ? names[k] : "an array of an unknown type";
}

class MatFileReader {
 public:
  MatFileReader(const std::string& path, std::string_view text, const std::string& name,
                const std::string& told, const StopRequest& stop)
      : path_(path), text_(text), name_(name), told_(told), stop_(stop) {}

  SparseMatrix read() {
    check_file();
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    const QuietHdf5 quiet;
    listen();
    const File file(Mat_Open(path_.c_str(), MAT_ACC_RDONLY));
    if (!file) fail("found no MATLAB file of version 5 or 7.3 that can be read; it may be damaged");
    const Variable variable = find(file.get());
    told_ += ", variable " + file::quoted(variable->name);
    check_type(*variable);
    if (is_version_73(text_) && variable->class_type == MAT_C_SPARSE) check_size(variable->name);
    listen();
    if (Mat_VarReadDataAll(file.get(), variable.get()) != 0 || variable->data == nullptr)
      fail("its data cannot be read; the file may be damaged");
    listen();
    return variable->class_type == MAT_C_SPARSE ? sparse(*variable) : full(*variable);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const { throw MatrixError(told_ + ": " + cause); }
  void listen() const {
    if (is_asked(stop_)) throw Interrupted("interrupted while " + told_ + " was read");
  }

  // matio takes whatever it does not know for a file of version 4, and reads short files as far as they go.
  void check_file() const {
    if (is_version_73(text_)) return;
    if (!is_version_5(text_))
      fail(
          "found no MATLAB file of version 5 or 7.3, must begin with \"MATLAB 5.0 MAT-file\" or \"MATLAB 7.3 "
          "MAT-file\"; in MATLAB, save it by save(..., \"-v7\") or save(..., \"-v7.3\")");
    if (text_.size() < header) fail("the file ends within its header of 128 bytes");
    const std::string_view order = text_.substr(126, 2);
    if (order != "IM" && order != "MI") fail("found a damaged header");
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      for (std::size_t k = 0; k < 4; ++k)
        value |= std::uint32_t{static_cast<unsigned char>(text_[at + k])} << 8 * (order == "IM" ? k : 3 - k);
      return value;
    };
    for (std::size_t at = header; at < text_.size();) {
      if (text_.size() - at < 8) fail("the file ends within a variable");
      const std::uint32_t type = word(at), bytes = word(at + 4);
      at += 8;
      if (type != matrix_element && type != compressed_element)
        fail("found an element of type " + std::to_string(type) + " at byte " + std::to_string(at - 8) +
             ", must be a variable: of type 14 or 15; the file may be damaged");
      if (bytes > text_.size() - at)
        fail("the file ends after " + std::to_string(text_.size() - at) + " of the " + std::to_string(bytes) +
             " bytes of a variable");
      at += bytes;
    }
  }

  // The variable by its name, or the only one.
  Variable find(mat_t* file) const {
    std::vector<std::string> names;
    Variable first;
    while (Variable next{Mat_VarReadNextInfo(file)}) {
      if (next->name == nullptr) continue;
      names.emplace_back(next->name);
      if (names.size() > most_variables)
        fail("found more than " + std::to_string(most_variables) + " variables");
      if (!name_.empty() && name_ == next->name) return next;
      if (name_.empty() && names.size() == 1) first = std::move(next);
    }
    if (names.empty()) fail("found no variable; the file may be damaged");
    std::sort(names.begin(), names.end());
    if (!name_.empty())
      fail("found no variable " + file::quoted(name_) + ", must be " + (names.size() > 1 ? "one of " : "") +
           listed(names) + file::hint(name_, names));
    if (names.size() > 1)
      fail("found the variables " + listed(names) +
           R"(, must be told which: {"file": ..., "variable": ...})");
    return first;
  }

  void check_type(const matvar_t& of) const {
    const std::string must = ", must be a real matrix of doubles, sparse or full";
    if (of.class_type != MAT_C_SPARSE && of.class_type != MAT_C_DOUBLE)
      fail("found " + name_of(of.class_type) + must);
    if (of.isComplex != 0) fail("found a complex matrix" + must);
    if (of.isLogical != 0) fail("found a logical matrix" + must);
    if (of.rank != 2 || of.dims == nullptr)
      fail("found an array of " + std::to_string(of.rank) + " dimensions" + must);
    if (std::max(of.dims[0], of.dims[1]) > largest_matrix_size)
      fail("found " + size(of) + ", must have at most " + std::to_string(largest_matrix_size) + " of each");
    if (of.class_type == MAT_C_DOUBLE && of.dims[1] > 0 && of.dims[0] > largest_full / of.dims[1])
      fail("found a full matrix with " + size(of) + ", must be sparse where it takes more than 4 GB");
    if (of.class_type == MAT_C_DOUBLE && of.dims[0] * of.dims[1] / most_compressed > text_.size() / 8)
      fail("found a full matrix with " + size(of) + " in a file of " + std::to_string(text_.size()) +
           " bytes; it may be damaged");
  }
  // matio takes the memory that the lengths in a file ask for, also where they are damaged.
  void check_size(const std::string& variable) const {
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    std::size_t longest = 0;
    for (const char* part : {"/ir", "/jc", "/data"}) {
      const hid_t data = H5Dopen2(file, (variable + part).c_str(), H5P_DEFAULT);
      if (data < 0) continue;  // an empty matrix has none
      const hid_t space = H5Dget_space(data);
      longest = std::max(longest, static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
      H5Sclose(space);
      H5Dclose(data);
    }
    H5Fclose(file);
    if (longest / most_compressed > text_.size() / 4)
      fail("found " + std::to_string(longest) + " entries in a file of " + std::to_string(text_.size()) +
           " bytes; it may be damaged");
  }
  static std::string size(const matvar_t& of) {
    return std::to_string(of.dims[0]) + " rows and " + std::to_string(of.dims[1]) + " columns";
  }

  double finite(double value, std::size_t row, std::size_t column) const {
    if (!std::isfinite(value))
      fail("found " + file::number_text(value) + " in row " + std::to_string(row + 1) + ", column " +
           std::to_string(column + 1) + ", must be a finite number");
    return value;
  }

  SparseMatrix full(const matvar_t& of) const {
    const std::size_t rows = of.dims[0], columns = of.dims[1];
    if (of.data_type != MAT_T_DOUBLE || of.nbytes < 8 * rows * columns)
      fail("its data cannot be read; the file may be damaged");
    SparseMatrix A{static_cast<int>(rows), static_cast<int>(columns), {0}, {}, {}};
    const auto* value = static_cast<const double*>(of.data);
    for (std::size_t j = 0; j < columns; ++j) {
      for (std::size_t i = 0; i < rows; ++i, ++value) {
        if (*value == 0) continue;
        A.row_of.push_back(static_cast<int>(i));
        A.values.push_back(finite(*value, i, j));
      }
      A.starts.push_back(static_cast<int>(A.values.size()));
    }
    return A;
  }

  SparseMatrix sparse(const matvar_t& of) const {
    const auto& from = *static_cast<const mat_sparse_t*>(of.data);
    const std::size_t rows = of.dims[0], columns = of.dims[1];
    const auto damaged = [&](const std::string& what) {
      fail("found " + what + "; the file may be damaged");
    };
    if (from.njc != columns + 1 || from.jc == nullptr || from.jc[0] != 0)
      damaged("no starts of its " + std::to_string(columns) + " columns");
    const std::size_t count = from.jc[columns];
    if (count > 0 && (from.ir == nullptr || from.data == nullptr || count > from.nir || count > from.ndata ||
                      of.data_type != MAT_T_DOUBLE || count > INT32_MAX))
      damaged("fewer entries than the " + std::to_string(count) + " that its columns have");
    SparseMatrix A{static_cast<int>(rows), static_cast<int>(columns), {0}, {}, {}};
    A.starts.reserve(columns + 1);
    A.row_of.reserve(count);
    A.values.reserve(count);
    const auto* values = static_cast<const double*>(from.data);
    bool sorted = true;
    for (std::size_t j = 0; j < columns; ++j) {
      if (from.jc[j + 1] < from.jc[j] || from.jc[j + 1] > count)
        damaged("that column " + std::to_string(j + 1) + " ends before it begins");
      for (std::size_t k = from.jc[j]; k < from.jc[j + 1]; ++k) {
        if (from.ir[k] >= rows)
          damaged("the row " + std::to_string(std::size_t{from.ir[k]} + 1) + " in column " +
                  std::to_string(j + 1) + ", where it has " + std::to_string(rows) + " rows");
        sorted = sorted && (k == from.jc[j] || from.ir[k - 1] < from.ir[k]);
        A.row_of.push_back(static_cast<int>(from.ir[k]));
        A.values.push_back(finite(values[k], from.ir[k], j));
      }
      A.starts.push_back(static_cast<int>(A.values.size()));
    }
    return sorted ? A : in_order(A);
  }

  // Each column by its rows.
  SparseMatrix in_order(const SparseMatrix& A) const {
    std::vector<MatrixEntry> entries;
    entries.reserve(A.values.size());
    std::vector<int> last(static_cast<std::size_t>(A.rows), -1);  // column of the last entry of each row
    for (int j = 0; j < A.columns; ++j)
      for (auto k = static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j)]);
           k < static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j) + 1]); ++k) {
        const int i = A.row_of[k];
        if (std::exchange(last[static_cast<std::size_t>(i)], j) == j)
          fail("found the entry in row " + std::to_string(i + 1) + ", column " + std::to_string(j + 1) +
               " twice");
        entries.push_back({i, j, A.values[k]});
      }
    return sparse_matrix(A.rows, A.columns, entries);
  }

  const std::string& path_;
  const std::string_view text_;
  const std::string& name_;
  std::string told_;
  const StopRequest& stop_;
};

}  // namespace

bool is_mat_file(std::string_view path, std::string_view text) {
  const std::string_view ending = path.substr(path.size() < 4 ? 0 : path.size() - 4);
  return ending == ".mat" || ending == ".MAT" || is_version_5(text) || is_version_73(text);
}

SparseMatrix read_mat_file(const std::string& path, std::string_view text, const std::string& variable,
                           const std::string& file, const StopRequest& stop) {
  return MatFileReader(path, text, variable, file, stop).read();
}

}  // namespace arcslip::scene

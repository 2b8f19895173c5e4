#include "read.hpp"
#include "answer.hpp"
#include "inside.hpp"

#include <arcslip/scene/files/mat_protocol.hpp>

#include <matio.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace arcslip::mat {
namespace {

namespace protocol = scene::mat_protocol;

constexpr std::size_t largest_full = (std::size_t{4} << 30) / 8;  // entries
constexpr std::size_t at_once = 1 << 14;                          // numbers that are written

struct CloseFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using File = std::unique_ptr<mat_t, CloseFile>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

// The number of the version is in bytes 124 and 125, in the order that the next two tell.
bool is_version_73(const char* path) {
  std::array<char, 128> header{};
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path, "rb"), std::fclose);
  if (!file || std::fread(header.data(), 1, header.size(), file.get()) != header.size()) return false;
  return header[header[126] == 'I' ? 125 : 124] == 2;
}

std::string name_of(matio_classes type) {
  constexpr std::array<const char*, 18> names = {
      "an empty array", "a cell array", "a struct", "an object", "characters", "a sparse matrix",
      "doubles",        "singles",      "int8",     "uint8",     "int16",      "uint16",
      "int32",          "uint32",       "int64",    "uint64",    "a function", "an object"};
  const auto k = static_cast<std::size_t>(type);
  return k < names.size() ? names[k] : "an array of an unknown type";
}

class Reader {
 public:
  Reader(const char* path, std::size_t bytes, const std::string& name)
      : path_(path), bytes_(bytes), name_(name) {}

  void read() {
    std::map<std::string, std::size_t> longest;
    if (is_version_73(path_)) longest = look_through(path_);
    const File file(Mat_Open(path_, MAT_ACC_RDONLY));
    if (!file) fail("found no MATLAB file of version 5 or 7.3 that can be read; it may be damaged");
    const Variable variable = find(file.get());
    if (!variable) return;
    reported_ = variable->name;
    check_type(*variable);
    if (const auto known = longest.find(reported_);
        known != longest.end() && variable->class_type == MAT_C_SPARSE)
      check_entries(known->second);
    if (Mat_VarReadDataAll(file.get(), variable.get()) != 0 || variable->data == nullptr)
      fail("its data cannot be read; the file may be damaged");
    if (variable->class_type == MAT_C_SPARSE)
      write_sparse(*variable);
    else
      write_full(*variable);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const { throw Fault(cause, reported_); }
  [[noreturn]] void tell_damage(const std::string& what) const {
    fail("found " + what + "; the file may be damaged");
  }

  // The variable by its name, or the only one. Null: the names are written.
  Variable find(mat_t* file) const {
    std::vector<std::string> names;
    Variable first;
    while (Variable next{Mat_VarReadNextInfo(file)}) {
      if (next->name == nullptr) continue;
      names.emplace_back(next->name);
      if (names.size() > protocol::most_variables)
        fail("found more than " + std::to_string(protocol::most_variables) + " variables");
      if (!name_.empty() && name_ == next->name) return next;
      if (name_.empty() && names.size() == 1) first = std::move(next);
    }
    if (name_.empty() && names.size() == 1) return first;
    write_variables(names);
    return {};
  }

  void check_type(const matvar_t& of) const {
    const std::string must = ", must be a real matrix of doubles, sparse or full";
    if (of.class_type != MAT_C_SPARSE && of.class_type != MAT_C_DOUBLE)
      fail("found " + name_of(of.class_type) + must);
    if (of.isComplex != 0) fail("found a complex matrix" + must);
    if (of.isLogical != 0) fail("found a logical matrix" + must);
    if (of.rank != 2 || of.dims == nullptr)
      fail("found an array of " + std::to_string(of.rank) + " dimensions" + must);
    const std::size_t rows = of.dims[0], columns = of.dims[1];
    const std::string size = std::to_string(rows) + " rows and " + std::to_string(columns) + " columns";
    const std::string in_file =
        size + " in a file of " + std::to_string(bytes_) + " bytes; it may be damaged";
    if (std::max(rows, columns) > scene::largest_matrix_size)
      fail("found " + size + ", must have at most " + std::to_string(scene::largest_matrix_size) +
           " of each");
    if (of.class_type == MAT_C_DOUBLE && columns > 0 && rows > largest_full / columns)
      fail("found a full matrix with " + size + ", must be sparse where it takes more than 4 GB");
    if (of.class_type == MAT_C_DOUBLE && rows * columns / protocol::most_compressed > bytes_ / 8)
      fail("found a full matrix with " + in_file);
    if (!protocol::has_size(bytes_, rows, columns)) fail("found " + in_file);
  }

  // matio takes the memory that the lengths in a file ask for, also where they are damaged.
  void check_entries(std::size_t count) const {
    if (!protocol::has_entries(bytes_, count))
      fail("found " + std::to_string(count) + " entries in a file of " + std::to_string(bytes_) +
           " bytes; it may be damaged");
  }

  void write_sparse(const matvar_t& of) const {
    const auto& from = *static_cast<const mat_sparse_t*>(of.data);
    const std::size_t columns = of.dims[1];
    if (from.njc != columns + 1 || from.jc == nullptr || from.jc[0] != 0)
      tell_damage("no starts of its " + std::to_string(columns) + " columns");
    const std::size_t count = from.jc[columns];
    if (count > 0 && (from.ir == nullptr || from.data == nullptr || count > from.nir || count > from.ndata ||
                      of.data_type != MAT_T_DOUBLE))
      tell_damage("fewer entries than the " + std::to_string(count) + " that its columns have");
    check_entries(count);
    write_matrix(reported_, {of.dims[0], columns, count});
    write(std::span<const std::uint32_t>(from.jc, columns + 1));
    write(std::span<const std::uint32_t>(from.ir, count));
    write(std::span(static_cast<const double*>(from.data), count));
  }

  // Column by column, without zeros.
  void write_full(const matvar_t& of) const {
    const std::size_t rows = of.dims[0], columns = of.dims[1];
    if (of.data_type != MAT_T_DOUBLE || of.nbytes < 8 * rows * columns)
      fail("its data cannot be read; the file may be damaged");
    const std::span all(static_cast<const double*>(of.data), rows * columns);
    const auto is_entry = [](double value) { return value != 0; };
    const auto count = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_entry));
    check_entries(count);
    write_matrix(reported_, {rows, columns, count});
    std::uint32_t start = 0;
    write_each<std::uint32_t>(columns + 1, [&](std::size_t j, auto& to) {
      if (j > 0) {
        const auto column = all.subspan((j - 1) * rows, rows);
        start += static_cast<std::uint32_t>(std::count_if(column.begin(), column.end(), is_entry));
      }
      to.push_back(start);
    });
    write_each<std::uint32_t>(all.size(), [&](std::size_t k, auto& to) {
      if (is_entry(all[k])) to.push_back(static_cast<std::uint32_t>(k % rows));
    });
    write_each<double>(all.size(), [&](std::size_t k, auto& to) {
      if (is_entry(all[k])) to.push_back(all[k]);
    });
  }

  template <class T, class F>
  static void write_each(std::size_t count, const F& append) {
    std::vector<T> some;
    for (std::size_t k = 0; k < count; ++k) {
      append(k, some);
      if (some.size() < at_once && k + 1 < count) continue;
      write(std::span<const T>(some));
      some.clear();
    }
  }

  const char* path_;
  std::size_t bytes_;
  const std::string& name_;
  std::string reported_;
};

}  // namespace

void read(const char* path, std::size_t bytes, const std::string& variable) {
  Reader(path, bytes, variable).read();
}

}  // namespace arcslip::mat

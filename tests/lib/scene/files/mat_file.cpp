// MATLAB files, written by matio: next to the same matrix in Matrix Market format, damaged, and mutated.
#include "catch.hpp"
#include "contains.hpp"
#include "controls.hpp"

#include "lib/scene/files/mat_mutants.hpp"
#include "lib/scene/folder.hpp"

#include <arcslip/scene/files/mat_file.hpp>
#include <arcslip/scene/files/matrix_market.hpp>

#include <matio.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

using namespace arcslip;

namespace {

enum class Kind { v5, v5_compressed, v73, v73_compressed };

// A .mat file in the making; each function adds a variable.
class MatFile {
 public:
  MatFile(const std::string& path, Kind kind)
      : file_(Mat_CreateVer(path.c_str(), nullptr,
                            kind == Kind::v73 || kind == Kind::v73_compressed ? MAT_FT_MAT73 : MAT_FT_MAT5)),
        compression_(kind == Kind::v5_compressed || kind == Kind::v73_compressed ? MAT_COMPRESSION_ZLIB
                                                                                 : MAT_COMPRESSION_NONE) {
    REQUIRE(file_ != nullptr);
  }
  MatFile(const MatFile&) = delete;
  MatFile& operator=(const MatFile&) = delete;
  ~MatFile() { Mat_Close(file_); }

  void sparse(const char* name, std::size_t rows, std::vector<mat_uint32_t> ir, std::vector<mat_uint32_t> jc,
              std::vector<double> values) {
    mat_sparse_t data{};
    data.nzmax = data.nir = data.ndata = static_cast<mat_uint32_t>(values.size());
    data.njc = static_cast<mat_uint32_t>(jc.size());
    data.ir = ir.data();
    data.jc = jc.data();
    data.data = values.data();
    std::size_t dims[2] = {rows, jc.size() - 1};
    add(Mat_VarCreate(name, MAT_C_SPARSE, MAT_T_DOUBLE, 2, dims, &data, MAT_F_DONT_COPY_DATA));
  }
  void full(const char* name, std::vector<std::size_t> dims, std::vector<double> values) {
    add(Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, static_cast<int>(dims.size()), dims.data(),
                      values.data(), 0));
  }
  void complex(const char* name) {
    double re[4] = {1, 0, 0, 1}, im[4] = {0, 1, 1, 0};
    mat_complex_split_t data{re, im};
    std::size_t dims[2] = {2, 2};
    add(Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, &data, MAT_F_COMPLEX));
  }
  void integers(const char* name) {
    mat_int32_t data[4] = {1, 0, 0, 1};
    std::size_t dims[2] = {2, 2};
    add(Mat_VarCreate(name, MAT_C_INT32, MAT_T_INT32, 2, dims, data, 0));
  }
  void singles(const char* name) {
    float data[4] = {1, 0, 0, 1};
    std::size_t dims[2] = {2, 2};
    add(Mat_VarCreate(name, MAT_C_SINGLE, MAT_T_SINGLE, 2, dims, data, 0));
  }
  void logical(const char* name) {
    mat_uint8_t data[4] = {1, 0, 0, 1};
    std::size_t dims[2] = {2, 2};
    add(Mat_VarCreate(name, MAT_C_UINT8, MAT_T_UINT8, 2, dims, data, MAT_F_LOGICAL));
  }
  void text(const char* name) {
    char data[] = "kg";
    std::size_t dims[2] = {1, 2};
    add(Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF8, 2, dims, data, 0));
  }
  void structure(const char* name) {
    const char* fields[1] = {"a"};
    std::size_t dims[2] = {1, 1};
    add(Mat_VarCreateStruct(name, 2, dims, fields, 1));
  }
  void cell(const char* name) {
    std::size_t dims[2] = {1, 1};
    matvar_t* inside[1] = {nullptr};
    double one = 1;
    inside[0] = Mat_VarCreate("", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, &one, 0);
    add(Mat_VarCreate(name, MAT_C_CELL, MAT_T_CELL, 2, dims, inside, 0));
  }

 private:
  void add(matvar_t* variable) {
    REQUIRE(variable != nullptr);
    const int failed = Mat_VarWrite(file_, variable, compression_);
    Mat_VarFree(variable);
    REQUIRE(failed == 0);
  }

  mat_t* file_;
  matio_compression compression_;
};

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

scene::SparseMatrix read(const std::string& path, const std::string& variable = "") {
  return scene::read_mat_file(path, text_of(path), variable, "\"A.mat\"");
}

std::string fault(const std::string& path, const std::string& variable = "") {
  try {
    read(path, variable);
  } catch (const scene::MatrixError& error) {
    return error.what();
  }
  return "none";
}

// A stiffness matrix of a chain with rounding in its entries.
constexpr const char* market =
    "%%MatrixMarket matrix coordinate real general\n4 4 10\n1 1 0.1\n2 1 -0.30000000000000004\n"
    "1 2 -0.30000000000000004\n2 2 1e-300\n3 2 -7\n2 3 -7\n3 3 123456789.12345679\n4 3 1\n3 4 1\n4 4 2\n";
const std::vector<mat_uint32_t> ir{0, 1, 0, 1, 2, 1, 2, 3, 2, 3}, jc{0, 2, 5, 8, 10};
const std::vector<double> values{
    0.1, -0.30000000000000004, -0.30000000000000004, 1e-300, -7, -7, 123456789.12345679, 1, 1, 2};

void check_same(const scene::SparseMatrix& a, const scene::SparseMatrix& b) {
  CHECK(a.rows == b.rows);
  CHECK(a.columns == b.columns);
  CHECK(a.starts == b.starts);
  CHECK(a.row_of == b.row_of);
  CHECK(a.values == b.values);
}

}  // namespace

TEST_CASE("a matrix from a MATLAB file is that of the Matrix Market file, to the last bit") {
  const Kind kind = GENERATE(Kind::v5, Kind::v5_compressed, Kind::v73, Kind::v73_compressed);
  const Folder folder;
  const std::string path = folder / "A.mat";
  {
    MatFile file(path, kind);
    file.sparse("K", 4, ir, jc, values);
    std::vector<double> full(16, 0.0);
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = jc[j]; k < jc[j + 1]; ++k) full[4 * j + ir[k]] = values[k];
    file.full("full", {4, 4}, full);
    // The rows of the second column in another order.
    file.sparse("unsorted", 4, {0, 1, 2, 0, 1, 1, 2, 3, 2, 3}, jc,
                {values[0], values[1], values[4], values[2], values[3], values[5], values[6], values[7],
                 values[8], values[9]});
    file.text("unit");
  }
  const scene::SparseMatrix wanted = scene::read_matrix_market(market, "A.mtx");
  CHECK(scene::is_mat_file("A.mat", ""));
  CHECK(scene::is_mat_file("A", text_of(path)));
  CHECK_FALSE(scene::is_mat_file("A.mtx", market));
  check_same(read(path, "K"), wanted);
  check_same(read(path, "full"), wanted);
  check_same(read(path, "unsorted"), wanted);
  CHECK(fault(path) ==
        "\"A.mat\": found the variables \"K\", \"full\", \"unit\", \"unsorted\", must say which: "
        "{\"file\": ..., "
        "\"variable\": ...}");
  CHECK(
      fault(path, "ful") ==
      "\"A.mat\": found no variable \"ful\", must be one of \"K\", \"full\", \"unit\", \"unsorted\"; did you "
      "mean \"full\"?");
}

TEST_CASE("the only variable of a MATLAB file needs no name") {
  const Kind kind = GENERATE(Kind::v5, Kind::v73);
  const Folder folder;
  const std::string path = folder / "A.mat";
  MatFile(path, kind).sparse("K", 4, ir, jc, values);
  check_same(read(path), scene::read_matrix_market(market, "A.mtx"));
  CHECK(fault(path, "M") == "\"A.mat\": found no variable \"M\", must be \"K\"");
}

TEST_CASE("variables of a MATLAB file that are no real matrix of doubles are reported") {
  const Kind kind = GENERATE(Kind::v5, Kind::v5_compressed, Kind::v73);
  const Folder folder;
  const std::string path = folder / "A.mat", must = ", must be a real matrix of doubles, sparse or full";
  const auto of = [&](const std::function<void(MatFile&)>& add) {
    {
      MatFile file(path, kind);
      add(file);
    }
    return fault(path, "A");
  };
  const std::string at = "\"A.mat\", variable \"A\": ";
  CHECK(of([](MatFile& file) { file.complex("A"); }) == at + "found a complex matrix" + must);
  CHECK(of([](MatFile& file) { file.integers("A"); }) == at + "found int32" + must);
  CHECK(of([](MatFile& file) { file.singles("A"); }) == at + "found singles" + must);
  CHECK(contains(of([](MatFile& file) { file.logical("A"); }), must));
  CHECK(of([](MatFile& file) { file.text("A"); }) == at + "found characters" + must);
  CHECK(of([](MatFile& file) { file.structure("A"); }) == at + "found a struct" + must);
  CHECK(of([](MatFile& file) { file.cell("A"); }) == at + "found a cell array" + must);
  CHECK(of([](MatFile& file) { file.full("A", {2, 2, 2}, std::vector<double>(8, 1.0)); }) ==
        at + "found an array of 3 dimensions" + must);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(contains(of([&](MatFile& file) { file.full("A", {2, 2}, {1, 0, nan, 1}); }),
                 "nan in row 1, column 2, must be a finite number"));
  CHECK(contains(of([&](MatFile& file) { file.sparse("A", 2, {0, 1}, {0, 1, 2}, {1, -HUGE_VAL}); }),
                 "-inf in row 2, column 2, must be a finite number"));
  CHECK(of([](MatFile& file) { file.sparse("A", 2, {0, 0, 1}, {0, 2, 3}, {1, 1, 1}); }) ==
        at + "found the entry in row 1, column 1 twice");
  CHECK(contains(of([](MatFile& file) { file.sparse("A", 2, {0, 5}, {0, 1, 2}, {1, 1}); }),
                 "found the row 6 in column 2, where it has 2 rows; the file may be damaged"));
  CHECK(contains(of([](MatFile& file) { file.sparse("A", 200'000'000, {0, 1}, {0, 1, 2}, {1, 1}); }),
                 "found 200000000 rows and 2 columns, must have at most 100000000 of each"));
}

TEST_CASE("files that are no MATLAB file of version 5 or 7.3 are reported") {
  const Folder folder;
  const std::string path = folder / "A.mat";
  const auto of = [&](const std::string& text) {
    folder.write("A.mat", text);
    return fault(path);
  };
  CHECK(contains(of("hello"), "found no MATLAB file of version 5 or 7.3, must begin with"));
  CHECK(contains(of(""), "found no MATLAB file of version 5 or 7.3"));
  CHECK(contains(of("MATLAB 5.0 MAT-file"), "the file ends within its header of 128 bytes"));
  CHECK(contains(of("MATLAB 5.0 MAT-file" + std::string(109, ' ')), "found a damaged header"));
  CHECK(contains(of("MATLAB 7.3 MAT-file" + std::string(1000, ' ')), "that can be read; it may be damaged"));
  MatFile(path, Kind::v5);  // without a variable
  CHECK(contains(fault(path), "found no variable"));
}

TEST_CASE("a MATLAB file that is cut off anywhere is reported, and never read in part") {
  const Kind kind = GENERATE(Kind::v5, Kind::v5_compressed, Kind::v73);
  const Folder folder;
  MatFile(folder / "whole.mat", kind).sparse("K", 4, ir, jc, values);
  const std::string whole = text_of(folder / "whole.mat");
  REQUIRE(whole.size() > 200);
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 100) {
    folder.write("A.mat", whole.substr(0, length));
    CAPTURE(length, whole.size());
    CHECK(fault(folder / "A.mat") != "none");
  }
  if (kind == Kind::v5) {
    folder.write("A.mat", whole.substr(0, whole.size() - 8));
    CHECK(contains(fault(folder / "A.mat"), "bytes of a variable"));
    folder.write("A.mat", whole + "1234");
    CHECK(contains(fault(folder / "A.mat"), "the file ends within a variable"));
    folder.write("A.mat", whole + "12345678");
    CHECK(contains(fault(folder / "A.mat"), "must be a variable: of type 14 or 15"));
  }
}

TEST_CASE("mutated MATLAB files are read or refused") {
  const Kind kind = GENERATE(Kind::v5, Kind::v5_compressed, Kind::v73, Kind::v73_compressed);
  const Folder folder;
  {
    MatFile file(folder / "whole.mat", kind);
    file.sparse("K", 4, ir, jc, values);
    const std::size_t size = kind == Kind::v73_compressed ? 60 : 2;
    std::vector<double> unit(size * size, 0.0);
    for (std::size_t k = 0; k < size; ++k) unit[k * (size + 1)] = 1;
    file.full("M", {size, size}, unit);
  }
  const std::string whole = text_of(folder / "whole.mat");
  std::minstd_rand random(static_cast<unsigned>(kind) + 1);
  const std::uint64_t mutants = mat_mutants.count();
  std::uint64_t read_well = 0, refused = 0;
  for (std::uint64_t k = 0; k < mutants; ++k) {
    std::string mutant = whole;
    for (auto n = 1 + random() % 3; n > 0; --n) {
      char& byte = mutant[random() % mutant.size()];
      byte = k % 3 == 0   ? static_cast<char>(0xff)
             : k % 3 == 1 ? static_cast<char>(byte ^ (1 << random() % 8))
                          : static_cast<char>(random());
    }
    folder.write("A.mat", mutant);
    for (const char* variable : {"K", "M"}) {
      try {
        const scene::SparseMatrix A = read(folder / "A.mat", variable);
        REQUIRE(A.starts.size() == static_cast<std::size_t>(A.columns) + 1);
        REQUIRE(std::all_of(A.values.begin(), A.values.end(), [](double v) { return std::isfinite(v); }));
        REQUIRE(std::all_of(A.row_of.begin(), A.row_of.end(), [&](int i) { return i >= 0 && i < A.rows; }));
        ++read_well;
      } catch (const scene::MatrixError&) {
        ++refused;
      }
    }
  }
  CHECK(read_well > 0);
  CHECK(refused > 0);
}

TEST_CASE("reading a MATLAB file can be stopped") {
  const Folder folder;
  MatFile(folder / "A.mat", Kind::v5).sparse("K", 4, ir, jc, values);
  CHECK_THROWS_AS(
      scene::read_mat_file(folder / "A.mat", text_of(folder / "A.mat"), "", "\"A.mat\"", controls::stopped()),
      control::Interrupted);
}

TEST_CASE("several threads read MATLAB files at the same time") {
  const Folder folder;
  const std::string path = folder / "A.mat";
  MatFile(path, Kind::v73).sparse("K", 4, ir, jc, values);
  const std::string text = text_of(path);
  std::atomic<int> well = 0;
  std::vector<std::thread> threads;
  for (int k = 0; k < 8; ++k)
    threads.emplace_back([&] {
      for (int n = 0; n < 5; ++n) {
        const scene::SparseMatrix A = scene::read_mat_file(path, text, n % 2 == 0 ? "K" : "", "\"A.mat\"");
        if (A.starts == std::vector<int>(jc.begin(), jc.end()) && A.values == ::values) ++well;
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(well == 40);
}

TEST_CASE("a full matrix is read whatever its shape, and an empty one") {
  const Kind kind = GENERATE(Kind::v5, Kind::v5_compressed, Kind::v73);
  const Folder folder;
  const std::string path = folder / "A.mat";
  std::vector<double> vector(50'001);
  for (std::size_t k = 0; k < vector.size(); ++k) vector[k] = k % 3 == 0 ? 0 : 0.1 * static_cast<double>(k);
  {
    MatFile file(path, kind);
    file.full("column", {vector.size(), 1}, vector);
    file.full("row", {1, vector.size()}, vector);
    file.full("zeros", {300, 200}, std::vector<double>(60'000, 0.0));
    file.sparse("empty", 3, {}, {0, 0, 0}, {});
  }
  const scene::SparseMatrix column = read(path, "column"), row = read(path, "row");
  CHECK(column.rows == 50'001);
  CHECK(column.starts == std::vector<int>{0, 33'334});
  CHECK(row.columns == 50'001);
  CHECK(row.starts.back() == 33'334);
  CHECK(row.values == column.values);
  for (std::size_t k = 0; k < column.values.size(); k += 1000)
    CHECK(column.values[k] == vector[static_cast<std::size_t>(column.row_of[k])]);
  CHECK(read(path, "zeros").entries() == 0);
  CHECK(read(path, "zeros").columns == 200);
  CHECK(read(path, "empty").entries() == 0);
  CHECK(read(path, "empty").rows == 3);
}

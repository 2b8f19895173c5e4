// MATLAB files that somebody made to do harm: they lead out of themselves, say that they hold far more than
// they do, or are damaged where HDF5 does not look.
#include "catch.hpp"
#include "contains.hpp"
#include "environment.hpp"

#include "lib/scene/files/mat_bytes.hpp"
#include "lib/scene/folder.hpp"

#include <arcslip/scene/files/mat_file.hpp>
#include <arcslip/scene/files/matrix_market.hpp>

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/stat.h>

using namespace arcslip;

namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string fault_in(const std::string& path, const std::string& variable = "K") {
  try {
    scene::read_mat_file(path, bytes_of(path), variable, "\"A.mat\"");
  } catch (const scene::MatrixError& error) {
    return error.what();
  }
  return "none";
}

// A variable of 4 rows and columns: its identifier, to be closed. creation: where and how its data are kept.
hid_t variable(hid_t in, const char* name, hid_t creation = H5P_DEFAULT) {
  const std::array<hsize_t, 2> size{4, 4};
  const hid_t space = H5Screate_simple(2, size.data(), nullptr);
  const hid_t data = H5Dcreate2(in, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  const hid_t scalar = H5Screate(H5S_SCALAR), text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, 6);
  const hid_t type = H5Acreate2(data, "MATLAB_class", text, scalar, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(type, text, "double");
  H5Aclose(type);
  H5Tclose(text);
  H5Sclose(scalar);
  H5Sclose(space);
  return data;
}

void write_identity(hid_t data) {
  std::array<double, 16> all{};
  for (std::size_t i = 0; i < 4; ++i) all[5 * i] = 1;
  H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data());
}

// A file of version 7.3 with the variable M, and what `add` adds.
void write_v73(const std::string& path, const std::function<void(hid_t)>& add) {
  const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_userblock(creation, 512);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
  REQUIRE(file >= 0);
  const hid_t mass = variable(file, "M");
  write_identity(mass);
  H5Dclose(mass);
  add(file);
  H5Pclose(creation);
  H5Fclose(file);
  const std::string header = mat_bytes::header("MATLAB 7.3 MAT-file", 2);
  std::fstream(path, std::ios::binary | std::ios::in | std::ios::out).write(header.data(), 128);
}

// The greatest memory of a child, in MB, and the processor time of all, in s.
double megabytes() {
  rusage used{};
  ::getrusage(RUSAGE_CHILDREN, &used);
  return static_cast<double>(used.ru_maxrss) / 1000;
}
double seconds() {
  rusage used{};
  ::getrusage(RUSAGE_CHILDREN, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
}

}  // namespace

TEST_CASE("a MATLAB file whose data are in another file is refused") {
  const Folder folder({{"outside.txt", std::string(128, 'A')}});
  const std::string path = folder / "A.mat";
  const std::string storage = GENERATE("outside.txt", "absolute", "fifo");
  const std::string outside = storage == "absolute" ? folder / "outside.txt" : storage;
  REQUIRE(::mkfifo((folder / "fifo").c_str(), 0600) == 0);  // which nobody writes to
  write_v73(path, [&](hid_t file) {
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(creation, outside.c_str(), 0, 128);
    H5Dclose(variable(file, "K", creation));
    H5Pclose(creation);
  });
  const std::string reported =
      "\"A.mat\", variable \"K\": found data that are in another file, must hold its data itself";
  CHECK(fault_in(path) == reported);
  CHECK(fault_in(path, "M") == reported);  // whichever is asked for
}

TEST_CASE("a MATLAB file with a link to another file is refused, which is not opened") {
  const Folder folder;
  const std::string path = folder / "A.mat";
  const bool is_fifo = GENERATE(true, false);
  if (is_fifo) REQUIRE(::mkfifo((folder / "other").c_str(), 0600) == 0);
  if (!is_fifo) write_v73(folder / "other", [](hid_t file) { H5Dclose(variable(file, "K")); });
  const std::string reported = ": found a link to another file, must hold its data itself";
  write_v73(path, [&](hid_t file) { H5Lcreate_external("other", "K", file, "K", H5P_DEFAULT, H5P_DEFAULT); });
  CHECK(fault_in(path) == "\"A.mat\", variable \"K\"" + reported);
  CHECK(fault_in(path, "M") == "\"A.mat\", variable \"K\"" + reported);
  // Below a group, and by a link of the file itself.
  write_v73(path, [&](hid_t file) {
    const hid_t group = H5Gcreate2(file, "S", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_external("other", "K", group, "ir", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/S/ir", file, "K", H5P_DEFAULT, H5P_DEFAULT);
    H5Gclose(group);
  });
  CHECK(fault_in(path) == "\"A.mat\", variable \"S\"" + reported);
}

TEST_CASE("a MATLAB file that hides a link to another file opens none") {
  const Folder folder;
  const std::string path = folder / "A.mat";
  REQUIRE(::mkfifo((folder / "fifo").c_str(), 0600) == 0);
  write_v73(path, [&](hid_t file) {
    const hid_t group = H5Gcreate2(file, "#refs#", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_external("fifo", "K", group, "a", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/#refs#/a", file, "K", H5P_DEFAULT, H5P_DEFAULT);
    H5Gclose(group);
  });
  CHECK(contains(fault_in(path), "found"));  // where the FIFO is opened, there is no end
  CHECK(fault_in(path, "M") == "none");
}

TEST_CASE("a MATLAB file of a virtual dataset, or of a filter that a plugin brings, is refused") {
  const Folder folder;
  const std::string path = folder / "A.mat";
  write_v73(path, [&](hid_t file) {
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const std::array<hsize_t, 2> size{4, 4};
    const hid_t space = H5Screate_simple(2, size.data(), nullptr);
    H5Pset_virtual(creation, space, "other", "K", space);
    H5Dclose(variable(file, "K", creation));
    H5Sclose(space);
    H5Pclose(creation);
  });
  CHECK(contains(fault_in(path), "variable \"K\": found data that are in another file"));
  write_v73(path, [&](hid_t file) {
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const std::array<hsize_t, 2> chunk{4, 4};
    H5Pset_chunk(creation, 2, chunk.data());
    H5Pset_filter(creation, 32000, H5Z_FLAG_OPTIONAL, 0, nullptr);
    H5Dclose(variable(file, "K", creation));
    H5Pclose(creation);
  });
  CHECK(contains(fault_in(path),
                 "variable \"K\": found data of the HDF5 filter 32000, must have none but deflate"));
}

TEST_CASE("links and compression within a MATLAB file are followed") {
  const Folder folder;
  const std::string path = folder / "A.mat";
  write_v73(path, [&](hid_t file) {
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const std::array<hsize_t, 2> chunk{2, 2};
    H5Pset_chunk(creation, 2, chunk.data());
    H5Pset_shuffle(creation);
    H5Pset_deflate(creation, 9);
    H5Pset_fletcher32(creation);
    const hid_t data = variable(file, "L", creation);
    write_identity(data);
    H5Dclose(data);
    H5Pclose(creation);
    H5Lcreate_hard(file, "L", file, "K", H5P_DEFAULT, H5P_DEFAULT);
  });
  const scene::SparseMatrix K = scene::read_mat_file(path, bytes_of(path), "K", "\"A.mat\"");
  CHECK(K.row_of == std::vector<int>{0, 1, 2, 3});
  CHECK(K.values == std::vector<double>(4, 1.0));
}

TEST_CASE("sizes beyond what a short MATLAB file can hold take no memory and no time") {
  const Folder folder;
  const std::string path = folder / "A.mat";
  const double before = seconds();
  const auto of = [&](const std::string& text) {
    folder.write("A.mat", text);
    REQUIRE(text.size() < 1000);
    return fault_in(path);
  };
  const auto both = [&](const std::string& body, std::uint32_t reported, const std::string& wanted) {
    CAPTURE(wanted);
    CHECK(contains(of(mat_bytes::header() + mat_bytes::packed(mat_bytes::element(14, body, reported))),
                   wanted));
    CHECK(contains(of(mat_bytes::header() + mat_bytes::element(14, body)), wanted));
  };
  const std::string one_row = mat_bytes::element(5, mat_bytes::bytes_of<std::int32_t>({0}));
  const std::string may = "the file may be damaged";
  for (const std::uint32_t reported : {2'000'000'000u, 0xfffffff8u, 500'000'000u}) {
    CAPTURE(reported);
    const std::string rows = mat_bytes::description(5, 1, 4, 4, "K") +
                             mat_bytes::element(5, mat_bytes::bytes_of<std::int32_t>({0}), reported);
    both(rows, reported, may);
    const std::string starts =
        mat_bytes::description(5, 1, 4, 4, "K") + one_row +
        mat_bytes::element(5, mat_bytes::bytes_of<std::int32_t>({0, 1, 1, 1, 1}), reported);
    both(starts, reported, may);
    const std::string values = mat_bytes::description(5, 1, 4, 4, "K") + one_row +
                               mat_bytes::element(5, mat_bytes::bytes_of<std::int32_t>({0, 1, 1, 1, 1})) +
                               mat_bytes::element(9, mat_bytes::bytes_of<double>({1}), reported);
    both(values, reported, may);
    both(mat_bytes::description(5, 1, 4, 4, "K").substr(0, 32) + mat_bytes::element(1, "K", reported),
         reported, "found");
  }
  both(mat_bytes::description(5, 1, 4, 90'000'000, "K") + one_row, 1000,
       "found 4 rows and 90000000 columns in a file of");
  both(mat_bytes::description(5, 1, 90'000'000, 4, "K") + one_row, 1000,
       "found 90000000 rows and 4 columns in a file of");
  both(mat_bytes::description(6, 0, 20'000, 20'000, "K"), 1000,
       "found a full matrix with 20000 rows and 20000 columns in a file of");
  both(mat_bytes::description(6, 0, 0, 90'000'000, "K"), 1000,
       "found 0 rows and 90000000 columns in a file of");
  // A file that says it is of the other version.
  const std::string one = mat_bytes::full("K", 1, 1, {2});
  CHECK(of(mat_bytes::header("MATLAB 7.3 MAT-file", 1) + one) ==
        "\"A.mat\": found no MATLAB file of version 5 or 7.3 that can be read; it may be damaged");
  CHECK(of(mat_bytes::header("MATLAB 5.0 MAT-file", 2) + one) == "\"A.mat\": found a damaged header");
  CHECK(megabytes() < (ARCSLIP_SANITIZED ? 1000 : 200));  // there, what is freed is kept for a while
  CHECK(seconds() - before < 20);
}

TEST_CASE("a MATLAB file that is damaged where HDF5 does not look ends no program but that which reads it") {
  for (const std::string name : {"damaged_accumulator.mat", "damaged_chunk.mat"}) {
    CAPTURE(name);
    CHECK(contains(fault_in(source_folder() + "/tests/lib/scene/files/" + name), "may be damaged"));
  }
}

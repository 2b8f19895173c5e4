#include "catch.hpp"
#include "controls.hpp"

#include <arcslip/scene/files/matrix_market.hpp>

#include <Eigen/Core>

#include <string>

using namespace arcslip;

namespace {

Eigen::MatrixXd dense_matrix(const std::string& text) {
  const scene::SparseMatrix A = scene::read_matrix_market(text, "K.mtx");
  Eigen::MatrixXd all(A.rows, A.columns);
  for (int i = 0; i < A.rows; ++i)
    for (int j = 0; j < A.columns; ++j) all(i, j) = scene::value_at(A, i, j);
  return all;
}

std::string matrix_fault(const std::string& text) {
  try {
    dense_matrix(text);
  } catch (const scene::MatrixError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("matrices in each form of the exchange format are read as written") {
  const Eigen::Matrix2d symmetric{{2, -1}, {-1, 1.5}}, skew{{0, -3}, {3, 0}};
  CHECK(dense_matrix(
            "%%MatrixMarket matrix coordinate real symmetric\n% stiffness\n\n2 2 3\n1 1 2\n2 1 -1\n2 2 "
            "1.5\n") == symmetric);
  // The upper triangle, tabs, carriage returns, exponents of Fortran, capitals, no end of line.
  CHECK(
      dense_matrix(
          "%%matrixmarket MATRIX Coordinate Real Symmetric\r\n2\t2 3\r\n1 1 +2.0D0\r\n1 2 -1\r\n2 2 15d-1") ==
      symmetric);
  CHECK(dense_matrix("%%MatrixMarket matrix array real symmetric\n2 2\n2\n-1\n1.5\n") == symmetric);
  CHECK(dense_matrix("%%MatrixMarket matrix array real general\n2 2\n2 -1\n-1 1.5\n") == symmetric);
  CHECK(dense_matrix("%%MatrixMarket matrix coordinate integer skew-symmetric\n2 2 1\n2 1 3\n") == skew);
  CHECK(dense_matrix("%%MatrixMarket matrix array real skew-symmetric\n2 2\n3\n") == skew);
  Eigen::MatrixXd wide(2, 3);
  wide << 0, 5, 0, 0, 0, -7e-300;
  CHECK(dense_matrix("%%MatrixMarket matrix coordinate real general\n2 3 2\n2 3 -7e-300\n1 2 5\n") == wide);
  CHECK(dense_matrix("%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1e-400\n")(0, 0) == 0);
}

TEST_CASE("what is wrong with a matrix file is reported with its line") {
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n";
  CHECK(matrix_fault("").find("K.mtx, line 1: found no Matrix Market header") == 0);
  CHECK(matrix_fault("1 2 3\n").find("line 1: found no Matrix Market header") != std::string::npos);
  CHECK(matrix_fault("%%MatrixMarket matrix coordinate complex symmetric\n").find("\"complex\"") !=
        std::string::npos);
  CHECK(matrix_fault("%%MatrixMarket matrix coordinate pattern general\n").find("\"pattern\"") !=
        std::string::npos);
  CHECK(matrix_fault("%%MatrixMarket matrix elemental real general\n").find("\"elemental\"") !=
        std::string::npos);
  CHECK(matrix_fault("%%MatrixMarket matrix coordinate real hermitian\n").find("\"hermitian\"") !=
        std::string::npos);
  CHECK(matrix_fault(head).find("line 1: the file ends before its sizes") != std::string::npos);
  CHECK(matrix_fault(head + "2 2\n")
            .find("line 2: found \"2 2\", must be the numbers of rows, columns and entries") !=
        std::string::npos);
  CHECK(matrix_fault(head + "-2 2 1\n").find("line 2") != std::string::npos);
  CHECK(matrix_fault(head + "2 3 1\n").find("must be square") != std::string::npos);
  CHECK(matrix_fault(head + "2 2 3\n1 1 2\n2 1 -1\n").find("line 4: the file ends after 2 of 3 entries") !=
        std::string::npos);
  // Sizes that promise far more than the file holds take no memory.
  CHECK(matrix_fault(head + "2 2 9000000000000000000\n1 1 2\n").find("ends after 1 of 9000000000000000000") !=
        std::string::npos);
  CHECK(matrix_fault(head + "2 2 1\n1 1 2\n2 2 3\n").find("line 4: found \"2\" after the last entry") !=
        std::string::npos);
  CHECK(matrix_fault(head + "2 2 1\n1 1\n").find("line 3: found \"1 1\", must be row, column and value") !=
        std::string::npos);
  CHECK(matrix_fault(head + "2 2 1\n0 1 5\n").find("line 3: found the row \"0\", must be 1 to 2") !=
        std::string::npos);
  CHECK(matrix_fault(head + "2 2 1\n1 3 5\n").find("the column \"3\", must be 1 to 2") != std::string::npos);
  for (const std::string number : {"nan", "inf", "1e400", "-1D999"})
    CHECK(matrix_fault(head + "2 2 1\n1 1 " + number + "\n").find("must be a finite number") !=
          std::string::npos);
  for (const std::string number : {"1.0x", "--1", "1,5", "0x10"})
    CHECK(matrix_fault(head + "2 2 1\n1 1 " + number + "\n").find("must be a number") != std::string::npos);
  CHECK(matrix_fault(head + "2 2 2\n2 1 5\n% both triangles\n1 2 5\n")
            .find("line 5: found the entry in row 2, column 1 again, which is also in line 3") !=
        std::string::npos);
  CHECK(matrix_fault("%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n1 1 5\n")
            .find("must be 0") != std::string::npos);
  CHECK(matrix_fault("%%MatrixMarket matrix array real general\n2 2\n1 2 3\n")
            .find("ends before the value in row 2, column 2") != std::string::npos);
  CHECK(matrix_fault("%%MatrixMarket matrix array real general\n1 1\n1 2\n").find("after the last entry") !=
        std::string::npos);
}

TEST_CASE("a matrix file too short for an entry in each row is refused before it takes memory") {
  const std::string head = "%%MatrixMarket matrix ";
  const auto reported = [](const std::string& sizes, std::size_t bytes) {
    return "K.mtx, line 2: found " + sizes + " in a file of " + std::to_string(bytes) +
           " bytes, must have at most 10000000 of each, or an entry in each";
  };
  const std::string long_row = head + "coordinate real general\n100000000 1 1\n1 1 1\n";
  CHECK(matrix_fault(long_row) == reported("100000000 rows and 1 columns", long_row.size()));
  const std::string wide = head + "coordinate real general\n1 10000001 1\n1 1 1\n";
  CHECK(matrix_fault(wide) == reported("1 rows and 10000001 columns", wide.size()));
  const std::string array = head + "array real general\n20000000 0\n";
  CHECK(matrix_fault(array) == reported("20000000 rows and 0 columns", array.size()));
  // The damping of two dampers in a large structure has no entries in the other rows.
  const scene::SparseMatrix C = scene::read_matrix_market(
      head + "coordinate real symmetric\n2000000 2000000 2\n7 7 0.5\n2000000 2000000 0.1\n", "C.mtx");
  CHECK(C.rows == 2'000'000);
  CHECK(C.entries() == 2);
  CHECK(scene::value_at(C, 1'999'999, 1'999'999) == 0.1);
}

TEST_CASE("reading a large matrix can be stopped") {
  std::string text = "%%MatrixMarket matrix coordinate real general\n200000 1 200000\n";
  for (int i = 1; i <= 200000; ++i) text += std::to_string(i) + " 1 1\n";
  CHECK(scene::read_matrix_market(text, "M.mtx").entries() == 200000);
  CHECK_THROWS_AS(scene::read_matrix_market(text, "M.mtx", controls::stopped()), control::Interrupted);
}

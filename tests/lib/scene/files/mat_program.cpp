// The program that reads MATLAB files, as the library sees it: missing, hanging, dying, and sending nonsense.
#include "catch.hpp"
#include "contains.hpp"
#include "controls.hpp"

#include "lib/scene/files/mat_bytes.hpp"
#include "lib/scene/files/mat_program.hpp"
#include "lib/scene/folder.hpp"

#include <arcslip/control/child_output.hpp>
#include <arcslip/scene/files/mat_file.hpp>
#include <arcslip/scene/files/matrix_market.hpp>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <sys/stat.h>

using namespace arcslip;
using mat_bytes::bytes_of;

namespace {

using Clock = std::chrono::steady_clock;

// A file that the library has nothing against.
const std::string file_text = mat_bytes::header() + mat_bytes::full("K", 2, 2, {2, 0, 0, 3});

scene::SparseMatrix read(const std::string& variable = "K", const control::Control& control = {}) {
  return scene::read_mat_file("A.mat", file_text, variable, "\"A.mat\"", control);
}

std::string fault(const std::string& variable = "K") {
  try {
    read(variable);
  } catch (const scene::MatrixError& error) {
    return error.what();
  }
  return "none";
}

// That of a program which sends these bytes and ends.
std::string fault_of(const std::string& answer, const std::string& variable = "K") {
  const FakeProgram fake("exec /bin/cat \"$here/answer\"");
  fake.folder().write("answer", answer);
  return fault(variable);
}

std::string matrix(const std::string& sizes, const std::vector<std::int32_t>& starts,
                   const std::vector<std::int32_t>& rows, const std::vector<double>& values) {
  return "arcslip-mat 1 matrix 1 " + sizes + "\nK" + bytes_of(starts) + bytes_of(rows) + bytes_of(values);
}

// Whether a process is there, and more than an entry that nobody has waited for.
bool runs(const std::string& pid) {
  std::ifstream stat("/proc/" + pid + "/stat");
  std::string number, name, state;
  return stat >> number >> name >> state && state != "Z";
}

std::string line_of(const std::string& path) {
  std::string line;
  std::ifstream in(path);
  std::getline(in, line);
  return line;
}

constexpr const char* damaged = "\"A.mat\": found a file that cannot be read; it may be damaged";
const std::string nonsense = std::string(damaged) + ", or the program arcslip-mat is of another version";
const std::string of_k = "\"A.mat\", variable \"K\": ";

}  // namespace

TEST_CASE("what the program sends is the matrix") {
  const FakeProgram fake("exec /bin/cat \"$here/answer\"");
  fake.folder().write("answer", matrix("2 3 3", {0, 1, 1, 3}, {1, 0, 1}, {5, -0.1, 1e300}));
  const scene::SparseMatrix A = read();
  CHECK(A.rows == 2);
  CHECK(A.columns == 3);
  CHECK(A.starts == std::vector<int>{0, 1, 1, 3});
  CHECK(A.row_of == std::vector<int>{1, 0, 1});
  CHECK(A.values == std::vector<double>{5, -0.1, 1e300});
  // Rows of a column in another order.
  fake.folder().write("answer", matrix("3 1 3", {0, 3}, {2, 0, 1}, {3, 1, 2}));
  CHECK(read().row_of == std::vector<int>{0, 1, 2});
  CHECK(read().values == std::vector<double>{1, 2, 3});
  fake.folder().write("answer", matrix("0 0 0", {0}, {}, {}));
  CHECK(read().entries() == 0);
}

TEST_CASE("without the program a MATLAB file is a fault that names it and where it was looked for") {
  const Environment none("ARCSLIP_MAT", nullptr), path("PATH", "relative:/nonexistent");
  const std::string reported = fault();
  CHECK(contains(
      reported,
      "\"A.mat\": found a MATLAB file, which is read by the program arcslip-mat, which is not there, "
      "must be in one of \""));
  const std::string here = std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
  CHECK(contains(reported, "\"" + here + "\""));
  CHECK(contains(reported, "\"" + std::filesystem::path(here).parent_path().string() + "/libexec/arcslip\""));
  CHECK(contains(reported, "in PATH, or where ARCSLIP_MAT says; it is built where matio is installed"));
}

TEST_CASE("the program is found in an absolute folder of PATH, and no file that is none") {
  const Environment none("ARCSLIP_MAT", nullptr);
  const Folder folder;
  folder.write("bin/arcslip-mat", "#!/bin/sh\nprintf 'arcslip-mat 1 fault 0 5\\nfound'\n");
  std::filesystem::create_directories(folder / "other/arcslip-mat");
  const Environment path("PATH", ("/nonexistent::" + (folder / "other") + ":" + (folder / "bin")).c_str());
  CHECK(contains(fault(), "which is not there"));  // may not be executed
  std::filesystem::permissions(folder / "bin/arcslip-mat", std::filesystem::perms::owner_all);
  CHECK(fault() == "\"A.mat\": found");
}

TEST_CASE("a program that cannot be started is a fault with the cause") {
  const Folder folder({{"text", "no program"}, {"script", "#!/nonexistent/sh\n"}});
  const auto of = [&](const std::string& path) {
    const Environment variable("ARCSLIP_MAT", path.c_str());
    return fault();
  };
  const auto reported = [&](const std::string& path, const std::string& cause) {
    return "\"A.mat\": found a MATLAB file, which is read by the program \"" + path +
           "\", which cannot be started: " + cause;
  };
  CHECK(of("/nonexistent") == reported("/nonexistent", "No such file or directory"));
  CHECK(of(folder / "text") == reported(folder / "text", "Permission denied"));
  CHECK(of(folder.path()) == reported(folder.path(), "Permission denied"));
  std::filesystem::permissions(folder / "text", std::filesystem::perms::owner_all);
  std::filesystem::permissions(folder / "script", std::filesystem::perms::owner_all);
  CHECK(of(folder / "text") == reported(folder / "text", "Exec format error"));
  CHECK(of(folder / "script") == reported(folder / "script", "No such file or directory"));
}

TEST_CASE("a program that ends by a signal is a damaged file") {
  const std::string whole = matrix("1 1 1", {0, 1}, {0}, {2});
  for (const std::string signal : {"KILL", "SEGV", "ABRT", "XCPU"}) {
    CAPTURE(signal);
    const FakeProgram fake("kill -" + signal + " $$");
    CHECK(fault() == damaged);
    const FakeProgram later("/bin/cat \"$here/answer\"; kill -" + signal + " $$");
    later.folder().write("answer", whole);
    CHECK(fault() == of_k + std::string(damaged).substr(9));
    later.folder().write("answer", whole.substr(0, whole.size() - 3));
    CHECK(fault() == of_k + std::string(damaged).substr(9));
  }
}

TEST_CASE("nonsense from the program is refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto of_matrix = of_k + nonsense.substr(9);
  SECTION("which is no answer") {
    for (const std::string answer : {"",
                                     "\n",
                                     "hello\n",
                                     "arcslip-mat",
                                     "arcslip-mat 1",
                                     "arcslip-mat 1\n",
                                     "arcslip-mat 1 matrix\n",
                                     "arcslip-mat 2 matrix 1 1 1 1\n",
                                     "arcslip-mat 1 matrix 1 1 1\n",
                                     "arcslip-mat 1 matrix 1 1 1 1 1\n",
                                     "arcslip-mat 1 matrix 1 -1 1 1\nK",
                                     "arcslip-mat 1 matrix 1 1 -1 1\nK",
                                     "arcslip-mat 1 matrix 1 1 1 -1\nK",
                                     "arcslip-mat 1 matrix 1 1.5 1 1\nK",
                                     "arcslip-mat 1 matrix 1 1 1 1",
                                     "arcslip-mat 1 matrix 0 1 1 1\n",
                                     "arcslip-mat 1 matrix 1  1 1 1\nK",
                                     "arcslip-mat 1 matrix 18446744073709551616 1 1 1\nK",
                                     "arcslip-mat 1 matrix 1000000000 1 1 1\nK",
                                     "arcslip-mat 1 fault 0 0\n",
                                     "arcslip-mat 1 fault 0 9\nfound",
                                     "arcslip-mat 1 fault 0 5\nfound more",
                                     "arcslip-mat 1 fault 0 5\nfou\x1b[",
                                     "arcslip-mat 1 fault 0 1000000\n",
                                     "arcslip-mat 1 variables 2 2\nab",
                                     "arcslip-mat 1 variables 99999 4\na",
                                     "arcslip-mat 1 variables 1 1000\n"})
      CHECK(fault_of(answer) == nonsense);
    CHECK(fault_of(std::string(1 << 20, 'x')) == nonsense);
    CHECK(fault_of(std::string("arcslip-mat 1 variables 3 4\na\0b\0", 32)) == nonsense);
    CHECK(fault_of(std::string("arcslip-mat 1 variables 1 2\nK\0", 30), "") == nonsense);  // the only one
  }
  SECTION("sizes beyond what the file can hold take no memory") {
    for (const std::string sizes :
         {"100000001 1 0", "1 100000001 0", "20000000 1 0", "1 20000000 0", "1 1 4294967297",
          "1 1 2147483648", "1 1 1000000", "18446744073709551615 18446744073709551615 0"})
      CHECK(fault_of("arcslip-mat 1 matrix 1 " + sizes + "\nK") == nonsense);
  }
  SECTION("too few bytes, and too many") {
    const std::string whole = matrix("2 2 2", {0, 1, 2}, {0, 1}, {2, 3});
    CHECK(fault_of(whole) == "none");
    const auto end_of_line = whole.find('\n');
    for (std::size_t length = 0; length < whole.size(); ++length) {
      CAPTURE(length);
      CHECK(fault_of(whole.substr(0, length)) == (length > end_of_line + 1 ? of_matrix : nonsense));
    }
    CHECK(fault_of(whole + "x") == of_matrix);
    CHECK(fault_of(whole + std::string(1 << 20, 'x')) == of_matrix);
  }
  SECTION("starts, rows and values that are those of no matrix") {
    const std::string may = "; the file may be damaged";
    CHECK(fault_of(matrix("2 2 2", {1, 1, 2}, {0, 1}, {2, 3})) ==
          of_k + "found no starts of its 2 columns" + may);
    CHECK(fault_of(matrix("2 2 2", {0, 2, 1}, {0, 1}, {2, 3})) ==
          of_k + "found that column 2 ends before it begins" + may);
    CHECK(fault_of(matrix("2 2 2", {0, -1, 2}, {0, 1}, {2, 3})) ==
          of_k + "found that column 1 ends before it begins" + may);
    CHECK(fault_of(matrix("2 2 2", {0, 3, 2}, {0, 1}, {2, 3})) ==
          of_k + "found that column 1 ends before it begins" + may);
    CHECK(fault_of(matrix("2 2 2", {0, 1, 1}, {0, 1}, {2, 3})) ==
          of_k + "found fewer entries than the 2 that its columns have" + may);
    CHECK(fault_of(matrix("2 2 2", {0, 1, 2}, {0, 2}, {2, 3})) ==
          of_k + "found the row 3 in column 2, where it has 2 rows" + may);
    CHECK(fault_of(matrix("2 2 2", {0, 1, 2}, {-1, 1}, {2, 3})) ==
          of_k + "found the row 4294967296 in column 1, where it has 2 rows" + may);
    CHECK(fault_of(matrix("2 2 2", {0, 1, 2}, {0, 1}, {2, nan})) ==
          of_k + "found nan in row 2, column 2, must be a finite number");
    CHECK(fault_of(matrix("2 2 2", {0, 1, 2}, {0, 1}, {-inf, 1})) ==
          of_k + "found -inf in row 1, column 1, must be a finite number");
    CHECK(fault_of(matrix("2 1 2", {0, 2}, {1, 1}, {2, 3})) ==
          of_k + "found the entry in row 2, column 1 twice");
  }
  SECTION("another exit code than 0") {
    const FakeProgram fake("/bin/cat \"$here/answer\"; exit 1");
    fake.folder().write("answer", matrix("1 1 1", {0, 1}, {0}, {2}));
    CHECK(fault() == of_matrix);
  }
}

TEST_CASE("a program that hangs is killed on request, with what it started") {
  const std::string started =
      "/bin/sleep 1000 & echo $! > \"$here/pid.new\"; mv \"$here/pid.new\" \"$here/pid\"; ";
  const std::string commands = GENERATE_COPY(
      started + "wait",                                                         // before it sends anything
      started + "printf 'arcslip-mat 1 matrix 1 2 2 2\\nK\\0\\0\\0\\0'; wait",  // in the middle
      started + "exec >&-; wait",                                               // behind its output
      started + "while :; do printf 'arcslip-mat 1 fault 0 5\\nfound'; done",   // or never ends
      started + "printf 'arcslip-mat 1 fault 0 5\\nfound'; exit 0");            // its child holds the output
  const FakeProgram fake(commands);
  const std::string pid = fake.folder() / "pid";
  const auto begin = Clock::now();
  Clock::time_point asked{};
  const auto keep_going = [&] {
    if (!std::filesystem::exists(pid)) return true;
    if (asked == Clock::time_point{}) asked = Clock::now();
    return false;
  };
  std::string reported;
  try {
    read("K", controls::polled(keep_going));
  } catch (const control::Interrupted& interrupted) {
    reported = interrupted.what();
  } catch (const scene::MatrixError&) {
    reported = "refused";  // what never ends is refused at the first byte that is too many
  }
  CHECK((reported == "refused" || contains(reported, "was read")));
  CHECK(Clock::now() - begin < std::chrono::seconds(20));
  if (reported != "refused") CHECK(Clock::now() - asked < std::chrono::seconds(1));
  const std::string sleeper = line_of(pid);
  REQUIRE(!sleeper.empty());
  for (int k = 0; k < 100 && runs(sleeper); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK_FALSE(runs(sleeper));
}

TEST_CASE("a program is killed at its time limit") {
  control::ChildOutput output({"/bin/sleep", {"1000"}}, {std::chrono::milliseconds(50)});
  char c = 0;
  CHECK_FALSE(output.read(&c, 1));
  CHECK(output.end() == control::ChildOutput::End::out_of_time);
  CHECK_FALSE(output.ends_well());
}

TEST_CASE("the program gets the file and the variable, and nothing else") {
  const Environment secret("ARCSLIP_TEST_SECRET", "1"), libraries("LD_LIBRARY_PATH", "/nonexistent");
  const FakeProgram fake(
      "for word in \"$@\"; do echo \"<$word>\"; done > \"$here/words\"; /usr/bin/env > "
      "\"$here/environment\"\n"
      "read line || echo nothing > \"$here/input\"\nls -l /proc/$$/fd > \"$here/descriptors\"; kill -USR1 "
      "$$");
  ::signal(SIGUSR1, SIG_IGN);  // which the program does not inherit
  CHECK(fault("a b'\"$(c)") == damaged);
  ::signal(SIGUSR1, SIG_DFL);
  std::ifstream words(fake.folder() / "words");
  std::ostringstream text;
  text << words.rdbuf();
  CHECK(text.str() == "<A.mat>\n<a b'\"$(c)>\n");
  CHECK(line_of(fake.folder() / "input") == "nothing");
  std::ifstream environment(fake.folder() / "environment");
  for (std::string line; std::getline(environment, line);) {
    const std::string name = line.substr(0, line.find('='));
    CAPTURE(line);
    CHECK((name == "LD_LIBRARY_PATH" || name == "HDF5_USE_FILE_LOCKING" || name == "PWD" || name == "_" ||
           name == "OLDPWD" || name == "SHLVL"));
  }
}

TEST_CASE("a caller that ignores the ends of its children reads MATLAB files as well") {
  const FakeProgram fake("exec /bin/cat \"$here/answer\"");
  fake.folder().write("answer", matrix("1 1 1", {0, 1}, {0}, {2}));
  ::signal(SIGCHLD, SIG_IGN);
  const std::string reported = fault();
  ::signal(SIGCHLD, SIG_DFL);
  CHECK(reported == "none");
}

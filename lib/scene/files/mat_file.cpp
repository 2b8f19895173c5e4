#include <arcslip/control/child_output.hpp>
#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/files/helper_program.hpp>
#include <arcslip/scene/files/mat_file.hpp>
#include <arcslip/scene/files/mat_protocol.hpp>
#include <arcslip/scene/files/matrix_market.hpp>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace arcslip::scene {
namespace {

using control::ChildOutput;
using file::listed;

constexpr std::size_t header = 128;  // bytes before the first element of version 5
constexpr std::uint32_t matrix_element = 14, compressed_element = 15;
constexpr const char* program = "arcslip-mat";
constexpr const char* program_variable = "ARCSLIP_MAT";
constexpr std::size_t longest_line = 200;  // of what it writes
constexpr std::size_t at_once = 1 << 18;   // numbers between which memory grows

bool is_version_5(std::string_view text) {
  return text.starts_with("MATLAB 5.0 MAT-file");
}
bool is_version_73(std::string_view text) {
  return text.starts_with("MATLAB 7.3 MAT-file");
}

// A machine that is busy gives it a tenth of its time: arcslip-mat itself is ended by its processor time.
std::chrono::seconds longest_time(std::size_t bytes) {
  return std::chrono::seconds(100 + bytes / 10'000);
}

// Nothing but where its libraries are, and no lock on files, which some file systems do not grant.
std::vector<std::string> environment() {
  std::vector<std::string> all{"HDF5_USE_FILE_LOCKING=FALSE"};
  if (const char* folders = std::getenv("LD_LIBRARY_PATH"))
    all.push_back("LD_LIBRARY_PATH=" + std::string(folders));
  return all;
}

std::optional<std::vector<std::size_t>> numbers(std::string_view text) {
  std::vector<std::size_t> all;
  while (!text.empty()) {
    if (!text.starts_with(' ')) return {};
    text.remove_prefix(1);
    std::size_t number = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return {};
    all.push_back(number);
    text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  }
  return all;
}

class MatFileReader {
 public:
  MatFileReader(const std::string& path, std::string_view text, const std::string& name,
                const std::string& reported, const control::Control& control)
      : path_(path), text_(text), name_(name), reported_(reported), control_(control) {}

  SparseMatrix read() {
    check_file();
    listen();
    ChildOutput answer = start();
    const std::string line = answer.line(longest_line).value_or("");
    if (const auto sizes = sizes_behind(line, "matrix", 4)) return matrix(answer, *sizes);
    if (const auto sizes = sizes_behind(line, "variables", 2)) tell_variables(answer, *sizes);
    if (const auto sizes = sizes_behind(line, "fault", 2)) tell_fault(answer, *sizes);
    refuse(answer);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const { throw MatrixError(reported_ + ": " + cause); }
  void listen() const {
    if (!control_.keep_going()) throw control::Interrupted("interrupted while " + reported_ + " was read");
  }

  // matio takes whatever it does not know for a file of version 4, goes by the number of the version alone,
  // and reads short files as far as they go.
  void check_file() const {
    const bool with_hdf5 = is_version_73(text_);
    if (!with_hdf5 && !is_version_5(text_))
      fail(
          "found no MATLAB file of version 5 or 7.3, must begin with \"MATLAB 5.0 MAT-file\" or \"MATLAB 7.3 "
          "MAT-file\"; in MATLAB, save it by save(..., \"-v7\") or save(..., \"-v7.3\")");
    if (text_.size() < header) fail("the file ends within its header of 128 bytes");
    const std::string_view order = text_.substr(126, 2);
    const std::string_view version = text_.substr(124, 2), low_first(with_hdf5 ? "\0\2" : "\0\1", 2);
    const bool known = (order == "IM" && version == low_first) ||
                       (order == "MI" && version[0] == low_first[1] && version[1] == low_first[0]);
    if (!known && with_hdf5)
      fail("found no MATLAB file of version 5 or 7.3 that can be read; it may be damaged");
    if (!known) fail("found a damaged header");
    if (with_hdf5) return;
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

  ChildOutput start() const {
    const detail::OwnProgram found = detail::find_own_program(program, program_variable);
    if (found.path.empty())
      fail("found a MATLAB file, which is read by the program " + std::string(program) +
           ", which is not there, must be in one of " + listed(found.folders) + ", in PATH, or where " +
           program_variable + " says; it is built where matio is installed");
    std::vector<std::string> arguments{path_};
    if (!name_.empty()) arguments.push_back(name_);
    try {
      return ChildOutput({found.path, arguments, environment()}, {longest_time(text_.size()), control_});
    } catch (const std::system_error& error) {
      fail("found a MATLAB file, which is read by the program " + file::quoted(found.path) +
           ", which cannot be started: " + error.code().message());
    }
  }

  // What stands behind the greeting and this word: so many numbers.
  static std::optional<std::vector<std::size_t>> sizes_behind(std::string_view line, std::string_view word,
                                                              std::size_t count) {
    for (const std::string_view begin :
         {std::string_view(mat_protocol::greeting), std::string_view(" "), word}) {
      if (!line.starts_with(begin)) return {};
      line.remove_prefix(begin.size());
    }
    auto sizes = numbers(line);
    if (sizes && sizes->size() != count) sizes.reset();
    return sizes;
  }

  // Where what arrives is not what it should be, or no more arrives.
  [[noreturn]] void refuse(ChildOutput& answer) const {
    using enum ChildOutput::End;
    listen();
    if (answer.end() == stopped) throw control::Interrupted("interrupted while " + reported_ + " was read");
    if (answer.end() == out_of_time)
      fail("found a file that is not read within " + std::to_string(longest_time(text_.size()).count()) +
           " s; it may be damaged");
    if (answer.end() == by_signal) fail("found a file that cannot be read; it may be damaged");
    fail("found a file that cannot be read; it may be damaged, or the program " + std::string(program) +
         " is of another version");
  }
  void expect(bool kept, ChildOutput& answer) const {
    if (!kept) refuse(answer);
  }

  std::string text(ChildOutput& answer, std::size_t bytes, std::size_t most) const {
    expect(bytes <= most, answer);
    std::string text(bytes, ' ');
    expect(answer.read(text.data(), bytes), answer);
    return text;
  }

  template <class T>
  std::vector<T> array(ChildOutput& answer, std::size_t count) const {
    std::vector<T> all;
    all.reserve(count);
    while (all.size() < count) {
      const std::size_t more = std::min(at_once, count - all.size());
      all.resize(all.size() + more);
      expect(answer.read(all.data() + all.size() - more, more * sizeof(T)), answer);
    }
    return all;
  }

  [[noreturn]] void tell_fault(ChildOutput& answer, const std::vector<std::size_t>& sizes) {
    const std::string variable = text(answer, sizes[0], mat_protocol::longest_name);
    const std::string cause = text(answer, sizes[1], mat_protocol::longest_cause);
    expect(answer.ends_well(), answer);
    expect(!cause.empty() &&
               std::all_of(cause.begin(), cause.end(), [](char c) { return c >= ' ' && c <= '~'; }),
           answer);
    if (!variable.empty()) reported_ += ", variable " + file::quoted(variable);
    fail(cause);
  }

  // There are several, or not the one that was asked for.
  [[noreturn]] void tell_variables(ChildOutput& answer, const std::vector<std::size_t>& sizes) const {
    expect(sizes[0] <= mat_protocol::most_variables, answer);
    std::string_view rest;
    const std::string all = text(answer, sizes[1], sizes[0] * (mat_protocol::longest_name + 1));
    expect(answer.ends_well() && (all.empty() || all.back() == '\0'), answer);
    std::vector<std::string> names;
    for (rest = all; !rest.empty(); rest.remove_prefix(names.back().size() + 1))
      names.emplace_back(rest.substr(0, rest.find('\0')));
    expect(names.size() == sizes[0] && (!name_.empty() || names.size() != 1), answer);
    if (names.empty()) fail("found no variable; the file may be damaged");
    std::sort(names.begin(), names.end());
    if (!name_.empty())
      fail("found no variable " + file::quoted(name_) + ", must be " + (names.size() > 1 ? "one of " : "") +
           listed(names) + file::hint(name_, names));
    fail("found the variables " + listed(names) + R"(, must say which: {"file": ..., "variable": ...})");
  }

  SparseMatrix matrix(ChildOutput& answer, const std::vector<std::size_t>& sizes) {
    const std::size_t rows = sizes[1], columns = sizes[2], count = sizes[3];
    const std::string variable = text(answer, sizes[0], mat_protocol::longest_name);
    expect(!variable.empty() && mat_protocol::has_size(text_.size(), rows, columns) &&
               mat_protocol::has_entries(text_.size(), count),
           answer);
    reported_ += ", variable " + file::quoted(variable);
    SparseMatrix A{static_cast<int>(rows), static_cast<int>(columns), {}, {}, {}};
    A.starts = array<int>(answer, columns + 1);
    check_starts(A, static_cast<int>(count));
    A.row_of = array<int>(answer, count);
    A.values = array<double>(answer, count);
    expect(answer.ends_well(), answer);
    if (!check_entries(A)) put_in_order(A);
    return A;
  }

  [[noreturn]] void tell_damage(const std::string& what) const {
    fail("found " + what + "; the file may be damaged");
  }

  void check_starts(const SparseMatrix& A, int count) const {
    if (A.starts[0] != 0) tell_damage("no starts of its " + std::to_string(A.columns) + " columns");
    for (std::size_t j = 1; j < A.starts.size(); ++j)
      if (A.starts[j] < A.starts[j - 1] || A.starts[j] > count)
        tell_damage("that column " + std::to_string(j) + " ends before it begins");
    if (A.starts.back() != count)
      tell_damage("fewer entries than the " + std::to_string(count) + " that its columns have");
  }

  // True where each column has its rows in their order.
  bool check_entries(const SparseMatrix& A) const {
    bool sorted = true;
    std::size_t k = 0;
    for (std::size_t j = 0; j + 1 < A.starts.size(); ++j) {
      const std::size_t first = k;
      for (; k < static_cast<std::size_t>(A.starts[j + 1]); ++k) {
        const auto row = static_cast<std::uint32_t>(A.row_of[k]);
        if (row >= static_cast<std::uint32_t>(A.rows))
          tell_damage("the row " + std::to_string(std::size_t{row} + 1) + " in column " +
                      std::to_string(j + 1) + ", where it has " + std::to_string(A.rows) + " rows");
        if (!std::isfinite(A.values[k]))
          fail("found " + file::number_text(A.values[k]) + " in row " + std::to_string(row + 1) +
               ", column " + std::to_string(j + 1) + ", must be a finite number");
        sorted = sorted && (k == first || A.row_of[k - 1] < A.row_of[k]);
      }
    }
    return sorted;
  }

  // Each column by its rows.
  void put_in_order(SparseMatrix& A) const {
    std::vector<std::pair<int, double>> column;
    for (std::size_t j = 0; j + 1 < A.starts.size(); ++j) {
      const auto first = static_cast<std::size_t>(A.starts[j]),
                 last = static_cast<std::size_t>(A.starts[j + 1]);
      column.clear();
      for (std::size_t k = first; k < last; ++k) column.emplace_back(A.row_of[k], A.values[k]);
      std::sort(column.begin(), column.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      for (std::size_t k = first; k < last; ++k) {
        const int row = column[k - first].first;
        if (k > first && A.row_of[k - 1] == row)
          fail("found the entry in row " + std::to_string(row + 1) + ", column " + std::to_string(j + 1) +
               " twice");
        A.row_of[k] = row;
        A.values[k] = column[k - first].second;
      }
    }
  }

  const std::string& path_;
  const std::string_view text_;
  const std::string& name_;
  std::string reported_;
  const control::Control& control_;
};

}  // namespace

bool is_mat_file(std::string_view path, std::string_view text) {
  const std::string_view ending = path.substr(path.size() < 4 ? 0 : path.size() - 4);
  return ending == ".mat" || ending == ".MAT" || is_version_5(text) || is_version_73(text);
}

SparseMatrix read_mat_file(const std::string& path, std::string_view text, const std::string& variable,
                           const std::string& file, const control::Control& control) {
  return MatFileReader(path, text, variable, file, control).read();
}

}  // namespace arcslip::scene

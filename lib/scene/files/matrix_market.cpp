#include <arcslip/scene/files/matrix_market.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace arcslip::scene {
namespace {

constexpr std::size_t lines_per_question = 1 << 16;

enum class Symmetry { general, symmetric, skew };

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

std::string shown_word(std::string_view text) {
  std::string plain;
  for (const char c : text.substr(0, 40)) plain += c >= 0x20 && c < 0x7f ? c : '?';
  return '"' + plain + (text.size() > 40 ? "...\"" : "\"");
}

std::optional<long long> integer(std::string_view word) {
  long long value = 0;
  const char* end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || rest != end) return {};
  return value;
}

// With exponents as Fortran writes them, 1.5D+03.
std::optional<double> real(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  char copy[64] = {};
  if (word.empty() || word.size() >= sizeof copy) return {};
  char* end =
      std::transform(word.begin(), word.end(), copy, [](char c) { return c == 'D' || c == 'd' ? 'e' : c; });
  double value = 0;
  const auto [rest, error] = std::from_chars(copy, end, value);
  if (error == std::errc::result_out_of_range && rest == end) return std::strtod(copy, nullptr);  // 0, inf
  if (error != std::errc() || rest != end) return {};
  return value;
}

class MatrixMarketReader {
 public:
  MatrixMarketReader(std::string_view text, const std::string& file, const control::Control& control)
      : text_(text), bytes_(text.size()), file_(file), control_(control) {}

  SparseMatrix read() {
    read_banner();
    const std::vector<long long> sizes = read_sizes();
    if (coordinate_)
      read_coordinates(sizes[2]);
    else
      read_array();
    if (next_words()) fail("found " + shown_word(words_[0]) + " after the last entry");
    const std::size_t given = entries_.size();
    for (std::size_t k = 0; k < given && symmetry_ != Symmetry::general; ++k)
      if (const MatrixEntry entry = entries_[k]; entry.row != entry.column)
        entries_.push_back(
            {entry.column, entry.row, symmetry_ == Symmetry::skew ? -entry.value : entry.value});
    SparseMatrix A = sparse_matrix(rows_, columns_, entries_);
    if (coordinate_ && A.entries() < entries_.size()) refuse_repeated();
    return A;
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const {
    throw MatrixError(file_ + ", line " + std::to_string(line_) + ": " + cause);
  }

  // The words of the next line that has any; none at the end.
  bool next_words() {
    words_.clear();
    while (words_.empty() && !text_.empty()) {
      if (++line_ % lines_per_question == 0 && !control_.keep_going())
        throw control::Interrupted("interrupted while " + file_ + " was read");
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      std::string_view line = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      if (line.starts_with('%')) continue;
      while (!line.empty()) {
        const std::size_t begin = line.find_first_not_of(" \t\r");
        if (begin == std::string_view::npos) break;
        line.remove_prefix(begin);
        const std::size_t length = std::min(line.find_first_of(" \t\r"), line.size());
        words_.push_back(line.substr(0, length));
        line.remove_prefix(length);
      }
    }
    return !words_.empty();
  }

  void read_banner() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // a byte order mark
    line_ = 1;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view banner = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    std::vector<std::string> words;
    while (!banner.empty()) {
      const std::size_t begin = std::min(banner.find_first_not_of(" \t\r"), banner.size());
      banner.remove_prefix(begin);
      const std::size_t length = std::min(banner.find_first_of(" \t\r"), banner.size());
      if (length > 0) words.push_back(lower_case(banner.substr(0, length)));
      banner.remove_prefix(length);
    }
    if (words.size() != 5 || words[0] != "%%matrixmarket" || words[1] != "matrix")
      fail(
          "found no Matrix Market header, must begin as in \"%%MatrixMarket matrix coordinate real "
          "symmetric\"");
    if (words[2] != "coordinate" && words[2] != "array")
      fail("found the format " + shown_word(words[2]) + R"(, must be "coordinate" or "array")");
    if (words[3] != "real" && words[3] != "integer" && words[3] != "double")
      fail("found values that are " + shown_word(words[3]) + R"(, must be "real" or "integer")");
    if (words[4] != "general" && words[4] != "symmetric" && words[4] != "skew-symmetric")
      fail("found the symmetry " + shown_word(words[4]) +
           R"(, must be "general", "symmetric" or "skew-symmetric")");
    coordinate_ = words[2] == "coordinate";
    symmetry_ = words[4] == "general"     ? Symmetry::general
                : words[4] == "symmetric" ? Symmetry::symmetric
                                          : Symmetry::skew;
  }

  std::vector<long long> read_sizes() {
    const std::string wanted = coordinate_ ? "rows, columns and entries" : "rows and columns";
    if (!next_words()) fail("the file ends before its sizes, must have the numbers of " + wanted);
    std::vector<long long> sizes;
    for (const std::string_view word : words_)
      if (const auto size = integer(word); size && *size >= 0 && *size <= most(sizes.size()))
        sizes.push_back(*size);
    if (sizes.size() != words_.size() || sizes.size() != (coordinate_ ? 3u : 2u))
      fail("found " + shown_word(line_of_words()) + ", must be the numbers of " + wanted);
    if (static_cast<std::size_t>(std::max(sizes[0], sizes[1])) > std::max(largest_empty_matrix, bytes_))
      fail("found " + std::to_string(sizes[0]) + " rows and " + std::to_string(sizes[1]) +
           " columns in a file of " + std::to_string(bytes_) + " bytes, must have at most " +
           std::to_string(largest_empty_matrix) + " of each, or an entry in each");
    rows_ = static_cast<int>(sizes[0]);
    columns_ = static_cast<int>(sizes[1]);
    if (symmetry_ != Symmetry::general && rows_ != columns_)
      fail("found " + std::to_string(rows_) + " rows and " + std::to_string(columns_) +
           " columns, must be square to be symmetric");
    return sizes;
  }
  static long long most(std::size_t which) {
    return which < 2 ? static_cast<long long>(largest_matrix_size) : std::numeric_limits<long long>::max();
  }
  std::string line_of_words() const {
    std::string line;
    for (const std::string_view word : words_) line += (line.empty() ? "" : " ") + std::string(word);
    return line;
  }

  double value_of(std::string_view word) const {
    const auto value = real(word);
    if (!value) fail("found " + shown_word(word) + ", must be a number");
    if (!std::isfinite(*value)) fail("found " + shown_word(word) + ", must be a finite number");
    return *value;
  }

  int index_of(std::string_view word, long long size, const char* what) const {
    const auto index = integer(word);
    if (!index || *index < 1 || *index > size)
      fail("found the " + std::string(what) + " " + shown_word(word) + ", must be 1 to " +
           std::to_string(size));
    return static_cast<int>(*index - 1);
  }

  void read_coordinates(long long count) {
    // What the sizes say may be wrong: an entry takes at least six characters.
    entries_.reserve((symmetry_ == Symmetry::general ? 1 : 2) *
                     std::min<std::size_t>(static_cast<std::size_t>(count), text_.size() / 6 + 1));
    for (long long k = 0; k < count; ++k) {
      if (!next_words())
        fail("the file ends after " + std::to_string(k) + " of " + std::to_string(count) + " entries");
      if (words_.size() != 3)
        fail("found " + shown_word(line_of_words()) + ", must be row, column and value");
      add(index_of(words_[0], rows_, "row"), index_of(words_[1], columns_, "column"), value_of(words_[2]));
    }
  }

  void add(int row, int column, double value) {
    if (symmetry_ == Symmetry::skew && row == column && value != 0)
      fail("found the diagonal entry " + std::to_string(value) + " of a skew-symmetric matrix, must be 0");
    if (symmetry_ != Symmetry::general && row < column) {
      std::swap(row, column);
      if (symmetry_ == Symmetry::skew) value = -value;
    }
    entries_.push_back({row, column, value});
    lines_.push_back(line_);
  }

  [[noreturn]] void refuse_repeated() {
    std::map<std::pair<int, int>, std::size_t> first;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      const MatrixEntry& entry = entries_[k];
      const auto [earlier, is_new] = first.emplace(std::pair(entry.row, entry.column), lines_[k]);
      if (is_new) continue;
      line_ = lines_[k];
      fail("found the entry in row " + std::to_string(entry.row + 1) + ", column " +
           std::to_string(entry.column + 1) + " again, which is also in line " +
           std::to_string(earlier->second) +
           (symmetry_ == Symmetry::general ? "" : "; of a symmetric matrix one triangle must be given"));
    }
    fail("found an entry twice");
  }

  // Column by column; of a symmetric matrix from the diagonal down, of a skew-symmetric one below it.
  void read_array() {
    std::size_t word = 0;
    words_.clear();
    for (int j = 0; j < columns_; ++j) {
      const int first = symmetry_ == Symmetry::general ? 0 : symmetry_ == Symmetry::symmetric ? j : j + 1;
      for (int i = first; i < rows_; ++i) {
        if (word == words_.size()) {
          if (!next_words())
            fail("the file ends before the value in row " + std::to_string(i + 1) + ", column " +
                 std::to_string(j + 1));
          word = 0;
        }
        const double value = value_of(words_[word++]);
        if (value != 0) entries_.push_back({i, j, value});
      }
    }
    if (word < words_.size()) fail("found " + shown_word(words_[word]) + " after the last entry");
  }

  std::string_view text_;
  std::size_t bytes_;
  const std::string& file_;
  const control::Control& control_;
  std::size_t line_ = 0;
  std::vector<std::string_view> words_;
  bool coordinate_ = true;
  Symmetry symmetry_ = Symmetry::general;
  int rows_ = 0, columns_ = 0;
  std::vector<MatrixEntry> entries_;
  std::vector<std::size_t> lines_;  // of the entries in the file
};

}  // namespace

SparseMatrix read_matrix_market(std::string_view text, const std::string& file,
                                const control::Control& control) {
  return MatrixMarketReader(text, file, control).read();
}

}  // namespace arcslip::scene

#include <arcslip/scene/faults.hpp>

#include <arcslip/results/text.hpp>
#include <arcslip/scene/scene.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

namespace arcslip::scene {
namespace {

std::string lines_of(const std::vector<Fault>& faults) {
  std::string lines;
  for (const Fault& fault : faults) {
    lines += lines.empty() ? "" : "\n";
    lines += fault.pointer.empty() ? fault.message : results::visible(fault.pointer) + ": " + fault.message;
  }
  return lines;
}

}  // namespace

SceneError::SceneError(std::vector<Fault> faults) : Error(lines_of(faults)), faults_(std::move(faults)) {}

namespace file {
namespace {

constexpr std::size_t most_faults = 1000;
constexpr std::size_t most_bytes = std::size_t{1} << 20;

// The copies of an entry with a fault at the same place: that of the first is reported.
struct Copies {
  explicit Copies(const Origin* origin) : first(origin) {}

  // "for i = 1, 2, 3 and 9 more"
  std::string text() const {
    constexpr std::size_t most = 3;
    std::string text = "for " + first->index + " = ";
    std::size_t count = 0;
    for (const int number : numbers)
      if (++count <= most) text += (count > 1 ? ", " : "") + std::to_string(number);
    return text + (numbers.size() > most ? " and " + std::to_string(numbers.size() - most) + " more" : "");
  }

  const Origin* first;
  std::set<int> numbers;
  std::vector<std::size_t> reported;  // among the faults
};

}  // namespace

void Faults::add(std::string pointer, std::string message) {
  ++count_;
  if (!full()) {
    size_ += pointer.size() + message.size();
    kept_.push_back({std::move(pointer), std::move(message)});
  }
}

bool Faults::full() const {
  return kept_.size() >= most_faults || size_ >= most_bytes;
}

void Faults::raise() const {
  if (count_ == 0) return;
  std::vector<Fault> faults;
  std::map<std::string, Copies> copies;  // by pointer
  for (Fault fault : kept_) {
    const Origin* origin = to_file(fault.pointer);
    if (origin == nullptr || origin->index.empty()) {
      faults.push_back(std::move(fault));
      continue;
    }
    Copies& all = copies.try_emplace(fault.pointer, origin).first->second;
    all.numbers.insert(origin->number);
    if (origin->number == all.first->number) {
      all.reported.push_back(faults.size());
      faults.push_back(std::move(fault));
    }
  }
  for (const auto& [pointer, all] : copies)
    for (const std::size_t i : all.reported) faults[i].message.insert(0, all.text() + ": ");
  if (count_ > kept_.size()) {
    faults.push_back(
        {"", "and " + std::to_string(count_ - kept_.size()) + " more faults, which are not listed"});
  }
  throw SceneError(std::move(faults));
}

const Origin* Faults::to_file(std::string& pointer) const {
  for (std::size_t slash = pointer.find('/', 1); !origins_.empty() && slash != std::string::npos;
       slash = pointer.find('/', slash + 1)) {
    const auto list = origins_.find(pointer.substr(0, slash));
    if (list == origins_.end()) continue;
    const std::size_t end = std::min(pointer.find('/', slash + 1), pointer.size());
    const Origin& origin = list->second[std::stoul(pointer.substr(slash + 1, end - slash - 1))];
    pointer.replace(slash + 1, end - slash - 1, std::to_string(origin.entry));
    if (!origin.list.empty()) pointer.replace(0, slash, origin.list);
    return &origin;
  }
  return nullptr;
}

std::string Faults::reported(const std::string& pointer) const {
  std::string in_file = pointer;
  const Origin* origin = to_file(in_file);
  if (origin == nullptr || origin->index.empty()) return in_file;
  return in_file + " for " + origin->index + " = " + std::to_string(origin->number);
}

std::string child(std::string_view pointer, std::string_view key) {
  std::string result(pointer);
  result += '/';
  for (const char c : key)
    if (c == '~')
      result += "~0";
    else if (c == '/')
      result += "~1";
    else
      result += c;
  return result;
}

std::string child(std::string_view pointer, std::size_t index) {
  return std::string(pointer) + '/' + std::to_string(index);
}

std::string number_text(double value) {
  if (value == 0 && std::signbit(value)) return "-0.0";  // "-0" is read as an integer, which has no sign
  return results::shortest(value);
}

std::string quoted(std::string_view text) {
  std::string inside;
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      inside += '\\';
      inside += c;
    } else if (c == '\n') {
      inside += "\\n";
    } else if (c == '\t') {
      inside += "\\t";
    } else {
      inside += c;
    }
  }
  return '"' + results::visible(inside) + '"';
}

std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60;
  if (text.size() <= longest) return quoted(text);
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80)
    --end;  // not in the middle of a character of UTF-8
  return quoted(text.substr(0, end)) + "... (" + std::to_string(text.size()) + " bytes)";
}

std::string listed(std::span<const std::string> words) {
  constexpr std::size_t most = 20;
  std::string result;
  for (std::size_t i = 0; i < words.size() && i < most; ++i) result += (i == 0 ? "" : ", ") + shown(words[i]);
  if (words.size() > most) result += ", ... (" + std::to_string(words.size()) + " in all)";
  return result;
}

std::string hint(std::string_view word, std::span<const std::string> known) {
  constexpr std::size_t most = 10'000;  // a search for each of many faults must not take minutes
  const std::string near = known.size() <= most ? nearest(word, known) : "";
  return near.empty() ? "" : "; did you mean " + file::quoted(near) + "?";
}

bool within(const Field& field, double value) {
  return std::isfinite(value) && value <= field.upper &&
         (field.lower_open ? value > field.lower : value >= field.lower);
}

void narrow(Field& field, const Field& by) {
  if (by.lower > field.lower) {
    field.lower = by.lower;
    field.lower_open = by.lower_open;
  } else if (by.lower == field.lower) {
    field.lower_open = field.lower_open || by.lower_open;
  }
  field.upper = std::min(field.upper, by.upper);
}

std::string allowed_text(const Field& field) {
  const std::string unit = field.unit == "-" || field.unit.empty() ? "" : " " + std::string(field.unit);
  const bool below = std::isfinite(field.lower), above = std::isfinite(field.upper);
  const std::string lower = (field.lower_open ? "above " : "at least ") + number_text(field.lower);
  const std::string upper = "at most " + number_text(field.upper);
  if (below && above) return lower + " and " + upper + unit;
  if (below || above) return (below ? lower : upper) + unit;
  return "a finite number" + (unit.empty() ? unit : " (" + std::string(field.unit) + ")");
}

std::string bound_fault(const Field& field, double value) {
  return "found " + number_text(value) + ", must be " + allowed_text(field);
}

}  // namespace file

// The known word most similar to a misspelt one.

namespace {

constexpr std::size_t longest_word = 128;  // longer words are no typing errors

char lower_case_letter(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// Edits (insert, delete, replace, swap of two neighbours) from a to b, whatever the case of the letters
// (optimal string alignment distance: Damerau 1964).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower_case_letter(a[i - 1]) == lower_case_letter(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0u : 1u)});
      if (i > 1 && j > 1 && lower_case_letter(a[i - 1]) == lower_case_letter(b[j - 2]) &&
          lower_case_letter(a[i - 2]) == lower_case_letter(b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

// The first "part.field" whose field is the word, for a parameter that is given without its part.
std::string with_field(std::string_view word, std::span<const std::string> known) {
  const auto found = std::find_if(known.begin(), known.end(), [&](const std::string& candidate) {
    const auto point = candidate.rfind('.');
    return point != std::string::npos && std::string_view(candidate).substr(point + 1) == word;
  });
  return found != known.end() ? *found : "";
}

}  // namespace

std::string nearest(std::string_view word, std::span<const std::string> known) {
  if (word.size() > longest_word) return {};
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t longer = std::max(word.size(), candidate.size());
    if (longer - std::min(word.size(), candidate.size()) >= least)
      continue;  // the lengths alone differ by more
    const std::size_t edits = distance(word, candidate);
    if (edits < least && edits < longer) {  // edits == longer: no letter in common
      least = edits;
      best = candidate;
    }
  }
  return best.empty() ? with_field(word, known) : best;
}

}  // namespace arcslip::scene

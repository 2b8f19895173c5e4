// Files of parts of an ensemble as one.
#include <arcslip/ensemble/difference.hpp>
#include <arcslip/ensemble/ensemble.hpp>
#include <arcslip/ensemble/ensemble_file.hpp>
#include <arcslip/results/text.hpp>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace arcslip::ensemble {
namespace {

std::string shown_path(const std::string& path) {
  return results::visible(path);
}

std::string shown_range(const Range& range) {
  return range.end - range.begin == 1
             ? "sample " + std::to_string(range.begin)
             : "samples " + std::to_string(range.begin) + " to " + std::to_string(range.end - 1);
}

struct PartFile {
  std::string path;
  Contents contents;
};

/// Reads what a part holds. Throws OtherEnsemble where it is not whole.
PartFile read_part(const std::string& path) {
  Database database(path, Database::Access::read);
  PartFile part{path, contents_of(database)};
  const std::vector<Range> missing = missing_in(database, part.contents.samples);
  if (!missing.empty())
    throw OtherEnsemble(shown_path(path) + ": " + shown_range(missing.front()) +
                        (missing.size() > 1 ? ", and others," : "") +
                        " not computed yet: run arcslip ensemble for this part again");
  return part;
}

/// Throws where two parts are of different ensembles.
void compare(const PartFile& first, const PartFile& other) {
  for (const auto& [key, value] : first.contents.facts) {
    const std::string found = fact_in(other.contents.facts, key);
    if (found == value) continue;
    const std::string where =
        shown_path(other.path) + ": not of the same ensemble as " + shown_path(first.path);
    if (key == "scene") throw OtherEnsemble(where + ": " + first_difference(value, found));
    throw OtherEnsemble(where + ": found " + key + " \"" + results::visible(found) + "\", must be \"" +
                        results::visible(value) + "\"");
  }
}

/// Throws where samples are in no part, or in several. The parts are in the order of their samples.
void check_cover(const std::vector<PartFile>& parts) {
  const long count = std::stol(fact_in(parts.front().contents.facts, "count"));
  long next = 0;
  const PartFile* before = nullptr;
  for (const PartFile& part : parts) {
    const Range& range = part.contents.samples;
    if (range.begin > next) throw OtherEnsemble(shown_range({next, range.begin}) + " in none of the parts");
    if (range.begin < next && before != nullptr)
      throw OtherEnsemble(shown_range({range.begin, std::min(next, range.end)}) + " both in " +
                          shown_path(before->path) + " and in " + shown_path(part.path));
    next = std::max(next, range.end);
    before = &part;
  }
  if (next < count) throw OtherEnsemble(shown_range({next, count}) + " in none of the parts");
}

void copy_part(Database& to, const PartFile& part) {
  Statement attach(to, "ATTACH ? AS part");
  attach.bind(0, part.path.starts_with('/') ? part.path : "./" + part.path);
  attach.run();
  to.execute("BEGIN");
  to.execute("INSERT INTO samples SELECT * FROM part.samples ORDER BY sample");
  for (const auto& [name, columns] : part.contents.tables)
    to.execute("INSERT INTO " + quoted_name(name) + " SELECT * FROM part." + quoted_name(name) +
               " ORDER BY rowid");
  to.execute("COMMIT");
  to.execute("DETACH part");
}

}  // namespace

Progress merge(const std::vector<std::string>& paths, const std::string& path,
               const control::Control& control) {
  if (std::filesystem::exists(path))
    throw OtherEnsemble(shown_path(path) +
                        ": found a file, must be a new one: remove it, or give another --out");
  std::vector<PartFile> parts;
  for (const std::string& each : paths) parts.push_back(read_part(each));
  for (const PartFile& part : parts) compare(parts.front(), part);
  std::stable_sort(parts.begin(), parts.end(), [](const PartFile& a, const PartFile& b) {
    return a.contents.samples.begin < b.contents.samples.begin;
  });
  std::erase_if(
      parts, [](const PartFile& part) { return part.contents.samples.begin == part.contents.samples.end; });
  if (parts.empty()) throw OtherEnsemble("the parts have no samples");
  check_cover(parts);
  const std::string unfinished = path + ".unfinished";
  std::filesystem::remove(unfinished);
  Progress progress;
  {
    Database to(unfinished, Database::Access::create);
    Contents contents = parts.front().contents;
    contents.samples = {0, parts.back().contents.samples.end};
    to.execute("PRAGMA journal_mode = OFF");  // the file has another name until it is whole
    make_tables(to, contents);
    for (const PartFile& part : parts) {
      if (!control.keep_going()) {
        std::filesystem::remove(unfinished);
        throw control::Interrupted("interrupted: no file was written");
      }
      copy_part(to, part);
    }
    progress.all = progress.done = std::get<long>(to.value("SELECT count(*) FROM samples"));
    progress.failed = std::get<long>(to.value("SELECT count(*) FROM samples WHERE status != 'complete'"));
  }
  std::filesystem::rename(unfinished, path);
  return progress;
}

}  // namespace arcslip::ensemble

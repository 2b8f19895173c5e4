// What stands in place of ensembles where SQLite was not there when the library was built.
#include <arcslip/ensemble/ensemble.hpp>

#include <arcslip/control/error.hpp>

namespace arcslip::ensemble {
namespace {

[[noreturn]] void refuse() {
  throw Error("ensembles need SQLite (package libsqlite3-dev), which was not there when this was built");
}

}  // namespace

bool is_available() {
  return false;
}

Outcome run(const scene::Scene&, const scene::Study&, const Settings&) {
  refuse();
}

std::vector<Range> prepare_file(const scene::Scene&, const scene::Study&, const Settings&) {
  refuse();
}

Progress merge(const std::vector<std::string>&, const std::string&, const control::Control&) {
  refuse();
}

std::string add_statistics(const std::string&) {
  refuse();
}

std::vector<results::FigureData> histograms(const std::string&) {
  refuse();
}

void write_csv(const std::string&, std::ostream&) {
  refuse();
}

}  // namespace arcslip::ensemble

#include "data_file.hpp"

#include <arcslip/output/atomic_file.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/studies/presentation/units.hpp>

#include <ostream>
#include <stdexcept>

namespace figures {
namespace {

void write_row(std::ostream& out, const DataFile& data, const std::vector<double>& row) {
  if (row.size() != data.columns.size())
    throw std::logic_error(data.name + ": a row of " + std::to_string(row.size()) + " for " +
                           std::to_string(data.columns.size()) + " columns");
  const char* separator = "";
  for (const double value : row) {
    out << separator << arcslip::results::shortest(value);
    separator = " ";
  }
  out << '\n';
}

}  // namespace

void write(const DataFile& data, const std::string& folder) {
  arcslip::output::write_file(folder + "/" + data.name + ".dat", [&](std::ostream& out) {
    out << "# " << data.title << "\n# scene: " << data.scene << '\n';
    for (std::size_t i = 0; i < data.columns.size(); ++i)
      out << "# " << i + 1 << ' ' << data.columns[i] << '\n';
    const char* separator = "";
    for (const Block& block : data.blocks) {
      out << separator << '"' << block.label << "\"\n";
      for (const auto& row : block.rows) write_row(out, data, row);
      separator = "\n\n";
    }
  });
}

}  // namespace figures

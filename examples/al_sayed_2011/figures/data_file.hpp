#pragma once
// The numbers behind one figure, as a table in blocks that gnuplot reads and people can.

#include <string>
#include <vector>

namespace figures {

/// One curve: rows of as many numbers as there are columns, in the order in which a line joins them.
struct Block {
  std::string label;
  std::vector<std::vector<double>> rows;
};

/// NAME.dat: a header of comments with title, scene and columns, then the blocks, each after a line with its
/// label in quotes, two empty lines between them.
struct DataFile {
  std::string name, title, scene;
  std::vector<std::string> columns;  // with their units, "frequency (Hz)"
  std::vector<Block> blocks;
};

/// Throws std::logic_error where a row has not one number for each column, output::WriteError.
void write(const DataFile& data, const std::string& folder);

}  // namespace figures

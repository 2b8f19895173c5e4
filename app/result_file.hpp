#pragma once
// Files of results, as --json writes them: read, shown as tables, drawn and compared.

#include "command_line/options.hpp"
#include "exit_code.hpp"

#include <arcslip/results/result.hpp>

#include <string>

namespace arcslip::app {

/// Whether a file is one of an ensemble: a database of SQLite.
bool is_ensemble(const std::string& path);

/// All results of a JSON file, with one schema for each list. Numbers are doubles, columns of type value.
/// Throws scene::FileError and UsageError for a file that is none of results.
results::Results read_results(const std::string& path);

/// Prints tables, with what is not complete or in doubt on standard error.
ExitCode show_results(const CommandOptions& options);

/// Draws each list of the file as a figure, whose x and y may be given, or the histograms of an ensemble.
ExitCode plot_results(const CommandOptions& options);

/// Prints what differs in two files: results, settings, ends, events, values. Counts of points may differ;
/// times and work are not compared. ExitCode::differ if anything does.
ExitCode compare_results(const CommandOptions& options);

}  // namespace arcslip::app

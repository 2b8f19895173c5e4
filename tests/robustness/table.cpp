// Prints docs/robustness.md, made from the tables that the tests run through:
// robustness_table > docs/robustness.md

#include "app/bad_inputs.hpp"
#include "app/interruptions.hpp"
#include "app/output_paths.hpp"
#include "app/results_folder.hpp"
#include "fuzz/mutation.hpp"
#include "lib/analyses/branches/parameter_ranges.hpp"
#include "lib/analyses/branches/structures.hpp"
#include "lib/analyses/responses/extremes.hpp"
#include "lib/analyses/responses/responses_at.hpp"
#include "lib/observables/truncation.hpp"
#include "lib/scene/files/mat_mutants.hpp"
#include "lib/scene/format/bad_scenes.hpp"
#include "lib/studies/mode_accuracy.hpp"
#include "optimize/certificate/tolerance_ranges.hpp"
#include "optimize/search/limited_searches.hpp"
#include "optimize/search/random_optima.hpp"

#include <arcslip/results/text.hpp>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace {

constexpr std::size_t widest = 110;  // characters of a cell

std::string shortened(const std::string& text) {
  if (text.size() <= widest) return text;
  std::size_t end = text.rfind(' ', widest);
  if (end == std::string::npos || end < widest / 2) end = widest;
  return text.substr(0, end) + " ...";
}

// Plain text of a cell, with what Markdown would take for its own marked.
std::string plain(const std::string& text) {
  std::string cell;
  for (const char c : shortened(text)) {
    if (std::string("|\\`*_<[").find(c) != std::string::npos) cell += '\\';
    cell += c;
  }
  return cell;
}

// Literal text of a cell. Inside a code span only '|' is taken for something else.
std::string literal(const std::string& text) {
  if (text.empty()) return "";
  std::string cell;
  for (const char c : shortened(text)) {
    if (c == '|') cell += '\\';
    cell += c;
  }
  const std::string fence = text.find('`') == std::string::npos ? "`" : "``";
  return fence + cell + fence;
}

std::string number(double value, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

void print_row(const std::vector<std::string>& cells) {
  std::cout << "| " << joined(cells, " | ") << " |\n";
}

void print_head(const std::vector<std::string>& titles) {
  print_row(titles);
  print_row(std::vector<std::string>(titles.size(), "---"));
}

std::string command_line(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"arcslip"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return arcslip::results::visible(joined(words, " "));
}

void print_introduction() {
  std::cout << R"(# Robustness

What Arcslip promises at the limits of its input: either the right answer of the harmonic balance equations of the
order that was asked for, with `truncation_flagged` where that order is too low to be trusted, or a clear stop with its
reason. Never a hang, a NaN or a silent wrong branch. What cannot be computed at all is an error that says what was
found, where, what is allowed and what to do, with the exit code 1 (command line, files) or 2 (scene), and no file
half-written.

Each row below is a row of a test. This page is printed by `tests/robustness/table.cpp` from the very tables that the
tests run through, and a test fails when they differ.
)";
}

void print_extremes() {
  std::cout << R"(
## Extremes

The oscillator of Al Sayed et al. (2011), `examples/al_sayed_2011/scene.json`, from 18 Hz to 22 Hz with Fn = 3 N and
N = 15 unless the row says otherwise. On every row, every point is finite, the frequency only grows (none of these
branches has a fold), and the energy from the force is what friction and dampers take. "Ends with" is the reason of each
branch's stop: `boundary` is the end of the window; `unbounded` is a resonance that neither friction nor dampers limit,
where the branch is cut and goes on beyond. The amplitude is that of the highest finite peak, from a closed form or the
reference, with the relative tolerance of the test.

)";
  print_head(
      {"what", "ends with", "finite peaks", "amplitude (m)", "tolerance", "truncation flagged", "outcome"});
  for (const auto& row : extremes::all()) {
    std::vector<std::string> reasons;
    for (const auto& reason : row.reasons) reasons.push_back(literal(std::string(reason.code)));
    const bool tested = row.amplitude > 0;
    print_row({plain(row.name), joined(reasons, ", "), row.peaks < 0 ? "several" : std::to_string(row.peaks),
               tested ? number(row.amplitude, "%.10g") : "", tested ? number(row.tolerance, "%.0e") : "",
               row.flagged ? "yes" : "no", plain(row.outcome)});
  }
  std::cout << R"(
The row of N = 501 is among the long tests (ctest label `long`). So are the sweeps of
`tests/lib/analyses/responses/sweeps.cpp`, which hold the peaks of every load against the exact solution with N = 101, and many
slip phases at low frequency with an order past the resonance; they run in reduced size, and in full with
`ARCSLIP_FULL=1 tests/run -L long`.
)";
}

void print_random_scenes() {
  std::cout << R"(
## Random structures

Chains of 1 to 5 masses with 1 to 5 friction dampers, random in stiffness, load, place, window and order up to 15
(`tests/lib/hbm/random_scenes.hpp`), excited in harmonic 1, in 1 and 3, or in 1 and 2. On each, the branch is complete and
only grows in frequency, no point is higher than both neighbours without a peak between them, and where the amplitude
changes most from one point to the next, responses found from nothing in between leave no gap. 40 of each kind are among
the long tests, the same on every machine; `ARCSLIP_SCENES=1000 tests/run -R random` runs the first 1000 of each.
)";
}

void print_bad_inputs() {
  std::cout << R"(
## Bad input of the command

Run in a folder that holds the paper's scene as `scene.json`; `bad.json` and `bare.json` hold what the first column
says. "Says" is part of what stands on standard error. The test also holds that no file was left and none was changed.

)";
  print_head({"what", "command", "exit code", "says"});
  for (const auto& row : app_test::bad_inputs()) {
    std::string line = command_line(row.arguments);
    if (!row.output.empty()) line += " > " + row.output;
    print_row({plain(row.name), literal(line), std::to_string(row.exit_code), literal(row.message)});
  }
}

void print_interruptions() {
  std::cout << R"(
## Interruptions

A run that takes minutes, `long.json`, is sent a signal in the middle. Every file that is left is whole.

)";
  print_head({"what", "command", "exit code", "says", "files left"});
  for (const auto& row : app_test::interruptions()) {
    std::vector<std::string> files;
    for (const auto& file : row.files) files.push_back(literal(file));
    print_row({plain(row.name), literal(command_line(row.arguments)),
               row.exit_code < 0 ? "none, ended by the signal" : std::to_string(row.exit_code),
               literal(row.message), files.empty() ? "none" : joined(files, ", ")});
  }
}

std::string all_files(const std::vector<std::string>& names) {
  std::vector<std::string> files;
  for (const auto& name : names) files.push_back(literal(name));
  return files.empty() ? "none" : joined(files, ", ");
}

void print_random_interruptions() {
  std::cout << R"(
The commands below, each with a scene of the examples, are sent SIGINT or SIGTERM at moments that are spread evenly over
the time they take, some of them with `--quiet`. The files are there before. Each time the command ends by itself and
within one second of work, with 0 or with 3 and a sentence on standard error; each file is what it was or whole; and no
other file is left. Where no study was started, every file is unchanged.

)";
  print_head({"command", "files"});
  for (const auto& row : app_test::random_interruptions())
    print_row({literal(command_line(row.arguments)), all_files(row.files)});
}

void print_output_paths() {
  std::cout << R"(
## Paths of the output

Disks that are full, streams that are closed, readers that are slow or go away: run for frf, trace, peaks, time and
optimize in place of `VERB`. What goes elsewhere is complete. `a.txt` is standard output; a disk of 4 kB is a file system
of this size, where the machine allows to mount one.

)";
  print_head({"what", "commands", "exit code", "says", "complete"});
  for (const auto& row : app_test::output_paths())
    print_row({plain(row.name), literal(row.script), std::to_string(row.exit_code), literal(row.message),
               all_files(row.whole)});
}

void print_volume() {
  std::cout << R"(
## At volume

Random cases, the same on every machine but for the moments of signals. The tests run some of them; with
`ARCSLIP_FULL=1`, or the number in the variable, as many as stand here.

)";
  print_head({"what", "in the tests", "in full", "command", "largest run so far"});
  const auto row = [](const char* what, const Volume& volume, std::uint64_t times, const char* test,
                      const char* figures) {
    print_row({what, std::to_string(volume.reduced * times), std::to_string(volume.full * times),
               literal(std::string(volume.variable) + "=" + std::to_string(volume.full) + " tests/run -R \"" +
                       test + "\""),
               figures});
  };
  row("mutants of scenes, read, written, read again and traced", fuzz::mutants, 1, "mutants of scenes",
      "100 000: nothing crashed or hung, all that was read came back as written, and what was not finite, a "
      "truncation estimate, was flagged. The same under the address and undefined-behaviour sanitizers, "
      "twice. The second time two were wrong: a fault of a factor in `mistuning` had a pointer that leads "
      "nowhere, and where a stiffness over a mass overflows, the largest of an empty list was read. Both are "
      "mended. And 45 000 of libFuzzer, but for one response, huge at its first frequency, for which memory "
      "before a list was read. It is mended and in the corpus");
  row("mutants of MATLAB files of version 5 and 7.3, plain and compressed, each read for two variables",
      mat_mutants, 4, "mutated MATLAB files",
      "28 000: all read or refused. Of the compressed ones of version 7.3, 9 of 14 000 times HDF5 ended the "
      "program that reads them by a signal, which is reported as damage. 20 000 under the address and "
      "undefined-behaviour sanitizers, with that program under them as well, without its limits: "
      "nothing was "
      "found");
  row("signals at random moments, of SIGINT and SIGTERM", app_test::random_moments,
      app_test::random_interruptions().size(), "a signal at any moment",
      "14 100: 930 of each command below \"Interruptions\", and of the first four 890 to 1000 more. All "
      "files whole, none silent, none left over");
  row("kills of `run`, `reduce` and `optimize` that write over older results", app_test::kills, 3,
      "killed at any moment", "201: each mix of old and new files reported by the manifest");
  row("random searches with limits over 1 to 4 parameters, on sums, energy, frequency and stick, compared "
      "with "
      "searches by LN_COBYLA and LD_MMA from the lowest of forty other designs over the bounds",
      limited_searches::number, 1, "random searches with limits",
      "1014. 780 of the seeds up to 999, those with the quicker responses: 446 with searches elsewhere as "
      "they are "
      "now, the last 138 of them after the last change; 70 before compared with the same other ways, 264 "
      "compared with LN_COBYLA alone. 613 complete, none above the other ways by more than 7e-8 and 82 below "
      "them by more "
      "than 1e-6, all limits kept in responses of their own; 150 for which no way has a design within the "
      "limits; 16 stopped where no conditions of a minimum hold, at a jump, or a kink of the amplitude or of "
      "a limit, none above the other ways by more than 3e-7; one stopped at its evaluations, 0.8 % above "
      "them (seed 625). 14 were cut after one to five minutes, 7 have no limit, 199 were not run. Complete "
      "is a local minimum: before, four ended complete above the other ways, by up to 6 % (seeds 209, 546, "
      "885, 906). Of further seeds up to 1319, again the quicker ones, 234: 183 complete, of which one is a "
      "higher minimum than LD_MMA comes to from a grid, by 0.08 % (seed 1111), the others within 1e-7 of the "
      "other ways or below them; 45 without a design within the limits; six stopped, none above the other "
      "ways; seven more cut after some minutes");
  row("linear absorbers over one parameter or two: each end of a tolerance range, and twenty places on the "
      "way "
      "there, compared with the closed form of the response",
      tolerance_ranges::absorbers, 1, "tolerance ranges of random absorbers",
      "500: all ends where the peak is 1 or 5 % up, to 1e-9");
  row("random structures with friction: optima over one load or two, compared with responses of their own, "
      "each end "
      "of "
      "their tolerance ranges and three places on the way there",
      random_optima::with_ranges, 1, "random optima have the amplitude",
      "500: 327 complete, with 1804 ends of ranges, all within 1e-6. Before, of 90 one range went through a "
      "part in "
      "which the amplitude was 5.3 % up");
  row("optima of random structures in windows and bounds that may miss the resonances, compared with a "
      "response "
      "over "
      "a wide window",
      random_optima::with_other_windows, 1, "random optima in windows",
      "300: 200 have their highest value at an end of the window and a higher peak beyond, and say so; 98 "
      "are "
      "complete, none of them compared with one, and 2 are stopped where no condition of a minimum holds. "
      "Before, "
      "22 in "
      "which no load had an influence were complete");
  row("conservative oscillators with a cubic spring and a stop, over four decades of amplitude: the "
      "frequency "
      "of their modes compared with the energy integral",
      mode_accuracy::conservative, 1, "conservative modes over four decades",
      "100, with 31 650 motions: all within the 1e-4 that was asked for, and within twice the error "
      "reported");
  row("damped oscillators with a slider and some with a cubic spring, over four decades of amplitude: "
      "frequency "
      "and damping ratio of their modes compared with shooting with Runge-Kutta steps",
      mode_accuracy::damped, 1, "damped modes over four decades", "300, with 2376 motions: likewise");
  row("the same with a second mass", mode_accuracy::two_masses, 1, "damped modes of two masses",
      "100, of which 60 have no fold of an internal resonance, with 1904 motions: likewise");
  row("frequencies from 1e-8 to 1e-2 next to a fold of a Duffing oscillator: how many responses are found, "
      "compared with "
      "the cubic equation of one harmonic",
      responses_at::near_folds, 1, "next to a fold as many responses", "5000: as many at each");
  row("windows that begin or end within the hysteresis of a Duffing oscillator: how many responses their "
      "ends "
      "have, compared with the cubic equation of one harmonic",
      responses_at::within_hystereses, 1, "a frequency response has all responses at the ends",
      "1000: as many at each");
  row("structures of one to three masses with an element of each of 15 laws, orders 3 to 11: truncation "
      "estimates at points and peaks, compared with the error that three times the order reports, and of "
      "piecewise "
      "linear "
      "laws at points compared with the exact motion in time",
      truncation::each_law, truncation::law_count, "truncation estimates of each law",
      "225, with 3203 estimates that are not flagged, 292 of them compared with the motion in time: 3 are "
      "below "
      "half of the "
      "error. Two of these are peaks of a contact in a plane, within 2e-6 of the amplitude, where a kink "
      "was passed at which it begins to slip. Of 100 Bouc-Wen elements one of 2200; before, 14 of 1301 "
      "points and 15 peaks");
  row("random structures of 1 to 6 masses with friction, some with cubic springs, in all units, names, "
      "orders and directions",
      structures::number, 1, "structures:",
      "all, 0 to 499 and those from 1604 on since the last changes: with exact friction the same events "
      "in all but one, which has a peak that is said not to be located. Of 1600 with exact friction 8 had"
      " a peak more in steps a tenth as long; these have the same ones now. 200 harder ones with all "
      "invariances (`ARCSLIP_INVARIANCES=200 tests/run -R \"under all invariances\"`): the same events to "
      "1e-10, and the same bits in units of two, in all 4589 checks");
  row("random joints of 5 to 40 contacts, from nearly full stick to nearly full slip: their frequency "
      "responses in one, two and four threads, and of one in four three points about the peak by "
      "integration in time",
      {"ARCSLIP_SCENES", 6, 200}, 1, "random joints",
      "in threads all 200: complete, with the same bits. In time 50: of 145 points without a flagged "
      "estimate none has an error"
      " above 1.2 times it, and five flagged ones are off by at most 8 %");
  row("an oscillator with a slider, two masses with a stop, and a contact with separation, all parameters "
      "between 1e-30 and 1e30 times what is usual, 0 and negative, each eighth point compared with equations "
      "in "
      "extended precision",
      parameter_ranges::random_scenes, 1, "all parameters at random",
      "100 400 scenes. Of the last 78 000, each eighth point: 1 614 405 points of 78 167 branches, of "
      "which 537 584 have a flagged truncation estimate and 21 380 are farther than 1e-9 from the "
      "branch, by the rounding of an ill-conditioned equation. Branches: 71 865 reach the end of the "
      "window; 5205 find no first response: 4039 with a negative spring or without one, 1157 whose mean"
      " position nothing holds, six with stiffnesses too far apart, which the message says, and three "
      "that should have one (seeds 28982, 48920, 87716); 455 grow until rounding destroys them; 304 end"
      " with steps too small, 172 at an unbounded resonance; 166 were cut at 2000 points or 5 s. In 41 "
      "scenes a point is farther off than allowed: in 30 from the branch, at most 7e-7 (seed 76820) and"
      " in all but six below 3e-8; in 14 from the closed form of a motion in one state, at most 6e-7 "
      "but for two with flagged estimates, 5e-6 (seed 33706) and the last point of a branch that stops "
      "(seed 42499); in four the terms of a residual are too small to be compared. The first 22 400 had"
      " three such points, at most 6e-8 off, since the corrector looks for kinks where its last "
      "correction may have crossed one");
  std::cout << R"(
With sampled friction a response has the same amplitude at a frequency in all units, names and orders, to 1e-9, but not
the same set of peaks: each sample that begins or ceases to slip, 256 of them for each damper in these structures, is a
kink, and the curve between two of them is off the smooth one by a part of the error of sampling, which falls with the
square of the number of samples. Such small peaks lie closer than steps, and steps do not stop at each of the kinks;
which of them are met depends on where steps end, and that on rounding. Of 130 such structures 70 had another set of
peaks in some variant; their highest peaks were the same to 4e-4, in all but two within the distance from the peak with
exact friction. Peaks that are to be the same ones want exact friction, the default.
)";
}

void print_bad_scenes() {
  std::cout << R"(
## Faults of a scene file

Each is one fault in a sound scene; the command ends with exit code 2. All faults of a file are reported in one go, each
with the JSON pointer of its place. Without a pointer the file is no JSON, and the message reports line and column where
it can.

)";
  print_head({"what", "pointer", "says"});
  for (const auto& row : arcslip::scene::test::bad_scenes())
    print_row({plain(row.name), literal(row.pointer), literal(row.message_part)});
}

}  // namespace

int main() try {
  print_introduction();
  print_extremes();
  print_random_scenes();
  print_bad_inputs();
  print_interruptions();
  print_random_interruptions();
  print_output_paths();
  print_volume();
  print_bad_scenes();
  std::cout.flush();
  return std::cout ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return EXIT_FAILURE;
}

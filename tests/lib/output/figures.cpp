#include "catch.hpp"
#include "lib/output/support.hpp"

#include <arcslip/control/run_control.hpp>
#include <arcslip/output/atomic_file.hpp>
#include <arcslip/output/figures.hpp>
#include <arcslip/output/process.hpp>
#include <arcslip/studies/presentation/figures.hpp>

#include <chrono>
#include <csignal>
#include <cstdlib>

#include <unistd.h>

using namespace arcslip;
using studies::BranchKind;
using support::content;
using support::TemporaryFolder;

namespace {

/// PATH is this while it lives.
class SearchPath {
 public:
  explicit SearchPath(const std::string& path) : old_(std::getenv("PATH")) {
    ::setenv("PATH", path.c_str(), 1);
  }
  SearchPath(const SearchPath&) = delete;
  SearchPath& operator=(const SearchPath&) = delete;
  ~SearchPath() { ::setenv("PATH", old_.c_str(), 1); }

 private:
  std::string old_;
};

bool have_gnuplot() {
  return output::run_program("gnuplot", {"--version"}, ".").end != output::ProcessEnd::not_found;
}

void write_program(const std::string& path, const std::string& script) {
  output::write_file(path, [&](std::ostream& out) { out << "#!/bin/sh\n" << script; });
  support::fs::permissions(path, support::fs::perms::owner_all);
}

output::Figures drawn(const scene::Scene& scene, BranchKind kind,
                      const std::vector<observables::ResponseBranch>& branches, const std::string& folder,
                      const std::string& name) {
  return output::draw_figures(studies::figures_of(scene, kind, branches), folder, name);
}

}  // namespace

TEST_CASE("figures come as whole SVG and PNG, amplitude and stick share") {
  if (!have_gnuplot()) {
    WARN("gnuplot is not there");
    return;
  }
  const TemporaryFolder folder;
  const std::vector branches{support::branch(1), support::branch(3)};
  const auto figures = drawn(support::scene(), BranchKind::responses, branches, folder.path(), "frf");
  CHECK(figures.problem.empty());
  CHECK(figures.sources == std::vector<std::string>{folder / "frf.dat", folder / "frf.gp"});
  CHECK(figures.images == std::vector<std::string>{folder / "frf_amplitude.svg", folder / "frf_amplitude.png",
                                                   folder / "frf_stick.svg", folder / "frf_stick.png"});
  const std::string svg = content(folder / "frf_amplitude.svg");
  for (const char* text :
       {"amplitude (mm)", "frequency (Hz)", "A slider", "damper normal load", "3 N", "peak"}) {
    CAPTURE(text);
    CHECK(svg.find(text) != std::string::npos);
  }
  CHECK(content(folder / "frf_amplitude.png").substr(1, 3) == "PNG");
  CHECK(folder.files() == 6);
}

TEST_CASE("no name or title runs a command or breaks a figure") {
  if (!have_gnuplot()) return;
  const TemporaryFolder folder;
  const std::string evil =
      "'; system('touch broken'); #\n`touch broken` $(touch broken) \" \\ {/=99 x}_a^b @m";
  auto branch = support::branch();
  for (auto& point : branch.points) {
    point.elements[0].name = evil;
    point.elements.push_back({"other", true, 10, {}, {}, 0, {}});
  }
  auto scene = support::scene(evil);
  scene.elements[0].name = evil;
  branch.set = {{evil + ".normal_load", 3}};
  const auto figures = drawn(scene, BranchKind::responses, std::vector{branch}, folder.path(), evil);
  CHECK(figures.problem == "");
  CHECK(figures.images.size() == 6);
  CHECK_FALSE(support::fs::exists(folder / "broken"));
}

TEST_CASE("results that are hard to draw are drawn") {
  if (!have_gnuplot()) return;
  auto zero = support::branch();
  auto one_point = support::branch();
  auto unbounded = support::branch();
  auto no_friction = support::branch();
  for (auto& point : zero.points) point.amplitude = 0;
  zero.events.clear();
  one_point.points.resize(1);
  unbounded.events[0].point.unbounded = true;
  unbounded.events[0].point.elements.clear();
  auto huge = support::branch();
  huge.points[2].amplitude = 1e40;
  huge.points[3].amplitude = 1e-40;
  for (auto& point : no_friction.points) point.elements.clear();
  const std::vector<std::pair<std::string, std::vector<observables::ResponseBranch>>> cases{
      {"zero", {zero}},
      {"one_point", {one_point}},
      {"unbounded", {unbounded, support::branch(5)}},
      {"no_friction", {no_friction}},
      {"huge", {huge}},
      {"many", std::vector<observables::ResponseBranch>(60, support::branch())}};
  for (const auto& [name, given] : cases) {
    CAPTURE(name);
    const TemporaryFolder folder;
    auto branches = given;
    for (std::size_t i = 0; i < branches.size(); ++i) branches[i].set[0].second = static_cast<double>(i);
    const auto figures = drawn(support::scene(), BranchKind::responses, branches, folder.path(), name);
    CHECK(figures.problem == "");
    CHECK(figures.images.size() == (name == "no_friction" ? 2 : 4));
  }
}

TEST_CASE("a study over a parameter that is hard to draw is drawn") {
  if (!have_gnuplot()) return;
  auto one_point = support::peaks();
  one_point.points.resize(1);
  one_point.events.clear();
  auto at_zero = one_point;
  at_zero.points[0].over = 0;
  at_zero.points[0].amplitude = 0;
  auto negative = support::peaks();
  auto nearly_constant = support::peaks();
  for (std::size_t i = 0; i < nearly_constant.points.size(); ++i) {
    nearly_constant.points[i].omega = 100 + 1e-13 * static_cast<double>(i % 2);
    nearly_constant.points[i].amplitude = -1 - 1e-15 * static_cast<double>(i % 2);
  }
  nearly_constant.events.clear();
  auto unbounded = support::peaks();
  for (auto& point : negative.points) point.over = -point.over;
  for (auto& point : unbounded.points) point.unbounded = true;
  for (const BranchKind kind : {BranchKind::over_parameter, BranchKind::peaks, BranchKind::folds}) {
    for (const auto& branch : {one_point, at_zero, negative, nearly_constant, unbounded}) {
      CAPTURE(static_cast<int>(kind), branch.points[0].over, branch.points[0].unbounded);
      const TemporaryFolder folder;
      const auto figures = drawn(support::scene(), kind, std::vector{branch}, folder.path(), "x");
      CHECK(figures.problem == "");
      CHECK_FALSE(figures.images.empty());
    }
  }
}

TEST_CASE("branches without a point give data and a reason, and no figure") {
  const TemporaryFolder folder;
  auto branch = support::branch();
  branch.points.clear();
  const auto figures =
      drawn(support::scene(), BranchKind::responses, std::vector{branch}, folder.path(), "frf");
  CHECK(figures.problem == "no figure was drawn: there are no points");
  CHECK(figures.images.empty());
  CHECK(folder.files() == 2);
}

TEST_CASE("without gnuplot there are the data, the script and a plain message") {
  const TemporaryFolder folder;
  const SearchPath nothing("/nonexistent");
  const auto figures =
      drawn(support::scene(), BranchKind::responses, std::vector{support::branch()}, folder.path(), "frf");
  CHECK(figures.problem.find("figures need gnuplot (Debian package gnuplot-nox)") == 0);
  CHECK(figures.images.empty());
  CHECK(folder.files() == 2);
}

TEST_CASE("a gnuplot that fails, is killed or stops half way leaves a message and no half figure") {
  const TemporaryFolder programs;
  struct Case {
    std::string script, message;
  };
  const std::vector<Case> cases{
      {"echo no such terminal >&2; exit 3", "gnuplot could not draw the figures (exit code 3)"},
      {"kill -9 $$", "gnuplot was ended by signal 9"},
      {"s=${3#suffix=\\'}; echo '<svg>' > frf_amplitude.svg${s%\\'}", "gnuplot left a figure incomplete"}};
  for (const Case& c : cases) {
    CAPTURE(c.script);
    const TemporaryFolder folder;
    write_program(programs / "gnuplot", c.script);
    const SearchPath path(programs.path() + ":/usr/bin:/bin");
    const auto figures =
        drawn(support::scene(), BranchKind::responses, std::vector{support::branch()}, folder.path(), "frf");
    CHECK(figures.problem.find(c.message) == 0);
    CHECK(figures.images.empty());
    CHECK(folder.files() == 2);
  }
}

TEST_CASE("what a failing gnuplot says is reported") {
  const TemporaryFolder folder;
  const TemporaryFolder programs;
  write_program(programs / "gnuplot", "echo no such terminal >&2; exit 3");
  const SearchPath path(programs.path() + ":/usr/bin:/bin");
  const auto figures =
      drawn(support::scene(), BranchKind::responses, std::vector{support::branch()}, folder.path(), "frf");
  CHECK(figures.problem.find("\nno such terminal") != std::string::npos);
}

TEST_CASE("a program that takes too long, or is asked to stop, is ended with all that it has started") {
  const TemporaryFolder folder;
  const std::string script = "sleep 600 & echo $! > child; echo said; exec sleep 600";
  for (const bool asked : {false, true}) {
    const control::Control control(
        {.poll = [&] { return !asked || !support::fs::exists(folder / "child"); }});
    const output::ProcessLimits limits{control, std::chrono::milliseconds(asked ? 600'000 : 500)};
    const auto result = output::run_program("sh", {"-c", script}, folder.path(), limits);
    CHECK(result.end == (asked ? output::ProcessEnd::stopped : output::ProcessEnd::out_of_time));
    CHECK(result.signal == SIGKILL);
    const pid_t child = std::stoi(content(folder / "child"));
    for (int i = 0; i < 200 && ::kill(child, 0) == 0; ++i) ::usleep(10'000);  // until it is gone
    CHECK((::kill(child, 0) != 0 ||
           content("/proc/" + std::to_string(child) + "/stat").find(") Z ") != std::string::npos));
    support::fs::remove(folder / "child");
  }
}

TEST_CASE(
    "a gnuplot that the system cannot start is a problem in words, and no image that is there is touched") {
  const TemporaryFolder folder, programs;
  output::write_file(programs / "gnuplot", [](std::ostream& out) { out << "no program"; });
  support::fs::permissions(programs / "gnuplot", support::fs::perms::owner_all);
  const SearchPath path(programs.path());
  output::write_file(folder / "frf_amplitude.svg", [](std::ostream& out) { out << "mine"; });
  const auto figures =
      drawn(support::scene(), BranchKind::responses, std::vector{support::branch()}, folder.path(), "frf");
  CHECK(figures.problem.find(
            "gnuplot cannot be started (Exec format error); the data and the script were written") == 0);
  CHECK(folder.files() == 3);
  CHECK(content(folder / "frf_amplitude.svg") == "mine");
}

TEST_CASE("the names of all files that figures may write are known before") {
  if (!have_gnuplot()) return;
  const TemporaryFolder folder;
  const auto data =
      studies::figures_of(support::scene(), BranchKind::responses, std::vector{support::branch()});
  const std::vector<std::string> names = output::figure_files(data, "frf");
  const auto figures = output::draw_figures(data, folder.path(), "frf");
  CHECK(figures.images.size() >= 2);
  for (const auto& paths : {figures.sources, figures.images})
    for (const std::string& written : paths)
      CHECK(std::find(names.begin(), names.end(), support::fs::path(written).filename().string()) !=
            names.end());
}

TEST_CASE("the data of a figure has blocks for each line and its marks, in SI units") {
  const TemporaryFolder folder;
  const SearchPath nothing("/nonexistent");
  auto second = support::branch();  // goes on beyond a cut: the same line
  second.events.clear();
  drawn(support::scene(), BranchKind::responses, std::vector{support::branch(), second}, folder.path(),
        "frf");
  const std::string data = content(folder / "frf.dat");
  CHECK(data.find("# amplitude: amplitude (mm) over frequency (Hz), both without the prefixes of their "
                  "units\n# damper.normal_load = 3 N\n1 0.01\n") == 0);
  CHECK(data.find("2 0.005\n\n1 0.01\n") != std::string::npos);
  CHECK(data.find("2 0.005\n\n\n# resonance peak\n1.5 0.1\n\n\n") != std::string::npos);
}

TEST_CASE("peaks over a parameter are drawn as amplitude, frequency, and amplitude over the stick share") {
  if (!have_gnuplot()) return;
  const TemporaryFolder folder;
  const auto figures =
      drawn(support::scene(), BranchKind::peaks, std::vector{support::peaks()}, folder.path(), "peaks");
  CHECK(figures.problem.empty());
  CHECK(figures.images ==
        std::vector<std::string>{folder / "peaks_amplitude.svg", folder / "peaks_amplitude.png",
                                 folder / "peaks_frequency.svg", folder / "peaks_frequency.png",
                                 folder / "peaks_amplitude_over_stick.svg",
                                 folder / "peaks_amplitude_over_stick.png"});
  struct Case {
    std::string figure;
    std::vector<std::string> texts;
  };
  const std::vector<Case> cases{
      {"peaks_amplitude.svg", {"damper normal load (N)", "peak amplitude (mm)", "minimum"}},
      {"peaks_frequency.svg", {"damper normal load (N)", "resonance frequency (Hz)"}},
      {"peaks_amplitude_over_stick.svg", {"stick of the period (%)", "peak amplitude (mm)"}}};
  for (const Case& c : cases) {
    for (const std::string& text : c.texts) {
      CAPTURE(c.figure, text);
      CHECK(content(folder / c.figure).find(text) != std::string::npos);
    }
  }
}

TEST_CASE("marks of a user's own kind of events follow those of the table, with their words in the key") {
  const TemporaryFolder folder;
  auto data = studies::figures_of(support::scene(), BranchKind::responses, std::vector{support::branch()});
  results::FigureLine& line = data.lines[0];
  REQUIRE(line.marks.size() == 1);
  const results::EventKind lift_off{
      .name = "lift_off", .words = "first lift-off", .mark = {results::Shape::star, 0.5, 2.5}};
  line.marks.insert(line.marks.begin(), {lift_off, line.parts[0][0]});
  output::draw_figures(data, folder.path(), "x");
  const std::string script = content(folder / "x.gp");
  const auto peak =
      script.find(" with points pointtype 7 pointsize 0.8 linecolor rgb '#444444' title 'resonance peak'");
  const auto own = script.find(
      " with points pointtype 3 pointsize 0.5 linewidth 2.5 linecolor rgb '#444444' title 'first lift-off'");
  CHECK(peak < own);
  CHECK(own != std::string::npos);
}

TEST_CASE("bands lie behind the curve over the parameter, named in the key, and not over the stick share") {
  const TemporaryFolder folder;
  auto data = studies::figures_of(support::scene(), BranchKind::peaks, std::vector{support::peaks()});
  data.lines[0].bands = {{"within 5 %", {2.5, 6}}, {"within 1 %", {3.25, 5}}};
  data.lines[0].marks[0].label = "4.0 N";
  const auto figures = output::draw_figures(data, folder.path(), "x");
  const std::string script = content(folder / "x.gp");
  const auto part = [&](const std::string& from, const std::string& to) {
    const auto begin = script.find("# " + from + "\n");
    return script.substr(begin, script.find("# " + to + "\n") - begin);
  };
  for (const std::string& figure :
       {part("x_amplitude", "x_frequency"), part("x_frequency", "x_amplitude_over_stick")}) {
    CHECK(figure.find(" with filledcurves ") < figure.find(" with lines "));
    CHECK(figure.find("title 'within 1 %'") < figure.find("title 'within 5 %'"));
    CHECK(figure.find("title 'within 5 %'") != std::string::npos);
  }
  const std::string over_stick = script.substr(script.find("# x_amplitude_over_stick\n"));
  CHECK(over_stick.find("filledcurves") == std::string::npos);
  CHECK(over_stick.find("within") == std::string::npos);
  const std::string of_bands = content(folder / "x.dat");
  const auto wide = of_bands.find("# from and to: within 5 %\n2.5 "),
             narrow = of_bands.find("# from and to: within 1 %\n3.25 ");
  CHECK(wide < narrow);
  CHECK(narrow != std::string::npos);
  if (!have_gnuplot()) return;
  CHECK(figures.problem == "");
  const std::string svg = content(folder / "x_amplitude.svg");
  for (const char* text : {"within 1 %", "within 5 %", "4.0 N"}) {
    CAPTURE(text);
    CHECK(svg.find(text) != std::string::npos);
  }
}

TEST_CASE(
    "a trace is drawn as amplitude and stick share, a curve of folds as the parameter over the frequency") {
  const SearchPath nothing("/nonexistent");
  const auto script_of = [](BranchKind kind) {
    const TemporaryFolder folder;
    drawn(support::scene(), kind, std::vector{support::peaks()}, folder.path(), "x");
    return content(folder / "x.gp");
  };
  const std::string trace = script_of(BranchKind::over_parameter);
  CHECK(trace.find("set output 'x_amplitude.svg'") != std::string::npos);
  CHECK(trace.find("set output 'x_stick.svg'") != std::string::npos);
  CHECK(trace.find("data index 0 using 1:($2*1000) with lines") != std::string::npos);
  CHECK(trace.find("data index 3 using 1:2 with points") != std::string::npos);
  const std::string folds = script_of(BranchKind::folds);
  CHECK(folds.find("set output 'x_folds.svg'") != std::string::npos);
  CHECK(folds.find("data index 0 using 1:2 with lines") != std::string::npos);
  CHECK(folds.find("set xlabel 'frequency (Hz)'") != std::string::npos);
  CHECK(folds.find("set ylabel 'damper normal load (N)'") != std::string::npos);
}

TEST_CASE("an axis of a parameter is logarithmic where it is positive over more than a decade") {
  const SearchPath nothing("/nonexistent");
  const auto script_of = [](double first) {
    const TemporaryFolder folder;
    auto branch = support::peaks();
    branch.points[0].over = first;
    branch.points.resize(2);
    branch.events.clear();
    drawn(support::scene(), BranchKind::peaks, std::vector{branch}, folder.path(), "x");
    return content(folder / "x.gp");
  };
  CHECK(script_of(0.01).find("\nset logscale x") != std::string::npos);
  CHECK(script_of(0.01).find("set xrange [0.01:1]") != std::string::npos);
  for (const double first : {0.5, 0.0, -0.01}) {
    CAPTURE(first);
    CHECK(script_of(first).find("\nset logscale x") == std::string::npos);
  }
}

TEST_CASE("formats, size and style of images are those asked for") {
  if (!have_gnuplot()) return;
  const TemporaryFolder folder;
  const auto data = studies::figures_of(support::scene(), BranchKind::peaks, std::vector{support::peaks()});
  const auto options = [](std::vector<std::string> formats) {
    return output::FigureOptions{std::move(formats), {.width = 400, .height = 300, .is_grey = true}};
  };
  const auto figures = output::draw_figures(data, folder.path(), "x", options({"pdf", "svg", "png"}));
  CHECK(figures.problem == "");
  CHECK(figures.images.size() == 3 * data.figures.size());
  CHECK(content(folder / "x_amplitude.pdf").substr(0, 5) == "%PDF-");
  const std::string svg = content(folder / "x_amplitude.svg"), png = content(folder / "x_amplitude.png");
  CHECK(svg.find("width=\"400\" height=\"300\"") != std::string::npos);
  CHECK(svg.find("stroke='rgb(") != std::string::npos);
  CHECK(svg.find("rgb( 13,   8, 135)") == std::string::npos);  // the first colour
  const auto big_endian = [&](std::size_t at) {
    return 256 * static_cast<unsigned char>(png[at + 2]) + static_cast<unsigned char>(png[at + 3]);
  };
  CHECK(big_endian(16) == 600);
  CHECK(big_endian(20) == 450);
  const auto none = output::draw_figures(data, folder.path(), "y", options({}));
  CHECK(none.problem == "");
  CHECK(none.images.empty());
  CHECK(support::fs::exists(folder / "y.gp"));
  const auto names = output::figure_files(data, "x", options({"pdf"}));
  CHECK(std::find(names.begin(), names.end(), "x_amplitude.pdf") != names.end());
  CHECK(std::find(names.begin(), names.end(), "x_amplitude.png") == names.end());
}

TEST_CASE("one gnuplot draws the figures of several sets of curves, while the caller goes on") {
  const TemporaryFolder folder, programs;
  write_program(programs / "gnuplot", "echo $$ >> started; echo $4 $5 > scripts; sleep 1; exit 3");
  const SearchPath path(programs.path() + ":/usr/bin:/bin");
  const auto data = studies::figures_of(support::scene(), BranchKind::peaks, std::vector{support::peaks()});
  const std::vector<output::NamedFigures> both{{"a", data}, {"b", data}};
  const auto begin = std::chrono::steady_clock::now();
  output::DrawingFigures drawing(both, folder.path());
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(700));
  const auto figures = drawing.finish();
  CHECK(figures.problem.find("run gnuplot -d a.gp b.gp in " + folder.path()) != std::string::npos);
  CHECK(figures.sources ==
        std::vector<std::string>{folder / "a.dat", folder / "a.gp", folder / "b.dat", folder / "b.gp"});
  CHECK(content(folder / "scripts") == "a.gp b.gp\n");
  const std::string started = content(folder / "started");
  CHECK(std::count(started.begin(), started.end(), '\n') == 1);
}

TEST_CASE("motions of several periods and isolated branches are lines of their own, with names") {
  auto twice = support::branch(), apart = support::branch();
  twice.period = 2;
  apart.isolated = true;
  const auto data = studies::figures_of(support::scene(), BranchKind::responses,
                                        std::vector{support::branch(), twice, apart});
  REQUIRE(data.lines.size() == 3);
  CHECK(data.lines[0].label == "1 period, 3 N");
  CHECK(data.lines[1].label == "2 periods, 3 N");
  CHECK(data.lines[2].label == "1 period, isolated, 3 N");
  const auto alike = studies::figures_of(support::scene(), BranchKind::responses,
                                         std::vector{support::branch(), support::branch()});
  REQUIRE(alike.lines.size() == 1);
  CHECK(alike.lines[0].label == "3 N");
}

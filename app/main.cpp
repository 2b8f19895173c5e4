// The command arcslip: see arcslip --help.

#include "command_line/options.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "output/message.hpp"
#include "output/standard_output.hpp"
#include "verbs.hpp"

#include <arcslip/control/run_control.hpp>
#include <arcslip/optimize/studies.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <exception>
#include <new>
#include <ostream>
#include <string>

#include <fcntl.h>
#include <unistd.h>

namespace arcslip::app {
namespace {

/// Otherwise the first file opened would take the descriptor of a standard stream that is closed at startup.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0)
      ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // its use fails, as it should
}

ExitCode print(const Information& information) {
  StandardOutput screen;
  screen.write_lines([&](std::ostream& out) { out << information.text; });
  screen.finish();
  return ExitCode::done;
}

void tell_faults(const std::string& file, const scene::SceneError& error) {
  for (const scene::Fault& fault : error.faults()) {
    tell_line((file.empty() ? "arcslip" : results::visible(file)) + ": " + results::visible(fault.pointer) +
              (fault.pointer.empty() ? "" : ": ") + fault.message);
  }
}

ExitCode run_program(int argc, const char* const* argv) {
  std::string scene_file;
  try {
    scene::Catalogue catalogue = studies::catalogue();
    optimize::add_studies(catalogue);
    const auto request = parse(argc, argv, catalogue);
    if (const auto* information = std::get_if<Information>(&request)) return print(*information);
    scene_file = std::get<CommandOptions>(request).scene;
    return execute(std::get<CommandOptions>(request), catalogue);
  } catch (const scene::SceneError& error) {
    tell_faults(scene_file, error);
    return ExitCode::invalid_scene;
  } catch (const control::Interrupted& error) {
    tell(error.what());
    return ExitCode::stopped_early;
  } catch (const std::bad_alloc&) {
    tell("out of memory: use fewer harmonics, a shorter range or fewer values in for_each");
  } catch (const std::exception& error) {
    tell(error.what());
  } catch (...) {
    tell("unknown error: please report it with the scene");
  }
  return ExitCode::usage_or_file;
}

}  // namespace
}  // namespace arcslip::app

int main(int argc, char** argv) {
  arcslip::app::hold_standard_streams();
  arcslip::app::watch_signals();
  arcslip::app::leave(static_cast<int>(arcslip::app::run_program(argc, argv)));
}

#include <arcslip/output/process.hpp>

#include <arcslip/control/child_output.hpp>

#include <cerrno>
#include <system_error>

namespace arcslip::output {
namespace {

constexpr std::size_t most_text = 1u << 20;  // bytes of it that are kept

}  // namespace

ProcessResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          const std::string& folder, const ProcessLimits& limits) {
  using control::ChildOutput;
  ProcessResult result;
  try {
    ChildOutput child({program, arguments, {}, folder, true}, {limits.time, limits.control});
    while (child.read_some(result.text))
      if (result.text.size() > most_text) result.text.resize(most_text);
    result.end = child.end() == ChildOutput::End::out_of_time ? ProcessEnd::out_of_time
                 : child.end() == ChildOutput::End::stopped   ? ProcessEnd::stopped
                                                              : ProcessEnd::by_itself;
    result.exit_code = child.exit_code();
    result.signal = child.signal();
  } catch (const std::system_error& error) {  // no pipe, no process, no program in this file
    const int code = error.code().value();
    result.end =
        code == ENOENT || code == EACCES || code == ENOTDIR ? ProcessEnd::not_found : ProcessEnd::not_started;
    result.exit_code = -1;
    result.text = error.code().message();
  }
  return result;
}

}  // namespace arcslip::output

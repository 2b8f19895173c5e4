#include "answer.hpp"

#include <arcslip/scene/files/mat_protocol.hpp>

#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <utility>

namespace arcslip::mat {
namespace {

namespace protocol = scene::mat_protocol;

void write_bytes(const void* from, std::size_t bytes) {
  if (std::fwrite(from, 1, bytes, stdout) != bytes) std::_Exit(EXIT_FAILURE);
}

void write_line(const std::string& word, std::initializer_list<std::size_t> sizes) {
  std::string line = std::string(protocol::greeting) + " " + word;
  for (const std::size_t size : sizes) line += " " + std::to_string(size);
  line += '\n';
  write_bytes(line.data(), line.size());
}

std::string sent_name(const std::string& name) {
  return name.substr(0, protocol::longest_name);
}

}  // namespace

Fault::Fault(const std::string& cause, std::string variable)
    : std::runtime_error(cause), variable_(std::move(variable)) {}

void write_fault(const Fault& fault) {
  const std::string variable = sent_name(fault.variable());
  const std::string cause = std::string(fault.what()).substr(0, protocol::longest_cause);
  write_line("fault", {variable.size(), cause.size()});
  write_bytes(variable.data(), variable.size());
  write_bytes(cause.data(), cause.size());
}

void write_variables(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) (all += sent_name(name)) += '\0';
  write_line("variables", {names.size(), all.size()});
  write_bytes(all.data(), all.size());
}

void write_matrix(const std::string& variable, const MatrixSizes& sizes) {
  const std::string name = sent_name(variable);
  write_line("matrix", {name.size(), sizes.rows, sizes.columns, sizes.entries});
  write_bytes(name.data(), name.size());
}

void write(std::span<const std::uint32_t> numbers) {
  write_bytes(numbers.data(), numbers.size_bytes());
}

void write(std::span<const double> numbers) {
  write_bytes(numbers.data(), numbers.size_bytes());
}

void finish() {
  std::_Exit(std::fflush(stdout) == 0 ? EXIT_SUCCESS : EXIT_FAILURE);
}

}  // namespace arcslip::mat

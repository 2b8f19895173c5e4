// arcslip-mat FILE [VARIABLE] reads a matrix from a MATLAB file and writes it on standard output, for
// arcslip: lib/scene/files/mat_protocol.hpp. matio and HDF5 are not made for files that somebody else may
// have written: what is damaged, or made to do damage, ends this program and no other.

#include "answer.hpp"
#include "limits.hpp"
#include "read.hpp"

#include <cstdio>
#include <new>

#include <sys/stat.h>

int main(int argc, char** argv) {
  using namespace arcslip::mat;
  if (argc < 2 || argc > 3) {
    std::fputs("usage: arcslip-mat FILE [VARIABLE]\nWrites a matrix of a MATLAB file, for arcslip to read.\n",
               stderr);
    return 2;
  }
  struct stat file {};
  try {
    if (::stat(argv[1], &file) != 0 || !S_ISREG(file.st_mode))
      throw Fault("found no MATLAB file of version 5 or 7.3 that can be read; it may be damaged");
    const auto bytes = static_cast<std::size_t>(file.st_size);
    limit_resources(bytes);
    read(argv[1], bytes, argc > 2 ? argv[2] : "");
  } catch (const Fault& fault) {
    write_fault(fault);
  } catch (const std::bad_alloc&) {
    write_fault(Fault("found a file that takes more memory than so few bytes can hold; it may be damaged"));
  }
  finish();
}

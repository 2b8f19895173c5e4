// Computes the figures of Al Sayed et al. (2011): al_sayed_2011 SCENES FOLDER
// reads the scenes of examples/al_sayed_2011 and writes one data file for each figure.

#include "figures.hpp"

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s FOLDER_OF_SCENES FOLDER_FOR_DATA\n", argv[0]);
    return 1;
  }
  try {
    for (const auto group : {figures::contact, figures::responses, figures::energies, figures::components})
      for (const figures::DataFile& data : group(argv[1])) figures::write(data, argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}

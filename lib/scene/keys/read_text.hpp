#pragma once
// Reading of the bytes of a scene.

#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>

namespace arcslip::scene::file {

/// All bytes of a stream. Throws SceneError above largest_size, FileError if the stream fails.
std::string read_text(std::istream& in);

/// All bytes of a file, or of a pipe, which is opened once; `control` is called while waiting for its writer.
/// Throws the same, FileError if it cannot be opened, and control::Interrupted. noun: the kind of file, for
/// messages; largest: its size in bytes.
std::string read_text(const std::string& path, const control::Control& control,
                      const std::string& noun = "scene", std::size_t largest = largest_size);

}  // namespace arcslip::scene::file

#pragma once
// The bytes of a scene, before anything is made of them.

#include <arcslip/scene/stop_request.hpp>

#include <iosfwd>
#include <string>
#include <string_view>

namespace arcslip::scene::file {

/// All bytes of a stream. Throws SceneError where there are more than largest_size, FileError where the
/// stream fails.
std::string read_text(std::istream& in);

/// All bytes of a file, or of a pipe, which is opened once; while nobody writes into it, `stop` is asked.
/// Throws the same, FileError where it cannot be opened, and Interrupted. noun: what it is, for messages.
std::string read_text(const std::string& path, const StopRequest& stop, const std::string& noun = "scene");

}  // namespace arcslip::scene::file

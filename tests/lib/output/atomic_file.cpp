#include "catch.hpp"
#include "lib/output/support.hpp"

#include <arcslip/output/atomic_file.hpp>

#include <cerrno>
#include <csignal>
#include <string>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace arcslip::output;
using support::content;
using support::TemporaryFolder;

namespace {

/// No file may grow beyond this size while it lives, as on a disk that is full.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit old_{};
  void (*handler_)(int);
};

int error_of_writing(const std::string& path) {
  try {
    write_file(path, [](std::ostream& out) { out << std::string(1 << 20, 'x'); });
  } catch (const WriteError& error) {
    CHECK(std::string(error.what()).find("cannot write " + path + ": ") == 0);
    return error.error();
  }
  return 0;
}

}  // namespace

TEST_CASE("a file appears under its name when it is whole, and not before") {
  const TemporaryFolder folder;
  const std::string path = folder / "result.json";
  {
    AtomicFile file(path);
    file.stream() << "half" << std::flush;
    CHECK_FALSE(support::fs::exists(path));
    file.stream() << " and half";
    file.commit();
  }
  CHECK(content(path) == "half and half");
  CHECK(folder.files() == 1);
}

TEST_CASE("a file that is given up leaves nothing behind and the old one as it was") {
  const TemporaryFolder folder;
  const std::string path = folder / "result.json";
  write_file(path, [](std::ostream& out) { out << "old"; });
  {
    AtomicFile file(path);
    file.stream() << "new" << std::flush;
  }
  CHECK(content(path) == "old");
  CHECK_THROWS_AS(write_file(path, [](std::ostream& out) { out << "new", throw 1; }), int);
  CHECK(content(path) == "old");
  CHECK(folder.files() == 1);
}

TEST_CASE("a disk that fills up in the middle leaves nothing behind and the old file as it was") {
  const TemporaryFolder folder;
  const std::string path = folder / "result.json";
  write_file(path, [](std::ostream& out) { out << "old"; });
  {
    const FileSizeLimit limit(100'000);
    CHECK(error_of_writing(path) == EFBIG);
    CHECK(error_of_writing(folder / "other.json") == EFBIG);
  }
  CHECK(content(path) == "old");
  CHECK(folder.files() == 1);
}

TEST_CASE(
    "what cannot be written is an error with its cause, found by check_writable where it can be known "
    "before") {
  const TemporaryFolder folder;
  write_file(folder / "file", [](std::ostream& out) { out << "x"; });
  support::fs::create_directory(folder / "folder");
  struct Case {
    std::string path;
    int error;
    bool known_before;
  };
  const std::vector<Case> cases{{folder / "nowhere/result.json", ENOENT, true},
                                {folder / "file/result.json", ENOTDIR, true},
                                {folder / "folder", EISDIR, true},
                                {folder / "folder/", EISDIR, true},
                                {folder / std::string(300, 'n'), ENAMETOOLONG, true},
                                {"", ENOENT, true},
                                {"/dev/full", ENOSPC, false}};
  for (const Case& c : cases) {
    CAPTURE(c.path);
    if (!c.path.empty()) CHECK(error_of_writing(c.path) == c.error);
    if (c.known_before)
      CHECK_THROWS_AS(check_writable(c.path), WriteError);
    else
      CHECK_NOTHROW(check_writable(c.path));
  }
  CHECK_NOTHROW(check_writable(folder / "new.json"));
  CHECK(folder.files() == 2);
}

TEST_CASE("the message of a full disk says what to do") {
  CHECK_THROWS_WITH(
      write_file("/dev/full", [](std::ostream& out) { out << 'x'; }),
      "cannot write /dev/full: No space left on device (free some space there or write to another disk)");
}

TEST_CASE("a file keeps its permissions, a new one follows the mask") {
  const TemporaryFolder folder;
  const std::string path = folder / "result.json";
  const auto permissions = [&] {
    struct stat status {};
    ::stat(path.c_str(), &status);
    return status.st_mode & 0777u;
  };
  const mode_t mask = ::umask(027);
  write_file(path, [](std::ostream& out) { out << 1; });
  ::umask(mask);
  CHECK(permissions() == 0640u);
  ::chmod(path.c_str(), 0604);
  write_file(path, [](std::ostream& out) { out << 2; });
  CHECK(permissions() == 0604u);
}

TEST_CASE("a link stays a link to the new content") {
  const TemporaryFolder folder;
  support::fs::create_directory(folder / "folder");
  write_file(folder / "folder/real", [](std::ostream& out) { out << "old"; });
  support::fs::create_symlink("folder/real", folder / "link");
  write_file(folder / "link", [](std::ostream& out) { out << "new"; });
  CHECK(support::fs::is_symlink(folder / "link"));
  CHECK(content(folder / "folder/real") == "new");
}

TEST_CASE("a link to what is not there yet is followed, link by link, and one in a circle is refused") {
  const TemporaryFolder folder;
  support::fs::create_directory(folder / "folder");
  support::fs::create_symlink("folder/new", folder / "link");
  support::fs::create_symlink(folder / "link", folder / "another");
  CHECK(arcslip::output::written_file(folder / "another") ==
        arcslip::output::written_file(folder / "folder/new"));
  CHECK(arcslip::output::written_file(folder / "folder/../link") ==
        arcslip::output::written_file(folder / "folder/new"));
  CHECK(arcslip::output::written_file(folder / "folder/old") !=
        arcslip::output::written_file(folder / "folder/new"));
  write_file(folder / "another", [](std::ostream& out) { out << "new"; });
  CHECK(support::fs::is_symlink(folder / "link"));
  CHECK(content(folder / "folder/new") == "new");
  support::fs::create_symlink("circle", folder / "circle");
  CHECK_THROWS_AS(write_file(folder / "circle", [](std::ostream&) {}), WriteError);
}

TEST_CASE("what killed writers have left is cleared, and nothing of living ones or of others") {
  const TemporaryFolder folder;
  for (const char* name : {".arcslip-17-0.tmp", "a.svg.17.tmp", "b.c.png.4711.tmp", "a.svg", "a.tmp",
                           "a.svg.x.tmp", ".arcslip-x.tmp", "a.json.17.tmp"})
    write_file(folder / name, [](std::ostream& out) { out << "x"; });
  arcslip::output::AtomicFile living(folder / "living");
  arcslip::output::clear_temporaries(folder.path());
  CHECK(folder.files() == 7);
  CHECK(support::fs::exists(folder / "b.c.png.4711.tmp"));
  CHECK_FALSE(support::fs::exists(folder / ".arcslip-17-0.tmp"));
  living.stream() << "x";
  living.commit();
  CHECK(folder.files() == 8);
}

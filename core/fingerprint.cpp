#include "core/fingerprint.hpp"

#include <dlfcn.h>
#include <link.h>

#include <fmt/format.h>

#include "core/files.hpp"

namespace touchdown {

std::string Fingerprint::text() const { return fmt::format("{:016x}", state_); }

std::string file_fingerprint(const std::filesystem::path& file) {
  return Fingerprint().add(read_file(file)).text();
}

std::filesystem::path own_binary() {
  Dl_info info = {};
  void* map = nullptr;
  const bool found = ::dladdr1(reinterpret_cast<const void*>(&build_fingerprint), &info, &map,
                               RTLD_DL_LINKMAP) != 0;
  // The program itself has an empty name in the link map.
  const char* const library = found && map != nullptr ? static_cast<link_map*>(map)->l_name : "";
  return *library == '\0' ? "/proc/self/exe" : library;
}

std::string build_fingerprint() {
  static const std::string name = file_fingerprint(own_binary());
  return name;
}

std::string build_commit(const std::filesystem::path& program) {
  std::error_code ignored;
  const std::filesystem::path folder =
      std::filesystem::weakly_canonical(program, ignored).parent_path();
  // Relative to the program where it was built, and where it is installed.
  for (const char* share : {"share", "../share"}) {
    const std::filesystem::path note = folder / share / "touchdown" / "commit";
    if (!std::filesystem::is_regular_file(note, ignored)) continue;
    std::string commit = read_file(note);
    while (commit.ends_with('\n')) commit.pop_back();
    return commit;
  }
  return "unknown: the files that are installed with the program are missing";
}

}  // namespace touchdown

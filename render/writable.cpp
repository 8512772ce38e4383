#include "render/writable.hpp"

#include <unistd.h>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown {

void require_writable(const std::filesystem::path& path) {
  const std::filesystem::path absolute = std::filesystem::absolute(path);
  if (!absolute.has_filename() || std::filesystem::is_directory(absolute)) {
    throw Error(fmt::format("{}: cannot be written: it is a folder", path.string()));
  }
  // The nearest folder that exists decides.
  std::error_code ignored;
  std::filesystem::path folder = absolute.parent_path();
  while (!folder.empty() && folder != folder.root_path() &&
         std::filesystem::status(folder, ignored).type() == std::filesystem::file_type::not_found) {
    folder = folder.parent_path();
  }
  if (!std::filesystem::is_directory(folder, ignored)) {
    throw Error(
        fmt::format("{}: cannot be written: {} is not a folder", path.string(), folder.string()));
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw Error(
        fmt::format("{}: cannot be written: no permission in {}", path.string(), folder.string()));
  }
}

}  // namespace touchdown

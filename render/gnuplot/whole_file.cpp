#include "render/gnuplot/whole_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <map>
#include <string>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown::render {
namespace {

using namespace std::string_view_literals;

/// The last bytes of a complete file, by extension.
const std::map<std::string, std::string_view> file_endings = {
    {".png", "\0\0\0\0IEND\xae\x42\x60\x82"sv}, {".svg", "</svg>"sv}, {".pdf", "%%EOF"sv}};

[[noreturn]] void fail(const std::filesystem::path& final_path, int reason) {
  const std::string why = reason == 0 ? "" : ": " + std::generic_category().message(reason);
  throw Error(fmt::format("{}: cannot be written{}", final_path.string(), why));
}

/// Reports write errors that the disk reveals only when its buffers are flushed.
void flush(const std::filesystem::path& path, const std::filesystem::path& final_path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool flushed = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL);
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!flushed) fail(final_path, reason);
}

}  // namespace

void write_whole(const std::filesystem::path& path, std::string_view content,
                 const std::filesystem::path& final_path) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) fail(final_path, errno);
  flush(path, final_path);
}

bool is_whole(const std::filesystem::path& drawing) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(drawing, ignored)) return false;
  std::string content = read_file(drawing);
  while (content.ends_with('\n')) content.pop_back();
  return content.ends_with(file_endings.at(drawing.extension().string()));
}

void require_whole(const std::filesystem::path& drawing, const std::filesystem::path& final_path) {
  if (is_whole(drawing)) {
    flush(drawing, final_path);
    return;
  }
  throw Error(fmt::format("{}: cannot be written: gnuplot left it unfinished; is the disk full?",
                          final_path.string()));
}

}  // namespace touchdown::render

#include "render/gnuplot/whole_file.hpp"

#include <cerrno>
#include <fstream>
#include <map>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown::render {
namespace {

using namespace std::string_view_literals;

/// By extension.
const std::map<std::string, std::string_view> last_words = {
    {".png", "\0\0\0\0IEND\xae\x42\x60\x82"sv}, {".svg", "</svg>"sv}, {".pdf", "%%EOF"sv}};

}  // namespace

void write_whole(const std::filesystem::path& path, std::string_view content,
                 const std::filesystem::path& becomes) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (file) return;
  const std::string why = errno == 0 ? "" : ": " + std::generic_category().message(errno);
  throw Error(fmt::format("{}: cannot be written{}", becomes.string(), why));
}

bool is_whole(const std::filesystem::path& drawing) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(drawing, ignored)) return false;
  std::string content = read_file(drawing);
  while (content.ends_with('\n')) content.pop_back();
  return content.ends_with(last_words.at(drawing.extension().string()));
}

void require_whole(const std::filesystem::path& drawing, const std::filesystem::path& becomes) {
  if (is_whole(drawing)) return;
  throw Error(fmt::format("{}: cannot be written: gnuplot left it unfinished; is the disk full?",
                          becomes.string()));
}

}  // namespace touchdown::render

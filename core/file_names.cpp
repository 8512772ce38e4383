#include "core/file_names.hpp"

#include <algorithm>
#include <random>
#include <regex>
#include <unistd.h>

#include <fmt/format.h>

namespace touchdown {

namespace {

constexpr std::size_t longest_word =
    100;  // file names may have 255, and the word is only a part of one

bool is_control(unsigned char byte) { return byte < 0x20 || byte == 0x7f; }

/// U+0080 to U+009F, as UTF-8.
bool has_high_control(std::string_view text) {
  for (std::size_t i = 1; i < text.size(); ++i) {
    const auto second = static_cast<unsigned char>(text[i]);
    if (text[i - 1] == '\xc2' && second >= 0x80 && second < 0xa0) return true;
  }
  return false;
}

std::string part_name(const std::filesystem::path& name) {
  // Two machines that share a disk may have processes with the same number.
  return fmt::format(".{}.{}.{:08x}.part", name.string(), ::getpid(), std::random_device{}());
}

}  // namespace

bool is_name_word(std::string_view text) {
  return !text.empty() && text.size() <= longest_word &&
         text.find_first_of("/\\ .") == std::string_view::npos &&
         std::none_of(text.begin(), text.end(), is_control) && !has_high_control(text);
}

std::filesystem::path part_path(const std::filesystem::path& path) {
  return path.parent_path() / (part_name(path.stem()) + path.extension().string());
}

std::filesystem::path part_folder_path(const std::filesystem::path& path) {
  return path.parent_path() / part_name(path.filename());
}

bool has_shape(const std::string& name, const std::string& shape) {
  return std::regex_match(name, std::regex(shape));
}

bool is_part_file_name(const std::filesystem::path& name) {
  return has_shape(name.string(), R"(\..*\.\d+\.[0-9a-f]{4,8}\.part(\.[^.]+)?)");
}

bool is_part_folder_name(const std::filesystem::path& name) {
  return has_shape(name.string(), R"(\..*\.\d+\.[0-9a-f]{4,8}\.part)");
}

}  // namespace touchdown

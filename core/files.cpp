#include "core/files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <new>
#include <random>
#include <regex>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/terminal_text.hpp"

namespace touchdown {

namespace {

constexpr std::size_t longest_word =
    100;  // file names may have 255, and the word is only a part of one

std::string part_name(const std::filesystem::path& name) {
  // Two machines that share a disk may have processes with the same number.
  return fmt::format(".{}.{}.{:08x}.part", name.string(), ::getpid(), std::random_device{}());
}

/// Removes the temporary file unless it was moved away.
struct TemporaryFile {
  std::filesystem::path path;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

/// `number` is `errno` of the failed write; 0 if it is unknown.
std::string unwritable(const std::filesystem::path& path, int number) {
  return fmt::format("{}: cannot be written: {}", path.string(),
                     number == 0 ? "is the disk full?" : std::generic_category().message(number));
}

/// Flushes the file to disk. A delayed write error is reported here, and nowhere later.
void flush_to_disk(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  // EINVAL: the file system has nothing to flush to, as some in memory do.
  const bool flushed = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL);
  const std::error_code why(errno, std::generic_category());
  if (descriptor >= 0) ::close(descriptor);
  if (!flushed) throw std::filesystem::filesystem_error("fsync", path, why);
}

/// The temporary file would replace a device or a pipe, and not be written to it.
void require_replaceable(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_other(std::filesystem::status(path, ignored))) return;
  throw InputError(fmt::format("{}: is a device or a pipe, which a file would replace: name a file",
                               path.string()));
}

/// Makes a new folder beside `path` that only this user can access. An existing file, folder or
/// link of the same name is left alone.
std::filesystem::path new_part_folder(const std::filesystem::path& path) {
  for (;;) {
    std::filesystem::path folder = part_folder_path(path);
    if (::mkdir(folder.c_str(), S_IRWXU) == 0) return folder;
    const std::error_code why(errno, std::generic_category());
    if (why != std::errc::file_exists) {
      throw std::filesystem::filesystem_error("mkdir", folder, why);
    }
  }
}

/// By steps that throw nothing. A folder that another process removes meanwhile has no entries.
template <typename Iterator>
std::vector<std::filesystem::path> entries_by(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> entries;
  std::error_code error;
  Iterator entry(folder, error);
  while (!error && entry != Iterator()) {
    entries.push_back(entry->path());
    entry.increment(error);
  }
  const bool is_missing =
      error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory;
  if (error && !is_missing) complain_unreadable(folder.string(), error);
  std::sort(entries.begin(), entries.end());
  return entries;
}

}  // namespace

bool is_name_word(std::string_view text) {
  return !text.empty() && text.size() <= longest_word &&
         text.find_first_of("/\\ .") == std::string_view::npos && terminal_text(text) == text;
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

void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write) {
  require_replaceable(path);
  try {
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    const TemporaryFile temporary{part_path(path)};
    write(temporary.path);
    flush_to_disk(temporary.path);
    std::filesystem::rename(temporary.path, path);
  } catch (const std::filesystem::filesystem_error& error) {
    throw Error(fmt::format("{}: cannot be written: {}", path.string(), error.code().message()));
  }
}

void write_atomically(const std::filesystem::path& path, std::string_view content) {
  write_stream_atomically(path, [&](std::ostream& file) {
    errno = 0;
    file.write(content.data(), static_cast<std::streamsize>(content.size())).flush();
    if (!file) throw Error(unwritable(path, errno));
  });
}

void write_stream_atomically(const std::filesystem::path& path,
                             const std::function<void(std::ostream&)>& write) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    errno = 0;
    std::ofstream file(temporary, std::ios::binary);
    if (!file) throw Error(unwritable(path, errno));
    try {
      write(file);
    } catch (const Error&) {
      if (file) throw;
      throw Error(unwritable(path, errno));
    }
    errno = 0;
    file.close();
    if (!file) throw Error(unwritable(path, errno));
  });
}

void append_to_file(const std::filesystem::path& path, std::string_view content) {
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  constexpr mode_t mode = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH;
  const int file =
      ::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW, mode);
  if (file < 0) throw Error(unwritable(path, errno));
  errno = 0;
  const ssize_t written = ::write(file, content.data(), content.size());
  const int number = errno;
  ::close(file);
  if (written != static_cast<ssize_t>(content.size())) throw Error(unwritable(path, number));
}

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool is_there(const std::filesystem::path& path) noexcept {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

bool is_folder(const std::filesystem::path& path) noexcept {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

std::uintmax_t size_of_file(const std::filesystem::path& path) noexcept {
  std::error_code missing;
  const std::uintmax_t size = std::filesystem::file_size(path, missing);
  return missing ? 0 : size;
}

std::vector<std::filesystem::path> entries_in(const std::filesystem::path& folder) {
  return entries_by<std::filesystem::directory_iterator>(folder);
}

std::vector<std::filesystem::path> entries_below(const std::filesystem::path& folder) {
  return entries_by<std::filesystem::recursive_directory_iterator>(folder);
}

std::filesystem::path temporary_folder() {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (!error) return folder;
  const char* const named = std::getenv("TMPDIR");
  throw InputError(fmt::format("{}: no folder for temporary files (TMPDIR): {}",
                               named == nullptr ? "/tmp" : named, error.message()));
}

std::filesystem::path absolute_path(const std::filesystem::path& path) {
  if (path.is_absolute()) return path;
  std::error_code error;
  const std::filesystem::path here = std::filesystem::current_path(error);
  if (error) {
    throw Error(fmt::format("{}: no working directory: {}", path.string(), error.message()));
  }
  return here / path;
}

void complain_unreadable(const std::string& name, const std::error_code& why,
                         std::string_view done) {
  if (why == std::errc::not_enough_memory) throw std::bad_alloc();
  const std::string message = fmt::format("{}: cannot be {}: {}", name, done, why.message());
  const bool is_of_the_system = why == std::errc::too_many_files_open ||
                                why == std::errc::too_many_files_open_in_system ||
                                why == std::errc::io_error;
  if (is_of_the_system) throw Error(message);
  throw InputError(message);
}

void require_regular_file(const std::filesystem::path& path) {
  using Type = std::filesystem::file_type;
  std::error_code error;
  const Type type = std::filesystem::status(path, error).type();
  if (type == Type::regular) return;
  if (type == Type::none) complain_unreadable(path.string(), error, "opened");
  std::string reason = "is not a regular file";
  if (type == Type::not_found) reason = "no such file";
  if (type == Type::directory) reason = "is a folder, expected a file";
  throw InputError(fmt::format("{}: {}", path.string(), reason));
}

std::string read_file(const std::filesystem::path& path) {
  require_regular_file(path);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) complain_unreadable(path.string(), {errno, std::generic_category()}, "opened");
  std::string content;
  std::array<char, 16384> block;
  do {
    file.read(block.data(), block.size());
    content.append(block.data(), static_cast<std::size_t>(file.gcount()));
  } while (file);
  // A read error looks like the end of the file.
  if (file.bad()) throw Error(fmt::format("{}: cannot be read", path.string()));
  return content;
}

void require_writable(const std::filesystem::path& path) {
  require_replaceable(path);
  std::error_code ignored;
  const std::filesystem::path absolute = std::filesystem::absolute(path, ignored);
  if (!absolute.has_filename() || std::filesystem::is_directory(absolute, ignored)) {
    throw Error(fmt::format("{}: cannot be written: it is a folder", path.string()));
  }
  // It is written under a longer name first.
  std::error_code problem;
  (void)std::filesystem::symlink_status(part_path(absolute), problem);
  if (problem == std::errc::filename_too_long ||
      problem == std::errc::too_many_symbolic_link_levels) {
    throw Error(fmt::format("{}: cannot be written: {}", path.string(), problem.message()));
  }
  // The nearest existing folder must be writable.
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

PartFolder::PartFolder(const std::filesystem::path& stem) {
  try {
    const std::filesystem::path whole = absolute_path(stem);
    std::filesystem::create_directories(whole.parent_path());
    path_ = new_part_folder(whole);
  } catch (const std::filesystem::filesystem_error& error) {
    throw Error(fmt::format("{}: cannot be written: {}", stem.string(), error.code().message()));
  }
}

PartFolder::~PartFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace touchdown

#include "core/files.hpp"

#include <fcntl.h>
#include <fstream>
#include <random>
#include <sstream>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown {

namespace {

/// Removes the temporary file unless it was moved away.
struct TemporaryFile {
  std::filesystem::path path;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

void flush_to_disk(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write) {
  try {
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    // Processes on two machines that share a disk may have the same number.
    // The extension stays last: encoders and plotters choose their format by it.
    const std::filesystem::path name =
        fmt::format(".{}.{}.{:08x}.part{}", path.stem().string(), ::getpid(),
                    std::random_device{}(), path.extension().string());
    const TemporaryFile temporary{path.parent_path() / name};
    write(temporary.path);
    flush_to_disk(temporary.path);
    std::filesystem::rename(temporary.path, path);
  } catch (const std::filesystem::filesystem_error& error) {
    throw Error(fmt::format("{}: cannot be written: {}", path.string(), error.code().message()));
  }
}

void write_atomically(const std::filesystem::path& path, std::string_view content) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream file(temporary, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file) throw Error(fmt::format("{}: cannot be written", path.string()));
  });
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    throw InputError(fmt::format("{}: no such file", path.string()));
  }
  std::stringstream content;
  content << file.rdbuf();
  return std::move(content).str();
}

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

PartFolder::PartFolder(const std::filesystem::path& stem) {
  try {
    const std::filesystem::path parent = std::filesystem::absolute(stem).parent_path();
    std::filesystem::create_directories(parent);
    path_ = parent / fmt::format(".{}.{}.part", stem.filename().string(), ::getpid());
    std::filesystem::create_directory(path_);
  } catch (const std::filesystem::filesystem_error& error) {
    throw Error(fmt::format("{}: cannot be written: {}", stem.string(), error.code().message()));
  }
}

PartFolder::~PartFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace touchdown

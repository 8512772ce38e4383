#include "logs/bags/files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"
#include "core/stop.hpp"

namespace touchdown::logs {

RandomFile::RandomFile(const std::filesystem::path& path, std::string name,
                       const std::atomic<bool>* stop)
    : name_(std::move(name)), stop_(stop) {
  require_file(path);
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);  // NOLINT
  const off_t end = descriptor_ < 0 ? -1 : ::lseek(descriptor_, 0, SEEK_END);
  if (end < 0) {
    const std::error_code why(errno, std::generic_category());
    if (descriptor_ >= 0) ::close(descriptor_);
    complain_unreadable(name_, why, "opened");
  }
  size_ = static_cast<std::uint64_t>(end);
}

RandomFile::~RandomFile() { ::close(descriptor_); }

void RandomFile::read(std::uint64_t offset, std::uint64_t size, std::string& bytes) const {
  end_if(stop_);
  const std::uint64_t there = offset < size_ ? size_ - offset : 0;
  bytes.resize(std::min(size, there));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::pread(descriptor_, bytes.data() + done, bytes.size() - done,
                                  static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw Error(fmt::format("{}: cannot be read: {}", name_, std::strerror(errno)));
    done += static_cast<std::size_t>(count);
  }
}

}  // namespace touchdown::logs

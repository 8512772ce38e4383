#include "recordings/bags/storage/temporary_file.hpp"

#include <cstdlib>
#include <string>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown::recordings {

TemporaryFile::TemporaryFile() {
  std::string name = (temporary_folder() / "touchdown_bag_XXXXXX").string();
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) throw Error(fmt::format("{}: cannot be made", name));
  ::close(descriptor);
  path_ = name;
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace touchdown::recordings

#include "recordings/mapping/mapped_log.hpp"

#include <fstream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "recordings/mapping/conversion.hpp"

namespace touchdown::recordings {

MappedLog::MappedLog(const std::filesystem::path& log, const std::filesystem::path& mapping,
                     const std::function<void()>& check_stop)
    : folder_(temporary_folder() / "touchdown_mapped_log") {
  std::ofstream stream(path(), std::ios::binary);
  const ConvertedLog converted = convert_log(log, mapping, stream, check_stop, false);
  stream.close();
  if (!stream) {
    throw Error(fmt::format("{}: cannot be written: is the disk full?", path().string()));
  }
  warnings_ = warnings_of(converted, log.string());
}

}  // namespace touchdown::recordings

#include "cli/estimate/converted_input.hpp"

#include <fstream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "recordings/mapping/conversion.hpp"

namespace touchdown::cli {

ConvertedInput::ConvertedInput(const std::string& log, const std::string& mapping,
                               const CliSession& session)
    : folder_(std::filesystem::temp_directory_path() / "touchdown_estimate") {
  std::ofstream stream(path(), std::ios::binary);
  const recordings::ConvertedLog converted = recordings::convert_log(log, mapping, stream, [&] {
    if (*session.stop) throw Stopped("stopped; nothing was written");
  });
  stream.close();
  if (!stream) {
    throw Error(fmt::format("{}: cannot be written: is the disk full?", path().string()));
  }
  for (const std::string& warning : recordings::warnings_of(converted, log)) {
    print_message(fmt::format("touchdown: {}\n", warning));
  }
}

}  // namespace touchdown::cli

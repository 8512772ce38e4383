#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchdown {

/// A file that a program reads; "-" is standard input.
struct InputFile {
  std::filesystem::path path;
  std::string what;  ///< "log", "model", "scenario"
};

/// Checks all outputs before the first one is opened. `outputs` are all files that will be written;
/// "-" is standard output. Files are compared by device and inode, so links and other spellings
/// count as the same file. Errors: `InputError` for
/// - an output that is one of the inputs;
/// - two outputs that are the same file;
/// - an existing output that is not a file, such as a device: writing atomically would replace it;
/// and `Error` for an output that cannot be written.
void check_outputs(const std::vector<InputFile>& inputs,
                   const std::vector<std::filesystem::path>& outputs);

/// Errors: `InputError` unless the output has one of the `extensions`, such as ".mpack". Readers
/// choose the format by the extension. `what` names the output: "a recording".
void require_extension(const std::filesystem::path& output,
                       const std::vector<std::string>& extensions, const std::string& what);

}  // namespace touchdown

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

/// To be called before the first output is opened. A file is known by its device and inode,
/// whatever its name: another spelling, a link. `outputs` are all files that will be written; "-"
/// is standard output. Errors: `InputError` for an output that is one of the inputs, two outputs
/// that are one file, and an output that is there and is no file, such as a device: to write a file
/// whole or not at all is to put a new one in its place.
void check_outputs(const std::vector<InputFile>& inputs,
                   const std::vector<std::filesystem::path>& outputs);

/// Errors: `InputError` unless the output's name ends with one of these, such as ".mpack": who
/// reads the file goes by its name. `what` it is: "a recording".
void require_extension(const std::filesystem::path& output,
                       const std::vector<std::string>& extensions, const std::string& what);

}  // namespace touchdown

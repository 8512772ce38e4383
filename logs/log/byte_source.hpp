#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace touchdown::logs {

/// Reads the next bytes of a stream as soon as they are available. Fills the beginning of the span
/// and returns the number of bytes; 0 at the end.
using ByteSource = std::function<std::size_t(std::span<char>)>;

/// A file, or standard input for "-". The stream ends within 0.1 s after `stop` becomes true, even
/// while it waits for bytes. `stop` may be null, and must outlive the source. Errors: `InputError`
/// when the file cannot be opened or read.
ByteSource file_source(const std::filesystem::path& path, const std::atomic<bool>* stop = nullptr);

/// Errors: `InputError` with the command that decompresses the file, if it is compressed with gzip.
void require_no_gzip(const std::filesystem::path& path);

}  // namespace touchdown::logs

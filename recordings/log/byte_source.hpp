#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace touchdown::recordings {

/// Gives the next bytes of a stream as soon as there are any: fills the beginning of the span and
/// returns how many; 0 at the end.
using ByteSource = std::function<std::size_t(std::span<char>)>;

/// A file, or standard input for "-". The stream ends, within 0.1 s even if it waits for bytes,
/// once `stop` (which may be null, and must outlive the source) is true. Errors: `InputError` when
/// it cannot be opened or read.
ByteSource file_source(const std::filesystem::path& path, const std::atomic<bool>* stop = nullptr);

/// Bytes that are at hand. The stream ends once `stop`, as above, is true.
ByteSource memory_source(std::shared_ptr<const std::string> bytes,
                         const std::atomic<bool>* stop = nullptr);

}  // namespace touchdown::recordings

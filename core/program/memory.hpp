#pragma once

namespace touchdown {

/// Keeps freed memory in the process. Runs allocate tens of megabytes each, and the system clears
/// returned pages one by one when they are needed again. Call it before any allocation.
void keep_freed_memory() noexcept;

/// Returns freed memory to the system all the same, after work that left much of it in pieces.
void release_free_memory() noexcept;

}  // namespace touchdown

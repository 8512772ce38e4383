#pragma once

namespace touchdown {

/// Lets what is freed stay with the process: runs come and go by tens of megabytes, and what goes
/// back to the system is cleared page by page when it is fetched again. To be called before
/// anything is allocated.
void keep_freed_memory() noexcept;

}  // namespace touchdown

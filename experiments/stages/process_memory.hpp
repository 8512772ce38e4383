#pragma once

namespace touchdown::experiments {

/// Memory of this process (bytes), as the system counts it; zero where it is unknown.
double memory_in_use();
/// The most since the start of the process, or since the last `reset_peak_memory`.
double peak_memory();
void reset_peak_memory();

/// Returns freed memory to the system; programs keep it otherwise (cli/main.cpp).
void release_free_memory();

}  // namespace touchdown::experiments

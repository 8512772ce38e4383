#pragma once

#include <cstdlib>

namespace touchdown {

/// Whether `make nightly` asks for every draw.
inline bool draws_all() { return std::getenv("TOUCHDOWN_LONG") != nullptr; }

/// How many of `all` random draws a test makes: a tenth of them before a change lands.
inline int draws(int all) { return draws_all() ? all : (all + 9) / 10; }

}  // namespace touchdown

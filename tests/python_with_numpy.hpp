#pragma once

#include <cstdlib>
#include <string>

namespace touchdown {

/// A Python interpreter that has NumPy, or empty.
inline std::string python_with_numpy() {
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const std::string command = std::string(python) + " -c 'import numpy' 2>/dev/null";
    if (std::system(command.c_str()) == 0) return python;
  }
  return {};
}

}  // namespace touchdown

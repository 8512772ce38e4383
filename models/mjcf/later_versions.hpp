#pragma once

#include <string>
#include <string_view>

namespace touchdown::models {

/// The version of MuJoCo that introduced the element or attribute which an error message of MuJoCo
/// calls unrecognized: " (`dampratio` came with MuJoCo 3; this is MuJoCo 2.2.2)". Empty for other
/// messages.
std::string later_version_text(std::string_view message);

}  // namespace touchdown::models

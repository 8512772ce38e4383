#include "render/phase_style.hpp"

namespace touchdown {

PhaseStyle style_of(Phase phase) {
  switch (phase) {
    case Phase::rolling:
      return {"rolling", "#d4d7da"};
    case Phase::unloading_1:
      return {"unloading, 150–60 ms", "#fde0b0"};
    case Phase::unloading_2:
      return {"unloading, 60–20 ms", "#f2ae3d"};
    case Phase::unloading_3:
      return {"unloading, 20–0 ms", "#b86b00"};
    case Phase::flight:
      return {"flight", "#0a5a9c"};
    case Phase::impact_1:
      return {"impact, 0–15 ms", "#00563f"};
    case Phase::impact_2:
      return {"impact, 15–60 ms", "#2fa884"};
    case Phase::impact_3:
      return {"impact, 60–150 ms", "#b5dfd0"};
    case Phase::held:
      return {"held", "#8d3b72"};
    case Phase::carried:
      return {"carried", "#dba3c4"};
    case Phase::left_only:
      return {"left wheel only", "#56b4e9"};
    case Phase::right_only:
      return {"right wheel only", "#a9d8f3"};
  }
  return {"", "#000000"};
}

}  // namespace touchdown

#include "simulators/collision_model.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <mujoco/mjxmacro.h>

#include "core/error.hpp"

namespace touchdown::simulators {

namespace {

/// Moves the rows `kept` of a table to its front.
template <typename T>
void keep_rows(T* table, int columns, const std::vector<int>& kept) {
  T* to = table;
  for (const int row : kept) {
    const T* from = table + static_cast<std::ptrdiff_t>(row) * columns;
    if (from != to) std::copy_n(from, columns, to);
    to += columns;
  }
}

}  // namespace

bool collides(const mjModel& model, int geom) {
  return model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0;
}

models::MjModelPtr collision_model(const mjModel& model) {
  models::MjModelPtr copy(mj_copyModel(nullptr, &model));
  if (!copy) throw Error("MuJoCo could not copy the model: out of memory");
  std::vector<int> kept;
  for (int body = 0; body < model.nbody; ++body) {
    const int first = model.body_geomadr[body];
    const auto kept_before = static_cast<int>(kept.size());
    for (int geom = first; geom < first + model.body_geomnum[body]; ++geom) {
      if (collides(model, geom)) kept.push_back(geom);
    }
    copy->body_geomnum[body] = static_cast<int>(kept.size()) - kept_before;
    copy->body_geomadr[body] = copy->body_geomnum[body] > 0 ? kept_before : -1;
  }
  // MuJoCo's own list of the model's tables; only those with one row per geom are filtered.
#undef MJ_M
#define MJ_M(n) copy->n
#define X(type, name, rows, columns)                        \
  if constexpr (std::string_view(#rows) == "ngeom") {       \
    keep_rows(copy->name, static_cast<int>(columns), kept); \
  }
  MJMODEL_POINTERS
#undef X
#undef MJ_M
  copy->ngeom = static_cast<int>(kept.size());
  return copy;
}

}  // namespace touchdown::simulators

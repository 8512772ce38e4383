#include "estimator/models/compiled.hpp"

#include <string>

namespace touchdown {

ModelArrays arrays_of(std::span<const CompiledArray> model) {
  ModelArrays arrays;
  for (const CompiledArray& from : model) {
    ModelArray& array = arrays[from.name];
    array.shape = {from.rows};
    if (from.columns > 0) array.shape.push_back(from.columns);
    const std::size_t count = array.rows() * array.columns();
    if (from.text != nullptr) {
      array = array_of_text({from.text, count});
    } else if (from.floats != nullptr) {
      array.data.assign(from.floats, from.floats + count);
    } else {
      array.data.assign(from.doubles, from.doubles + count);
    }
  }
  return arrays;
}

std::unique_ptr<ContactEstimator> make_estimator(std::span<const CompiledArray> model,
                                                 const ModelUse& use) {
  return make_estimator(arrays_of(model), use);
}

}  // namespace touchdown

#include "fields/load_fields.hpp"

#include "base/errors.hpp"
#include "fields/nodal_field.hpp"

namespace mortise {

void load_fields(const Scene& scene) {
  for (const FieldSpec& spec : scene.fields) {
    if (spec.function->at) continue;
    try {
      spec.function->at = nodal_field(spec.key, spec.file, spec.values, spec.component);
    } catch (const InputError& error) {
      throw SceneError(spec.key + ": " + error.what());
    }
  }
}

}  // namespace mortise

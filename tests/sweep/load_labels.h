// A session's way to a volume made in memory, as if its file had been dropped, and to fields set by name.
#pragma once

#include <string>
#include <vector>

#include "io/volume/write_volume.h"
#include "pipeline/session.h"

namespace voxtet::sweep {

inline constexpr const char* kNotThere = "the volume is not there: set VOXTET_DATA";

/// The affine is rounded to single precision, as NIfTI stores it.
inline Status load_labels(const LabelVolume& volume, Session& session) {
  const Result<Bytes> file = write_nifti(volume, false);
  if (!file) return file.error();
  return session.load_volume({"volume.nii", *file, {}});
}

/// Sets fields of the recipe, each written as path=value.
inline Status set_fields(const std::vector<std::string>& fields, Session& session) {
  for (const std::string& field : fields) {
    const std::size_t equals = field.find('=');
    const Result<Recipe> recipe = with_field(session.recipe(), field.substr(0, equals),
                                             equals == std::string::npos ? "" : field.substr(equals + 1));
    if (!recipe) return recipe.error();
    if (Status set = session.set_recipe(*recipe); !set) return set;
  }
  return std::monostate{};
}

}  // namespace voxtet::sweep

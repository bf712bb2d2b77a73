#include "pipeline/sources/source_volume.h"

#include <string_view>

#include "base/base64url.h"
#include "io/volume/coded/coded_volume.h"
#include "phantom/make_phantom.h"
#include "types/stage_names.h"

namespace voxtet {

Result<LabelVolume> make_volume(const Source& source) {
  if (source.phantom) return make_phantom(*source.phantom);
  const Result<std::string> bytes =
      from_base64url(source.inlined->data, std::string(kVolumeStage), "source.inline.data");
  if (!bytes) return bytes.error();
  Result<LabelVolume> volume =
      decode_volume({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()});
  if (volume) return volume;
  Error error = volume.error();
  error.message = "source.inline.data: " + error.message;
  return error;
}

Result<Recipe> with_inline_volume(Recipe recipe, const LabelVolume& volume) {
  const Result<Bytes> bytes = code_volume(volume);
  if (!bytes) return bytes.error();
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  const std::string name = recipe.source.file ? recipe.source.file->name : "volume";
  recipe.source = {};
  recipe.source.inlined = InlineSource{name, base64url(text)};
  recipe.legend = legend_of(with_legend(volume.infos, recipe.legend));
  return recipe;
}

}  // namespace voxtet
